"""Hold one tick's decision: the next state, at most one command, and the messages to send."""

from __future__ import annotations

from bridge.core.state import BridgeState
from wire import DriveCommand, Event, Odometry, Status
from wire.value import value


@value
class Decision:
    """Answer one step. The shell sends its set parts and feeds ``state`` to the next step."""

    state: BridgeState
    command: DriveCommand | None
    """Exactly one per tick; None only while SELFTEST proves the drive's own time-out."""
    status: Status | None
    odometry: Odometry | None
    events: tuple[Event, ...]
    reasons: tuple[str, ...]
    """What bounded the command and why anything was refused or dropped, for the record."""
