"""Take six columns for boxes only where they can be boxes: a classifier may have them too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.failure import VisionFailure
from tests.planner.perception.detect import tiny
from tests.planner.perception.detect.tiny import Array

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
