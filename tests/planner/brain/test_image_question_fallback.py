"""Check that a look never fails: the detector answers in the model's place, and says for whom."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence

import pytest

from planner.brain import BadPlan, BrainDown, OutOfBudget
from planner.brain.circuit_breaker import TRIPS, Breaker
from planner.brain.image_question_fallback import FallbackLooker
from planner.brain.image_questions import (
    DetectedObject,
    ImageDescription,
    ImagePoint,
    ImageQuestion,
    ImageSighting,
    NotSent,
    NotThere,
    PosedPicture,
)
from planner.perception import Detection
from planner.plan import Bilingual, BrainTag, say_same

MODEL = BrainTag(name="m", version="1")
PICTURE = PosedPicture(b"", 320, 240, 7)
CUP = Detection("cup", 0.9, (10.0, 10.0, 20.0, 20.0), "red", 1.5)


class Scripted:
    """Answer, or raise what the script says."""

    tag = MODEL

    def __init__(self, failure: BaseException | None) -> None:
        self.failure, self.calls = failure, 0

    async def describe(self, *_: object) -> ImageDescription:
        self._next()
        return ImageDescription(say_same("a cup"), True, MODEL)

    async def point(self, *_: object) -> ImagePoint | NotThere:
        self._next()
        return ImagePoint(1, 2, MODEL)

    async def seek(self, *_: object) -> ImageSighting:
        self._next()
        return ImageSighting(True, 0, 1, 0, 0.9, MODEL)

    def _next(self) -> None:
        self.calls += 1
        if self.failure is not None:
            raise self.failure


def by_detector(question: str, found: Sequence[DetectedObject]) -> tuple[Bilingual, bool | None]:
    return say_same(f"{question} {' '.join(each.label for each in found)}"), bool(found)


def describe(looker: FallbackLooker) -> ImageDescription:
    return asyncio.run(
        looker.describe(ImageQuestion(PICTURE, "a cup?", detections=[CUP], goal="g1"))
    )


@pytest.mark.parametrize(
    ("failure", "why", "rests"),
    [
        (NotSent("x", why="pictures_offhost"), "pictures_offhost", False),
        (NotSent("x", why="no_pictures"), "no_pictures", False),
        (OutOfBudget("x", say_same("spent")), "out_of_budget", False),
        (BadPlan("x"), "bad_plan", False),
        (BrainDown("x", why="timeout"), "timeout", True),
        (BrainDown("x", why="bad_key"), "bad_key", True),
    ],
)
def test_the_detector_answers_for_a_model_that_fails(
    failure: Exception, why: str, rests: bool
) -> None:
    model, breaker = Scripted(failure), Breaker()
    looker = FallbackLooker(model, by_detector, breaker, clock=lambda: 5.0)
    for _ in range(TRIPS + 2):
        said = describe(looker)
        assert (said.text, said.seen) == (say_same("a cup? cup"), True)
        assert (said.brain.name, said.brain.fallback_from) == ("detector", "m")
        assert said.brain.fallback_message is not None
        assert said.brain.fallback_reason in (why, "resting")
    assert breaker.is_closed is not rests
    assert (model.calls < TRIPS + 2) is rests, "a server that is down is not waited for again"
    with pytest.raises((BrainDown, BadPlan)):
        asyncio.run(looker.point(ImageQuestion(PICTURE, "the cup")))
    with pytest.raises((BrainDown, BadPlan)):  # no detector knows what is sought
        asyncio.run(looker.seek(ImageQuestion(PICTURE, "the umbrella stand")))


def test_a_model_that_answers_is_believed_and_a_cancellation_is_not_swallowed() -> None:
    looker = FallbackLooker(Scripted(None), by_detector)
    assert (describe(looker).brain, looker.tag) == (MODEL, MODEL)
    assert asyncio.run(looker.point(ImageQuestion(PICTURE, "the cup"))) == ImagePoint(1, 2, MODEL)
    assert asyncio.run(looker.seek(ImageQuestion(PICTURE, "a stand"))).middle == 1
    breaker = Breaker()
    with pytest.raises(asyncio.CancelledError):
        describe(FallbackLooker(Scripted(asyncio.CancelledError()), by_detector, breaker))
    assert breaker.is_closed
    assert not breaker.trying
