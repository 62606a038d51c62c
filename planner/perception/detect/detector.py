"""Look at one picture after another: bytes in, detections in picture pixels out.

Whatever a picture is, the answer is detections or a code that says why it was skipped. How high
each class must score to be believed says the owner, else the model's file by ``min_scores`` in its
metadata, one number a class, 0 to 1: a detector errs more in some classes than in others, and
who made it knows which. Knows no map and no process.
"""

from __future__ import annotations

import time
from collections.abc import Mapping

import numpy as np

from planner.language.object_classes import kind_of
from planner.language.object_names import canonical
from planner.perception.color_classifier import dark, exposure
from planner.perception.detect.class_names import literal
from planner.perception.detect.depth_sampling import ANY, hints, look_inside
from planner.perception.detect.detections import Row, filter_rows, in_picture, strongest, suppress
from planner.perception.detect.input_size import without_batch
from planner.perception.detect.model_file import Model, ModelOptions, open_model
from planner.perception.detect.pictures import Depth, Picture, unpack_color, unpack_depth
from planner.perception.detect.preprocess import Preparer, preparer
from planner.perception.detect.session import RUN_ERRORS, Array, last_words, senseless
from planner.perception.failure import VisionFailure
from planner.perception.snapshot import Detection, DetectorInfo, LookResult

MIN_SCORE = 0.4
"""What is believed of a class where nobody says anything."""
KEY = "min_scores"


def least_scores(
    metadata: Mapping[str, str], count: int, owner: float | None
) -> tuple[tuple[float, ...], str]:
    """Return the least score of each of so many classes, and in words where it is from."""
    if owner is not None:
        return (owner,) * count, f"{owner:.2f}, as set"
    told = literal(metadata.get(KEY, ""))
    if isinstance(told, (list, tuple)) and len(told) == count and all(map(_a_score, told)):
        scores = tuple(float(score) for score in told)
        return scores, f"{min(scores):.2f} to {max(scores):.2f} by class, as its file says"
    return (MIN_SCORE,) * count, f"{MIN_SCORE:.2f}"


def _a_score(value: object) -> bool:
    """Tell whether a value can be a score; not a number is none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and 0.0 < value < 1.0


EMPTY = "depth_empty"
"""The camera measures nothing here, or no longer: what it sees is placed without."""


class OnnxDetector:
    """Find things with one model."""

    def __init__(
        self,
        wanted: ModelOptions,
        min_score: float | None = None,
        beside: OnnxDetector | None = None,
    ) -> None:
        """Open the model.

        Args:
            wanted: what the owner sets about it.
            min_score: what is believed of every class; None: what the model's file says.
            beside: finds more kinds in the same pictures, where it is asked for.

        Raises:
            VisionFailure: it is refused.
        """
        self.model: Model = open_model(wanted)
        choice, taken = self.model.choice, self.model.input
        metadata, count = self.model.session.metadata, len(choice.classes)
        scores, least = least_scores(metadata, count, min_score)
        self._least, self._lowest = scores, min(scores)
        self._decoder, self._classes = choice.decoder, choice.classes
        self._kinds = [kind_of(canonical(label)) for label in self._classes]
        self._preparer: Preparer = preparer(self._decoder.RECIPE, taken)
        self._feeds = self.feeds(self._preparer.buffer)
        session = self.model.session
        try:
            session.fix(self._feeds, session.run(self._feeds))
        except RUN_ERRORS as error:
            text = f"it failed on its second picture: {last_words(error)}"
            raise VisionFailure("model_broken", text) from None
        self.about: DetectorInfo = DetectorInfo(
            model=self.model.name,
            decoder=self._decoder.NAME,
            why=choice.why,
            provider=session.provider,
            provider_why=session.provider_why,
            classes=self._classes,
            width=taken.width,
            height=taken.height,
            least=least,
            words=self.model.words,
            beside=beside.about if beside is not None else None,
        )
        self._beside, self._own = beside, frozenset(map(canonical, filter(None, self._classes)))

    def look(
        self,
        color: bytes,
        depth: bytes | None = None,
        said: tuple[int, int] | None = None,
        focal_px: float | None = None,
        *,
        wide: bool = False,
    ) -> LookResult:
        """Return the detections in a picture.

        Args:
            color: JPEG, or PNG of eight bits.
            depth: 16-bit PNG in millimetres, of the same size.
            said: width and height as whoever sent the picture said.
            focal_px: the camera's, where it is known: how large a thing shows bounds how near.
            wide: have the model beside it look, too, where there is one.
        """
        began_s = time.monotonic()
        try:
            return self._detect(color, depth, said, focal_px, began_s, wide=wide)
        except RUN_ERRORS:
            return _skip("detector_failed", began_s)

    def _detect(
        self,
        color: bytes,
        depth: bytes | None,
        said: tuple[int, int] | None,
        focal_px: float | None,
        began_s: float,
        *,
        wide: bool,
    ) -> LookResult:
        """Look as above, or end in ``RUN_ERRORS``."""
        picture = unpack_color(color, said)
        if isinstance(picture, str):
            return _skip(picture, began_s)
        if dark(picture):
            return _skip("picture_dark", began_s)
        height, width = picture.shape[:2]
        far = unpack_depth(depth, (width, height)) if depth is not None else None
        lost = far if isinstance(far, str) else None
        if lost is not None and lost != EMPTY:
            return _skip(lost, began_s)
        measured = None if isinstance(far, str) else far
        detections = self.find(picture, measured, focal_px)
        beside = self._beside if wide else None
        if beside is not None:
            others = beside.find(picture, measured, focal_px)
            detections += tuple(it for it in others if canonical(it.label) not in self._own)
        took_s = time.monotonic() - began_s
        return LookResult(
            detections, width, height, took_s, depth_lost=lost, wide=beside is not None
        )

    def find(
        self, picture: Picture, depth: Depth | None = None, focal_px: float | None = None
    ) -> tuple[Detection, ...]:
        """Return the detections in an unpacked picture, the surest first.

        Raises:
            RuntimeError: or another of ``RUN_ERRORS``: the model failed on it.
        """
        return self._detections(self.boxes(picture), picture, depth, focal_px)

    def boxes(self, picture: Picture) -> list[Row]:
        """Return the boxes in an unpacked picture, in its pixels, the surest first."""
        _, placed = self._preparer.prepare(picture)
        outputs = self.model.session.run(self._feeds)
        found = filter_rows(self._decoder.decode(outputs, self._lowest), self._least)
        if not found and senseless(outputs):
            # To be told of as a failure: an empty picture would be a thing's absence.
            raise ArithmeticError("no number came out that is finite")
        found = in_picture(found, placed, picture.shape[1], picture.shape[0])
        return suppress(found) if self._decoder.SUPPRESS else strongest(found)

    def prepare(self, picture: Picture) -> Array:
        """Return the model's input for a picture; the next picture is written over it."""
        return self._preparer.prepare(picture)[0]

    def feeds(self, buffer: Array) -> Mapping[str, Array]:
        """Return all that the model is fed with such an input."""
        return {
            self.model.input.name: without_batch(buffer, self.model.input),
            **self.model.beside,
        }

    def _detections(
        self, rows: list[Row], picture: Picture, depth: Depth | None, focal_px: float | None
    ) -> tuple[Detection, ...]:
        if not rows:
            return ()
        told = [ANY] * len(rows)
        if depth is not None:
            boxes = np.array([row[:4] for row in rows], np.float32)
            kinds = [self._kinds[row[5]] for row in rows]
            told = hints(boxes, kinds, (picture.shape[1], picture.shape[0]), focal_px)
        gain = exposure(picture)
        made: list[Detection] = []
        for (left, top, right, bottom, score, number), hint in zip(rows, told, strict=True):
            if label := self._classes[number]:
                box = (left, top, right, bottom)
                seen = look_inside(picture, depth, box, hint, gain)
                made.append(Detection(label, score, box, seen.color, seen.depth_m, seen.spread_m))
        return tuple(made)


def _skip(code: str, began_s: float) -> LookResult:
    return LookResult((), 0, 0, time.monotonic() - began_s, code)
