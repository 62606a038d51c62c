"""Open the detector that comes with Pons: bytes in as they are unpacked, finished boxes out."""

from __future__ import annotations

import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.process_client import DEFAULT_MODEL
from tests.planner.perception.detect import tiny
from tools.train.budget import CLASSES, HEIGHT_PX, WIDTH_PX


@pytest.fixture(scope="module")
def detector() -> OnnxDetector:
    return OnnxDetector(ModelOptions(DEFAULT_MODEL, provider="cpu"))


def test_it_is_read_as_what_it_is(detector: OnnxDetector) -> None:
    about = detector.about
    assert (about.decoder, about.width, about.height) == ("end_to_end", WIDTH_PX, HEIGHT_PX)
    assert about.classes == CLASSES
    assert "as its file says" in about.least
    assert detector.model.input.bytes_in == "bgr"


def test_a_bare_wall_is_an_empty_picture(detector: OnnxDetector) -> None:
    for size in ((WIDTH_PX, HEIGHT_PX), (640, 360)):
        result = detector.look(tiny.jpeg(*size, (120, 130, 140)))
        assert (result.skipped, result.detections) == (None, ())
