"""Read what MMYOLO's deployment writes, YOLO-World's own exporter among them: boxes, counted.

Non-maximum suppression is in the graph: of n rows the first ``num_dets`` are boxes, the rest is
filling. Pictures go in whole, centred on grey. Boxes: input pixels.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import UNTOLD
from planner.perception.detect.decoders.rtdetr import COUNT, class_numbers
from planner.perception.detect.detections import Row, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe


class MmYolo:
    """Decode num_dets 1 x 1, boxes 1 x n x 4, scores 1 x n, labels 1 x n."""

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
