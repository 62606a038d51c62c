"""Ask the model about a picture; where it fails, give the detector's findings, visibly.

The answer then carries the detector's tag with the model's name and the reason. It shares the
breaker of whoever plans by the same model: a server that is down makes no look wait.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from planner.brain.circuit_breaker import Breaker
from planner.brain.errors import BadPlan, BrainDown, OutOfBudget
from planner.brain.fallback import HOPELESS
from planner.brain.image_questions import (
    DetectedObject,
    ImageDescription,
    ImagePoint,
    ImageQuestion,
    ImageSighting,
    Looker,
    NotSent,
    NotThere,
)
from planner.brain.model_error_codes import tell_failure
from planner.plan import Bilingual, BrainTag

log = logging.getLogger(__name__)

Words = Callable[[str, Sequence[DetectedObject]], tuple[Bilingual, bool | None]]
"""Answers a question by what a detector saw: the words, and whether what it asks for is there."""
DETECTOR = BrainTag(name="detector", version="1")


class FallbackLooker:
    """Look with a model, and without it where it fails."""

    def __init__(
        self,
        model: Looker,
        words: Words,
        breaker: Breaker | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Look by ``model``, or tell by ``words``; ``breaker``: the one that its plans pass."""
        self._model, self._words, self._clock = model, words, clock
        self._breaker = breaker or Breaker()

    @property
    def tag(self) -> BrainTag:
        """Return the model's name."""
        return self._model.tag

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        """Return the model's answer, else the detector's. Raises nothing but a cancellation."""
        try:
            with self._guard_call():
                return await self._model.describe(asked)
        except (BrainDown, BadPlan) as failure:
            text, seen = self._words(asked.words, asked.detections)
            return ImageDescription(text, seen, self._instead(failure))

    async def point(self, asked: ImageQuestion) -> ImagePoint | NotThere:
        """Return where the model points; no detector can do that for it.

        Raises:
            NotSent, BadPlan, BrainDown, OutOfBudget: as the model's, or ``resting``.
        """
        with self._guard_call():
            return await self._model.point(asked)

    async def seek(self, asked: ImageQuestion) -> ImageSighting:
        """Return what the model sees of a kind that no detector here knows.

        Raises:
            NotSent, BadPlan, BrainDown, OutOfBudget: as the model's, or ``resting``.
        """
        with self._guard_call():
            return await self._model.seek(asked)

    @contextmanager
    def _guard_call(self) -> Iterator[None]:
        """Let a call through where the breaker does, and tell it how the call ended."""
        if not self._breaker.lets(self._clock()):
            raise BrainDown(f"{self._breaker.rests_s(self._clock()):.0f} s more", why="resting")
        try:
            yield
        except (NotSent, OutOfBudget):  # no call went out, or none is to blame
            self._breaker.note_cancel()
            raise
        except BrainDown as down:
            self._breaker.note_failure(self._clock(), hopeless=down.why in HOPELESS)
            raise
        except BadPlan:  # it answers
            self._breaker.note_success()
            raise
        except BaseException:  # cancelled, or a fault of ours
            self._breaker.note_cancel()
            raise
        self._breaker.note_success()

    def _instead(self, failure: BrainDown | BadPlan) -> BrainTag:
        why = failure.why if isinstance(failure, BrainDown) else failure.code
        server = failure.server if isinstance(failure, BrainDown) else ""
        log.warning("%s: %s (%s); the detector answers", self.tag.name, why, failure)
        said = failure.said if isinstance(failure, OutOfBudget) else tell_failure(why, server)
        told = {"fallback_from": self.tag.name, "fallback_reason": why, "fallback_message": said}
        return DETECTOR.model_copy(update=told)
