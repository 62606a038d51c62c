"""Hold the number of names to what the trial tells: one too many makes no other layout of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.detect.decoders import choose
from planner.perception.detect.decoders.base import Facts, Shape
from planner.perception.detect.decoders.layout_choice import has_objectness
from planner.perception.detect.decoders.yolo import grid
from planner.perception.detect.model_file import GREY
from planner.perception.failure import VisionFailure
from tests.planner.perception.detect import tiny

SIDE, COLUMNS = 64, 9
TASK = {"task": "detect"}


def facts(
    names: int, score: float, reach: float = 60.0, metadata: Mapping[str, str] | None = None
) -> Facts:
    """Return what is known of a row a cell of nine columns: four classes, or five."""
    trial = np.full((1, tiny.CELLS, COLUMNS), score, np.float32)
    trial[0, :, :4] = reach
    known = tuple(f"thing_{number}" for number in range(names))
    return Facts({"out": trial.shape}, metadata or {}, known, "labels", SIDE, SIDE, reach, trial)


TOLD = [
    ("yolox", 4, 0.0, 3.0, {}),
    ("yolox", 4, 0.0, 3.0, TASK),  # the numbers are no pixels, whatever is said
    ("yolox_decoded", 4, 0.15, 60.0, {}),
    ("yolov8", 5, 1e-5, 60.0, {}),
    ("yolov8", 5, 0.15, 60.0, TASK),
    ("yolov8", 5, 0.0, 60.0, TASK),
    ("yolov8", 5, 0.0, 0.0, TASK),
]


@pytest.mark.parametrize(("name", "count", "score", "reach", "metadata"), TOLD)
def test_the_trial_tells_the_layout_and_the_names_must_fit_it(
    name: str, count: int, score: float, reach: float, metadata: Mapping[str, str]
) -> None:
    told = choose(facts(count, score, reach, metadata)).decoder.NAME
    assert told == name
    for wrong in {3, 4, 5, 6} - {count}:
        with pytest.raises(VisionFailure, match="model_names_wrong") as caught:
            choose(facts(wrong, score, reach, metadata))
        assert caught.value.detail.startswith(f"as {name} it has {count} classes, {wrong} names")
        assert ("[vision] decoder" in caught.value.detail) == (wrong in {4, 5})


@pytest.mark.parametrize("score", [0.0, 0.02, np.nan])
@pytest.mark.parametrize("names", [4, 5])
def test_where_nothing_tells_the_owner_must(score: float, names: int) -> None:
    silent = facts(names, score)
    for known in (silent, replace(silent, trial=None)):
        with pytest.raises(VisionFailure, match="model_layout_unknown") as caught:
            choose(known)
        assert "yolov8 (5 classes) or yolox_decoded (4 classes)" in caught.value.detail
    said = {4: "yolox_decoded", 5: "yolov8"}[names]
    told = choose(silent, said).decoder.NAME
    assert told == said


def test_an_objectness_that_is_one_everywhere_is_no_class() -> None:
    known = facts(5, 1e-5)
    assert known.trial is not None
    known.trial[0, :, 4] = 1.0
    with pytest.raises(VisionFailure, match="model_layout_unknown"):
        choose(known)


def test_a_trial_without_numbers_leaves_names_alone_and_is_refused() -> None:
    with pytest.raises(VisionFailure, match="model_layout_unknown"):
        choose(facts(5, np.nan, np.nan))


V5, RT = 3 * tiny.CELLS, 10
SCORED = [
    ("yolov8", (1, 6, tiny.CELLS), (0, slice(4, None)), {}),
    ("yolov8", (1, 6, 40), (0, slice(4, None)), {}),  # a grid of strides of its own
    ("yolov8", (1, tiny.CELLS, 6), (0, slice(None), slice(4, None)), TASK),
    ("yolov8", (1, tiny.CELLS, 5), (0, slice(None), slice(4, None)), {}),
    ("yolov5", (1, V5, 7), (0, slice(None), slice(4, None)), {}),
    ("yolox", (1, tiny.CELLS, 7), (0, slice(None), slice(4, None)), {}),
    ("rtdetr_rows", (1, RT, 6), (0, slice(None), slice(4, None)), {"description": "RT-DETR"}),
]


@pytest.mark.parametrize(("name", "shape", "scores", "metadata"), SCORED)
def test_what_scores_beyond_zero_to_one_is_of_another_layout(
    name: str, shape: Shape, scores: tuple[int | slice, ...], metadata: Mapping[str, str]
) -> None:
    reach = 3.0 if name == "yolox" else 60.0
    trial = np.full(shape, reach, np.float32)
    trial[scores] = 0.5
    names = ("thing", "other")[: 1 if shape[-1] == 5 else 2]
    known = Facts({"out": shape}, metadata, names, "labels", SIDE, SIDE, reach, trial)
    for fine in (0.0, 1.0, np.nan, np.inf):
        trial[scores][0] = fine
        told = choose(known).decoder.NAME
        assert told == name
    for wrong in (-0.1, 1.1, 60.0):
        trial[scores][0] = wrong
        with pytest.raises(VisionFailure, match="model_layout_unknown") as caught:
            choose(known)
        assert f"as {name} its scores in a trial are from" in caught.value.detail


def test_a_model_of_others_tells_that_it_has_an_objectness(shared_data: Path) -> None:
    path, labels = shared_data / "models" / "yolox_nano.onnx", shared_data / "models"
    yolox = OnnxDetector(ModelOptions(path, labels / "coco_classes.txt"))
    grey = np.full((1, 3, yolox.about.height, yolox.about.width), GREY, np.float32)
    (raw,) = yolox.model.session.run({yolox.model.input.name: grey})
    decoded = np.array(raw, np.float32)
    corners, strides = grid(416, 416, (8, 16, 32))
    decoded[0, :, :2] = (decoded[0, :, :2] + corners) * strides
    decoded[0, :, 2:4] = np.exp(decoded[0, :, 2:4]) * strides
    assert has_objectness(replace(facts(4, 0.0), trial=decoded)) is True


def test_one_name_too_many_is_refused_for_a_model_of_others(
    shared_data: Path, tmp_path: Path
) -> None:
    path, labels = shared_data / "models" / "yolox_nano.onnx", tmp_path / "names.txt"
    for count in (79, 81):
        labels.write_text("\n".join(f"thing {number}" for number in range(count)))
        with pytest.raises(VisionFailure, match="model_names_wrong"):
            OnnxDetector(ModelOptions(path, labels))
