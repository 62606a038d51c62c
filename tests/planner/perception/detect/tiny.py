"""Make detectors of every layout that see what a test wants: picture in, constants out."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from onnx import TensorProto, helper, numpy_helper, save

Array = NDArray[Any]
SIDE = 64
CELLS = 64 + 16 + 4
NAMES = ("person", "cup")
OPSET, IR_VERSION = 17, 8
ULTRALYTICS = {"names": "{0: 'person', 1: 'cup'}", "stride": "32", "task": "detect"}
QUERIES = 10
BESIDE_OBJECTNESS = 0.15
"""What a real YOLOX typically scores its likeliest class by where nothing is."""


@dataclass(frozen=True)
class Seen:
    """What a model is to see: a box in input pixels, a class, a score."""

    box: tuple[float, float, float, float]
    number: int
    score: float


def model(
    path: Path,
    outputs: Mapping[str, Array],
    shape: Sequence[int | str] = (1, 3, SIDE, SIDE),
    metadata: Mapping[str, str] | None = None,
    **more: Any,
) -> Path:
    """Write a model of constants. More: ``kind`` of the input, ``beside`` it, ``opset``, ``ir``."""
    nodes = [helper.make_node("Identity", [f"{name}_is"], [name]) for name in outputs]
    graph = helper.make_graph(
        nodes,
        "tiny",
        [
            helper.make_tensor_value_info("images", more.get("kind", TensorProto.FLOAT), shape),
            *more.get("beside", ()),
        ],
        [
            helper.make_tensor_value_info(
                name, helper.np_dtype_to_tensor_dtype(value.dtype), value.shape
            )
            for name, value in outputs.items()
        ],
        [numpy_helper.from_array(value, f"{name}_is") for name, value in outputs.items()],
    )
    return write(path, graph, metadata or {}, more.get("opset", OPSET), more.get("ir", IR_VERSION))


def live(path: Path, base: Array, by: Array, weights: Array, metadata: Mapping[str, str]) -> Path:
    """Write a model that puts out base + by x (the weighted mean of each channel of its input)."""
    made = helper.make_graph(
        [
            helper.make_node("GlobalAveragePool", ["images"], ["means"]),
            helper.make_node("Mul", ["means", "weights"], ["weighted"]),
            helper.make_node("ReduceSum", ["weighted", "axes"], ["sum"], keepdims=0),
            helper.make_node("Mul", ["by", "sum"], ["grown"]),
            helper.make_node("Add", ["base", "grown"], ["output0"]),
        ],
        "live",
        [helper.make_tensor_value_info("images", TensorProto.FLOAT, (1, 3, SIDE, SIDE))],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, base.shape)],
        [
            numpy_helper.from_array(weights, "weights"),
            numpy_helper.from_array(np.array([0, 1, 2, 3], np.int64), "axes"),
            numpy_helper.from_array(by, "by"),
            numpy_helper.from_array(base, "base"),
        ],
    )
    return write(path, made, metadata)


def hungry(path: Path, floats: int) -> Path:
    """Write a model that asks for so many numbers while it is made ready."""
    made = helper.make_graph(
        [
            helper.make_node("ConstantOfShape", ["many"], ["ones"]),
            helper.make_node("ReduceSum", ["ones"], ["sum"]),
            helper.make_node("GlobalAveragePool", ["images"], ["means"]),
            helper.make_node("Add", ["means", "sum"], ["output0"]),
        ],
        "hungry",
        [helper.make_tensor_value_info("images", TensorProto.FLOAT, (1, 3, SIDE, SIDE))],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, None)],
        [numpy_helper.from_array(np.array([floats], np.int64), "many")],
    )
    return write(path, made, {})


PRIMARIES = ("first", "second", "third")
BRIGHT = 0.6
"""From which mean on, as a share of white, :func:`of_bytes` sees a channel."""


def of_bytes(path: Path, shape: Sequence[int | str], metadata: Mapping[str, str]) -> Path:
    """Write a model that takes bytes and sees a box for each bright channel, however many."""
    boxes = np.tile(np.array([[8, 24, 56, 40]], np.float32), (3, 1))
    constants = {
        "boxes": boxes,
        "classes": np.arange(3, dtype=np.float32)[:, None],
        "white": np.float32(255.0),
        "least": np.float32(BRIGHT),
        "flat": np.array([-1], np.int64),
        "front": np.array([0], np.int64),
    }
    made = helper.make_graph(
        [
            helper.make_node("Cast", ["images"], ["floats"], to=TensorProto.FLOAT),
            helper.make_node("ReduceMean", ["floats"], ["means"], axes=[0, 1, 2], keepdims=0),
            helper.make_node("Div", ["means", "white"], ["shares"]),
            helper.make_node("Greater", ["shares", "least"], ["bright"]),
            helper.make_node("Unsqueeze", ["shares", "flat"], ["scores"]),
            helper.make_node("Concat", ["boxes", "scores", "classes"], ["all"], axis=1),
            helper.make_node("Compress", ["all", "bright"], ["rows"], axis=0),
            helper.make_node("Unsqueeze", ["rows", "front"], ["output0"]),
        ],
        "of_bytes",
        [helper.make_tensor_value_info("images", TensorProto.UINT8, shape)],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, (1, "n", 6))],
        [numpy_helper.from_array(np.asarray(it), name) for name, it in constants.items()],
    )
    return write(path, made, {"names": str(PRIMARIES), "end2end": "True"} | dict(metadata))


def write(
    path: Path, graph: Any, metadata: Mapping[str, str], opset: int = OPSET, ir: int = IR_VERSION
) -> Path:
    """Write a graph as a model file."""
    made = helper.make_model(graph, opset_imports=[helper.make_opsetid("", opset)], ir_version=ir)
    helper.set_model_props(made, dict(metadata))
    save(made, path)
    return path


def sizes(
    name: str = "orig_target_sizes",
    shape: Sequence[int | str] = (1, 2),
    kind: int = TensorProto.INT64,
) -> Any:
    """Return the input by which RT-DETR, D-FINE and the like ask for the picture's size."""
    return helper.make_tensor_value_info(name, kind, shape)


def asking(path: Path, shares: Array, shape: Sequence[int], *, height_first: bool) -> Path:
    """Write a DETR without batches whose boxes are shares (n x 4) of the size that it is told."""
    order = [1, 0, 1, 0] if height_first else [0, 1, 0, 1]
    count = len(shares)
    constants = {
        "shares": shares,
        "order": np.array(order, np.int64),
        "labels_are": np.ones(count, np.int64),
        "scores_are": np.full(count, 0.9, np.float32),
    }
    made = helper.make_graph(
        [
            helper.make_node("Cast", ["orig_target_size"], ["told"], to=TensorProto.FLOAT),
            helper.make_node("Gather", ["told", "order"], ["edges"], axis=0),
            helper.make_node("Mul", ["shares", "edges"], ["boxes"]),
            helper.make_node("Identity", ["labels_are"], ["labels"]),
            helper.make_node("Identity", ["scores_are"], ["scores"]),
        ],
        "asking",
        [
            helper.make_tensor_value_info("images", TensorProto.FLOAT, shape),
            sizes("orig_target_size", (2,), TensorProto.INT32),
        ],
        [
            helper.make_tensor_value_info("labels", TensorProto.INT64, (count,)),
            helper.make_tensor_value_info("boxes", TensorProto.FLOAT, (count, 4)),
            helper.make_tensor_value_info("scores", TensorProto.FLOAT, (count,)),
        ],
        [numpy_helper.from_array(it, name) for name, it in constants.items()],
    )
    return write(path, made, {"names": str(list(NAMES))})


def centred(box: Sequence[float]) -> tuple[float, float, float, float]:
    """Return a box by centre and size."""
    left, top, right, bottom = box
    return (left + right) / 2, (top + bottom) / 2, right - left, bottom - top


def yolov8(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return 1 x (4 + classes) x cells."""
    out = np.zeros((1, 4 + len(NAMES), CELLS), np.float32)
    for cell, it in enumerate(seen):
        out[0, :4, cell] = centred(it.box)
        out[0, 4 + it.number, cell] = it.score
    return {"output0": out}


def yolov8_turned(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return 1 x cells x (4 + classes)."""
    return {"output0": np.ascontiguousarray(yolov8(seen)["output0"].transpose(0, 2, 1))}


def yolov5(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return 1 x (3 x cells) x (5 + classes)."""
    out = np.zeros((1, 3 * CELLS, 5 + len(NAMES)), np.float32)
    for row, it in enumerate(seen):
        out[0, row, :4] = centred(it.box)
        out[0, row, 4] = 1.0
        out[0, row, 5 + it.number] = it.score
    return {"output": out}


def yolox(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return the raw grid; what is seen goes to cells of the coarser grids, row 64 and on."""
    out = np.zeros((1, CELLS, 5 + len(NAMES)), np.float32)
    for number, it in enumerate(seen):
        x, y, wide, high = centred(it.box)
        column, line = number % 4, number // 4  # of the grid of 4 x 4 cells of 16 px
        row = 64 + 4 * line + column
        out[0, row, :2] = x / 16 - column, y / 16 - line
        out[0, row, 2:4] = np.log((wide / 16, high / 16))
        out[0, row, 4] = it.score
        out[0, row, 5 + it.number] = 1.0
    return {"output": out}


def yolox_decoded(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return the grid as it is once decoded; every cell has its box, and talks of its classes."""
    out = np.zeros((1, CELLS, 5 + len(NAMES)), np.float32)
    out[0, :, :4], out[0, :, 5:] = (SIDE - 8, SIDE - 8, 9, 9), BESIDE_OBJECTNESS
    for row, it in enumerate(seen):
        out[0, row, :4] = centred(it.box)
        out[0, row, 4] = it.score
        out[0, row, 5 + it.number] = 1.0
    return {"output": out}


def end_to_end(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return 1 x n x 6."""
    out = np.zeros((1, QUERIES, 6), np.float32)
    for row, it in enumerate(seen):
        out[0, row] = (*it.box, it.score, it.number)
    return {"output0": out}


def rtdetr(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return labels, boxes and scores."""
    labels, boxes = np.zeros((1, QUERIES), np.int64), np.zeros((1, QUERIES, 4), np.float32)
    scores = np.zeros((1, QUERIES), np.float32)
    for row, it in enumerate(seen):
        labels[0, row], boxes[0, row], scores[0, row] = it.number, it.box, it.score
    return {"labels": labels, "boxes": boxes, "scores": scores}


def rtdetr_alone(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return labels n, boxes n x 4 and scores n, without a batch around them, in another order."""
    of = {name: output[0] for name, output in rtdetr(seen).items()}
    return {"scores": of["scores"], "labels": of["labels"].astype(np.int32), "boxes": of["boxes"]}


def rtdetr_rows(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return 1 x n x (4 + classes), boxes in shares of the input."""
    out = np.zeros((1, QUERIES, 4 + len(NAMES)), np.float32)
    for row, it in enumerate(seen):
        out[0, row, :4] = np.array(centred(it.box)) / SIDE
        out[0, row, 4 + it.number] = it.score
    return {"output0": out}


def rfdetr(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return boxes in shares and logits, with one class more than have a name."""
    dets = np.zeros((1, QUERIES, 4), np.float32)
    labels = np.full((1, QUERIES, len(NAMES) + 1), -9.0, np.float32)
    for row, it in enumerate(seen):
        dets[0, row] = np.array(centred(it.box)) / SIDE
        labels[0, row, it.number] = np.log(it.score / (1 - it.score))
    return {"dets": dets, "labels": labels}


def mmyolo(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return boxes that are counted; behind them stands filling that looks like some."""
    of = rtdetr(seen)
    of["boxes"][0, -1], of["scores"][0, -1] = (0.0, 0.0, 60.0, 60.0), 0.99
    return {"num_dets": np.array([[len(seen)]], np.int32), **of}


def detr_logits(seen: Sequence[Seen], queries: int = QUERIES) -> dict[str, Array]:
    """Return logits and boxes in shares."""
    logits = np.full((1, queries, len(NAMES)), -9.0, np.float32)
    boxes = np.zeros((1, queries, 4), np.float32)
    for row, it in enumerate(seen):
        boxes[0, row] = np.array(centred(it.box)) / SIDE
        logits[0, row, it.number] = np.log(it.score / (1 - it.score))
    return {"logits": logits, "pred_boxes": boxes}


def owlvit(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return the same with a query for each patch of 16 px, and embeddings beside it."""
    embeds = np.zeros((1, len(NAMES), 8), np.float32)
    return detr_logits(seen, (SIDE // 16) ** 2) | {"text_embeds": embeds}


def owlv2(seen: Sequence[Seen]) -> dict[str, Array]:
    """Return the same with how likely each patch is any thing."""
    return {"objectness_logits": np.zeros((1, (SIDE // 16) ** 2), np.float32), **owlvit(seen)}


Layout = Callable[[Sequence[Seen]], dict[str, Array]]


def jpeg(width: int, height: int, color: tuple[int, int, int] = (0, 0, 255)) -> bytes:
    """Return a picture of one colour (blue, green, red)."""
    return encoded(".jpg", np.full((height, width, 3), color, np.uint8))


def encoded(kind: str, picture: Array) -> bytes:
    """Return a picture as a file of that kind."""
    return bytes(cv2.imencode(kind, picture)[1].tobytes())
