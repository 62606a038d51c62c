"""Check that who asks the model about pictures is put together so that a refusal shows."""

from __future__ import annotations

import asyncio
from pathlib import Path

import httpx
import pytest

from planner.brain import FallbackBrain, OfflineBrain
from planner.brain.endpoint import EndpointBrain
from planner.brain.image_questions import ImageDescription, ImageQuestion, PosedPicture
from planner.perception import Detection, VisionWorker
from planner.perception_factory import looker_of
from planner.settings import ModelSettings, VisionSettings
from tests.planner.brain.pictures import jpeg

CUP = Detection("cup", 0.9, (10.0, 10.0, 20.0, 20.0), "red", 1.5)
SMALL, LARGE = ((320, 240), (2048, 1536))


@pytest.mark.parametrize(
    ("url", "size", "why"),
    [
        ("https://model.example/v1", SMALL, "pictures_offhost"),
        ("http://127.0.0.1:9/v1", LARGE, "bad_picture"),  # nobody there who could make it smaller
    ],
)
def test_the_detector_answers_for_a_picture_that_does_not_leave(
    url: str, size: tuple[int, int], why: str, tmp_path: Path
) -> None:
    def nothing(request: httpx.Request) -> httpx.Response:
        raise AssertionError("a call went out")

    async def story() -> ImageDescription:
        settings = ModelSettings(url=url, name="m", allow_offhost=True)
        model = EndpointBrain(settings, tmp_path, transport=httpx.MockTransport(nothing))
        worker = VisionWorker(VisionSettings())
        looker = looker_of(model, FallbackBrain(model, OfflineBrain()), worker)
        assert looker is not None
        shown = PosedPicture(jpeg(*size), *size, seq=1)
        try:
            return await looker.describe(
                ImageQuestion(shown, "what is there?", detections=[CUP], goal="g1")
            )
        finally:
            await worker.close()
            await model.close()

    said = asyncio.run(story())
    assert said.text.en == "I see: red cup."
    assert (said.brain.name, said.brain.fallback_from) == ("detector", "m")
    assert said.brain.fallback_reason == why


def test_without_a_model_nobody_is_asked() -> None:
    assert looker_of(None, OfflineBrain(), VisionWorker(VisionSettings())) is None
