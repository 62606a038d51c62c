"""Read YOLOv5: a row an anchor, three to a cell: box by centre and size, objectness, class scores.

Boxes are in input pixels and scores are sigmoids already: the head decodes itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import GRIDS, by_objectness, floats
from planner.perception.detect.detections import Row, from_centres, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe

ANCHORS = 3


class YoloV5:
    """Decode 1 x (3 x cells) x (5 + classes)."""

    NAME: ClassVar[str] = "yolov5"
    RECIPE: ClassVar[Recipe] = Recipe("centred", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = True
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        """Need nothing of the shapes."""

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        # Older exports give the heads beside the whole; it comes first.
        shape = facts.first
        if len(shape) != 3 or shape[0] != 1 or shape[2] < 6:
            return None
        counts = {ANCHORS * facts.cells(strides) for strides in GRIDS} - {0}
        return shape[2] - 5 if shape[1] in counts else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        rows = floats(outputs[0])
        # No class raises a score above its objectness, so most rows are done with here.
        boxes, scores, classes = by_objectness(rows[rows[:, 4] >= min_score], min_score)
        return rows_of(from_centres(boxes), scores, classes)
