"""Say of each box what its class and the boxes beside it tell about where its depth is to be read.

On a floor, of two things whose boxes overlap the one whose box ends lower stands in front. Pure.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planner.language.object_classes import TOP, Kind
from planner.perception.detect.depth_sampling import Hint

Boxes = NDArray[np.float32]
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
