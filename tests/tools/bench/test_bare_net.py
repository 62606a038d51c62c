"""Cut networks out of files: what goes in front of the first convolution, and behind the last."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from onnx import TensorProto, helper, load, numpy_helper

from planner.perception.process_client import DEFAULT_MODEL
from tests.planner.perception.detect import tiny
from tools.bench.bare_net import BareNet, NotCut, cut, ends
from tools.train.budget import CLASSES, HEIGHT_PX, STRIDES, WIDTH_PX


def convolving(path: Path, cast: str = "floats") -> Path:
    """Write bytes made floats, a convolution, and two behind it whose answers are joined."""
    node = helper.make_node
    made = helper.make_graph(
        [
            node("Cast", ["images"], ["floats"], to=TensorProto.FLOAT),
            node("Conv", [cast, "double"], ["doubled"]),
            node("Relu", ["doubled"], ["between"]),
            node("Conv", ["between", "double"], ["left"]),
            node("Conv", ["between", "double"], ["right"]),
            node("Sigmoid", ["right"], ["squashed"]),
            node("Add", ["left", "squashed"], ["output0"]),
        ],
        "convolving",
        [helper.make_tensor_value_info("images", TensorProto.UINT8, (1, 1, 4, 4))],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, (1, 1, 4, 4))],
        [numpy_helper.from_array(np.full((1, 1, 1, 1), 2.0, np.float32), "double")],
    )
    return tiny.write(path, made, {})


def test_the_network_lies_between_the_first_convolution_and_the_last_ones(tmp_path: Path) -> None:
    path = convolving(tmp_path / "m.onnx")
    assert ends(load(path).graph) == ("floats", ["left", "right"])
    pictures = [np.full((1, 1, 4, 4), value, np.uint8) for value in (3, 100)]
    net = BareNet(path, pictures, 1, tmp_path)
    for number, value in enumerate((3, 100)):
        net.ready(number)
        for said in net.run():
            assert np.array_equal(said, np.full((1, 1, 4, 4), 4.0 * value, np.float32))


def test_what_has_nothing_to_cut_is_said(tmp_path: Path) -> None:
    with pytest.raises(NotCut, match="no convolution"):
        cut(tiny.of_bytes(tmp_path / "m.onnx", (1, 64, 64, 3), {}), tmp_path)
    with pytest.raises(NotCut, match="first convolution's"):
        cut(convolving(tmp_path / "m.onnx", "images"), tmp_path)


def test_of_our_own_detector_only_the_heads_speak(tmp_path: Path) -> None:
    net = BareNet(DEFAULT_MODEL, [np.zeros((1, HEIGHT_PX, WIDTH_PX, 3), np.uint8)], 1, tmp_path)
    count = len(CLASSES) + 4
    shapes = [(1, count, HEIGHT_PX // stride, WIDTH_PX // stride) for stride in STRIDES]
    assert [said.shape for said in net.run()] == shapes
