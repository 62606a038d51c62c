"""Read RT-DETR, D-FINE and DEIM as their own exporters leave them: labels, boxes, scores.

Boxes come in pixels of the size that the model was told, where it asks for one
(``orig_target_sizes``), else in pixels of its input. Some wants width first and some height first,
so it is told a square, and boxes are taken back to the input here. A batch of one may stand around
all three outputs or around none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import UNTOLD
from planner.perception.detect.detections import Row, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe

COUNT = "num_dets"


class RtDetr:
    """Decode labels n, boxes n x 4, scores n, each with 1 before it or without."""

    NAME: ClassVar[str] = "rtdetr"
    RECIPE: ClassVar[Recipe] = Recipe("stretched", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 0
    OUTPUTS: ClassVar[tuple[str, ...]] = ("labels", "boxes", "scores")
    EXPECTED: ClassVar[str] = "labels n, boxes n x 4, scores n, or all three with 1 x before it"

    def __init__(self, facts: Facts) -> None:
        """Find the outputs' places and the scale of their boxes."""
        self._at = tuple(list(facts.outputs).index(name) for name in self.OUTPUTS)
        side_px = facts.told_side_px
        scale = (1.0, 1.0) if side_px is None else (facts.width / side_px, facts.height / side_px)
        self._scale = np.array(scale * 2, np.float32)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        counted = COUNT in facts.outputs  # MMYOLO's: its pictures go in otherwise
        if counted or not all(name in facts.outputs for name in cls.OUTPUTS):
            return None
        labels, boxes, scores = (facts.outputs[name] for name in cls.OUTPUTS)
        one_picture = len(scores) == 1 or (len(scores) == 2 and scores[0] == 1)
        return UNTOLD if one_picture and labels == scores and boxes == (*scores, 4) else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        labels, boxes, scores = (outputs[at] for at in self._at)
        told = np.asarray(scores, np.float32).reshape(-1)
        kept = told >= min_score
        rows = np.asarray(boxes, np.float32).reshape(-1, 4)[kept] * self._scale
        return rows_of(rows, told[kept], class_numbers(labels.reshape(-1)[kept]))


def class_numbers(labels: NDArray[np.generic]) -> NDArray[np.intp]:
    """Return class numbers; -1 where there is none."""
    if np.issubdtype(labels.dtype, np.integer):
        return np.asarray(labels, np.intp)
    found = np.asarray(labels, np.float32)
    return np.nan_to_num(found, nan=-1.0, posinf=-1.0, neginf=-1.0).astype(np.intp)
