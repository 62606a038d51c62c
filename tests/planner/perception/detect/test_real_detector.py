"""Let a detector that strangers trained look at photographs of rooms that strangers took."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.snapshot import LookResult

SEEN = {
    "om1_indoor_2.jpg": {"pottedplant"},
    "rai_vlm_image_1.jpg": {"chair", "bed"},
    "rai_vlm_image_3.jpg": {"chair"},
    "rai_vlm_image_5.jpg": {"pottedplant"},
    "rai_vlm_image_7.jpg": {"chair", "sofa"},
}
"""What a person sees there too."""


@pytest.fixture(scope="module")
def detector(shared_data: Path) -> OnnxDetector:
    models = shared_data / "models"
    return OnnxDetector(ModelOptions(models / "yolox_nano.onnx", models / "coco_classes.txt"))


def test_it_is_read_as_what_it_is(detector: OnnxDetector) -> None:
    about = detector.about
    assert (about.decoder, about.width, about.height) == ("yolox", 416, 416)
    assert len(about.classes) == 80


def test_it_sees_what_is_there(detector: OnnxDetector, shared_data: Path) -> None:
    for name, expected in SEEN.items():
        result = detector.look((shared_data / "images" / name).read_bytes())
        assert expected <= {it.label for it in result.detections}, name
        assert_sane(result)


def test_a_chair_is_where_it_stands(detector: OnnxDetector, shared_data: Path) -> None:
    result = detector.look((shared_data / "images" / "rai_vlm_image_7.jpg").read_bytes())
    chair = next(it for it in result.detections if it.label == "chair")
    assert chair.box == pytest.approx((508, 316, 639, 479), abs=6)
    assert chair.color == "gray"


def assert_sane(result: LookResult) -> None:
    for it in result.detections:
        left, top, right, bottom = it.box
        assert 0 <= left < right <= result.width
        assert 0 <= top < bottom <= result.height
        assert 0.4 <= it.score <= 1.0
