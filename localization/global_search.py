"""Find a robot on a whole map from one scan, and tell whether the answer may be believed.

A coarse lattice (0.2 m, 3 degrees) rates every free position; the best of them, well apart, are
aligned by Gauss-Newton and scored (localization.quality). The answer is sure where the best place
leads every other by 0.30 of the score: two equal rooms are never sure, and ask for a person.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import TYPE_CHECKING

import numpy as np

from localization.correlative_search import LatticeSearch, WindowSearch
from localization.quality import scores
from localization.scan_matching import align, thin

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from localization.distance_field import DistanceField

    Floats = NDArray[np.float64]
    Bools = NDArray[np.bool_]

STEP_M, STEP_RAD = 0.2, radians(3.0)
SIGMA_M = 0.15
BEAMS = 90
ALIGNED_BEAMS = 120
RATED, ALIGNED, KEPT = 1000, 120, 5
"""Lattice poses looked at, aligned, and given in the answer."""
APART_M, APART_RAD = 0.5, radians(15.0)
"""Poses closer than both are one place."""
SEPARATE_M, SEPARATE_RAD = 0.35, radians(10.0)
"""Starts closer than both would end in one place."""
SURE_LEADS = ((0.9, 0.06), (0.8, 0.12), (0.6, 0.20))
"""What a best score must lead the next place's by. The less is unexplained, the smaller a lead is
enough: what could make the true place look worse than a wrong one, things that the map does not
know, would be seen here too. 0 wrong and sure of 4 600 searches (ADR 0039)."""
CLEAR_M = 0.15
"""A robot's centre is never nearer to an obstacle of the map."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """Hold one place where the robot may be."""

    pose: tuple[float, float, float]
    """x [m], y [m], yaw [rad] of ``base`` in ``map``."""
    score: float


def is_sure(candidates: tuple[Candidate, ...]) -> bool:
    """Return whether the first candidate is good and leads the second far enough."""
    if not candidates:
        return False
    best = candidates[0].score
    lead = best - (candidates[1].score if len(candidates) > 1 else 0.0)
    return any(best >= score and lead >= least for score, least in SURE_LEADS)


@dataclass(frozen=True, slots=True)
class SearchArea:
    """Bound a search to where a person says the robot is."""

    pose: tuple[float, float, float]
    """x [m], y [m], yaw [rad] of ``base`` in ``map``."""
    radius_m: float
    any_heading: bool
    outline: tuple[tuple[float, float], ...] = ()
    """In ``map`` [m]; empty: all of the circle."""


class GlobalSearch:
    """Search one map."""

    def __init__(self, field: DistanceField) -> None:
        self.field = field
        self._lattice = LatticeSearch(field, step_m=STEP_M, sigma_m=SIGMA_M)
        self._window = WindowSearch.of_field(field)
        row, column = self._lattice.positions()
        standable = field.free[row, column] & (field.distance_m[row, column] >= CLEAR_M)
        self._standable = np.flatnonzero(standable)
        x_m, y_m = field.cell_centre(row.ravel(), column.ravel())
        self._xy_m = np.column_stack((x_m, y_m))[self._standable]

    def find(
        self, points_m: Floats, lidar_m: tuple[float, float], near: SearchArea | None = None
    ) -> tuple[Candidate, ...]:
        """Return the places that fit a scan best, best first: on the whole map, or in an area.

        Args:
            points_m: returns in ``base``, shape (n, 2).
            lidar_m: where the lidar is in ``base``.
            near: where a person says the robot is, and which way it looks if the person knows.
        """
        if near is None:
            return self.everywhere(points_m, lidar_m)
        if near.any_heading:
            return self.find_within(points_m, lidar_m, near)
        return self.around(points_m, lidar_m, np.array(near.pose), near.radius_m)

    def find_within(
        self, points_m: Floats, lidar_m: tuple[float, float], near: SearchArea
    ) -> tuple[Candidate, ...]:
        """Return at most five places in an area that fit best, whichever way the robot looks."""
        away_m = np.hypot(*(self._xy_m - np.array(near.pose[:2])).T)
        inside = away_m <= near.radius_m
        if near.outline:
            inside &= is_inside(self._xy_m, near.outline)
        if not len(points_m) or not inside.any():
            return ()
        starts = self._rated_starts(thin(points_m, BEAMS), inside)
        found = self._judge(points_m, lidar_m, starts)
        if near.outline:
            found = tuple(
                one for one in found if is_inside(np.array([one.pose[:2]]), near.outline)[0]
            )
        return self._near(found, near.pose, near.radius_m)

    def everywhere(self, points_m: Floats, lidar_m: tuple[float, float]) -> tuple[Candidate, ...]:
        """Return the places that fit a scan best, best first, at most five.

        Args:
            points_m: returns in ``base``, shape (n, 2).
            lidar_m: where the lidar is in ``base``.
        """
        if not len(points_m) or not len(self._standable):
            return ()
        return self._judge(points_m, lidar_m, self._rated_starts(thin(points_m, BEAMS)))

    def around(
        self, points_m: Floats, lidar_m: tuple[float, float], pose: Floats, radius_m: float
    ) -> tuple[Candidate, ...]:
        """Return the best place within a radius of a pose that a person named, or none."""
        if not len(points_m):
            return ()
        start = self._window.best(points_m, pose, radius_m, radians(30.0))
        found = self._judge(points_m, lidar_m, np.stack((start, pose)))
        return self._near(found, (float(pose[0]), float(pose[1]), float(pose[2])), radius_m)[:1]

    def _near(
        self, found: tuple[Candidate, ...], pose: tuple[float, float, float], radius_m: float
    ) -> tuple[Candidate, ...]:
        """Return those of the places that lie within a radius."""
        return tuple(
            one
            for one in found
            if np.hypot(one.pose[0] - pose[0], one.pose[1] - pose[1]) <= radius_m
        )

    def _rated_starts(self, beams: Floats, inside: Bools | None = None) -> Floats:
        """Return the lattice's best poses, none close to another that is better."""
        places = slice(None) if inside is None else inside
        standable, xy_m = self._standable[places], self._xy_m[places]
        yaws = np.arange(0.0, 2 * np.pi, STEP_RAD)
        ratings = np.stack([self._lattice.rate(beams, yaw).ravel()[standable] for yaw in yaws])
        flat = ratings.ravel()
        count = min(RATED, flat.size)
        top = np.argpartition(flat, -count)[-count:]
        top = top[np.argsort(flat[top], kind="stable")[::-1]]
        turn, place = np.divmod(top, ratings.shape[1])
        poses = np.column_stack((xy_m[place], yaws[turn]))
        return keep_separate(poses, SEPARATE_M, SEPARATE_RAD, ALIGNED)

    def _judge(
        self, points_m: Floats, lidar_m: tuple[float, float], starts: Floats
    ) -> tuple[Candidate, ...]:
        beams = thin(points_m, ALIGNED_BEAMS)
        wide = align(self.field, beams, starts, loss_m=0.3, iterations=5).poses
        poses = align(self.field, beams, wide, iterations=10).poses
        rated = scores(self.field, beams, lidar_m, poses)
        order = np.argsort(rated, kind="stable")[::-1]
        best = keep_separate(poses[order], APART_M, APART_RAD, KEPT)
        best = keep_separate(align(self.field, points_m, best).poses, APART_M, APART_RAD, KEPT)
        rated = scores(self.field, points_m, lidar_m, best)
        order = np.argsort(rated, kind="stable")[::-1]
        return tuple(
            Candidate((float(x_m), float(y_m), float(yaw)), float(score))
            for (x_m, y_m, yaw), score in zip(best[order], rated[order], strict=True)
        )


def is_inside(points_m: Floats, outline: tuple[tuple[float, float], ...]) -> Bools:
    """Return which points, shape (n, 2), lie inside an outline, by how many edges are crossed."""
    inside = np.zeros(len(points_m), np.bool_)
    x_m, y_m = points_m[:, 0], points_m[:, 1]
    for (ax, ay), (bx, by) in zip(outline, (*outline[1:], outline[0]), strict=True):
        crosses = (ay > y_m) != (by > y_m)
        with np.errstate(divide="ignore", invalid="ignore"):
            at_m = ax + (y_m - ay) * (bx - ax) / (by - ay)
        inside ^= crosses & (x_m < at_m)
    return inside


def keep_separate(poses: Floats, apart_m: float, apart_rad: float, most: int) -> Floats:
    """Return poses, best first, without those close to an earlier one in place and in yaw."""
    kept: list[int] = []
    left = np.ones(len(poses), bool)
    for index in range(len(poses)):
        if not left[index]:
            continue
        kept.append(index)
        if len(kept) == most:
            break
        offset = poses[:, :2] - poses[index, :2]
        turn = np.abs((poses[:, 2] - poses[index, 2] + np.pi) % (2 * np.pi) - np.pi)
        left &= (np.hypot(offset[:, 0], offset[:, 1]) > apart_m) | (turn > apart_rad)
    return poses[kept]
