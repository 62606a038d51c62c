"""Cut a model's file to the network proper: from its first convolution to its last ones.

What a file does beside that for whoever calls it (a picture's bytes made numbers in front, boxes
made, chosen and suppressed behind) is left out: so a look can be held against the network alone,
wherever the rest is done. Needs ``onnx``.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from planner.perception.detect.session import ModelSession

    Array = NDArray[np.generic]

CONVOLUTION = "Conv"


class NotCut(ValueError):
    """The file holds no convolution to cut at."""


def ends(graph: Any) -> tuple[str, list[str]]:
    """Return what goes into a graph's first convolution, and what its last ones put out.

    The last are those that no other convolution hears of.

    Raises:
        NotCut: there is none.
    """
    convolutions = [node for node in graph.node if node.op_type == CONVOLUTION]
    if not convolutions:
        raise NotCut("the model holds no convolution")
    heard: set[str] = set()
    last: list[str] = []
    for node in reversed(graph.node):  # a graph's nodes stand in the order of their running
        convolves = node.op_type == CONVOLUTION
        if convolves and not heard.intersection(node.output):
            last.append(node.output[0])
        if convolves or heard.intersection(node.output):
            heard.update(node.input)
    return convolutions[0].input[0], last[::-1]


def cut(model: Path, folder: Path) -> tuple[Path, Path]:
    """Write what comes in front of the network and the network, and return both files.

    Raises:
        NotCut: there is no network, or nothing in front of it.
    """
    import onnx

    whole = onnx.shape_inference.infer_shapes(onnx.load(model))
    given = whole.graph.input[0].name
    first, last = ends(whole.graph)
    if first == given:
        raise NotCut("the model's input is its first convolution's")
    extractor = onnx.utils.Extractor(whole)
    files = folder / "front.onnx", folder / "net.onnx"
    onnx.save(extractor.extract_model([given], [first]), files[0])
    onnx.save(extractor.extract_model([first], last), files[1])
    return files


class BareNet:
    """Run the network of a model alone, on inputs that lie ready, as the planner runs models."""

    def __init__(self, model: Path, inputs: Sequence[Array], threads: int, folder: Path) -> None:
        """Cut and warm it up.

        Raises:
            NotCut: as above.
        """
        front, net = (_session(file, threads) for file in cut(model, folder))
        name = front.inputs[0].name
        self._inputs = [front.run({name: array})[0].copy() for array in inputs]
        self._buffer = self._inputs[0].copy()
        self._feeds = {net.inputs[0].name: self._buffer}
        net.fix(self._feeds, net.run(self._feeds))
        self._net = net

    def ready(self, number: int) -> None:
        """Put an input where the network reads it."""
        self._buffer[...] = self._inputs[number]

    def run(self) -> Sequence[Array]:
        """Return what the last convolutions put out."""
        return self._net.run(self._feeds)


def _session(file: Path, threads: int) -> ModelSession:
    from planner.perception.detect.onnx_file import examine
    from planner.perception.detect.session import ModelSession

    return ModelSession(file, examine(file), threads, "cpu")
