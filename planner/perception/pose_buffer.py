"""Say where the robot was at the instant of a picture. Pure: told messages, asked by stamp.

Stamps are one host's monotonic clock [s]; they align a picture with odometry, they prove no
freshness. ``base`` in ``odom`` comes at 50 Hz and is interpolated; ``odom`` in ``map`` wanders
slowly and is interpolated where two answers lie around the instant, else the nearest one counts.
Law: what another odometry, another map or a poor localization says is no pose. A model may think
for a minute, and odometry's history is five seconds: a picture that is handed out keeps the stance
of its instant for as long as it may be asked about.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import deque
from dataclasses import dataclass
from itertools import islice
from math import hypot
from typing import TYPE_CHECKING

from wire import Pose2, compose, wrap

if TYPE_CHECKING:
    from planner.perception.interfaces import Picture
    from wire import Localization, Odometry

KEPT = 256
"""Odometry at 50 Hz for 5 s: a picture of half a second, thought upon for a second, lies within."""
KEPT_PLACED = 128
GAP_S = 0.25
"""Between two odometries farther apart nobody knows how the robot moved."""
AHEAD_S = 0.06
"""So far past the newest odometry its speeds carry; beyond, nothing is known."""
PLACED_S = 0.4
"""An answer of localization counts for pictures so far from it; the bridge allows 0.3 s."""
GOOD_QUALITY = 0.5
SIGMA_M = 0.03
"""Of a good localization; the stand-in's error is 0.02 m on each axis."""
SIGMA_RAD = 0.012
MOVING_MPS, MOVING_RADPS = 0.02, 0.05
"""Slower than this the robot stands."""
STAMP_S = 0.01
"""A stamp's own error: exposure, and the clock of a camera's driver."""


@dataclass(frozen=True, slots=True)
class Stance:
    """Say where the robot stood, and how surely (one standard deviation)."""

    base_in_map: Pose2
    sigma_m: float = SIGMA_M
    sigma_rad: float = SIGMA_RAD


class Poses:
    """Keep the latest messages of odometry and localization."""

    def __init__(self, map_id: str) -> None:
        self._map_id = map_id
        self._odom_id: str | None = None
        self._moved: deque[Odometry] = deque(maxlen=KEPT)
        self._placed: deque[Localization] = deque(maxlen=KEPT_PLACED)

    def odometry(self, odometry: Odometry) -> None:
        """Take the bridge's odometry; another odom_id is another frame and starts anew."""
        if odometry.odom_id != self._odom_id:
            self._odom_id = odometry.odom_id
            self._moved.clear()
            self._placed.clear()
        if not self._moved or odometry.stamp_s > self._moved[-1].stamp_s:
            self._moved.append(odometry)

    def localization(self, localization: Localization) -> None:
        """Take an answer of localization; one on another map or of poor quality ends the old."""
        good = localization.map_id == self._map_id and localization.quality >= GOOD_QUALITY
        if not good:
            self._placed.clear()
        elif not self._placed or localization.stamp_s > self._placed[-1].stamp_s:
            self._placed.append(localization)

    @property
    def moving(self) -> bool:
        """Tell whether the robot moved when odometry spoke last; unheard, it stands."""
        if not self._moved:
            return False
        twist = self._moved[-1].twist
        return abs(twist.v_mps) > MOVING_MPS or abs(twist.w_radps) > MOVING_RADPS

    @property
    def speed_mps(self) -> float:
        """Return how fast the robot drove ahead when odometry spoke last; unheard, it stands."""
        return self._moved[-1].twist.v_mps if self._moved else 0.0

    def at(self, stamp_s: float) -> Stance | None:
        """Return where the robot was; None where odometry or localization do not tell."""
        moved, placed = self._moved_at(stamp_s), self._placed_at(stamp_s)
        if moved is None or placed is None:
            return None
        base_in_odom, v_mps, w_radps = moved
        return Stance(
            compose(placed, base_in_odom),
            hypot(SIGMA_M, v_mps * STAMP_S),
            hypot(SIGMA_RAD, w_radps * STAMP_S),
        )

    def _moved_at(self, stamp_s: float) -> tuple[Pose2, float, float] | None:
        """Return base in odom with its speeds."""
        index = bisect_left(self._moved, stamp_s, key=lambda odometry: odometry.stamp_s)
        if index == len(self._moved):
            return self._ahead(stamp_s)
        after = self._moved[index]
        speeds = after.twist.v_mps, after.twist.w_radps
        if after.stamp_s == stamp_s:
            return after.base_in_odom, *speeds
        if index == 0:
            return None  # older than all that is kept
        before = self._moved[index - 1]
        span_s = after.stamp_s - before.stamp_s
        if not span_s <= GAP_S:
            return None
        share = (stamp_s - before.stamp_s) / span_s
        return blend(before.base_in_odom, after.base_in_odom, share), *speeds

    def _ahead(self, stamp_s: float) -> tuple[Pose2, float, float] | None:
        if not self._moved:
            return None
        newest = self._moved[-1]
        ahead_s, twist = stamp_s - newest.stamp_s, newest.twist
        if not ahead_s <= AHEAD_S:
            return None
        step = Pose2(twist.v_mps * ahead_s, 0.0, twist.w_radps * ahead_s)
        return compose(newest.base_in_odom, step), twist.v_mps, twist.w_radps

    def _placed_at(self, stamp_s: float) -> Pose2 | None:
        """Return odom in map, of this odometry alone."""
        known = [said for said in self._placed if said.odom_id == self._odom_id]
        index = bisect_left(known, stamp_s, key=lambda said: said.stamp_s)
        around = list(islice(known, max(0, index - 1), index + 1))
        near = [said for said in around if abs(said.stamp_s - stamp_s) <= PLACED_S]
        if len(near) < 2:
            return near[0].odom_in_map if near else None
        before, after = near
        share = (stamp_s - before.stamp_s) / (after.stamp_s - before.stamp_s)
        return blend(before.odom_in_map, after.odom_in_map, share)


def blend(a: Pose2, b: Pose2, share: float) -> Pose2:
    """Go ``share`` of the way from a to b, turning the shorter way."""
    return Pose2(
        a.x_m + share * (b.x_m - a.x_m),
        a.y_m + share * (b.y_m - a.y_m),
        wrap(a.yaw_rad + share * wrap(b.yaw_rad - a.yaw_rad)),
    )


KEPT_STANCES = 128
SETTLED_S = 0.3
"""So long after a picture, odometry and localization of its instant have come, or never will."""

Shot = tuple[str, int]


class PendingPoses:
    """Hold the stances of pictures by boot and seq of their camera."""

    def __init__(self) -> None:
        self._stances: dict[Shot, Stance] = {}
        self._waiting: dict[Shot, float] = {}

    def note(self, picture: Picture) -> None:
        """Take note that somebody has this picture."""
        shot = _shot_of(picture)
        if shot not in self._stances:
            self._waiting[shot] = picture.taken_s

    def settle(self, poses: Poses, now_s: float) -> None:
        """Look up the stances that are known by now."""
        for shot, taken_s in tuple(self._waiting.items()):
            if now_s - taken_s >= SETTLED_S:
                del self._waiting[shot]
                self._keep(shot, poses.at(taken_s))

    def stance(self, picture: Picture, poses: Poses) -> Stance | None:
        """Return where the robot was when a picture was taken."""
        return self._stances.get(_shot_of(picture)) or poses.at(picture.taken_s)

    def _keep(self, shot: Shot, stance: Stance | None) -> None:
        if stance is not None:
            self._stances[shot] = stance
            if len(self._stances) > KEPT_STANCES:
                del self._stances[next(iter(self._stances))]


def _shot_of(picture: Picture) -> Shot:
    return picture.color.header.boot_id, picture.color.header.seq
