"""Read the heads of the YOLO family: boxes in input pixels, scores that are sigmoids already."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import (
    GRIDS,
    UNTOLD,
    Facts,
    best_class,
    by_objectness,
    finite_rows,
    floats,
)
from planner.perception.detect.decoders.detr import COUNT, class_numbers
from planner.perception.detect.detections import MAX_ROWS, Row, from_centres, rows_of
from planner.perception.detect.preprocess import Floats, Recipe

ANCHORS = 3


class YoloV5:
    """Decode YOLOv5: 1 x (3 x cells) x (5 + classes).

    A row an anchor, three to a cell: box by centre and size, objectness, class scores.
    """

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


class YoloV8:
    """Decode YOLOv8 and YOLO11: 1 x (4 + classes) x cells.

    One column a cell, its box by centre and size, then one score a class. Some exporters turn it
    over, one row a cell.
    """

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


RAW_REACH = 12.0
"""Raw numbers are offsets and logarithms, 3.8 at most in ten pictures; decoded ones are pixels. A
row with a larger one is no box: e^12 strides are 1 300 000 px."""


class YoloX:
    """Decode YOLOX as its own exporter leaves it, a raw grid: 1 x cells x (5 + classes).

    Centre = (cell + offset) x stride and size = exp(raw) x stride, input pixels. Pictures go in
    blue green red, 0 to 255, at the upper left. Source: Ge et al. 2021, "YOLOX: Exceeding YOLO
    Series in 2021", section 2, and its ONNX demo.
    """

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


class DecodedYoloX:
    """Decode YOLOX with its decoding inside: the raw grid's shape, boxes in input pixels."""

    NAME: ClassVar[str] = "yolox_decoded"
    RECIPE: ClassVar[Recipe] = YoloX.RECIPE
    SUPPRESS: ClassVar[bool] = True
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        """Need nothing of the shapes."""

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        if not facts.largest > RAW_REACH:
            return None
        return YoloX.classes_of(replace(facts, largest=0.0))

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        rows = floats(outputs[0])
        boxes, scores, classes = by_objectness(rows[rows[:, 4] >= min_score], min_score)
        return rows_of(from_centres(boxes), scores, classes)


class MmYolo:
    """Decode what MMYOLO's deployment writes, YOLO-World's own exporter among them.

    ``num_dets`` 1 x 1, boxes 1 x n x 4, scores 1 x n, labels 1 x n. Non-maximum suppression is in
    the graph: of n rows the first ``num_dets`` are boxes, the rest is filling. Pictures go in
    whole, centred on grey.
    """

    NAME: ClassVar[str] = "mmyolo"
    RECIPE: ClassVar[Recipe] = Recipe("centred", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 0
    OUTPUTS: ClassVar[tuple[str, ...]] = (COUNT, "labels", "boxes", "scores")
    EXPECTED: ClassVar[str] = "num_dets 1 x 1, boxes 1 x n x 4, scores 1 x n, labels 1 x n"

    def __init__(self, facts: Facts) -> None:
        """Find the outputs' places."""
        self._at = tuple(list(facts.outputs).index(name) for name in self.OUTPUTS)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        if not all(name in facts.outputs for name in cls.OUTPUTS):
            return None
        count, labels, boxes, scores = (facts.outputs[name] for name in cls.OUTPUTS)
        one_picture = count in ((1, 1), (1,)) and len(scores) == 2 and scores[0] == 1
        return UNTOLD if one_picture and labels == scores and boxes == (*scores, 4) else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        count, labels, boxes, scores = (outputs[at] for at in self._at)
        found = slice(0, max(0, int(count.reshape(-1)[0])))
        told = np.asarray(scores[0, found], np.float32)
        kept = told >= min_score
        rows = np.asarray(boxes[0, found], np.float32)[kept]
        return rows_of(rows, told[kept], class_numbers(labels[0, found][kept]))


class EndToEnd:
    """Decode a YOLO that suppresses by itself: 1 x n x 6, or n x 6.

    Few rows of left, top, right, bottom, score, class. YOLOv10 and YOLO26 are made so, others by
    their exporter's ``nms`` option.
    """

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
