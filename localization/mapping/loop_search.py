"""Recognize a place seen long ago, by correlating a scan with the keyframes around it.

A candidate is near by the graph's own poses, as far as the chain may have drifted since. It counts
only where nearly all of the scan lies on what was seen there; what still slips through the pose
graph's kernel holds off.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import TYPE_CHECKING

import numpy as np

from localization.mapping.keyframes import pose_between
from localization.mapping.local_map import LocalMap
from localization.mapping.pose_graph import PoseEdge
from localization.mapping.scan_tracker import REFERENCES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.mapping.keyframes import Keyframe
    from localization.mapping.pose_graph import PoseGraph

    Floats = NDArray[np.float64]

SIGHT_M = 3.0
"""Two keyframes farther apart see too little in common."""
DRIFTS = 3.0
"""Standard deviations of drift that a place is looked for within."""
FARTHEST_M = 4.0
LEAST_WINDOW_M = 0.3
NEIGHBOURS = 4
"""Keyframes to each side of the old one, which show the place together."""
CANDIDATES = 2
COARSE_M, FINE_M = 0.1, 0.05
REACH_M = 8.0
WINDOW_RAD = radians(20.0)
ENOUGH_SCORE = 0.7
SIGMA_M, SIGMA_RAD = 0.02, 0.006


@dataclass(frozen=True, slots=True)
class LoopSearch:
    """Look for loops from a graph's newest keyframe."""

    lidar_m: tuple[float, float] = (0.0, 0.0)
    """Where the lidar is in ``base``."""

    def find(self, keyframes: Sequence[Keyframe], graph: PoseGraph) -> list[PoseEdge]:
        """Return edges from old keyframes to the newest one, at most ``CANDIDATES``."""
        newest = len(keyframes) - 1
        found = []
        for index, window_m in self._candidates(keyframes, graph):
            edge = self._recognize(keyframes, index, newest, window_m)
            if edge is not None:
                found.append(edge)
        return found

    def _candidates(
        self, keyframes: Sequence[Keyframe], graph: PoseGraph
    ) -> list[tuple[int, float]]:
        """Return old keyframes that may be near, each with the window to search [m]."""
        newest = len(keyframes) - 1
        old = newest - REFERENCES
        if old < 0:
            return []
        poses = graph.poses
        gap_m = np.hypot(*(poses[: old + 1, :2] - poses[newest, :2]).T)
        taken: list[tuple[int, float]] = []
        for index in np.argsort(gap_m, kind="stable").tolist():
            drift_m = min(FARTHEST_M, DRIFTS * graph.spread_m(index, newest))
            if len(taken) == CANDIDATES or gap_m[index] > SIGHT_M + FARTHEST_M:
                break
            is_apart = all(abs(index - other) > 2 * NEIGHBOURS for other, _ in taken)
            if gap_m[index] <= SIGHT_M + drift_m and is_apart:
                taken.append((index, max(LEAST_WINDOW_M, drift_m)))
        return taken

    def _recognize(
        self, keyframes: Sequence[Keyframe], old: int, newest: int, window_m: float
    ) -> PoseEdge | None:
        around = keyframes[max(0, old - NEIGHBOURS) : old + NEIGHBOURS + 1]
        seen, points_m = keyframes[newest], keyframes[newest].points_m
        centre_m = keyframes[old].pose[:2]
        coarse = LocalMap(around, centre_m, REACH_M, COARSE_M)
        start = coarse.search(points_m, seen.pose, window_m, WINDOW_RAD)
        fine = LocalMap(around, centre_m, REACH_M, FINE_M)
        pose, fit, has_free_axis = fine.align(points_m, start)
        # A free axis is a corridor without ends in view: nothing says where along it.
        score = fit - fine.passed_share(points_m, self.lidar_m, pose)
        if has_free_axis or not score >= ENOUGH_SCORE:
            return None
        return PoseEdge(old, newest, pose_between(keyframes[old].pose, pose), SIGMA_M, SIGMA_RAD)
