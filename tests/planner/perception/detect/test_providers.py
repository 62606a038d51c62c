"""Choose providers by what onnxruntime offers and what starts; devices are stood for."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import onnxruntime as ort
import pytest

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.detect.session import CPU, ORDER, choose_providers, options
from planner.perception.failure import VisionFailure
from tests.planner.perception.detect import tiny

TRT, CUDA, VINO, CORE = (ORDER[name] for name in ("tensorrt", "cuda", "openvino", "coreml"))
AZURE = "AzureExecutionProvider"


@pytest.mark.parametrize(
    ("offered", "wanted", "names", "why"),
    [
        ((AZURE, CPU), None, (CPU,), "first of: cpu"),
        ((CPU, CUDA, TRT), None, (TRT, CUDA, CPU), "first of: tensorrt, cuda, cpu"),
        ((CORE, TRT, VINO), None, (TRT, VINO, CORE, CPU), "first of: tensorrt, openvino, coreml"),
        ((CUDA, CPU), None, (CUDA, CPU), "first of: cuda, cpu"),
        ((CPU, VINO), None, (VINO, CPU), "first of: openvino, cpu"),
        ((CORE, CPU), None, (CORE, CPU), "first of: coreml, cpu"),
        ((TRT, CUDA, CPU), "cuda", (CUDA, CPU), "set by the owner"),
        ((TRT, CUDA, CPU), "cpu", (CPU,), "set by the owner"),
    ],
)
def test_the_fastest_offered_is_taken(
    offered: tuple[str, ...], wanted: str | None, names: tuple[str, ...], why: str
) -> None:
    chosen = choose_providers(offered, wanted)
    assert (chosen.names, chosen.why) == (names, why)
    short = next(key for key, long in ORDER.items() if long == names[0])
    assert chosen.explain(names) == (short, why)


@pytest.mark.parametrize(("offered", "wanted"), [((CPU,), "cuda"), ((AZURE,), None), ((), None)])
def test_what_is_not_offered_is_refused(offered: tuple[str, ...], wanted: str | None) -> None:
    with pytest.raises(VisionFailure, match="provider_unavailable"):
        choose_providers(offered, wanted)


def test_what_was_offered_but_did_not_start_is_said_and_refused_where_it_was_set() -> None:
    assert choose_providers((CUDA, CPU)).explain((CPU,)) == (
        "cpu",
        "cuda was offered but did not start; cpu runs",
    )
    with pytest.raises(VisionFailure, match="cuda was offered but did not start"):
        choose_providers((CUDA, CPU), "cuda").explain((CPU,))


class Devices:
    """Stand for an onnxruntime that offers more than works here; thinks on the processor."""

    def __init__(self, patch: pytest.MonkeyPatch, offered: Sequence[str], work: Sequence[str]):
        """Take the library's place."""
        self.asked: list[str] = []
        self._works, self._opens = work, ort.InferenceSession
        patch.setattr(ort, "get_available_providers", lambda: list(offered))
        patch.setattr(ort, "InferenceSession", self._open)

    def _open(self, path: str, sess_options: object, providers: list[str]) -> Any:
        self.asked = providers
        opened = self._opens(path, sess_options=sess_options, providers=[CPU])
        opened.get_providers = lambda: [name for name in providers if name in self._works]
        return opened


@pytest.mark.parametrize(
    ("work", "runs", "why"),
    [
        ((TRT, CUDA, CPU), "tensorrt", "first of: tensorrt, cuda, cpu"),
        ((CUDA, CPU), "cuda", "tensorrt was offered but did not start; cuda runs"),
        ((CPU,), "cpu", "tensorrt, cuda was offered but did not start; cpu runs"),
    ],
)
def test_what_runs_is_the_fastest_that_starts(
    work: tuple[str, ...], runs: str, why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tiny.model(tmp_path / "m.onnx", tiny.yolov8([]), metadata=tiny.ULTRALYTICS)
    devices = Devices(monkeypatch, (CPU, CUDA, TRT), work)
    about = OnnxDetector(ModelOptions(path)).about
    assert devices.asked == [TRT, CUDA, CPU]
    assert (about.provider, about.provider_why) == (runs, why)
    if runs != "tensorrt":
        with pytest.raises(VisionFailure, match="provider_unavailable"):
            OnnxDetector(ModelOptions(path, provider="tensorrt"))


def test_sessions_leave_the_processor_to_others() -> None:
    made = options(2)
    assert (made.intra_op_num_threads, made.inter_op_num_threads) == (2, 1)
    assert made.execution_mode == ort.ExecutionMode.ORT_SEQUENTIAL
    for kind in ("intra", "inter"):
        assert made.get_session_config_entry(f"session.{kind}_op.allow_spinning") == "0"
