"""Hold what the detectors of motion, sight, power and floods remember. Levels are windows [s]."""

from __future__ import annotations

from dataclasses import dataclass

from wire import Pose2
from wire.value import value


@value
class Sent:
    """Bound what was sent to both wheels [m/s at the rim] since a time."""

    since_s: float
    left_low: float
    left_high: float
    right_low: float
    right_high: float


@dataclass(slots=True)
class Watch:
    """Remember how long each trouble has been seen."""

    blind_s: float = 0.0
    yaw_s: float = 0.0
    runaway_s: float = 0.0
    sent: tuple[Sent, ...] = ()
    """Oldest first; together they reach as far back as a drive may still follow."""
    stuck_s: float = 0.0
    progress_at: Pose2 | None = None
    """Where in ``odom`` the robot was when it last got on; None where nothing is to be got on."""
    progress_s: float = 0.0
    stuck_at_s: tuple[float, ...] = ()
    """When it was found stuck, the last three times."""
    peak_s: float = 0.0
    heat_a2s: float = 0.0
    """Square of the current beyond what may flow for ever, added up [A^2 s]."""
    low_s: float = 0.0
    empty_s: float = 0.0
    zone_mps: float | None = None
    """Speed of the slowest zone that the robot is in."""
    outside: bool = False
    """A hand took the robot out of the fence, and it has not been well inside since."""


@value
class Flood:
    """Count what came on each command key, in this half window and in the one before."""

    half_since_s: float = 0.0
    counts: tuple[int, ...] = ()
    before: tuple[int, ...] = ()
    level_s: float = 0.0
    key: str = ""
    """Which key was over its limit last."""
