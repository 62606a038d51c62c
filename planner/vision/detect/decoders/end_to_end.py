"""Read a YOLO that suppresses by itself: few rows of left, top, right, bottom, score, class.

YOLOv10 and YOLO26 are made so, others by their exporter's ``nms`` option. Boxes: input pixels.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.vision.detect.decoders.base import GRIDS, UNTOLD, finite_rows, integral
from planner.vision.detect.facts import Facts
from planner.vision.detect.found import Found
from planner.vision.detect.prepare import Recipe


class EndToEnd:
    """Decode 1 x n x 6, or n x 6."""

    NAME: ClassVar[str] = "end_to_end"
    RECIPE: ClassVar[Recipe] = Recipe("centred", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        """Need nothing of the shapes."""

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        shape = facts.first
        if len(facts.outputs) != 1 or len(shape) not in (2, 3) or shape[-1] != 6:
            return None
        if len(shape) == 3 and shape[0] != 1:
            return None
        # One class in a grid has six columns too: box, objectness, score.
        cells = {facts.cells(strides) for strides in GRIDS} - {0}
        return None if shape[-2] in cells | {3 * count for count in cells} else UNTOLD

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> Found:
        rows = np.asarray(outputs[0], np.float32).reshape(-1, 6)
        rows = rows[finite_rows(rows)]
        rows = rows[(rows[:, 4] >= min_score) & integral(rows[:, 5])]
        # Far outside any count of classes either way, and inside what an integer can hold.
        classes = np.clip(rows[:, 5], -1.0, 1e6).astype(np.intp)
        return Found(rows[:, :4], rows[:, 4], classes)
