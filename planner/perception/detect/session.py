"""Open onnxruntime sessions that leave the processor to others. The only file that imports it.

Its threads spin by default while they wait: beside the bridge's loop that made ticks late and burnt
twice the processor, so spinning is off and the threads are counted. A provider's offer is what was
compiled in; whether it works here shows only when a session opens, and what then really runs is
asked of the session. Azure's provider sends pictures away: it is never taken.
"""

from __future__ import annotations

import re
import resource
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile
from math import isfinite
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import onnxruntime as ort
from numpy.typing import NDArray
from onnxruntime.capi import onnxruntime_pybind11_state

from planner.perception.detect.onnx_file import OnnxFile
from planner.perception.failure import VisionFailure

CPU = "CPUExecutionProvider"
ORDER = {
    "tensorrt": "TensorrtExecutionProvider",
    "cuda": "CUDAExecutionProvider",
    "openvino": "OpenVINOExecutionProvider",
    "coreml": "CoreMLExecutionProvider",
    "cpu": CPU,
}
"""Fastest first, by the names that settings use."""
SHORT = {long: short for short, long in ORDER.items()}


@dataclass(frozen=True, slots=True)
class Providers:
    """Hold the providers that a session is asked for, first choice first, and why."""

    names: tuple[str, ...]
    why: str
    wanted: str | None = None
    """What the owner set, by its short name."""

    def explain(self, running: Sequence[str]) -> tuple[str, str]:
        """Return the provider that really runs and why.

        Raises:
            VisionFailure: ``provider_unavailable`` where the owner set another.
        """
        first = running[0] if running else CPU
        short = SHORT.get(first, first)
        if first == self.names[0]:
            return short, self.why
        failed = takewhile(lambda name: name != first, self.names)
        listed = ", ".join(SHORT[name] for name in failed)
        text = f"{listed} was offered but did not start; {short} runs"
        if self.wanted is not None:
            raise VisionFailure("provider_unavailable", text)
        return short, text


def choose_providers(offered: Sequence[str], wanted: str | None = None) -> Providers:
    """Return the providers to ask for: each stands behind the ones that did not start, CPU last.

    An onnxruntime for CUDA offers TensorRT too, whether or not that is installed. Where the owner
    set one, CPU alone stands behind it, for what it can't do.

    Raises:
        VisionFailure: ``provider_unavailable`` where the owner set one that is not offered.
    """
    known = tuple(name for name in ORDER.values() if name in offered)
    listed = ", ".join(SHORT[name] for name in known) or "none"
    if wanted is not None:
        if ORDER.get(wanted) not in known:
            raise VisionFailure("provider_unavailable", f"{wanted}; offered here: {listed}")
        return Providers(_with_cpu((ORDER[wanted],)), "set by the owner", wanted)
    if not known:
        raise VisionFailure("provider_unavailable", f"offered: {', '.join(offered) or 'none'}")
    return Providers(_with_cpu(known), f"first of: {listed}")


def _with_cpu(names: tuple[str, ...]) -> tuple[str, ...]:
    return (*(name for name in names if name != CPU), CPU)


Array = NDArray[np.generic]
RUN_ERRORS: tuple[type[Exception], ...] = (
    RuntimeError,
    ValueError,
    TypeError,
    LookupError,
    ArithmeticError,
    MemoryError,
    cv2.error,
    *(
        kind
        for kind in vars(onnxruntime_pybind11_state).values()
        if isinstance(kind, type) and issubclass(kind, Exception)
    ),
)
"""What a run, or the reading of an odd output or picture, may end in: neither library's own errors
have a base of their own. That costs one picture, never the process."""
QUIET = 3
"""Errors alone: warnings of a stranger's graph tell its owner nothing."""
MAX_WORDS = 240
MOST_BYTES = 3 << 30
"""A detector of 1 GB, its copy while it is made ready, and a picture: more is a mistake or an
attack, for a graph of a few bytes may ask for any number of them."""
SAMPLES = 1000
FRACTIONS, NUMBERS = "f", frozenset("fiub")
"""Letters of numpy's kinds."""
_NEWEST = re.compile(r"till opset (\d+)")
"""How onnxruntime says which operators it knows, after much else."""


@dataclass(frozen=True, slots=True)
class Slot:
    """Name one input or output and its shape; a size that is left open is a word or None."""

    name: str
    shape: tuple[int | str | None, ...]
    kind: str

    def describe(self) -> str:
        """Write it for a person."""
        return f"{self.name} [{', '.join(map(str, self.shape))}] {self.kind}"


class ModelSession:
    """Run one model."""

    def __init__(
        self, path: Path, file: OnnxFile, threads: int, provider: str | None = None
    ) -> None:
        """Load it.

        Args:
            path: of the model.
            file: what the model says of itself, for the words of a refusal.
            threads: that think at once.
            provider: short name of what the owner set.

        Raises:
            VisionFailure: ``model_broken``, ``model_too_new`` or ``provider_unavailable``.
        """
        ort.disable_telemetry_events()
        chosen = choose_providers(ort.get_available_providers(), provider)
        try:
            self._session: Any = ort.InferenceSession(
                str(path), sess_options=options(threads), providers=list(chosen.names)
            )
            # Names that are no UTF-8 are read here, and no earlier.
            self.inputs = tuple(map(_slot, self._session.get_inputs()))
            self.outputs = tuple(map(_slot, self._session.get_outputs()))
            self.metadata: Mapping[str, str] = self._session.get_modelmeta().custom_metadata_map
        except RUN_ERRORS as error:
            raise _refusal(path, file, error) from None
        self.provider, self.provider_why = chosen.explain(self._session.get_providers())
        self._fixed: Mapping[str, Array] | None = None
        self._binding: Any = None
        self._results: list[Array] = []

    def run(self, feeds: Mapping[str, Array]) -> Sequence[Array]:
        """Return the outputs, valid until the next run of fixed feeds. Raises ``RUN_ERRORS``."""
        if feeds is self._fixed:
            self._session.run_with_iobinding(self._binding)
            return self._results
        found: Sequence[Array] = self._session.run(None, feeds)
        return found

    def fix(self, feeds: Mapping[str, Array], outputs: Sequence[Array]) -> None:
        """Run these very feeds, in their own arrays, into the same outputs each time.

        That saves making and copying the outputs: 0.1 ms of 7. Only on the CPU, and where the
        model promises the shapes that came out of a trial.
        """
        promised = [slot.shape for slot in self.outputs]
        if self.provider != "cpu" or not all(kind_of(found) in NUMBERS for found in outputs):
            return
        if promised != [found.shape for found in outputs]:
            return
        binding = self._session.io_binding()
        self._results = [np.empty_like(found) for found in outputs]
        for name, array in feeds.items():
            binding.bind_input(name, *_memory(array))
        for slot, array in zip(self.outputs, self._results, strict=True):
            binding.bind_output(slot.name, *_memory(array))
        self._binding, self._fixed = binding, feeds


def options(threads: int) -> Any:
    """Return the options of every session."""
    made = ort.SessionOptions()
    made.intra_op_num_threads = threads
    made.inter_op_num_threads = 1
    made.execution_mode = ort.ExecutionMode.ORT_SEQUENTIAL
    made.graph_optimization_level = ort.GraphOptimizationLevel.ORT_ENABLE_ALL
    made.add_session_config_entry("session.intra_op.allow_spinning", "0")
    made.add_session_config_entry("session.inter_op.allow_spinning", "0")
    made.log_severity_level = QUIET
    return made


def kind_of(found: object) -> str:
    """Return numpy's letter for an output's type; none for a list, which some graphs give."""
    return found.dtype.kind if isinstance(found, np.ndarray) else ""


def senseless(outputs: Sequence[Array]) -> bool:
    """Tell whether an output of fractions has some and none is finite, by a sample of them."""
    fractions = (found for found in outputs if kind_of(found) == FRACTIONS)
    return any(it.size > 0 and not (isfinite(it.item(0)) or _any_finite(it)) for it in fractions)


def _any_finite(fractions: Array) -> bool:
    sample = fractions.reshape(-1)[:: max(1, fractions.size // SAMPLES)]
    return bool(np.isfinite(sample).any())


def _memory(array: Array) -> tuple[str, int, type[np.generic], tuple[int, ...], int]:
    """Return device, its number, kind, shape and address of an array."""
    return "cpu", 0, array.dtype.type, array.shape, array.ctypes.data


def _slot(node: Any) -> Slot:
    return Slot(str(node.name), tuple(node.shape), str(node.type))


def _refusal(path: Path, file: OnnxFile, error: Exception) -> VisionFailure:
    text = last_words(error)
    newer = "opset" in text.lower() and "guarantee" in text.lower()
    if newer or "unsupported model ir version" in text.lower():
        needs = f"operators {file.opset}, format {file.ir_version}"
        most = _NEWEST.search(text)
        knows = f", which knows operators to {most[1]}" if most is not None else f": {text}"
        detail = f"{path.name} needs {needs}; onnxruntime is {ort.__version__}{knows}"
        return VisionFailure("model_too_new", detail)
    if is_starved(error):
        return VisionFailure("model_too_hungry", f"{path.name}: at most {MOST_BYTES} bytes")
    return VisionFailure("model_broken", f"{path.name}: {text}")


def bound_memory(provider: str | None = None) -> None:
    """Bound what this process may hold, where the CPU alone thinks: drivers of others map far more.

    Raises:
        VisionFailure: ``provider_unavailable``.
    """
    if choose_providers(ort.get_available_providers(), provider).names == (CPU,):
        _, hard = resource.getrlimit(resource.RLIMIT_DATA)
        most = MOST_BYTES if hard == resource.RLIM_INFINITY else min(MOST_BYTES, hard)
        resource.setrlimit(resource.RLIMIT_DATA, (most, hard))


def is_starved(error: Exception) -> bool:
    """Return whether memory was refused, by the words of onnxruntime and C++."""
    text = str(error).lower()
    spoken = ("bad_alloc", "bad allocation", "failed to allocate", "out of memory")
    return isinstance(error, MemoryError) or any(words in text for words in spoken)


def last_words(error: Exception) -> str:
    """Return the end of the library's message; before it stand its own files and functions."""
    return " ".join(str(error).split())[-MAX_WORDS:]
