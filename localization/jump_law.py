"""Let no good message displace the robot unless messages of quality 0 came before it.

The bridge compares each good localization with the good one before: more than 0.1 m or 5 degrees at
the robot's place is POSE_JUMP, which takes the grant while the robot may be at full speed. Said
poor first, the robot holds by POSE_LOST and stands when its new pose comes. Pure.
"""

from __future__ import annotations

from math import radians
from typing import TYPE_CHECKING

from localization.quality import POOR_QUALITY
from wire import compose, distance, wrap

if TYPE_CHECKING:
    from wire import Pose2

DECLARED_M, DECLARED_RAD = 0.08, radians(4.0)
"""Four fifths of what the bridge calls a jump."""
DECLARING = 2
"""Messages of quality 0 before a displaced pose, so that one may be lost on the way."""


class JumpLaw:
    """Hold what was said last."""

    def __init__(self) -> None:
        self._good: Pose2 | None = None
        self._poor = 0

    def clear(self) -> None:
        """Begin anew: what is said next is of another ``odom`` and compares with nothing."""
        self._good, self._poor = None, 0

    def apply(self, odom_in_map: Pose2, base_in_odom: Pose2, quality: float) -> tuple[Pose2, float]:
        """Return the transform and quality that may be said now."""
        if not quality >= POOR_QUALITY:
            self._poor += 1
            return odom_in_map, quality
        if self._good is not None and self._poor < DECLARING:
            before = compose(self._good, base_in_odom)
            after = compose(odom_in_map, base_in_odom)
            turn_rad = abs(wrap(after.yaw_rad - before.yaw_rad))
            if not (distance(before, after) <= DECLARED_M and turn_rad <= DECLARED_RAD):
                self._poor += 1
                return self._good, 0.0
        self._good, self._poor = odom_in_map, 0
        return odom_in_map, quality
