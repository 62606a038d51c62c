"""Follow the robot through a home that no map shows yet, by the last keyframes' returns.

Each scan is aligned with a distance field of what the latest keyframes saw; a new keyframe is
taken every half metre or half radian. After a turn, or where the fit is poor, a window around the
predicted pose is searched by correlation first: without that, revisits of one recorded office were
off by 0.45 m in place of 0.05. Short enough for a real-time thread; loops are found elsewhere,
and their correction is told to :meth:`ScanTracker.correct`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import TYPE_CHECKING

import numpy as np

from localization.correlative_search import WINDOW_M, WINDOW_RAD
from localization.mapping.keyframes import keyframe_of, pose_after, pose_between
from localization.mapping.local_map import LocalMap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.mapping.carry_law import CarryLaw
    from localization.mapping.keyframes import Keyframe

    Floats = NDArray[np.float64]

KEYFRAME_M, KEYFRAME_RAD = 0.5, 0.5
REFERENCES = 25
"""Keyframes matched against: a room's worth."""
REACH_M = 8.5
RESOLUTION_M = 0.05
TURNED_RAD = radians(6.0)
DOUBTED_FIT = 0.8
BETTER_FIT = 0.02
ENOUGH_FIT = 0.4
"""Share of returns that lie on what was seen before. At a new door half of them are of a new room;
below this nothing holds the scan, and odometry is believed."""
FEW_RETURNS = 30
SIGMA_M, SIGMA_RAD = 0.01, 0.004
"""Of a keyframe in the one before it, matched; repeatability seen in the simulated home."""
BLIND_SIGMA_PER_M, BLIND_SIGMA_PER_RAD = 0.1, 0.1
"""By odometry alone: wheels of 5 % and some slip."""


@dataclass(frozen=True, slots=True)
class KeyframeLink:
    """Hold a new keyframe and where it stands in the chain."""

    keyframe: Keyframe
    relation: Floats | None
    """In the keyframe before it; None for the first of a run."""
    sigma_m: float
    sigma_rad: float


class ScanTracker:
    """Hold the pose in a growing map, by scans against the latest keyframes."""

    def __init__(
        self,
        start: Floats | None = None,
        known: Sequence[Keyframe] = (),
        carry_law: CarryLaw | None = None,
        lidar_m: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        """Begin at a pose.

        Args:
            start: x, y, yaw in ``map``; the frame's origin if left out.
            known: all keyframes of the map so far, which the new ones go on from.
            carry_law: what scans count, of a robot that somebody may carry; None: all that fit.
            lidar_m: where the lidar is in ``base``; needed by the law alone.
        """
        self.pose = np.zeros(3) if start is None else np.array(start, np.float64)
        self.fit = 1.0
        """Of the newest scan: the share of its returns that lie on what was seen before."""
        self.is_placed = False
        """Whether the newest scan holds the pose."""
        self._carry_law, self._lidar_m = carry_law, lidar_m
        self._carried: Floats | None = None
        self._references = _nearest(known, self.pose)
        """Keyframes by their number; the last is the end of the chain."""
        self._count = len(known)
        self._seen: LocalMap | None = None
        self._turned_rad = 0.0
        self._blind_m = self._blind_rad = 0.0
        """Odometry's share of the way since the last keyframe."""
        if known:
            self._renew_map()

    def predict(self, carried: Floats) -> Floats:
        """Return the pose in ``map`` when odometry is at ``carried``."""
        if self._carried is None:
            return self.pose
        return pose_after(self.pose, pose_between(self._carried, carried))

    def use_scan(self, points_m: Floats, carried: Floats, stamp_s: float) -> KeyframeLink | None:
        """Place a scan; return a keyframe where one is due.

        Args:
            points_m: returns in ``base``, deskewed, shape (n, 2).
            carried: x, y, yaw by odometry at the same instant.
            stamp_s: the instant.
        """
        carried = np.array(carried, np.float64)
        step = np.zeros(3) if self._carried is None else pose_between(self._carried, carried)
        predicted = pose_after(self.pose, step)
        self._carried = carried
        if self._carry_law is not None:
            self._carry_law.carry(step)
        self.is_placed = len(points_m) >= FEW_RETURNS
        if not self.is_placed:
            self._coast(predicted, step)
            return None
        if self._seen is not None:
            self._turned_rad = abs(float(step[2]))
            pose, self.fit = self._match(points_m, predicted)
            self.is_placed = self.fit >= ENOUGH_FIT and self._counts(points_m, predicted, pose)
            if self.is_placed:
                self.pose = pose
            else:
                self._coast(predicted, step)
            if self._carry_law is not None and not self.is_placed:
                # Its score is told at the pose that is kept; nothing is written from there.
                self.fit = self._seen.fit(points_m, predicted)
                self._carry_law.refuse()
                return None
        if self._carry_law is not None:
            self._carry_law.count(self.fit)
        return self._keyframe(points_m, stamp_s)

    def forget_odometry(self) -> None:
        """Join the next scan on where the robot stands: odometry has begun another frame."""
        self._carried = None
        if self._carry_law is not None:
            self._carry_law.join()

    def correct(self, poses: Floats) -> None:
        """Take the poses that keyframes have once a loop is closed; the robot moves along.

        Args:
            poses: x, y, yaw in ``map`` by keyframe, shape (n, 3). Keyframes that were taken since
                move with the last of these, as one piece.
        """
        if not len(poses) or not self._references:
            return
        last = len(poses) - 1
        held = [number for number in self._references if number <= last]
        if not held:
            return
        before, after = self._references[held[-1]].pose, np.array(poses[held[-1]])
        for number, keyframe in self._references.items():
            if number <= last:
                pose = poses[number]
            else:
                pose = pose_after(after, pose_between(before, keyframe.pose))
            self._references[number] = keyframe.move_to(pose)
        self.pose = pose_after(after, pose_between(before, self.pose))
        self._renew_map()

    def _match(self, points_m: Floats, predicted: Floats) -> tuple[Floats, float]:
        if self._seen is None:
            return predicted, 0.0
        pose, fit, _ = self._seen.align(points_m, predicted)
        if self._turned_rad > TURNED_RAD or fit < DOUBTED_FIT:
            start = self._seen.search(points_m, predicted, WINDOW_M, WINDOW_RAD)
            other, other_fit, _ = self._seen.align(points_m, start)
            if other_fit > fit + BETTER_FIT:
                return other, other_fit
        return pose, fit

    def _counts(self, points_m: Floats, predicted: Floats, pose: Floats) -> bool:
        """Return whether odometry allows a match, and the map where the robot was lost."""
        if self._carry_law is None or self._seen is None:
            return True
        bound, off = self._carry_law.bound_match(), pose_between(predicted, pose)
        near = np.hypot(off[0], off[1]) <= bound.off_m and abs(off[2]) <= bound.off_rad
        if not (near and self.fit >= bound.fit):
            return False
        if self.fit >= bound.sure_fit:
            return True
        return self._seen.passed_share(points_m, self._lidar_m, pose) <= bound.passed

    def _coast(self, predicted: Floats, step: Floats) -> None:
        self.pose = predicted
        self._blind_m += float(np.hypot(step[0], step[1]))
        self._blind_rad += abs(float(step[2]))

    def _keyframe(self, points_m: Floats, stamp_s: float) -> KeyframeLink | None:
        relation = None
        if self._references:
            relation = pose_between(self._references[self._count - 1].pose, self.pose)
            far = np.hypot(relation[0], relation[1]) >= KEYFRAME_M
            if not (far or abs(relation[2]) >= KEYFRAME_RAD):
                return None
        keyframe = keyframe_of(self.pose, points_m, stamp_s)
        while len(self._references) >= REFERENCES:
            del self._references[next(iter(self._references))]
        self._references[self._count] = keyframe
        self._count += 1
        self._renew_map()
        link = KeyframeLink(
            keyframe,
            relation,
            SIGMA_M + BLIND_SIGMA_PER_M * self._blind_m,
            SIGMA_RAD + BLIND_SIGMA_PER_RAD * self._blind_rad,
        )
        self._blind_m = self._blind_rad = 0.0
        return link

    def _renew_map(self) -> None:
        self._seen = LocalMap([*self._references.values()], self.pose[:2], REACH_M, RESOLUTION_M)


def _nearest(known: Sequence[Keyframe], pose: Floats) -> dict[int, Keyframe]:
    """Return the keyframes around a pose by their number, and always the last."""
    gaps_m = [float(np.hypot(*(one.pose[:2] - pose[:2]))) for one in known]
    near = np.argsort(gaps_m, kind="stable")[: REFERENCES - 1].tolist()
    return {number: known[number] for number in sorted({*near, *range(len(known))[-1:]})}
