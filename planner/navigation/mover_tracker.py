"""Follow things that move, scan by scan, as discs with a velocity. Told points and the time.

Points that the map does not explain are joined into clusters; each is followed by an alpha-beta
filter on its centre. What has gone faster than a slow walk for half a second is a mover. It leaves
no trail in the obstacle layer, and nothing is routed around where it is now.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from planner.navigation.route import is_wide

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Points = NDArray[np.float64]

JOIN_M = 0.25
"""Between two points of one cluster: legs of a walking person are so near to each other."""
LARGEST_M = 1.2
"""A cluster wider than this is a wall or a row of things: it is not followed."""
SAME_M = 0.6
"""From where a mover was expected: at 2 m/s and 5 scans a second it is 0.4 m from where it was."""
ALPHA, BETA = 0.5, 0.2
MOVES_MPS = 0.25
MOVES_S = 0.5
SLOWS_MPS = 0.1
"""What is as wide as a robot and has moved still moves, down to this: it slows down in a door."""
LOST_S = 1.0
MOST = 32
"""Clusters followed at a time."""


@dataclass(frozen=True, slots=True)
class TrackedMover:
    """Hold one cluster that is followed."""

    number: int
    x_m: float
    y_m: float
    vx_mps: float
    vy_mps: float
    radius_m: float
    seen_s: float
    fast_since_s: float | None = None
    is_mover: bool = False

    @property
    def speed_mps(self) -> float:
        """Return how fast it goes."""
        return hypot(self.vx_mps, self.vy_mps)


class MoverTracker:
    """Follow clusters from scan to scan."""

    def __init__(self) -> None:
        self._tracks: tuple[TrackedMover, ...] = ()
        self._points: dict[int, Points] = {}
        self._next = 1

    @property
    def movers(self) -> tuple[TrackedMover, ...]:
        """Return what moves."""
        return tuple(track for track in self._tracks if track.is_mover)

    def expected_points(self, at_s: float) -> Points:
        """Return the points of movers, carried to where they are expected, shape (n, 2) [m]."""
        moved = [
            self._points[track.number]
            + np.array([track.vx_mps, track.vy_mps]) * max(0.0, at_s - track.seen_s)
            for track in self.movers
            if track.number in self._points
        ]
        return np.concatenate(moved) if moved else np.empty((0, 2))

    def update(self, points_m: Points, at_s: float) -> None:
        """Take the unexplained points of one scan, shape (n, 2) in ``map`` [m]."""
        free = [track for track in self._tracks if at_s - track.seen_s <= LOST_S]
        kept: list[TrackedMover] = []
        points: dict[int, Points] = {}
        for cluster in cluster_points(points_m)[:MOST]:
            x_m, y_m = (float(value) for value in cluster.mean(axis=0))
            radius_m = float(np.hypot(*(cluster - (x_m, y_m)).T).max()) + 0.05
            near = [(_miss_m(track, x_m, y_m, at_s), track) for track in free]
            best = min(near, key=lambda pair: pair[0], default=None)
            if best is not None and best[0] <= SAME_M:
                free.remove(best[1])
                track = _follow(best[1], x_m, y_m, radius_m, at_s)
            else:
                track = TrackedMover(self._next, x_m, y_m, 0.0, 0.0, radius_m, at_s)
                self._next += 1
            kept.append(track)
            points[track.number] = cluster
        self._tracks = (*kept, *free)
        points |= {t.number: self._points[t.number] for t in free if t.number in self._points}
        self._points = points


def cluster_points(points_m: Points) -> list[Points]:
    """Join points nearer than JOIN_M in the order of the beams; leave out what is too wide."""
    if len(points_m) == 0:
        return []
    gaps = np.hypot(*np.diff(points_m, axis=0).T)
    parts = np.split(points_m, np.flatnonzero(gaps > JOIN_M) + 1)
    if len(parts) > 1 and hypot(*(points_m[0] - points_m[-1])) <= JOIN_M:
        parts = [np.concatenate([parts[-1], parts[0]]), *parts[1:-1]]
    return [part for part in parts if hypot(*np.ptp(part, axis=0)) <= LARGEST_M]


def _miss_m(track: TrackedMover, x_m: float, y_m: float, at_s: float) -> float:
    gone_s = at_s - track.seen_s
    return hypot(track.x_m + track.vx_mps * gone_s - x_m, track.y_m + track.vy_mps * gone_s - y_m)


def _follow(
    track: TrackedMover, x_m: float, y_m: float, radius_m: float, at_s: float
) -> TrackedMover:
    gone_s = at_s - track.seen_s
    if not gone_s > 0.0:
        return track
    due_x_m, due_y_m = track.x_m + track.vx_mps * gone_s, track.y_m + track.vy_mps * gone_s
    miss_x_m, miss_y_m = x_m - due_x_m, y_m - due_y_m
    vx_mps = track.vx_mps + BETA * miss_x_m / gone_s
    vy_mps = track.vy_mps + BETA * miss_y_m / gone_s
    least_mps = SLOWS_MPS if track.is_mover and is_wide(radius_m) else MOVES_MPS
    fast = hypot(vx_mps, vy_mps) > least_mps
    since_s = None if not fast else track.fast_since_s if track.fast_since_s is not None else at_s
    return replace(
        track,
        x_m=due_x_m + ALPHA * miss_x_m,
        y_m=due_y_m + ALPHA * miss_y_m,
        vx_mps=vx_mps,
        vy_mps=vy_mps,
        radius_m=radius_m,
        seen_s=at_s,
        fast_since_s=since_s,
        is_mover=since_s is not None and at_s - since_s >= MOVES_S,
    )
