"""Read YOLOX exported with its decoding inside: the raw grid's shape, but boxes in input pixels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import by_objectness, floats
from planner.perception.detect.decoders.yolox import RAW_REACH, YoloX
from planner.perception.detect.detections import Row, from_centres, rows_of
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Recipe


class DecodedYoloX:
    """Decode 1 x cells x (5 + classes)."""

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
