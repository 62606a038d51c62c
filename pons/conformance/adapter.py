"""Define the kit's needs of a bridge under test. Small, so that another vendor's bridge fits in.

A bridge that speaks this project's wire needs no adapter: ``pons conformance --bridge MODULE``
starts it in the place of ours. One that speaks something else is given this face: what is said to
it arrives as the wire's bytes, what it says is returned as the wire's status.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Self

    from pons.conformance.bounds import MotionBounds
    from pons.conformance.record import DriveRecord
    from wire import OpKind, Status


class CannotTest(Exception):
    """The bridge can't be tested as it is; nothing was sent to it, or it never got ready."""


class Adapter(Protocol):
    """Be one bridge with its simulated robot, seen from outside."""

    name: str
    bounds: MotionBounds
    record: DriveRecord

    def __enter__(self) -> Self:
        """Start it, or join it; return when it speaks and its robot reports. Raises CannotTest."""
        ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
        /,
    ) -> None:
        """Leave nothing running that was started."""
        ...

    def status(self) -> Status | None:
        """Return its newest word; never waits."""
        ...

    def say(self, key: str, payload: bytes) -> None:
        """Send bytes on a key (``cmd/external``) as they are; never waits."""
        ...

    def operate(self, kind: OpKind) -> bytes:
        """Make an operator's request, with a proof; return its bytes."""
        ...

    def helper(self) -> tuple[str, ...]:
        """Return the command of a worker process with a link of its own to this bridge."""
        ...

    def door(self) -> str:
        """Return the unix socket path or host:port at which the bridge listens."""
        ...
