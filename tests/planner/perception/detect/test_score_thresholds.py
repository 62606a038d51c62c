"""Hold who says how high a class must score, and what becomes of what is no such word."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.detect.detections import Row, filter_rows
from planner.perception.detect.detector import MIN_SCORE, least_scores
from tests.planner.perception.detect import tiny


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
