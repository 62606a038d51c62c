"""Write a streaming transducer that hears loudness instead of words, as files for sherpa-onnx.

Not trained and not a recogniser: its weights are written by hand, so that a test knows what the
real library must return. Steady noise that is faint is "go" and then "home", loud "stop", between
them "停"; silence is nothing. A few kB.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import onnx
from numpy.typing import NDArray
from onnx import TensorProto, helper, numpy_helper

SYMBOLS = ("<blk>", "<sos/eos>", "<unk>", "▁GO", "▁HOME", "▁STOP", "停")
FEATURES = 80
CHUNK_FRAMES, CHUNK_STEP = 9, 4
"""Of 10 ms; what the encoder sees and by how much it then goes on."""
FAINT, MIDDLING, LOUD = 300, 2_500, 16_000
"""Standard deviations of white noise, of 32767, that fall between the encoder's bounds."""
BOUNDS = (-6.5, -3.0, 1.0)
"""Mean logarithms of the filter bank's energies, from which a sound is faint, middling, loud."""
STEADY = 2.0
"""How far a chunk's frames may lie apart: what swells is not judged yet."""
SURE = 12.0
"""How far a chosen symbol stands above all others."""

Shape = list[int | str]
Arrays = dict[str, NDArray[np.float32] | NDArray[np.int64]]


def write_model(folder: Path, *, suffix: str = "", fresh: bool = True) -> Path:
    """Write encoder, decoder, joiner and tokens into a folder, and return it."""
    folder.mkdir(parents=True, exist_ok=True)
    _write_encoder(folder / f"encoder{suffix}.onnx")
    _write_decoder(folder / f"decoder{suffix}.onnx")
    _write_joiner(folder / f"joiner{suffix}.onnx")
    if fresh:
        lines = (f"{symbol} {number}\n" for number, symbol in enumerate(SYMBOLS))
        (folder / "tokens.txt").write_text("".join(lines), "utf-8")
    return folder


def _write_encoder(path: Path) -> None:
    """Score each symbol by the mean energy of the newest frames: blank below all bounds."""
    gates: Arrays = {
        "bounds": np.array([[list(BOUNDS)]], np.float32),
        "steep": np.array(200.0, np.float32),
        "scores": _scores_by_loudness(),
        "silent": np.array([[[SURE, *[0.0] * (len(SYMBOLS) - 1)]]], np.float32),
        "steady": np.array(STEADY, np.float32),
        "swelling": np.array([[[8.0 * SURE, *[0.0] * (len(SYMBOLS) - 1)]]], np.float32),
    }
    nodes = [
        helper.make_node("ReduceMean", ["x"], ["energies"], axes=[2], keepdims=1),
        helper.make_node("ReduceMin", ["energies"], ["least"], axes=[1], keepdims=1),
        helper.make_node("ReduceMax", ["energies"], ["most"], axes=[1], keepdims=1),
        helper.make_node("Sub", ["least", "bounds"], ["over"]),
        helper.make_node("Mul", ["over", "steep"], ["gate"]),
        helper.make_node("Sigmoid", ["gate"], ["open"]),
        helper.make_node("MatMul", ["open", "scores"], ["raised"]),
        helper.make_node("Add", ["raised", "silent"], ["judged"]),
        helper.make_node("Sub", ["most", "least"], ["apart"]),
        helper.make_node("Sub", ["apart", "steady"], ["unsteady"]),
        helper.make_node("Mul", ["unsteady", "steep"], ["unsteadily"]),
        helper.make_node("Sigmoid", ["unsteadily"], ["swells"]),
        helper.make_node("Mul", ["swells", "swelling"], ["held_back"]),
        helper.make_node("Add", ["judged", "held_back"], ["encoder_out"]),
        helper.make_node("Identity", ["h"], ["next_h"]),
        helper.make_node("Identity", ["c"], ["next_c"]),
    ]
    state: Shape = ["layers", "N", 1]
    _save(
        path,
        nodes,
        gates,
        inputs=[("x", ["N", CHUNK_FRAMES, FEATURES]), ("h", state), ("c", state)],
        outputs=[("encoder_out", ["N", 1, len(SYMBOLS)]), ("next_h", state), ("next_c", state)],
        told={
            "model_type": "lstm",
            "num_encoder_layers": "1",
            "T": str(CHUNK_FRAMES),
            "decode_chunk_len": str(CHUNK_STEP),
            "rnn_hidden_size": "1",
            "d_model": "1",
        },
    )


def _scores_by_loudness() -> NDArray[np.float32]:
    """Return what each passed bound adds to each symbol: the last one passed wins."""
    scores = np.zeros((len(BOUNDS), len(SYMBOLS)), np.float32)
    scores[0, [0, 3, 4]] = -SURE, SURE, SURE
    scores[1, [3, 4, 6]] = -SURE, -SURE, SURE
    scores[2, [6, 5]] = -SURE, SURE
    return scores


def _write_decoder(path: Path) -> None:
    """Say each symbol once, and "home" only after "go"."""
    least = -4.0 * SURE
    after = np.zeros((len(SYMBOLS), len(SYMBOLS)), np.float32)
    after[:, 0] = SURE / 2.0
    after[:, 4] = least
    after[3, [3, 4]] = least, 0.0
    for said in (4, 5, 6):
        after[said, [3, 4, said]] = least
    nodes = [
        helper.make_node("Gather", ["y", "last"], ["newest"], axis=1),
        helper.make_node("Gather", ["after", "newest"], ["decoder_out"], axis=0),
    ]
    values: Arrays = {"last": np.array(1, np.int64), "after": after}
    _save(
        path,
        nodes,
        values,
        inputs=[("y", ["N", 2])],
        outputs=[("decoder_out", ["N", len(SYMBOLS)])],
        told={"vocab_size": str(len(SYMBOLS)), "context_size": "2"},
        kind=TensorProto.INT64,
    )


def _write_joiner(path: Path) -> None:
    width: Shape = ["N", len(SYMBOLS)]
    _save(
        path,
        [helper.make_node("Add", ["encoder_out", "decoder_out"], ["logit"])],
        {},
        inputs=[("encoder_out", width), ("decoder_out", width)],
        outputs=[("logit", width)],
        told={"joiner_dim": str(len(SYMBOLS))},
    )


def _save(
    path: Path,
    nodes: list[onnx.NodeProto],
    values: Arrays,
    *,
    inputs: list[tuple[str, Shape]],
    outputs: list[tuple[str, Shape]],
    told: dict[str, str],
    kind: int = TensorProto.FLOAT,
) -> None:
    graph = helper.make_graph(
        nodes,
        path.stem,
        [helper.make_tensor_value_info(name, kind, shape) for name, shape in inputs],
        [helper.make_tensor_value_info(name, TensorProto.FLOAT, shape) for name, shape in outputs],
        [numpy_helper.from_array(value, name) for name, value in values.items()],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)
    helper.set_model_props(model, told)
    path.write_bytes(model.SerializeToString())
