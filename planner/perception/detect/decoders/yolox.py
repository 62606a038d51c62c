"""Read YOLOX as its own exporter leaves it: a raw grid, one row a cell.

Centre = (cell + offset) x stride and size = exp(raw) x stride, input pixels; objectness and class
scores are sigmoids already. Pictures go in blue green red, 0 to 255, at the upper left.
Source: Ge et al. 2021, "YOLOX: Exceeding YOLO Series in 2021", section 2, and its ONNX demo.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import GRIDS, best_class, floats
from planner.perception.detect.detections import Row, from_centres, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Floats, Recipe

RAW_REACH = 12.0
"""Raw numbers are offsets and logarithms, 3.8 at most in ten pictures; decoded ones are pixels. A
row with a larger one is no box: e^12 strides are 1 300 000 px."""


class YoloX:
    """Decode 1 x cells x (5 + classes)."""

    NAME: ClassVar[str] = "yolox"
    RECIPE: ClassVar[Recipe] = Recipe("corner", "bgr")
    SUPPRESS: ClassVar[bool] = True
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        """Lay out the grid once."""
        strides = _strides(facts) or GRIDS[0]
        self._grid = np.hstack(grid(facts.width, facts.height, strides))

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        shape = facts.first
        if len(facts.outputs) != 1 or len(shape) != 3 or shape[0] != 1 or shape[2] < 6:
            return None
        fits = _strides(facts) is not None and facts.largest <= RAW_REACH
        return shape[2] - 5 if fits else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        rows = floats(outputs[0])
        # No class raises a score above its objectness, so most rows are done with here.
        candidates = (rows[:, 4] >= min_score).nonzero()[0]
        if not len(candidates):
            return []
        rows = rows.take(candidates, axis=0)
        scores, classes = best_class(rows)
        reach = np.abs(rows[:, :4]).max(axis=1)
        kept = ((scores >= min_score) & (reach <= RAW_REACH)).nonzero()[0]  # NaN is neither
        boxes = self._boxes(rows.take(kept, axis=0)[:, :4], candidates[kept])
        return rows_of(boxes, scores[kept], classes[kept])

    def _boxes(self, raw: Floats, cells: NDArray[np.intp]) -> Floats:
        """Return the boxes of some cells, in input pixels; written over the raw ones."""
        grid = self._grid.take(cells, axis=0)
        raw[:, :2] += grid[:, :2]
        np.exp(raw[:, 2:], out=raw[:, 2:])
        raw *= grid[:, 2:]
        return from_centres(raw)


def grid(width: int, height: int, strides: Sequence[int]) -> tuple[Floats, Floats]:
    """Return each cell's column and row (n x 2) and its stride (n x 1), finest grid first."""
    corners, sizes = [], []
    for stride in strides:
        rows, columns = np.mgrid[: height // stride, : width // stride]
        cells = np.stack((columns, rows), axis=-1).reshape(-1, 2)
        corners.append(cells)
        sizes.append(np.full((len(cells), 1), stride))
    return (
        np.concatenate(corners).astype(np.float32),
        np.concatenate(sizes).astype(np.float32),
    )


def _strides(facts: Facts) -> tuple[int, ...] | None:
    rows = facts.first[1]
    return next((strides for strides in GRIDS if rows and rows == facts.cells(strides)), None)
