"""Space a line's points evenly and give each its speed. Knows the costmap and the limits."""

from __future__ import annotations

from math import hypot

import numpy as np
from numpy.typing import NDArray

from planner.navigation.costmap import MARGIN_M, Costmap
from planner.navigation.route import MIN_SPEED_MPS, RouteLimits
from planner.navigation.smoothing import Line, lengths_m

SPACING_M = 0.10
MIN_GAP_M = 0.05
"""The bridge refuses points nearer than this or farther apart than 0.25 m; the first and the last
gap may be as short as 0.01 m."""
MIN_END_GAP_M = 0.01
WAY_OUT_SPEED_MPS = 0.20
"""Where a robot begins nearer to something than its margin, until it is out."""
TIGHT_SPEED_MPS = 0.30
"""Where the disc just fits; a door of 0.90 m is passed at about 0.34 m/s. The bridge stops from
that in 0.14 m, whatever stands behind the door."""
ROOMY_M = 0.35
"""With this much between disc and wall the robot may go as fast as it can."""
SLOWING_MPS2 = 0.5
"""Ahead of a slow point; gentler than any stop, so that the limiter need not act."""


def evenly(line: Line, spacing_m: float = SPACING_M) -> Line:
    """Return points along a line about ``spacing_m`` apart, its ends included."""
    along_m = lengths_m(line)
    if along_m[-1] < MIN_END_GAP_M:
        return line[-1:]
    at_m = np.linspace(0.0, along_m[-1], max(1, round(along_m[-1] / spacing_m)) + 1)
    return thin(np.column_stack([np.interp(at_m, along_m, line[:, axis]) for axis in (0, 1)]))


def thin(line: Line) -> Line:
    """Drop inner points too near to the one before, so that every gap is one the bridge takes."""
    kept = [line[0]]
    for point in line[1:-1]:
        least_m = MIN_END_GAP_M if len(kept) == 1 else MIN_GAP_M
        if hypot(*(point - kept[-1])) >= least_m:
            kept.append(point)
    while len(kept) > 1 and hypot(*(line[-1] - kept[-1])) < MIN_END_GAP_M:
        kept.pop()
    return np.asarray([*kept, line[-1]])


def speeds(
    costmap: Costmap, line: Line, zone_mps: NDArray[np.float64], limits: RouteLimits
) -> NDArray[np.float64]:
    """Return the speed to pass each point at [m/s]: slower in tight places, zones and bends."""
    spare_m = costmap.clearance_at(line) - (limits.radius_m + MARGIN_M)
    room = np.clip(spare_m / ROOMY_M, 0.0, 1.0)
    tight_mps = min(TIGHT_SPEED_MPS, limits.max_speed_mps)
    wanted = tight_mps + (limits.max_speed_mps - tight_mps) * room
    wanted[spare_m < 0.0] = min(WAY_OUT_SPEED_MPS, limits.max_speed_mps)
    wanted = np.minimum(np.minimum(wanted, zone_mps), _bend_mps(line, limits))
    wanted = np.maximum(wanted, MIN_SPEED_MPS)
    gaps_m = np.hypot(*np.diff(line, axis=0).T)
    for index in range(len(line) - 2, -1, -1):
        reachable = (wanted[index + 1] ** 2 + 2 * SLOWING_MPS2 * gaps_m[index]) ** 0.5
        wanted[index] = min(wanted[index], reachable)
    return np.asarray(wanted, np.float64)


def _bend_mps(line: Line, limits: RouteLimits) -> NDArray[np.float64]:
    """Bound the speed in bends: v^2 * curvature is lateral acceleration, v * curvature turning."""
    bound = np.full(len(line), np.inf)
    if len(line) < 3:
        return bound
    steps = np.diff(line, axis=0)
    heading = np.arctan2(steps[:, 1], steps[:, 0])
    turn = np.abs((np.diff(heading) + np.pi) % (2 * np.pi) - np.pi)
    gaps_m = np.hypot(*steps.T)
    curvature = np.maximum(turn / ((gaps_m[:-1] + gaps_m[1:]) / 2), 1e-6)
    lateral = np.sqrt(limits.max_lateral_mps2 / curvature)
    bound[1:-1] = np.minimum(lateral, limits.max_turn_radps / curvature)
    return bound
