"""Read ``logits`` and ``pred_boxes``, as Hugging Face's transformers leave DETRs and OWLs.

Each query has one logit a class, a sigmoid's, and one box by centre and size in shares of the
input. An OWL has a query for each patch of its input, and one class for each text whose embedding
is in the file; others have a few hundred. Their families differ in how the picture goes in, and
nothing in the file says it: what the shapes don't tell, the owner does (``decoder``). DETR itself,
whose classes are a softmax with one for nothing at all, is another layout and has a class too many.
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

PATCHES_PX = (14, 16, 32)
"""Sides of the patches of the image encoders that OWLs have."""
OBJECTNESS = "objectness_logits"
"""An output of OWLv2 alone."""
CLIP_MEAN = (0.48145466, 0.4578275, 0.40821073)
CLIP_DEVIATION = (0.26862954, 0.26130258, 0.27577711)
"""The constants of CLIP's pictures (Radford et al. 2021)."""


class DetrLogits:
    """Decode logits 1 x n x classes and pred_boxes 1 x n x 4 of RT-DETR and D-FINE."""

    NAME: ClassVar[str] = "detr_logits"
    RECIPE: ClassVar[Recipe] = Recipe("stretched", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 0
    OUTPUTS: ClassVar[tuple[str, ...]] = ("logits", "pred_boxes")
    EXPECTED: ClassVar[str] = "logits 1 x n x classes, pred_boxes 1 x n x 4"

    def __init__(self, facts: Facts) -> None:
        """Find the outputs' places."""
        names = list(facts.outputs)
        self._at = names.index("logits"), names.index("pred_boxes")
        self._size = np.array((facts.width, facts.height) * 2, np.float32)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        if not all(name in facts.outputs for name in cls.OUTPUTS):
            return None
        logits, boxes = (facts.outputs[name] for name in ("logits", "pred_boxes"))
        both = len(logits) == len(boxes) == 3 and logits[:2] == boxes[:2] and logits[0] == 1
        return logits[2] if both and boxes[2] == 4 and logits[2] > 0 else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        logits, boxes = (floats(outputs[at]) for at in self._at)
        # Asked as a logit, so that only what is kept needs an exponential.
        kept = logits.max(axis=1, initial=-np.inf) >= log(min_score / (1.0 - min_score))
        kept &= finite_rows(boxes) & finite_rows(logits)
        best = logits[kept]
        scores = 1.0 / (1.0 + np.exp(-best.max(axis=1, initial=-np.inf)))
        found = from_centres(boxes[kept] * self._size)
        return rows_of(found, scores, best.argmax(axis=1))


class OwlVit(DetrLogits):
    """Decode the same of OWL-ViT: a query a patch, the picture stretched."""

    NAME: ClassVar[str] = "owlvit"
    RECIPE: ClassVar[Recipe] = Recipe("stretched", "rgb", 1 / 255, CLIP_MEAN, CLIP_DEVIATION)
    SUPPRESS: ClassVar[bool] = True

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        count = super().classes_of(facts)
        grids = {(facts.width // side) * (facts.height // side) for side in PATCHES_PX}
        return count if count is not None and facts.outputs["logits"][1] in grids else None


class OwlV2(OwlVit):
    """Decode the same of OWLv2: the picture whole, at the upper left."""

    NAME: ClassVar[str] = "owlv2"
    RECIPE: ClassVar[Recipe] = Recipe("corner", "rgb", 1 / 255, CLIP_MEAN, CLIP_DEVIATION)
    OUTPUTS: ClassVar[tuple[str, ...]] = ("logits", "pred_boxes", OBJECTNESS)
    EXPECTED: ClassVar[str] = "logits 1 x patches x classes, pred_boxes 1 x patches x 4"
