"""Describe one fault of a brain, or of the link to it, and the claims that must then hold."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pons.conformance.driver import pack

if TYPE_CHECKING:
    from pons.conformance.driver import Breaker, Sent
    from pons.conformance.fault_context import FaultContext
    from wire import OwnerKind, Status

X: OwnerKind = "external"
W: OwnerKind = "planner"
COMMANDS = frozenset({"cmd/external", "cmd/waypoints"})

VELOCITY_S, PATH_S, LOST_S, USED_S = 0.25, 0.5, 0.3, 1.0
"""After so long the bridge must have begun to stop: since the status on which the newest good
velocity, or horizon, was cut; since the newest echoed status; since the newest used one."""
AT_ONCE_S = 0.03

STALE = {X: VELOCITY_S, W: PATH_S}
"""The owner lives, but no good command comes any more."""
SILENT = {X: VELOCITY_S, W: LOST_S}
"""The owner shows no sign of life any more."""
DRIVES_ON: dict[OwnerKind, float] = {}
"""Nobody asks that it stand; all else must hold."""


@dataclass(frozen=True, slots=True)
class Fault:
    """Describe one fault."""

    name: str
    what: str
    play: Callable[[FaultContext], None]
    """Prepares, calls ``begin`` and, unless the return is the end, ``end``."""
    noticed_s: dict[OwnerKind, float]
    """Where it must stand: within which the bridge must have begun to stop."""
    kinds: tuple[OwnerKind, ...] = (X, W)
    rest: bool = False
    """It begins standing, and must not move at all."""
    quick: tuple[OwnerKind, ...] = ()
    """Part of the short run with these brains."""


Message = dict[str, Any]
Change = Callable[[Message, "Status"], object]
"""Takes a good command; returns what is sent in its place: bytes, or what JSON can hold."""


def commands(change: Change) -> Breaker:
    """Break the commands; hellos, grants and heartbeats stay good."""

    def breaker(said: list[tuple[str, Message]], status: Status) -> list[Sent]:
        return [
            (key, _bytes(change(dict(message), status)) if key in COMMANDS else pack(message))
            for key, message in said
        ]

    return breaker


def everything(change: Change) -> Breaker:
    """Break every message."""

    def breaker(said: list[tuple[str, Message]], status: Status) -> list[Sent]:
        return [(key, _bytes(change(dict(message), status))) for key, message in said]

    return breaker


def _bytes(what: object) -> bytes:
    return what if isinstance(what, bytes) else pack(what)


def spoil(
    make: Callable[[FaultContext], Breaker], *, stand: bool = True
) -> Callable[[FaultContext], None]:
    """Return the play of a brain whose words go wrong, until it stands or for a while."""

    def play(stage: FaultContext) -> None:
        stage.begin(make(stage))
        if stand:
            stage.until_standing()
        else:
            stage.wait()

    return play
