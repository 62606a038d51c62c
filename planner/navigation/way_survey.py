"""Tell of a way how narrow it gets, and how far it leads through what may still stand there."""

from __future__ import annotations

import numpy as np

from planner.navigation.costmap import Costmap
from planner.navigation.route import RouteSurvey
from planner.navigation.smoothing import Line

ASIDE_M = 1.5
"""To each side; what is wider is narrow for nobody."""
STEP_M = 0.02


def survey(costmap: Costmap, line: Line) -> RouteSurvey:
    """Measure across a way, at a right angle to it, from one obstacle to the other."""
    if len(line) < 2:
        return RouteSurvey(None, None, 0.0)
    along = np.gradient(line, axis=0)
    along /= np.maximum(np.hypot(*along.T), 1e-9)[:, None]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    away_m = np.arange(STEP_M, ASIDE_M, STEP_M)
    left_m, right_m = (_free_m(costmap, line, side * across, away_m) for side in (1.0, -1.0))
    width_m = left_m + right_m
    at = int(np.argmin(width_m))
    narrowest_m = float(width_m[at])
    suspect_m = _suspect_m(costmap, line)
    if narrowest_m >= ASIDE_M:
        return RouteSurvey(None, None, suspect_m)
    return RouteSurvey(narrowest_m, (float(line[at, 0]), float(line[at, 1])), suspect_m)


def _free_m(costmap: Costmap, line: Line, across: Line, away_m: Line) -> Line:
    """Return how far it is to the first thing on one side of each point [m]."""
    points = line[:, None, :] + across[:, None, :] * away_m[None, :, None]
    hit = _is_occupied(costmap, points.reshape(-1, 2)).reshape(len(line), len(away_m))
    first = np.where(hit.any(axis=1), hit.argmax(axis=1), len(away_m) - 1)
    return np.asarray(away_m[first], np.float64)


def _is_occupied(costmap: Costmap, points: Line) -> Line:
    # A cell's clearance is counted from its middle: an occupied one has none.
    return np.asarray(costmap.clearance_at(points) <= 0.0)


def _suspect_m(costmap: Costmap, line: Line) -> float:
    if costmap.suspicion is None:
        return 0.0
    grid = costmap.grid
    column = np.floor((line[:, 0] - grid.origin_x_m) / grid.resolution_m).astype(int)
    row = np.floor((line[:, 1] - grid.origin_y_m) / grid.resolution_m).astype(int)
    seen = costmap.suspicion[np.clip(row, 0, grid.height - 1), np.clip(column, 0, grid.width - 1)]
    gaps_m = np.hypot(*np.diff(line, axis=0).T)
    return float(gaps_m[seen[1:]].sum())
