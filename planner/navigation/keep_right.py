"""Shift a way to the right where there is room, so that somebody who comes can walk past.

Knows the costmap. Law: every point stays on free floor and comes no nearer to anything than it was,
or than a robot's width and a hand; where there is no room the way stays as it was.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from planner.navigation.smoothing import is_free, lengths_m
from planner.navigation.waypoints import evenly

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from planner.navigation.costmap import Costmap
    from planner.navigation.smoothing import Line

ROOM_M = 0.075
"""Kept from what is on the right: the gate's margin, and what pose and follower err by."""
MOST_M = 0.6
"""Farther aside than this nobody expects a robot to go for them."""
STEP_M = 0.02
SLOPE = 0.55
"""Metres aside for each metre ahead: half a turn of 30 degrees, which needs no turn in place."""
SMOOTHED = 7
"""Points over which the shift is averaged, so that its corners are bends."""
LASTS = 11
"""Points on which there must be as much room: a metre."""
SPARE_M = 0.04
"""Taken off, so that points lie within the cells that have room, not at their edge."""
SHARES = (1.0, 0.75, 0.5)


def keep_right(costmap: Costmap, line: Line, reach_m: float) -> Line:
    """Return a line whose next metres lead as far to the right as there is room for.

    Args:
        costmap: what is known now.
        line: points about 0.1 m apart, from the robot to the goal, all on free floor.
        reach_m: of the line, from the robot on; beyond it the line stays.
    """
    if len(line) < 3:
        return line
    along_m = lengths_m(line)
    right = _right_of(line)
    room_m = _limit_slope(_room_m(costmap, line, right), along_m, min(reach_m, float(along_m[-1])))
    for share in SHARES:
        shifted = evenly(line + share * room_m[:, None] * right)
        if is_free(costmap, shifted):
            return shifted
    return line


def _right_of(line: Line) -> NDArray[np.float64]:
    """Return the unit vector to the right of the line at each of its points."""
    ahead = np.gradient(line, axis=0)
    long_m = np.maximum(np.hypot(*ahead.T), 1e-9)
    return np.asarray(np.column_stack([ahead[:, 1], -ahead[:, 0]]) / long_m[:, None], np.float64)


def _room_m(costmap: Costmap, line: Line, right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far each point can go to the right with room all the way [m]."""
    room_m, open_still = np.zeros(len(line)), np.ones(len(line), np.bool_)
    for shift_m in np.arange(STEP_M, MOST_M + 1e-6, STEP_M):
        at = line + shift_m * right
        open_still &= np.isfinite(costmap.cost_at(at))
        open_still &= costmap.clearance_at(at) >= costmap.radius_m + ROOM_M
        room_m[open_still] = shift_m
    # A door beside the way is no lane: only room that lasts counts.
    half = LASTS // 2
    lasting = np.lib.stride_tricks.sliding_window_view(np.pad(room_m, half, mode="edge"), LASTS)
    return np.asarray(np.maximum(lasting.min(axis=1) - SPARE_M, 0.0), np.float64)


def _limit_slope(
    room_m: NDArray[np.float64], along_m: NDArray[np.float64], reach_m: float
) -> NDArray[np.float64]:
    """Return the shift that begins and ends at nothing and changes no faster than the slope."""
    shift_m = np.minimum(room_m, SLOPE * np.minimum(along_m, np.maximum(reach_m - along_m, 0.0)))
    for index in range(1, len(shift_m)):
        gap_m = along_m[index] - along_m[index - 1]
        shift_m[index] = min(shift_m[index], shift_m[index - 1] + SLOPE * gap_m)
    for index in range(len(shift_m) - 2, -1, -1):
        gap_m = along_m[index + 1] - along_m[index]
        shift_m[index] = min(shift_m[index], shift_m[index + 1] + SLOPE * gap_m)
    half = SMOOTHED // 2
    padded = np.pad(shift_m, half, mode="edge")
    smooth_m = np.convolve(padded, np.ones(SMOOTHED) / SMOOTHED, mode="valid")
    return np.asarray(np.minimum(smooth_m, room_m), np.float64)
