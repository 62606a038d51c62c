"""Read the heads of the DETR family: a row a query, its box and its classes."""

from __future__ import annotations

from collections.abc import Sequence
from math import log
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import UNTOLD, Facts, finite_rows, floats
from planner.perception.detect.detections import Row, from_centres, rows_of
from planner.perception.detect.preprocess import Recipe

COUNT = "num_dets"


class RtDetr:
    """Decode RT-DETR, D-FINE and DEIM as their own exporters leave them.

    Labels n, boxes n x 4, scores n, each with 1 before it or without. Boxes come in pixels of the
    size that the model was told, where it asks for one (``orig_target_sizes``), else in pixels of
    its input. Some want width first and some height first, so it is told a square, and boxes are
    taken back to the input here.
    """

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


MAX_QUERIES = 1000


class RtDetrRows:
    """Decode RT-DETR as Ultralytics exports it: 1 x n x (4 + classes), boxes as shares."""

    NAME: ClassVar[str] = "rtdetr_rows"
    RECIPE: ClassVar[Recipe] = Recipe("stretched", "rgb", scale=1 / 255)
    SUPPRESS: ClassVar[bool] = False
    SPARE: ClassVar[int] = 0

    def __init__(self, facts: Facts) -> None:
        self._size = np.array((facts.width, facts.height) * 2, np.float32)

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        shape = facts.first
        one = len(facts.outputs) == 1 and len(shape) == 3 and shape[0] == 1
        if not one or shape[1] > MAX_QUERIES or shape[2] < 5:
            return None
        # Nothing in the shape tells it from others; the names do.
        return shape[2] - 4 if shape[2] - 4 == len(facts.names) else None

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        rows = floats(outputs[0])
        rows = rows[finite_rows(rows)]
        rows = rows[rows[:, 4:].max(axis=1, initial=0.0) >= min_score]
        boxes = from_centres(rows[:, :4] * self._size)
        return rows_of(boxes, rows[:, 4:].max(axis=1, initial=0.0), rows[:, 4:].argmax(axis=1))


class RfDetr:
    """Decode RF-DETR: ``dets`` 1 x n x 4 in shares by centre and size, ``labels`` as logits.

    Pictures go in stretched, normalised as for ImageNet. A head has one class more than were
    trained, for nothing at all; weights trained on COCO have 91, numbered as COCO numbers its
    categories.
    """

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


PATCHES_PX = (14, 16, 32)
"""Sides of the patches of the image encoders that OWLs have."""
OBJECTNESS = "objectness_logits"
"""An output of OWLv2 alone."""
CLIP_MEAN = (0.48145466, 0.4578275, 0.40821073)
CLIP_DEVIATION = (0.26862954, 0.26130258, 0.27577711)
"""The constants of CLIP's pictures (Radford et al. 2021)."""


class DetrLogits:
    """Decode ``logits`` and ``pred_boxes``, as Hugging Face's transformers leave DETRs and OWLs.

    Each query has one logit a class, a sigmoid's, and one box by centre and size in shares of the
    input. An OWL has a query for each patch of its input, and one class for each text whose
    embedding is in the file; others have a few hundred. Their families differ in how the picture
    goes in, and nothing in the file says it: what the shapes don't tell, the owner does
    (``decoder``). DETR itself, whose classes are a softmax with one for nothing at all, is another
    layout and has a class too many.
    """

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
