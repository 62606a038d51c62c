"""Read RT-DETR as Ultralytics exports it: a row a query, box as shares of the input, scores."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import finite_rows, floats
from planner.perception.detect.detections import Row, from_centres, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe

MAX_QUERIES = 1000


class RtDetrRows:
    """Decode 1 x n x (4 + classes)."""

    NAME: ClassVar[str] = "rtdetr_rows"
    RECIPE: ClassVar[Recipe] = Recipe("stretched", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        self._size = np.array((facts.width, facts.height) * 2, np.float32)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        shape = facts.first
        one = len(facts.outputs) == 1 and len(shape) == 3 and shape[0] == 1
        if not one or shape[1] > MAX_QUERIES or shape[2] < 5:
            return None
        # Nothing in the shape tells it from others; the names do.
        return shape[2] - 4 if shape[2] - 4 == len(facts.names) else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        rows = floats(outputs[0])
        rows = rows[finite_rows(rows)]
        rows = rows[rows[:, 4:].max(axis=1, initial=0.0) >= min_score]
        boxes = from_centres(rows[:, :4] * self._size)
        return rows_of(boxes, rows[:, 4:].max(axis=1, initial=0.0), rows[:, 4:].argmax(axis=1))
