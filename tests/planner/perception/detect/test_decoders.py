"""Let one thing be seen through every layout: the same box, name and score must come out."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from onnx import TensorProto

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.detect.decoders import ALL
from planner.perception.snapshot import Detection
from tests.planner.perception.detect import tiny
from tests.planner.perception.detect.tiny import Array, Layout, Seen

WIDTH, HEIGHT = 128, 64
"""Of the picture; the input is 64 x 64, so it is halved and has a border above and below."""
THING = (20.0, 10.0, 60.0, 40.0)
"""In the picture."""
PLACES = {"centred": (0.5, 0.5, 16.0), "corner": (0.5, 0.5, 0.0), "stretched": (0.5, 1.0, 0.0)}
BAD = (np.nan, np.inf, -np.inf)


@dataclass(frozen=True)
class Case:
    """One layout, and why it is read as it is."""

    layout: Layout
    decoder: str
    why: str
    metadata: Mapping[str, str] = field(default_factory=dict)
    labels: bool = False
    beside: tuple[Any, ...] = ()
    shape: tuple[int | str, ...] = (1, 3, tiny.SIDE, tiny.SIDE)


YOLO = tiny.ULTRALYTICS
LABELS, SCORES = "outputs are named labels,", "outputs are named scores, labels"
BY_ITSELF = "metadata: it suppresses"
CASES = (
    Case(tiny.yolov8, "yolov8", "metadata: 2 names", YOLO),
    Case(tiny.yolov8_turned, "yolov8", "metadata: 2 names", YOLO),
    Case(tiny.yolov5, "yolov5", "metadata: 2 names", {"names": "['person', 'cup']"}),
    Case(tiny.yolox, "yolox", "labels: 2 names", labels=True),
    Case(tiny.yolox_decoded, "yolox_decoded", "labels: 2 names", labels=True),
    Case(tiny.end_to_end, "end_to_end", BY_ITSELF, YOLO | {"end2end": "True"}),
    Case(tiny.end_to_end, "end_to_end", BY_ITSELF, YOLO | {"args": "{'nms': True}"}),
    Case(tiny.end_to_end, "end_to_end", "shape: output0 1x10x6", labels=True),
    Case(tiny.rtdetr, "rtdetr", LABELS, labels=True, beside=(tiny.sizes(),)),
    Case(tiny.rtdetr, "rtdetr", LABELS, labels=True),
    Case(tiny.rtdetr_alone, "rtdetr", SCORES, labels=True, beside=(tiny.sizes(),)),
    Case(tiny.rtdetr_alone, "rtdetr", SCORES, labels=True,
         beside=(tiny.sizes("orig_target_size", (2,), TensorProto.FLOAT),),
         shape=(3, tiny.SIDE, tiny.SIDE)),
    Case(tiny.rtdetr_alone, "rtdetr", SCORES, YOLO,
         beside=(tiny.sizes("target_sizes", ("N", 2), TensorProto.INT32),),
         shape=("N", 3, tiny.SIDE, tiny.SIDE)),
    Case(tiny.rtdetr_rows, "rtdetr_rows", "metadata: described", YOLO | {"description": "rt-detr"}),
    Case(tiny.rfdetr, "rfdetr", "outputs are named dets, labels", labels=True),
    Case(tiny.mmyolo, "mmyolo", "outputs are named num_dets,", labels=True),
    Case(tiny.detr_logits, "detr_logits", "outputs are named logits,", labels=True),
    Case(tiny.owlvit, "owlvit", "outputs are named logits,", labels=True),
    Case(tiny.owlv2, "owlv2", "outputs are named objectness_logits,", YOLO),
)  # fmt: skip
IDS = [f"{n} {case.layout.__name__} by {case.why[:18]}" for n, case in enumerate(CASES)]


def in_input(case: Case, box: Sequence[float] = THING) -> tuple[float, float, float, float]:
    """Return where a box of the picture lies in the model's input."""
    scale_x, scale_y, top = PLACES[ALL[case.decoder].RECIPE.fit]
    left, upper, right, lower = box
    return left * scale_x, upper * scale_y + top, right * scale_x, lower * scale_y + top


def detector(case: Case, folder: Path, outputs: Mapping[str, Array]) -> OnnxDetector:
    """Return a detector that puts out just that."""
    path = tiny.model(
        folder / "m.onnx", outputs, case.shape, metadata=case.metadata, beside=case.beside
    )
    labels = None
    if case.labels:
        labels = folder / "names.txt"
        labels.write_text("\n".join(tiny.NAMES))
    return OnnxDetector(ModelOptions(path, labels))


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_each_layout_shows_the_same_thing(case: Case, tmp_path: Path) -> None:
    shifted = tuple(side + 2.0 for side in THING)
    seen = [
        Seen(in_input(case), 1, 0.9),
        Seen(in_input(case, (100.0, 4.0, 120.0, 60.0)), 0, 0.6),
        Seen(in_input(case, shifted), 0, 0.5),  # another class: it stays beside the first
        Seen(in_input(case), 1, 0.3),  # below the least score
    ]
    looking = detector(case, tmp_path, case.layout(seen))
    assert looking.about.decoder == case.decoder
    assert looking.about.why.startswith(case.why)
    assert looking.about.classes[:2] == tiny.NAMES
    found = looking.look(tiny.jpeg(WIDTH, HEIGHT)).detections
    assert [it.label for it in found] == ["cup", "person", "person"]
    assert found[0].score == pytest.approx(0.9, abs=1e-3)
    assert found[0].box == pytest.approx(THING, abs=0.01)
    assert found[0].color == "red"


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_of_several_boxes_for_one_thing_the_strongest_stays(case: Case, tmp_path: Path) -> None:
    shifted = tuple(side + 2.0 for side in THING)
    seen = [Seen(in_input(case, shifted), 1, 0.6), Seen(in_input(case), 1, 0.9)]
    looking = detector(case, tmp_path, case.layout(seen))
    found = looking.look(tiny.jpeg(WIDTH, HEIGHT)).detections
    suppressed = ALL[case.decoder].SUPPRESS
    assert [round(it.score, 2) for it in found] == ([0.9] if suppressed else [0.9, 0.6])


def looked(looking: OnnxDetector, outputs: Iterable[Array]) -> tuple[Detection, ...]:
    """Return what it sees where its model puts out something else."""
    given = list(outputs)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(looking.model.session, "run", lambda _: given)
        return looking.look(tiny.jpeg(WIDTH, HEIGHT)).detections


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_what_is_not_finite_never_becomes_a_thing(case: Case, tmp_path: Path) -> None:
    """Spoil each number that shows a thing, one by one."""
    clean, empty = case.layout([Seen(in_input(case), 1, 0.9)]), case.layout([])
    looking = detector(case, tmp_path, clean)
    assert len(looked(looking, clean.values())) == 1
    floats = {name: it for name, it in clean.items() if np.issubdtype(it.dtype, np.floating)}
    for name, value in floats.items():
        for place in np.argwhere(value != empty[name]):
            for bad in BAD:
                spoilt = {other: it.copy() for other, it in clean.items()}
                spoilt[name][tuple(place)] = bad
                assert looked(looking, spoilt.values()) == (), (name, place, bad)


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_outputs_full_of_nonsense_become_nothing(case: Case, tmp_path: Path) -> None:
    clean = case.layout([])
    looking = detector(case, tmp_path, clean)
    for bad in BAD:
        floats = (np.full_like(it, bad) if it.dtype.kind == "f" else it for it in clean.values())
        assert looked(looking, floats) == (), bad


@pytest.mark.parametrize("height_first", [False, True])
def test_boxes_of_a_size_that_was_asked_for_come_back_to_the_picture(
    tmp_path: Path, *, height_first: bool
) -> None:
    """The input is no square: whoever wants height first is not told width first."""
    shares = np.array([[0.25, 0.5, 0.75, 1.0]], np.float32)
    path = tiny.asking(tmp_path / "m.onnx", shares, (1, 3, 64, 96), height_first=height_first)
    (found,) = OnnxDetector(ModelOptions(path)).look(tiny.jpeg(WIDTH, HEIGHT)).detections
    assert found.box == pytest.approx((32.0, 32.0, 96.0, 64.0), abs=0.01)


def test_any_number_of_boxes_is_survived(tmp_path: Path) -> None:
    """A hundred thousand come out, all but two as strong as each other: those two are kept."""
    count = 100_000
    labels, scores = np.zeros(count, np.int64), np.full(count, 0.5, np.float32)
    boxes = np.tile(np.array([[4.0, 4.0, 20.0, 20.0]], np.float32), (count, 1))
    scores[[777, 99_999]], labels[99_999] = (0.8, 0.9), 1
    scores[5], boxes[6], labels[7] = np.nan, np.inf, 99
    outputs: dict[str, Array] = {"labels": labels, "boxes": boxes, "scores": scores}
    quiet = outputs | {"scores": np.zeros_like(scores)}
    path = tiny.model(tmp_path / "m.onnx", quiet, metadata={"names": "['person', 'cup']"})
    looking = OnnxDetector(ModelOptions(path))
    found = looked(looking, outputs.values())
    assert [round(it.score, 2) for it in found[:3]] == [0.9, 0.8, 0.5]
    assert found[0].label == "cup"
    assert len(found) <= 100


def test_a_thousand_boxes_come_out_as_a_hundred_at_most(tmp_path: Path) -> None:
    case = CASES[0]
    out = np.zeros((1, 6, 4000), np.float32)
    out[0, 0], out[0, 1] = np.arange(4000) % 64, 16 + np.arange(4000) // 125
    out[0, 2:4], out[0, 4] = 0.9, 0.5
    looking = detector(case, tmp_path, {"output0": out})
    assert len(looking.look(tiny.jpeg(WIDTH, HEIGHT)).detections) <= 100


def test_every_picture_itself_reaches_the_model(tmp_path: Path) -> None:
    """A model whose score is the red of its input sees red pictures alone, one after another."""
    box = np.array([[[16, 16, 48, 48, 0, 1]]], np.float32)
    score = np.array([[[0, 0, 0, 0, 1, 0]]], np.float32)
    red = np.array([1, 0, 0], np.float32).reshape(1, 3, 1, 1)
    path = tiny.live(tmp_path / "red.onnx", box, score, red, tiny.ULTRALYTICS)
    looking = OnnxDetector(ModelOptions(path))
    for color, expected in (((0, 0, 255), [1.0]), ((255, 0, 0), []), ((9, 9, 204), [0.8])):
        found = looking.look(tiny.jpeg(tiny.SIDE, tiny.SIDE, color)).detections
        assert [round(it.score, 1) for it in found] == expected
