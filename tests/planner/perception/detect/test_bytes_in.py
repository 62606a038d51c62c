"""Give a model a picture's bytes: it scales by itself, and may see nothing at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from tests.planner.perception.detect import tiny

RED = (0, 0, 255)
"""Blue, green, red."""
SHAPE = (1, 64, 64, 3)


def detector(folder: Path, **metadata: str) -> OnnxDetector:
    return OnnxDetector(ModelOptions(tiny.of_bytes(folder / "m.onnx", SHAPE, metadata)))


@pytest.mark.parametrize(
    ("metadata", "label"),
    [({}, "first"), ({"channels": "3"}, "first"), ({"channels": "bgr"}, "third")],
)
def test_channels_go_in_as_the_metadata_say(
    metadata: dict[str, str], label: str, tmp_path: Path
) -> None:
    (seen,) = detector(tmp_path, **metadata).look(tiny.jpeg(64, 64, RED)).detections
    assert seen.label == label
    assert seen.score == pytest.approx(254 / 255, abs=0.005)
    assert seen.box == (8, 24, 56, 40)


def test_a_picture_of_another_size_is_fitted_on_grey_and_its_boxes_come_back(
    tmp_path: Path,
) -> None:
    looking = detector(tmp_path)
    seen = looking.look(tiny.jpeg(128, 64, (255, 255, 255))).detections
    assert {it.label for it in seen} == set(tiny.PRIMARIES)
    for it in seen:
        assert it.score == pytest.approx((255 + 114) / 2 / 255, abs=0.002)
        assert it.box == (16, 16, 112, 48)


def test_no_rows_at_all_are_an_empty_picture_and_no_failure(tmp_path: Path) -> None:
    looking = detector(tmp_path)
    for _ in range(2):
        dim = looking.look(tiny.jpeg(64, 64, (100, 100, 100)))
        assert (dim.skipped, dim.detections) == (None, ())
        (red,) = looking.look(tiny.jpeg(64, 64, RED)).detections
        assert red.label == "first"


def test_a_size_left_open_is_taken_from_the_metadata(tmp_path: Path) -> None:
    shape = ("batch", "height", "width", 3)
    path = tiny.of_bytes(tmp_path / "m.onnx", shape, {"imgsz": "[64, 96]"})
    about = OnnxDetector(ModelOptions(path)).about
    assert (about.width, about.height, about.decoder) == (96, 64, "end_to_end")
