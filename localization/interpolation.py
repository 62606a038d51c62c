"""Keep stamped poses for a moment and interpolate between them. Pure.

Stamps are one host's monotonic clock [s]; they only align two sources, never prove freshness.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import deque

from wire import Pose2, wrap

KEPT = 128
"""Poses kept: 2.5 s at 50 Hz, far more than any two sources lie apart."""


class PoseTrack:
    """Hold the last poses of one thing, by rising stamp."""

    def __init__(self) -> None:
        self._poses: deque[tuple[float, Pose2]] = deque(maxlen=KEPT)

    @property
    def newest_s(self) -> float | None:
        """Return the newest stamp; None while empty."""
        return self._poses[-1][0] if self._poses else None

    def add(self, stamp_s: float, pose: Pose2) -> None:
        """Append a pose; one that is not newer than the last is ignored."""
        if not self._poses or stamp_s > self._poses[-1][0]:
            self._poses.append((stamp_s, pose))

    def clear(self) -> None:
        """Forget all: another boot's poses do not join on."""
        self._poses.clear()

    def at(self, stamp_s: float) -> Pose2 | None:
        """Return the interpolated pose at a time; None outside of the poses held."""
        if not self._poses or not self._poses[0][0] <= stamp_s <= self._poses[-1][0]:
            return None
        index = bisect_left(self._poses, stamp_s, key=lambda entry: entry[0])
        after_s, after = self._poses[index]
        if after_s == stamp_s:
            return after
        before_s, before = self._poses[index - 1]
        return blend(before, after, (stamp_s - before_s) / (after_s - before_s))


def blend(a: Pose2, b: Pose2, share: float) -> Pose2:
    """Go ``share`` of the way from a to b, turning the shorter way."""
    return Pose2(
        a.x_m + share * (b.x_m - a.x_m),
        a.y_m + share * (b.y_m - a.y_m),
        wrap(a.yaw_rad + share * wrap(b.yaw_rad - a.yaw_rad)),
    )
