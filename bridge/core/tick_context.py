"""Carry one tick through the core: settings, the next state, arrivals, messages to send.

Lives for one ``step`` and is then dropped. Every part of the core takes it; each field of ``s`` is
assigned to in one module alone, which tests/bridge/core/laws/test_wings.py lists and holds.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from wire import Mode

if TYPE_CHECKING:
    from bridge.core.config import CoreConfig
    from bridge.core.inbox import Inbox
    from bridge.core.state import BridgeState
    from wire import Pose2

POWERED = frozenset({Mode.HOLD, Mode.ACTIVE, Mode.TELEOP, Mode.STOPPING})
MOVING = frozenset({Mode.ACTIVE, Mode.TELEOP})
"""Output follows from the mode alone: outside of these the target is zero."""

STANDING_MPS = 0.02
STANDING_RADPS = 0.05


@dataclass(slots=True)
class TickContext:
    """Hold one tick in the making."""

    config: CoreConfig
    s: BridgeState
    """The draft: written here, unseen by whoever holds the state of the last tick."""
    inbox: Inbox
    now_s: float
    dt_s: float
    events: list[tuple[str, str]] = field(default_factory=list)
    """Code and detail, in order."""
    reasons: list[str] = field(default_factory=list)
    dropped: int = 0
    """Messages of this tick that were not obeyed."""
    stopped: bool = False
    """A stop was obeyed in this tick: what came with it is void."""
    room_m: float | None = None
    """Path in which the robot must be able to stand; None where nothing is in the way."""
    robot_in_map: Pose2 | None = None
    """None while localization is not to be trusted."""

    @property
    def epoch(self) -> str:
        """Return the epoch as it is on the wire."""
        return f"{self.config.boot}-{self.s.epoch_no}"

    @property
    def is_powered(self) -> bool:
        """Tell whether the mode keeps the drive powered."""
        return self.s.mode in POWERED

    @property
    def is_moving(self) -> bool:
        """Tell whether the mode follows anybody."""
        return self.s.mode in MOVING

    def say(self, code: str, detail: str = "") -> None:
        """Add an event."""
        self.events.append((code, detail))

    def drop(self, code: str) -> None:
        """Count a message that is not obeyed, and keep the reason for the record."""
        self.dropped += 1
        self.reasons.append(code)

    def still_for(self, seconds: float) -> bool:
        """Tell whether a reporting drive has been standing for so long."""
        drive = self.s.drive
        return (
            drive.still_since_s is not None
            and drive.received_s is not None
            and self.now_s - drive.received_s <= 0.25
            and self.now_s - drive.still_since_s >= seconds - 1e-9
        )
