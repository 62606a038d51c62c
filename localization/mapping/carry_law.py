"""Tell a robot that drove from one that was carried while its map grows.

A growing map shows no more than what was seen so far, and rooms look alike: of a scan from another
room half the returns lie on what was seen in the first; a keyframe from there makes it all of them,
and the robot is sure of a pose that is metres off. Thus a scan counts only where wheels and gyro
may have brought the robot, and a lost one is taken up only where the map agrees much as before.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, radians
from typing import TYPE_CHECKING

from localization.correlative_search import WINDOW_M, WINDOW_RAD

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

STEP_M, STEP_RAD = 0.15, radians(9.0)
"""Between what odometry and a scan say of one step. While sites were explored it was never above
0.01 m and 0.01 rad; a robot that is pushed stays below them from scan to scan."""
BACK_M, BACK_RAD = 0.3, radians(15.0)
"""How well a person puts a robot back where it was."""
PER_M, RAD_PER_M, PER_RAD = 0.15, 0.1, 0.15
"""What wheels and gyro err by on their way: three times 5 %, and a slip."""
JOINED_M, JOINED_RAD = 0.35, radians(11.0)
"""What a robot may roll and turn between two frames of odometry, unseen by either."""
LOST_SCANS = 3
AGREEING_FIT, LESS_FIT = 0.8, 0.1
"""To take up a lost robot: so much of the scan, or little less than before it was lost."""
MOST_PASSED = 0.05
"""Of its beams: what they pass through, they would have seen."""
SUDDEN_FIT, SUDDEN_PASSED = 0.2, 0.15
"""Of a tracked robot's scan that fits so much less than the one before: behind a door, or with a
person beside it, few of its beams pass through a wall."""
MOST_SUDDEN_FIT, FIT_PER_M = 0.35, 1.0
"""No door opens up so much of a new room between two scans, unless the robot drove on meanwhile."""


@dataclass(frozen=True, slots=True)
class MatchBound:
    """Bound where and how well a scan must match to count."""

    off_m: float
    off_rad: float
    """From where odometry has carried the robot."""
    fit: float
    sure_fit: float
    """From here on a match counts however many beams pass through what was seen."""
    passed: float
    """The most that may, of one that fits less."""


class CarryLaw:
    """Follow how far odometry may err since a scan counted, and count those that did not."""

    def __init__(self) -> None:
        self._metres = self._turned_rad = 0.0
        self._joined = False
        self._refused = 0
        self._fit = 0.0

    @property
    def is_lost(self) -> bool:
        """Return whether so many scans in a row did not count that the robot may be anywhere."""
        return self._refused >= LOST_SCANS

    def join(self) -> None:
        """Take that odometry has begun another frame: the way between the two is unknown."""
        self._joined = True

    def carry(self, step: Floats) -> None:
        """Take odometry's step since the last scan: x [m], y [m], yaw [rad]."""
        self._metres += hypot(step[0], step[1])
        self._turned_rad += abs(float(step[2]))

    def bound_match(self) -> MatchBound:
        """Return where the next scan counts."""
        least_m, least_rad = (BACK_M, BACK_RAD) if self.is_lost else (STEP_M, STEP_RAD)
        if self._joined:
            least_m, least_rad = least_m + JOINED_M, least_rad + JOINED_RAD
        off_m = least_m + PER_M * self._metres
        off_rad = least_rad + RAD_PER_M * self._metres + PER_RAD * self._turned_rad
        return MatchBound(
            off_m=min(off_m, WINDOW_M),
            off_rad=min(off_rad, WINDOW_RAD),
            fit=self._least_fit(),
            sure_fit=2.0 if self.is_lost else self._fit - SUDDEN_FIT,
            passed=MOST_PASSED if self.is_lost else SUDDEN_PASSED,
        )

    def _least_fit(self) -> float:
        if self.is_lost:
            return min(AGREEING_FIT, self._fit - LESS_FIT)
        return self._fit - MOST_SUDDEN_FIT - FIT_PER_M * self._metres

    def count(self, fit: float) -> None:
        """Take a scan that counts, by its fit."""
        self._metres = self._turned_rad = 0.0
        self._joined, self._refused, self._fit = False, 0, fit

    def refuse(self) -> None:
        """Take a scan that does not count."""
        self._refused += 1
