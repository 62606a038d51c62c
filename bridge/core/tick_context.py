"""Carry one tick through the core, and judge ages and windows on its clock.

``TickContext`` holds settings, the next state, arrivals and messages to send; it lives for one
``step`` and is then dropped. Every part of the core takes it; each field of ``s`` is assigned to in
one module alone, which tests/bridge/core/laws/test_wings.py lists and holds.

Ages run on this clock alone: no sender can make anything younger. A command names the newest status
its origin had seen; its age runs from when that status was sent. A sensor's age runs from receipt,
or from its stamp where that is on this host's clock and older. A window fills while trouble is seen
and drains four times as slowly, so that dither hides nothing: a detector that flickers between yes
and no, one to one, still fills its window, in 8/3 of the time.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from wire import STATUS_RING, Mode

if TYPE_CHECKING:
    from bridge.core.config import CoreConfig
    from bridge.core.geometry.fence import FenceGrid
    from bridge.core.inbox import Inbox
    from bridge.core.state import BridgeState
    from wire import Pose2

DRAIN = 0.25
LONGEST_S = 0.05
"""What one tick may add: a loop that slept has not watched."""


def fill(level_s: float, dt_s: float, top_s: float, *, dirty: bool) -> float:
    """Return the window's new level [s], from 0 to ``top_s``."""
    step_s = min(max(dt_s, 0.0), LONGEST_S)
    level_s = level_s + step_s if dirty else max(0.0, level_s - DRAIN * step_s)
    return min(level_s, top_s)


def append_sent(ring: tuple[float, ...], sent_s: float) -> tuple[float, ...]:
    """Return the ring of sending times with one more, the oldest let go."""
    return (*ring[-(STATUS_RING - 1) :], sent_s)


def sent_at(ring: tuple[float, ...], newest_seq: int, seen: int) -> float | None:
    """Return when the status ``seen`` was sent; None if never, or longer ago than the ring."""
    back = newest_seq - seen
    if 0 <= back < len(ring):
        return ring[-1 - back]
    return None


def sensor_age_s(now_s: float, received_s: float, stamp_s: float, *, same_host: bool) -> float:
    """Return the age of a reading [s]: the larger of the two, a stamp of the future ignored."""
    if same_host and stamp_s < received_s:
        return now_s - stamp_s
    return now_s - received_s


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
    def fence(self) -> FenceGrid | None:
        """Return the fence less what people drew on the map: what holds for every motion."""
        fence, text = self.config.fence, self.s.marks.text
        return fence.with_marks(text) if fence is not None and text else fence

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
