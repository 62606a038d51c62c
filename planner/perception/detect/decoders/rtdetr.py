"""Read RT-DETR and D-FINE as their own exporters leave them: labels, boxes, scores.

Boxes come in pixels of the size given as ``orig_target_sizes`` (width, height). We give the input's
own size there, so that boxes are in input pixels as with every other family.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import UNTOLD, floats
from planner.perception.detect.detections import Row, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe

SIZES = "orig_target_sizes"
OUTPUTS = ("labels", "boxes", "scores")


class RtDetr:
    """Decode labels 1 x n, boxes 1 x n x 4, scores 1 x n."""

    NAME: ClassVar[str] = "rtdetr"
    RECIPE: ClassVar[Recipe] = Recipe("stretched", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        """Find the outputs' places."""
        self._at = tuple(list(facts.outputs).index(name) for name in OUTPUTS)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        if not all(name in facts.outputs for name in OUTPUTS):
            return None
        labels, boxes, scores = (facts.outputs[name] for name in OUTPUTS)
        one_picture = len(scores) == 2 and scores[0] == 1
        return UNTOLD if one_picture and labels == scores and boxes == (*scores, 4) else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        labels, boxes, scores = (outputs[at] for at in self._at)
        scores = floats(scores)
        kept = scores >= min_score
        return rows_of(floats(boxes)[kept], scores[kept], _numbers(labels)[kept])


def _numbers(labels: NDArray[np.generic]) -> NDArray[np.intp]:
    """Return class numbers; -1 where there is none."""
    if np.issubdtype(labels.dtype, np.integer):
        return np.asarray(labels[0], np.intp)
    return np.nan_to_num(floats(labels), nan=-1.0, posinf=-1.0, neginf=-1.0).astype(np.intp)
