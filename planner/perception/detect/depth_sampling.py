"""Read depth and colour from the middle of a box, where the thing is and the wall behind it is not.

Depth has holes (0), and a box shows floor and wall beside the thing: of the measured depths, the
nearest ones that stand close together and are enough count as the thing. What its class and the
boxes beside it tell says where to read: on a floor, of two things whose boxes overlap the one whose
box ends lower stands in front.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, isfinite

import numpy as np
from numpy.typing import NDArray

from planner.language.object_classes import ENOUGH, MIDDLE, TOP, Kind
from planner.perception.color_classifier import prevailing
from planner.perception.detect.pictures import Depth, Picture

WHOLE = (0.0, 0.0, 1.0, 1.0)
ENOUGH_BEHIND = 0.2
MOST_PIXELS_A_SIDE = 32
"""Of the part of a box that is looked at, evenly spread: a large box costs no more than others."""
LEFT = 0.15
"""Share of a whole box that must be left of it behind what stands before it."""
WINDOW_M = 0.15
WINDOW_SHARE = 0.06
"""How deep a thing may be behind its front [m], and how much more with each metre of distance."""
MIN_MEASURED = 3
AROUND_PX = (2, 6)
MM = 0.001

Boxes = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Hint:
    """Name where in a box a thing of its class is to be looked for, and its company in there."""

    part: tuple[float, float, float, float] = MIDDLE
    """Left, top, right, bottom, as shares of the box."""
    enough: float = ENOUGH
    """Share of the measured depths that the thing must have there."""
    nearest_m: float = 0.0
    """Nearer than this, what fills the box were too small to be it."""
    others: Boxes | None = None
    """Boxes of other things (n x 4 [px]), whose pixels are not its own."""


ANY = Hint()


@dataclass(frozen=True, slots=True)
class Inner:
    """Hold the pixels in the middle of a box."""

    color: str | None
    depth_m: float | None
    spread_m: float
    """Half the distance between the quartiles of what counted."""


@dataclass(frozen=True, slots=True)
class _Sample:
    """Hold some pixels of a picture with their depths, one row each."""

    pixels: NDArray[np.uint8]
    millimetres: NDArray[np.uint16]

    def thing(self, enough: float, nearest_m: float = 0.0) -> NDArray[np.float32] | None:
        """Return the sorted depths of the nearest thing that is not too near; None without."""
        beyond = self.millimetres[self.millimetres >= nearest_m / MM]
        left = len(beyond) >= LEFT * len(self.millimetres)
        return foreground(beyond, enough) if left or nearest_m <= 0.0 else None


def look_inside(
    picture: Picture, depth: Depth | None, box: Sequence[float], hint: Hint = ANY, gain: float = 1.0
) -> Inner:
    """Return colour and depth of the thing in a box: left, top, right, bottom [px].

    Gain: what the picture lacks in light, for its colours.
    """
    if depth is None:
        part = inner(box, picture.shape[1], picture.shape[0])
        return Inner(prevailing(picture[part].reshape(-1, 3), gain), None, 0.0)
    sample = _sample(picture, depth, box, hint.part, hint.others)
    measured = sample.thing(hint.enough)
    if measured is not None and not measured[len(measured) // 2] * MM >= hint.nearest_m:
        whole = _sample(picture, depth, box, WHOLE, hint.others)
        behind = whole.thing(ENOUGH_BEHIND, hint.nearest_m)
        sample, measured = (sample, measured) if behind is None else (whole, behind)
    if measured is None:
        return Inner(prevailing(sample.pixels, gain), None, 0.0)
    near = (sample.millimetres >= measured[0]) & (sample.millimetres <= measured[-1])
    low, middle, high = (float(measured[len(measured) * part // 4]) * MM for part in (1, 2, 3))
    return Inner(prevailing(sample.pixels[near], gain), middle, (high - low) / 2)


def _sample(
    picture: Picture,
    depth: Depth,
    box: Sequence[float],
    shares: tuple[float, float, float, float],
    others: Boxes | None,
) -> _Sample:
    """Return the pixels of a part of a box, without those of other boxes where some are left."""
    height, width = depth.shape
    rows = _between(box[1], box[3], height, shares[1], shares[3])
    columns = _between(box[0], box[2], width, shares[0], shares[2])
    pixels, millimetres = picture[rows, columns].reshape(-1, 3), depth[rows, columns].reshape(-1)
    if others is None or not len(others):
        return _Sample(pixels, millimetres)
    down = np.arange(rows.start, rows.stop, rows.step)[:, None]
    across = np.arange(columns.start, columns.stop, columns.step)[None, :]
    own = np.ones((len(down), across.shape[1]), np.bool_)
    for left, top, right, bottom in others:
        own &= ~((across >= left) & (across < right) & (down >= top) & (down < bottom))
    kept = own.reshape(-1)
    if not kept.sum() >= max(MIN_MEASURED, LEFT * len(kept)):
        return _Sample(pixels, millimetres)
    return _Sample(pixels[kept], millimetres[kept])


def inner(box: Sequence[float], width: int, height: int) -> tuple[slice, slice]:
    """Return rows and columns of a box's middle, thinned where it is large."""
    left, top, right, bottom = MIDDLE
    return _between(box[1], box[3], height, top, bottom), _between(
        box[0], box[2], width, left, right
    )


def _between(low: float, high: float, limit: int, begin: float, end: float) -> slice:
    """Return a part of an interval as pixels: at least one, all inside the picture."""
    side = high - low
    first = min(max(0, int(low + begin * side)), limit - 1)
    last = min(max(first + 1, ceil(low + end * side)), limit)
    return slice(first, last, ceil((last - first) / MOST_PIXELS_A_SIDE))


def foreground(
    millimetres: NDArray[np.uint16], enough: float = ENOUGH
) -> NDArray[np.float32] | None:
    """Return the depths of the nearest thing that has enough, sorted; None for too few."""
    measured = np.sort(millimetres[millimetres > 0]).astype(np.float32)
    if len(measured) < MIN_MEASURED:
        return None
    # For each depth: how many lie within a thing's depth behind it. The nearest with enough is it.
    reach = measured + (WINDOW_M / MM + WINDOW_SHARE * measured)
    within = np.searchsorted(measured, reach, side="right") - np.arange(len(measured))
    fronts = np.flatnonzero(within >= max(MIN_MEASURED, enough * len(measured)))
    first = int(fronts[0]) if len(fronts) else int(within.argmax())
    return measured[first : first + int(within[first])]


def depth_at(depth: Depth, u_px: float, v_px: float) -> float | None:
    """Return the depth measured around a pixel [m]; wider around it where it is a hole.

    None where nothing was, and for a pixel whose place is not finite: who points may be a model.
    """
    if not (isfinite(u_px) and isfinite(v_px)):
        return None
    height, width = depth.shape
    column, row = min(max(0, int(u_px)), width - 1), min(max(0, int(v_px)), height - 1)
    for radius in AROUND_PX:
        around = depth[max(0, row - radius) : row + radius + 1,
                       max(0, column - radius) : column + radius + 1]  # fmt: skip
        measured = foreground(around.reshape(-1))
        if measured is not None:
            return float(measured[len(measured) // 2]) * MM
    return None


LOWER_PX = 2.0
MOSTLY = 0.5
"""A smaller box that lies so much in a larger one stands on or before it."""
EDGE_PX = 2.0
NEARLY_ALL = (0.1, 0.1, 0.9, 0.9)


def hints(
    boxes: Boxes, kinds: list[Kind], size: tuple[int, int], focal_px: float | None
) -> list[Hint]:
    """Return one hint for each of n boxes (n x 4 [px]), given their kinds and the picture's size.

    Without a focal length nobody can tell from how large a thing shows how near it is.
    """
    return [
        Hint(
            _part(box, kind, size),
            kind.enough,
            _nearest_m(box, kind, size, focal_px),
            _before(boxes, row),
        )
        for row, (box, kind) in enumerate(zip(boxes, kinds, strict=True))
    ]


def _part(box: Boxes, kind: Kind, size: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return where in a box depth is read.

    What reaches below the picture is near, and beside its upper part much shows of what is behind.
    """
    return NEARLY_ALL if kind.part == TOP and box[3] >= size[1] - EDGE_PX else kind.part


def _nearest_m(box: Boxes, kind: Kind, size: tuple[int, int], focal_px: float | None) -> float:
    left, top, right, bottom = (float(edge) for edge in box)
    inside = left > EDGE_PX and top > EDGE_PX
    inside = inside and right < size[0] - EDGE_PX and bottom < size[1] - EDGE_PX
    return kind.nearest_m(right - left, bottom - top, focal_px) if inside and focal_px else 0.0


def _before(boxes: Boxes, row: int) -> Boxes:
    """Return the boxes of things that stand before a thing, or on it."""
    box, area = boxes[row], (boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])
    wide = np.minimum(boxes[:, 2], box[2]) - np.maximum(boxes[:, 0], box[0])
    high = np.minimum(boxes[:, 3], box[3]) - np.maximum(boxes[:, 1], box[1])
    shared = np.maximum(wide, 0.0) * np.maximum(high, 0.0)
    lower = boxes[:, 3] > box[3] + LOWER_PX
    upon = (area < area[row]) & (shared >= MOSTLY * area)
    before: Boxes = boxes[(shared > 0.0) & (lower | upon) & (np.arange(len(boxes)) != row)]
    return before
