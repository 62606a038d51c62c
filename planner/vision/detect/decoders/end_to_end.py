"""Read a YOLO that suppresses by itself: few rows of left, top, right, bottom, score, class.

YOLOv10 and YOLO26 are made so, others by their exporter's ``nms`` option. Boxes: input pixels.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.vision.detect.decoders.base import GRIDS, UNTOLD
from planner.vision.detect.facts import Facts
from planner.vision.detect.found import Found
from planner.vision.detect.prepare import Recipe

MOST = 1e6
"""Far above any count of classes, and inside what an integer can hold."""


class EndToEnd:
    """Decode 1 x n x 6, or n x 6."""

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

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> Found:
        # Few rows, and numpy is cold after a run: as Python's numbers they take half the time.
        rows = [
            row
            for row in outputs[0].reshape(-1, 6).tolist()
            if row[4] >= min_score and 0.0 <= row[5] <= MOST and row[5] % 1.0 == 0.0
        ]
        if not rows:
            return Found.none()
        numbers = np.array(rows, np.float32)
        return Found(numbers[:, :4], numbers[:, 4], numbers[:, 5].astype(np.intp))
