"""Read RF-DETR: ``dets`` in shares of the input by centre and size, ``labels`` as logits.

Pictures go in stretched, normalised as for ImageNet. A head has one class more than were trained,
for nothing at all; weights trained on COCO have 91, numbered as COCO numbers its categories.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import log
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import finite_rows, floats
from planner.perception.detect.detections import Row, from_centres, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe


class RfDetr:
    """Decode dets 1 x n x 4 and labels 1 x n x classes."""

    NAME: ClassVar[str] = "rfdetr"
    RECIPE: ClassVar[Recipe] = Recipe(
        "stretched",
        "rgb",
        scale=1 / 255,
        mean=(0.485, 0.456, 0.406),
        deviation=(0.229, 0.224, 0.225),
    )
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 1
    OUTPUTS: ClassVar[tuple[str, ...]] = ("dets", "labels")
    EXPECTED: ClassVar[str] = "dets 1 x n x 4, labels 1 x n x classes"

    def __init__(self, facts: Facts) -> None:
        """Find the outputs' places."""
        self._at = tuple(list(facts.outputs).index(name) for name in self.OUTPUTS)
        self._size = np.array((facts.width, facts.height) * 2, np.float32)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        if not all(name in facts.outputs for name in cls.OUTPUTS):
            return None
        dets, labels = (facts.outputs[name] for name in cls.OUTPUTS)
        both = len(dets) == len(labels) == 3 and dets[:2] == labels[:2] and dets[0] == 1
        return labels[2] if both and dets[2] == 4 and labels[2] > 0 else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        dets, logits = (floats(outputs[at]) for at in self._at)
        # Asked as a logit, so that only what is kept needs an exponential.
        kept = logits.max(axis=1) >= log(min_score / (1.0 - min_score))
        kept &= finite_rows(dets) & finite_rows(logits)
        classes = logits[kept].argmax(axis=1)
        scores = 1.0 / (1.0 + np.exp(-logits[kept].max(axis=1, initial=-np.inf)))
        boxes = from_centres(dets[kept] * self._size)
        return rows_of(boxes, scores, classes)
