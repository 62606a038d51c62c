"""Define what a recording holds: gzipped lines of JSON, one frame each (``zcat FILE | jq``).

header   all that is configured: enough to build the same core again
state    the core's whole state before the tick that follows
tick     what one step was given and the command it gave
gap      ticks not recorded because the pipe was full; it lies between a header and a state

A segment begins with a header and a state, so a file may begin at any header. Floats are written in
their shortest exact form and come back bit for bit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

from pydantic import ConfigDict, Field, TypeAdapter

from bridge.core import BridgeState, CoreConfig, Inbox
from wire import DriveCommand, Mode

_STRICT = ConfigDict(extra="forbid", allow_inf_nan=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Header:
    """Begin a segment. ``kind`` comes first in every frame: the writer looks for it there."""

    kind: Literal["header"] = "header"
    version: Literal[1] = 1
    config: CoreConfig
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class StateFrame:
    """Give the state before the next tick."""

    kind: Literal["state"] = "state"
    state: BridgeState
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class TickFrame:
    """Give one tick's arguments and what came of them."""

    kind: Literal["tick"] = "tick"
    tick: int
    now_s: float
    inbox: Inbox
    command: DriveCommand | None
    mode: Mode
    reasons: tuple[str, ...]
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Gap:
    """Say how many ticks are missing here."""

    kind: Literal["gap"] = "gap"
    ticks: int
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


Frame = Header | StateFrame | TickFrame | Gap

FRAMES: TypeAdapter[Frame] = TypeAdapter(Annotated[Frame, Field(discriminator="kind")])
_HEADER = TypeAdapter(Header)
_STATE = TypeAdapter(StateFrame)
_TICK = TypeAdapter(TickFrame)
_GAP = TypeAdapter(Gap)


def tick_line(frame: TickFrame) -> bytes:
    """Return one tick's line; about 20 us, 70 us with a scan."""
    return _TICK.dump_json(frame) + b"\n"


def segment_lines(config: CoreConfig, missing: int, state: BridgeState) -> bytes:
    """Return what a segment begins with, told how many ticks are missing before it."""
    lines = [_HEADER.dump_json(Header(config=config))]
    if missing:
        lines.append(_GAP.dump_json(Gap(ticks=missing)))
    lines.append(_STATE.dump_json(StateFrame(state=state)))
    return b"\n".join(lines) + b"\n"
