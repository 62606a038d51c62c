"""Own boxes as arrays while they are many: believe finite ones only, bring them to the picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from planner.vision.detect.prepare import Floats, Placed

Ints = NDArray[np.intp]
MIN_SIDE_PX = 1.0
"""A thinner box shows nothing that a depth or a colour could be read from."""
HIGHEST_SCORE = 1.001
"""One, and what half precision makes of it."""

EDGES: Floats = np.array(
    [[1, 0, 1, 0], [0, 1, 0, 1], [-0.5, 0, 0.5, 0], [0, -0.5, 0, 0.5]], np.float32
)
"""Centre and size times this are left, top, right and bottom."""


@dataclass(frozen=True, slots=True)
class Found:
    """Hold boxes with their scores and classes, row by row."""

    boxes: Floats
    """n x 4: left, top, right, bottom [px]."""
    scores: Floats
    classes: Ints

    @classmethod
    def none(cls) -> Found:
        """Return no boxes."""
        return cls(np.empty((0, 4), np.float32), np.empty(0, np.float32), np.empty(0, np.intp))

    def __len__(self) -> int:
        return len(self.scores)

    def only(self, rows: NDArray[np.bool_] | Ints) -> Found:
        """Return some of the rows."""
        return Found(self.boxes[rows], self.scores[rows], self.classes[rows])


def from_centres(cxcywh: Floats) -> Floats:
    """Return left, top, right, bottom of boxes given by centre and size, all finite."""
    return np.asarray(cxcywh[:, :4] @ EDGES)


def fenced(least: Sequence[float]) -> Floats:
    """Return how high each class must score, in the model's order, between two never reached."""
    return np.array((inf, *least, inf), np.float32)


def believed(found: Found, least: Floats) -> Found:
    """Keep rows whose every number is possible; NaN and infinity fail by themselves.

    Args:
        found: as it was decoded.
        least: of :func:`fenced`: what is no class meets a fence.
    """
    if not len(found):
        return found
    kept = found.scores >= least.take(found.classes + 1, mode="clip")
    kept &= found.scores <= HIGHEST_SCORE
    finite = np.isfinite(found.boxes)
    if not finite.all():
        kept &= finite.all(axis=1)
    found = found if kept.all() else found.only(kept)
    return Found(found.boxes, np.minimum(found.scores, np.float32(1.0)), found.classes)


def in_picture(found: Found, placed: Placed, width: int, height: int) -> Found:
    """Return the input's boxes as the picture's, cut at its borders, without slivers."""
    if not len(found):
        return found
    boxes = found.boxes
    if not placed.as_it_is:
        boxes = boxes - np.array((placed.left, placed.top) * 2, np.float32)
        boxes /= np.array((placed.scale_x, placed.scale_y) * 2, np.float32)
    boxes = np.maximum(boxes, np.float32(0.0))
    np.minimum(boxes, np.array((width, height) * 2, np.float32), out=boxes)
    sides = boxes[:, 2:] - boxes[:, :2]
    found = Found(boxes, found.scores, found.classes)
    return found if sides.min() >= MIN_SIDE_PX else found.only(sides.min(axis=1) >= MIN_SIDE_PX)
