"""Open what is no detector: each is refused with its own code, before a picture ever comes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from onnx import TensorProto, helper

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.detect.input_size import BYTES, EXPECTED, FLOAT
from planner.perception.detect.onnx_file import examine
from planner.perception.detect.session import ModelSession
from planner.perception.failure import REFUSALS, VisionFailure
from tests.planner.perception.detect import tiny

GOOD = tiny.yolov8([])


def good(path: Path) -> Path:
    return tiny.model(path, GOOD, metadata=tiny.ULTRALYTICS)


def directory(path: Path) -> Path:
    path.mkdir()
    return path


def written(data: bytes) -> Callable[[Path], Path]:
    def write(path: Path) -> Path:
        path.write_bytes(data)
        return path

    return write


def without_its_end(path: Path) -> Path:
    data = good(path).read_bytes()
    path.write_bytes(data[: len(data) // 2])
    return path


def with_a_broken_middle(path: Path) -> Path:
    data = bytearray(good(path).read_bytes())
    data[40:300] = bytes(260)
    path.write_bytes(data)
    return path


def with_names_that_are_no_text(path: Path) -> Path:
    path.write_bytes(good(path).read_bytes().replace(b"'person'", b"'\xff\xff\xff\xff\xff\xff'"))
    return path


def bare_nms(path: Path) -> Path:
    """Be the graph that some exporters write beside the detector: boxes in, choice out."""
    inputs = [
        helper.make_tensor_value_info("boxes", TensorProto.FLOAT, (1, 100, 4)),
        helper.make_tensor_value_info("scores", TensorProto.FLOAT, (1, 2, 100)),
    ]
    output = helper.make_tensor_value_info("selected", TensorProto.INT64, ("n", 3))
    node = helper.make_node("NonMaxSuppression", ["boxes", "scores"], ["selected"])
    return tiny.write(path, helper.make_graph([node], "nms", inputs, [output]), {})


def shaped(*shape: int | str, **more: object) -> Callable[[Path], Path]:
    return lambda path: tiny.model(path, GOOD, shape, tiny.ULTRALYTICS | {"imgsz": ""}, **more)


def putting_out(output: tiny.Array) -> Callable[[Path], Path]:
    return lambda path: tiny.model(path, {"output0": output}, metadata=tiny.ULTRALYTICS)


def a_list(path: Path) -> Path:
    """Put out a list of tensors, as converters of other learners' models do."""
    picture = helper.make_tensor_value_info("images", TensorProto.FLOAT, (1, 3, 64, 64))
    several = helper.make_tensor_sequence_value_info("all", TensorProto.FLOAT, None)
    node = helper.make_node("SequenceConstruct", ["images"], ["all"])
    return tiny.write(path, helper.make_graph([node], "list", [picture], [several]), {})


def detr(
    metadata: dict[str, str] | None = None, beside: tuple[object, ...] = (), **other: tiny.Array
) -> Callable[[Path], Path]:
    """Put out labels, boxes and scores without a batch, some of them as a bad export has them."""
    outputs = tiny.rtdetr_alone([]) | other
    sizes = beside or (tiny.sizes(),)
    return lambda path: tiny.model(path, outputs, metadata=metadata, beside=sizes)


WORDS = {"labels": np.full((1, tiny.QUERIES), "cup", object)}
BESIDE = helper.make_tensor_value_info("scale_factor", TensorProto.FLOAT, (1, 2))
REFUSED = [
    (lambda path: path, "model_missing", "m.onnx"),
    (directory, "model_unreadable", "not a file"),
    (written(b""), "model_truncated", "empty"),
    (written(b"weights of something else\n" * 40), "model_not_onnx", "m.onnx"),
    (written(b"PK\x03\x04" + bytes(200)), "model_not_onnx", "m.onnx"),
    (without_its_end, "model_truncated", "its fields go on"),
    (with_a_broken_middle, "model_broken", "m.onnx"),
    (with_names_that_are_no_text, "model_broken", "can't decode byte 0xff"),
    (bare_nms, "model_not_detector", "boxes [1, 100, 4]"),
    (shaped(1, 3, 64, 64, opset=999), "model_too_new", "which knows operators to "),
    (shaped(1, 3, 64, 64, ir=99), "model_too_new", "format 99"),
    (shaped(1, 3, "h", "w"), "model_size_open", "input_px"),
    (shaped(4, 3, 64, 64), "model_input_odd", "[4, 3, 64, 64]"),
    (shaped(1, 1, 64, 64), "model_input_odd", "expected 1 x 3 x height x width"),
    (shaped(1, 64, 64, 3), "model_input_odd", f"[1, 64, 64, 3] {FLOAT}; {EXPECTED}"),
    (shaped(1, 3, 8, 64), "model_input_odd", "64 x 8 px; expected 32 to 2048"),
    (shaped(1, 3, 64, 9000), "model_input_odd", "9000 x 64"),
    (shaped(1, 3, 64, 64, kind=TensorProto.UINT8), "model_input_odd",
     f"[1, 3, 64, 64] {BYTES}; {EXPECTED}"),
    (shaped(4, 64, 64, 3, kind=TensorProto.UINT8), "model_input_odd", EXPECTED),
    (shaped(1, 8, 64, 3, kind=TensorProto.UINT8), "model_input_odd", "64 x 8 px"),
    (shaped(1, 64, 64, 3, kind=TensorProto.INT8), "model_input_odd", EXPECTED),
    (shaped(1, 3, 64, 64, beside=(BESIDE,)), "model_input_odd", "scale_factor"),
    (lambda path: tiny.model(path, GOOD), "model_names_missing", "it has 2"),
    (lambda path: tiny.model(path, GOOD, metadata={"names": "exit()"}), "model_names_malformed",
     "metadata names"),
    (lambda path: tiny.model(path, GOOD, metadata={"names": "['a']"}), "model_names_wrong",
     "2 classes, 1 names"),
    (lambda path: tiny.model(path, {"probabilities": np.zeros((1, 9), np.float32)}),
     "model_not_detector", "probabilities 1x9"),
    (putting_out(GOOD["output0"].astype(np.int64)), "model_not_detector", "no output holds fract"),
    (a_list, "model_not_detector", "no output holds fractions"),
    (putting_out(np.full((1, 10, 6), "cup", object)), "model_not_detector", "tensor(string)"),
    (putting_out(np.full_like(GOOD["output0"], np.nan)), "model_broken", "no number came out"),
    (putting_out(np.full_like(GOOD["output0"], np.inf)), "model_broken", "no number came out"),
    (lambda path: tiny.model(path, tiny.rtdetr([]) | WORDS, metadata=tiny.ULTRALYTICS,
                             beside=(tiny.sizes(),)),
     "model_layout_unknown", "labels holds object; expected numbers"),
    (detr(), "model_names_missing", "[vision] labels"),
    (detr(boxes=np.zeros((10, 5), np.float32), metadata=tiny.ULTRALYTICS), "model_layout_unknown",
     "boxes 10x5; expected for rtdetr labels n, boxes n x 4, scores n, or all three"),
    (detr(labels=np.zeros(9, np.int64), metadata=tiny.ULTRALYTICS), "model_layout_unknown",
     "labels 9, boxes 10x4"),
    (detr(labels=np.full(10, 79), scores=np.full(10, 0.1, np.float32), metadata=tiny.ULTRALYTICS),
     "model_names_wrong", "class 79 came out, counted from 0; 2 names"),
    (detr(scores=np.full(10, 4.2, np.float32), metadata=tiny.ULTRALYTICS), "model_not_detector",
     "its score is none"),
    (detr(labels=np.full(10, 0.5, np.float32), scores=np.full(10, 0.1, np.float32),
          metadata=tiny.ULTRALYTICS), "model_not_detector", "its class is no number of a class"),
    (detr(scores=np.full(10, np.nan, np.float32), metadata=tiny.ULTRALYTICS), "model_broken",
     "no number came out"),
    (detr(metadata=tiny.ULTRALYTICS, beside=(tiny.sizes(shape=(4, 2)),)), "model_input_odd",
     "orig_target_sizes [4, 2] tensor(int64); beside the picture only its size"),
    (lambda path: tiny.model(path, tiny.mmyolo([]) | {"num_dets": np.zeros((1, 2), np.int32)},
                             metadata=tiny.ULTRALYTICS),
     "model_layout_unknown", "for mmyolo num_dets 1 x 1, boxes 1 x n x 4"),
    (lambda path: tiny.model(path, tiny.detr_logits([]), metadata={"names": "['only one']"}),
     "model_names_wrong", "as detr_logits it has 2 classes, 1 names"),
    (detr(metadata=tiny.ULTRALYTICS, beside=(tiny.sizes("im_shape"),)), "model_input_odd",
     "im_shape"),
]  # fmt: skip


@pytest.mark.parametrize(("make", "code", "told"), REFUSED, ids=[code for _, code, _ in REFUSED])
def test_what_is_no_detector_is_refused(
    make: Callable[[Path], Path], code: str, told: str, tmp_path: Path
) -> None:
    with pytest.raises(VisionFailure) as caught:
        OnnxDetector(ModelOptions(make(tmp_path / "m.onnx")))
    assert caught.value.code == code
    assert told in caught.value.detail
    assert caught.value.message["en"].startswith(REFUSALS[code][0])
    assert caught.value.message["zh"].startswith(REFUSALS[code][1])


@pytest.mark.parametrize(
    ("metadata", "input_px"), [({"imgsz": "[64, 64]"}, None), ({"imgsz": "64"}, 32), ({}, 64)]
)
def test_a_size_left_open_is_taken_from_metadata_or_else_from_the_owner(
    metadata: dict[str, str], input_px: int | None, tmp_path: Path
) -> None:
    shape = ("batch", 3, "height", "width")
    path = tiny.model(tmp_path / "m.onnx", GOOD, shape, tiny.ULTRALYTICS | metadata)
    about = OnnxDetector(ModelOptions(path, input_px=input_px)).about
    assert (about.width, about.height) == (64, 64)


def test_labels_take_the_place_of_the_names_in_the_file(tmp_path: Path) -> None:
    labels = tmp_path / "names.txt"
    labels.write_text("Robot\nCoffee Cup\n", "utf-8")
    assert OnnxDetector(ModelOptions(good(tmp_path / "m.onnx"), labels)).about.classes == (
        "robot",
        "coffee_cup",
    )
    for content, code in ((b"\xff\xfe", "model_names_malformed"), (None, "model_names_missing")):
        labels.unlink(missing_ok=True)
        if content is not None:
            labels.write_bytes(content)
        with pytest.raises(VisionFailure, match=code):
            OnnxDetector(ModelOptions(tmp_path / "m.onnx", labels))


def test_words_beside_the_boxes_are_left_aside(tmp_path: Path) -> None:
    outputs = tiny.yolov5([]) | WORDS
    path = tiny.model(tmp_path / "m.onnx", outputs, metadata={"names": "['person', 'cup']"})
    assert OnnxDetector(ModelOptions(path)).look(tiny.jpeg(64, 64)).skipped is None


def test_a_model_that_fails_the_second_time_is_refused(tmp_path: Path) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("out of memory")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ModelSession, "fix", fail)
        with pytest.raises(VisionFailure, match=r"model_broken: .*second picture: out of memory"):
            OnnxDetector(ModelOptions(good(tmp_path / "m.onnx")))


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return good(tmp_path_factory.mktemp("model") / "m.onnx")


def test_a_file_cut_anywhere_is_never_taken_for_whole(whole: Path, tmp_path: Path) -> None:
    data, cut = whole.read_bytes(), tmp_path / "cut.onnx"
    examine(whole)
    end = data.rfind(b"\x42")  # its operators' version is what must not be missing
    for length in range(0, end, 61):
        cut.write_bytes(data[:length])
        with pytest.raises(VisionFailure) as caught:
            examine(cut)
        assert caught.value.code in ("model_truncated", "model_not_onnx")


@given(data=st.binary(max_size=200))
@settings(max_examples=50)
def test_whatever_a_file_holds_it_is_examined_or_refused(
    data: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / "any.onnx"
    path.write_bytes(data)
    with pytest.raises(VisionFailure):
        examine(path)
