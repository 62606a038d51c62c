"""Boxes are taken where they can be boxes, by scores that are known; the shipped detector too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.detect.detections import Row, filter_rows
from planner.perception.detect.detector import MIN_SCORE, least_scores
from planner.perception.failure import VisionFailure
from planner.perception.process_client import DEFAULT_MODEL
from tests.planner.perception.detect import tiny
from tests.planner.perception.detect.tiny import Array
from tools.train.budget import CLASSES, HEIGHT_PX, WIDTH_PX

GOOD = (10.0, 10.0, 40.0, 40.0, 0.9, 1.0)
NMS = {"end2end": "True"}


def rows(*given: tuple[float, ...], fill: float = 0.0) -> Array:
    """Return such rows, and some that hold nothing."""
    return np.array([[*given, *[(fill,) * 6] * 4]], np.float32)


def detector(folder: Path, output: Array, metadata: dict[str, str] | None = None) -> OnnxDetector:
    named = {"names": "['person', 'cup']"} | (metadata or {})
    return OnnxDetector(
        ModelOptions(tiny.model(folder / "m.onnx", {"output0": output}, metadata=named))
    )


NOISE = np.random.default_rng(5).normal(0.0, 1.0, (1, 512, 6)).astype(np.float32)
NONE = [
    (rows((10, 10, 40, 40, 0.9, 0.5)), "no number of a class"),
    (rows((10, 10, 40, 40, 0.9, -2.0)), "no number of a class"),
    (rows((10, 10, 40, 40, 1.5, 1.0)), "its score is none"),
    (rows((10, 10, 40, 40, -3.0, 1.0)), "its score is none"),
    (rows((40, 10, 10, 40, 0.9, 1.0)), "its box ends before it begins"),
    (rows((10, 40, 40, 10, 0.9, 1.0)), "its box ends before it begins"),
    (NOISE, "its score is none"),
    (np.abs(NOISE) / 9, "no number of a class"),
    (np.array([GOOD], np.float32), "outputs: output0 1x6"),
]


@pytest.mark.parametrize(("output", "told"), NONE)
def test_what_gives_no_boxes_is_no_detector(output: Array, told: str, tmp_path: Path) -> None:
    with pytest.raises(VisionFailure, match="model_not_detector") as caught:
        detector(tmp_path, output)
    assert told in caught.value.detail


def test_a_class_without_a_name_came_of_another_model(tmp_path: Path) -> None:
    with pytest.raises(VisionFailure, match=r"model_names_wrong: .*class 2 came out.*2 names"):
        detector(tmp_path, rows((10, 10, 40, 40, 0.1, 2.0)))


@pytest.mark.parametrize(
    ("output", "metadata"),
    [
        (rows(GOOD), {}),
        (rows(GOOD, fill=-1.0), {}),  # as some exporters fill up
        (rows(GOOD, (np.nan,) * 6, (9, 9, 1, 1, 0.01, 1.0)), {}),
        (np.array([GOOD], np.float32), NMS),  # one row, by its own word
        (np.array([GOOD] * 2, np.float32), {}),
    ],
)
def test_what_gives_boxes_is_a_detector(
    output: Array, metadata: dict[str, str], tmp_path: Path
) -> None:
    looking = detector(tmp_path, output, metadata)
    assert looking.about.decoder == "end_to_end"
    assert {it.label for it in looking.look(tiny.jpeg(64, 64)).detections} == {"cup"}


@pytest.mark.parametrize("number", [0.7, -1.0, -0.5, 2.0, 3e38, np.inf, -np.inf, np.nan])
def test_a_row_that_names_no_class_becomes_nothing_later_either(
    number: float, tmp_path: Path
) -> None:
    looking = detector(tmp_path, rows(GOOD))
    later = rows((10, 10, 40, 40, 0.9, number))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(looking.model.session, "run", lambda _: [later])
        result = looking.look(tiny.jpeg(64, 64))
    assert (result.skipped, result.detections) == (None, ())


def test_the_owner_wins_over_the_file() -> None:
    told = {"min_scores": "[0.5, 0.6]"}
    assert least_scores(told, 2, None) == ((0.5, 0.6), "0.50 to 0.60 by class, as its file says")
    assert least_scores(told, 2, 0.3) == ((0.3, 0.3), "0.30, as set")
    assert least_scores({}, 2, None) == ((MIN_SCORE, MIN_SCORE), "0.40")


@pytest.mark.parametrize(
    "text",
    ["", "[0.5]", "[0.5, 0.6, 0.7]", "0.5", "['a', 'b']", "[0.0, 0.5]", "[0.5, 1.0]", "[NaN, 0.5]",
     "[0.5, Infinity]", "[-0.5, 0.5]", "[true, 0.5]", "[null, 0.5]", "{0: 0.5, 1: 0.5}", "(("],
)  # fmt: skip
def test_what_is_no_score_for_each_class_is_not_meant_for_us(text: str) -> None:
    assert least_scores({"min_scores": text}, 2, None)[0] == (MIN_SCORE, MIN_SCORE)


def test_each_class_has_a_least_score_of_its_own() -> None:
    rows: list[Row] = [
        (0.0, 0.0, 9.0, 9.0, score, number)
        for score, number in ((0.5, 0), (0.5, 1), (0.6, 1), (0.4, 0))
    ]
    assert filter_rows(rows, [0.45, 0.55]) == [rows[0], rows[2]]


def test_a_detector_believes_as_its_file_says(tmp_path: Path) -> None:
    said = tiny.ULTRALYTICS | {"min_scores": str([0.55] * len(tiny.NAMES))}
    said |= {"min_scores": "[0.55, 0.45]"}
    seen = [
        tiny.Seen(box=(4, 4, 20, 20), number=0, score=0.5),
        tiny.Seen(box=(30, 30, 50, 50), number=1, score=0.5),
    ]
    path = tiny.model(tmp_path / "m.onnx", tiny.yolov8(seen), metadata=said)
    picture = tiny.jpeg(tiny.SIDE, tiny.SIDE)

    def labels(detector: OnnxDetector) -> list[str]:
        return [it.label for it in detector.look(picture).detections]

    detector = OnnxDetector(ModelOptions(path))
    assert labels(detector) == [tiny.NAMES[1]]
    assert "0.45 to 0.55 by class" in detector.about.line
    assert sorted(labels(OnnxDetector(ModelOptions(path), 0.3))) == sorted(tiny.NAMES)


@pytest.fixture(scope="module")
def shipped() -> OnnxDetector:
    return OnnxDetector(ModelOptions(DEFAULT_MODEL, provider="cpu"))


def test_it_is_read_as_what_it_is(shipped: OnnxDetector) -> None:
    about = shipped.about
    assert (about.decoder, about.width, about.height) == ("end_to_end", WIDTH_PX, HEIGHT_PX)
    assert about.classes == CLASSES
    assert "as its file says" in about.least
    assert shipped.model.input.bytes_in == "bgr"


def test_a_bare_wall_is_an_empty_picture(shipped: OnnxDetector) -> None:
    for size in ((WIDTH_PX, HEIGHT_PX), (640, 360)):
        result = shipped.look(tiny.jpeg(*size, (120, 130, 140)))
        assert (result.skipped, result.detections) == (None, ())
