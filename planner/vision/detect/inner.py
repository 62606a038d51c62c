"""Read depth and colour from the middle of a box, where the thing is and the wall behind it is not.

Depth has holes (0), and a box shows floor and wall beside the thing: of the measured depths, the
nearest ones that stand close together and are enough count as the thing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planner.vision.colors_pixels import prevailing
from planner.vision.detect.pictures import Depth, Picture

SHARE = 0.5
"""Of a box's width and height that its inner box has."""
MOST_PIXELS_A_SIDE = 32
"""Of the inner box that are looked at, evenly spread: a large box costs no more than others."""
ENOUGH = 0.3
"""Share of the measured depths that the thing must have: a leg or a leaf before it has less."""
WINDOW_M = 0.15
WINDOW_SHARE = 0.06
"""How deep a thing may be behind its front [m], and how much more with each metre of distance."""
MIN_MEASURED = 3
AROUND_PX = (2, 6)
MM = 0.001


@dataclass(frozen=True, slots=True)
class Inner:
    """Hold what the middle of a box shows."""

    color: str | None
    depth_m: float | None
    spread_m: float
    """Half the distance between the quartiles of what counted."""


def look_inside(picture: Picture, depth: Depth | None, box: NDArray[np.float32]) -> Inner:
    """Return colour and depth of the thing in a box: left, top, right, bottom [px]."""
    part = inner(box, picture.shape[1], picture.shape[0])
    pixels = picture[part].reshape(-1, 3)
    if depth is None:
        return Inner(prevailing(pixels), None, 0.0)
    millimetres = depth[part].reshape(-1)
    measured = foreground(millimetres)
    if measured is None:
        return Inner(prevailing(pixels), None, 0.0)
    near = (millimetres >= measured[0]) & (millimetres <= measured[-1])
    low, middle, high = (float(measured[len(measured) * part // 4]) * MM for part in (1, 2, 3))
    return Inner(prevailing(pixels[near]), middle, (high - low) / 2)


def inner(box: NDArray[np.float32], width: int, height: int) -> tuple[slice, slice]:
    """Return rows and columns of a box's middle, thinned where it is large."""
    return _middle(box[1], box[3], height), _middle(box[0], box[2], width)


def _middle(low: float, high: float, limit: int) -> slice:
    """Return the middle of an interval as pixels: at least one, all inside the picture."""
    margin = (high - low) * (1 - SHARE) / 2
    first = min(max(0, int(low + margin)), limit - 1)
    end = min(max(first + 1, int(np.ceil(high - margin))), limit)
    return slice(first, end, max(1, (end - first) // MOST_PIXELS_A_SIDE))


def foreground(millimetres: NDArray[np.uint16]) -> NDArray[np.float32] | None:
    """Return the depths of the nearest thing that has enough, sorted; None for too few."""
    measured = np.sort(millimetres[millimetres > 0]).astype(np.float32)
    if len(measured) < MIN_MEASURED:
        return None
    # For each depth: how many lie within a thing's depth behind it. The nearest with enough is it.
    reach = measured + (WINDOW_M / MM + WINDOW_SHARE * measured)
    within = np.searchsorted(measured, reach, side="right") - np.arange(len(measured))
    fronts = np.flatnonzero(within >= max(MIN_MEASURED, ENOUGH * len(measured)))
    first = int(fronts[0]) if len(fronts) else int(within.argmax())
    return measured[first : first + int(within[first])]


def depth_at(depth: Depth, u_px: float, v_px: float) -> float | None:
    """Return what was measured around a pixel [m]; wider around it where it is a hole."""
    height, width = depth.shape
    column, row = min(max(0, int(u_px)), width - 1), min(max(0, int(v_px)), height - 1)
    for radius in AROUND_PX:
        around = depth[max(0, row - radius) : row + radius + 1,
                       max(0, column - radius) : column + radius + 1]  # fmt: skip
        measured = foreground(around.reshape(-1))
        if measured is not None:
            return float(measured[len(measured) // 2]) * MM
    return None
