"""Read a YOLO that suppresses by itself: few rows of left, top, right, bottom, score, class.

YOLOv10 and YOLO26 are made so, others by their exporter's ``nms`` option. Boxes: input pixels.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import GRIDS, UNTOLD
from planner.perception.detect.detections import MAX_ROWS, Row
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe


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

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        found = np.asarray(outputs[0], np.float32).reshape(-1, 6)
        if len(found) > MAX_ROWS:
            found = found[found[:, 4] >= min_score]
            found = found[np.argsort(-found[:, 4])[:MAX_ROWS]]
        return [
            (left, top, right, bottom, score, int(number))
            for left, top, right, bottom, score, number in found.tolist()
            if score >= min_score and isfinite(number) and number == int(number)
        ]
