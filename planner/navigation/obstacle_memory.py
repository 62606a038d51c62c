"""Put the layers of the costmap together: the map, what stood, what is suspicions, what moves.

Nav2's static, obstacle and inflation layers in one; the movers are known beside it and close
nothing. Holds what changes from scan to scan, and so is each robot's own; the map's part is told.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from planner.navigation.mover_tracker import MoverTracker
from planner.navigation.obstacle_layer import ObstacleLayer, ScanView
from planner.navigation.route import Mover, ObstacleReport, ScanObservation
from wire.geometry import compose

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from planner.navigation.costmap import Costmap

MAX_CELLS = 4_000
"""Of a layer, told to people: 10 m2 at 0.05 m."""
MAX_ESCAPE_M = 0.5
"""A way that begins too near to something is no closed way, where it is open after this."""
NEAR_MOVER_M = 1.5
"""From the robot's middle: who walks nearer than this is in its way all the same."""
MOVER_ROOM_M = 0.25
"""Beside a mover's disc, for how far it has gone since it was seen."""
JUMP_M, FASTEST_MPS = 0.3, 2.0
"""A robot that is farther away than it can have driven was found elsewhere: what it saw before lies
in wrong places."""


class ObstacleMemory:
    """Hold one robot's obstacle layer and movers."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        """Begin with nothing seen, for a map of so many rows and columns."""
        self._shape = (shape[0], shape[1])
        self._version = 0
        self._seen: ScanObservation | None = None
        self._forget()

    def _forget(self) -> None:
        self._layer = ObstacleLayer(self._shape)
        self._tracker = MoverTracker()
        self._layered: tuple[int, Costmap] | None = None

    def observe(self, mapped: Costmap, seen: ScanObservation) -> None:
        """Take a scan in; scans come in the order of their times."""
        if self._has_jumped(seen):
            self._forget()
        self._seen = seen
        self._version += 1
        view = ScanView(
            lidar_in_map=compose(seen.base_in_map, seen.lidar_in_base),
            first_rad=seen.first_rad,
            step_rad=seen.step_rad,
            range_min_m=seen.range_min_m,
            ranges_m=np.array(seen.ranges_m, np.float64),
            at_s=seen.at_s,
        )
        news = self._layer.observe(mapped, view, self._tracker.expected_points(seen.at_s))
        self._tracker.update(news, seen.at_s)

    def recall(self, cells: bytes, suspicions: bytes) -> None:
        """Begin with what another memory told in its report: it is out of sight here."""
        self._layer.recall(unpack_cells(cells, self._shape), unpack_cells(suspicions, self._shape))
        self._version += 1

    def leave_movers_out(
        self, points: tuple[tuple[float, float], ...]
    ) -> tuple[tuple[float, float], ...]:
        """Return the points [m] that are no mover's, or of one that is near the robot now.

        Who walks some metres away will be elsewhere by the time the robot is there.
        """
        if self._seen is None or not points:
            return points
        here = self._seen.base_in_map
        discs = [
            (mover.x_m, mover.y_m, mover.radius_m + MOVER_ROOM_M)
            for mover in self._tracker.movers
            if hypot(mover.x_m - here.x_m, mover.y_m - here.y_m) >= NEAR_MOVER_M
        ]
        return tuple(
            (x_m, y_m)
            for x_m, y_m in points
            if not any(hypot(x_m - x, y_m - y) <= far_m for x, y, far_m in discs)
        )

    def costmap(self, mapped: Costmap) -> Costmap:
        """Return the map with what the obstacle layer holds now."""
        if self._layered is None or self._layered[0] != self._version:
            costmap = mapped.with_cells(self._layer.obstacles, self._layer.suspicions)
            self._layered = (self._version, costmap)
        return self._layered[1]

    def hopeful_costmap(self, mapped: Costmap) -> Costmap:
        """Return the map with what is in sight; what is only remembered is a suspicion."""
        in_sight = self._layer.in_sight
        remembered = (self._layer.obstacles | self._layer.suspicions) & ~in_sight
        return mapped.with_cells(in_sight, remembered)

    def patient_costmap(self, mapped: Costmap) -> Costmap:
        """Return the map with all that was seen as a suspicion: dear, and closing nothing."""
        nothing = np.zeros(self._shape, np.bool_)
        return mapped.with_cells(nothing, self._layer.obstacles | self._layer.suspicions)

    def report(self, mapped: Costmap, ahead: tuple[tuple[float, float], ...]) -> ObstacleReport:
        """Say what the layer holds, and where it closes a way whose points are ``ahead``."""
        return ObstacleReport(
            version=self._version,
            blocked_ahead_m=self._blocked_ahead_m(mapped, ahead),
            movers=tuple(
                Mover(m.number, m.x_m, m.y_m, m.vx_mps, m.vy_mps, m.radius_m)
                for m in self._tracker.movers
            ),
            cells=_pack_cells(self._layer.obstacles),
            suspicions=_pack_cells(self._layer.suspicions),
        )

    def _blocked_ahead_m(
        self, mapped: Costmap, ahead: tuple[tuple[float, float], ...]
    ) -> float | None:
        if not ahead:
            return None
        line = np.asarray(ahead, np.float64)
        layered = self.costmap(mapped)
        closed = np.isinf(layered.cost_at(line)) & np.isfinite(mapped.cost_at(line))
        along_m = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
        if closed[0]:  # the robot is in a tight spot, and this is its way out
            out = int(np.argmin(closed)) if not closed.all() else len(closed)
            if out < len(closed) and along_m[out] <= MAX_ESCAPE_M:
                closed[:out] = False
        if not closed.any():
            return None
        return float(along_m[int(np.argmax(closed))])

    def _has_jumped(self, seen: ScanObservation) -> bool:
        before = self._seen
        if before is None:
            return False
        gone_s = seen.at_s - before.at_s
        here, there = before.base_in_map, seen.base_in_map
        away_m = hypot(there.x_m - here.x_m, there.y_m - here.y_m)
        return not away_m <= JUMP_M + FASTEST_MPS * max(0.0, gone_s)


def _pack_cells(cells: NDArray[np.bool_]) -> bytes:
    rows, columns = np.nonzero(cells)
    return np.column_stack([columns, rows])[:MAX_CELLS].astype("<u2").tobytes()


def unpack_cells(packed: bytes, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Return the cells of a report, for a map of so many rows and columns."""
    cells = np.zeros(shape, np.bool_)
    columns, rows = np.frombuffer(packed, "<u2").reshape(-1, 2).T
    inside = (columns < shape[1]) & (rows < shape[0])
    cells[rows[inside], columns[inside]] = True
    return cells
