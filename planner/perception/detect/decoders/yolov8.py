"""Read YOLOv8 and YOLO11: one column a cell, its box by centre and size, then one score a class.

Boxes are in input pixels and scores are sigmoids already: the head decodes itself. Some exporters
turn it over, one row a cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import GRIDS, finite_rows, floats
from planner.perception.detect.detections import Row, from_centres, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe


class YoloV8:
    """Decode 1 x (4 + classes) x cells."""

    NAME: ClassVar[str] = "yolov8"
    RECIPE: ClassVar[Recipe] = Recipe("centred", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = True
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        self._turned = is_turned(facts)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        shape = facts.first
        if len(facts.outputs) != 1 or len(shape) != 3 or shape[0] != 1:
            return None
        count = shape[2 if is_turned(facts) else 1] - 4
        named = count == len(facts.names)
        return count if count > 0 and (named or _cells_at(facts) is not None) else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        columns = floats(outputs[0])
        if self._turned:
            columns = columns.T
        # Channel by channel as it lies in memory; only what is left is turned into rows.
        best = columns[4:].max(axis=0)
        candidates = (best >= min_score).nonzero()[0]
        if not len(candidates):
            return []
        kept = columns.take(candidates, axis=1)
        rows = kept.T[finite_rows(kept.T)]
        classes = rows[:, 4:].argmax(axis=1)
        return rows_of(from_centres(rows), rows[:, 4:].max(axis=1), classes)


def _cells_at(facts: Facts) -> int | None:
    """Return which axis counts a grid's cells."""
    counts = {facts.cells(strides) for strides in GRIDS} - {0}
    shape = facts.first
    return next((axis for axis in (2, 1) if shape[axis] in counts), None)


def is_turned(facts: Facts) -> bool:
    """Tell whether there is one row a cell."""
    return _cells_at(facts) == 1
