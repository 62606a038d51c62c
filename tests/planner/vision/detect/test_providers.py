"""Choose providers by what onnxruntime offers; only the choice can be tried without the devices."""

from __future__ import annotations

import onnxruntime as ort
import pytest

from planner.vision.detect.providers import CPU, ORDER, choose
from planner.vision.detect.session import options
from planner.vision.failure import VisionFailure

TRT, CUDA, VINO, CORE = (ORDER[name] for name in ("tensorrt", "cuda", "openvino", "coreml"))
AZURE = "AzureExecutionProvider"


@pytest.mark.parametrize(
    ("offered", "wanted", "names", "why"),
    [
        ((AZURE, CPU), None, (CPU,), "first of: cpu"),
        ((CPU, CUDA, TRT), None, (TRT, CPU), "first of: tensorrt, cuda, cpu"),
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
    chosen = choose(offered, wanted)
    assert (chosen.names, chosen.why) == (names, why)
    short = next(key for key, long in ORDER.items() if long == names[0])
    assert chosen.told(names) == (short, why)


@pytest.mark.parametrize(("offered", "wanted"), [((CPU,), "cuda"), ((AZURE,), None), ((), None)])
def test_what_is_not_offered_is_refused(offered: tuple[str, ...], wanted: str | None) -> None:
    with pytest.raises(VisionFailure, match="provider_unavailable"):
        choose(offered, wanted)


def test_what_was_offered_but_did_not_start_is_said_and_refused_where_it_was_set() -> None:
    assert choose((CUDA, CPU)).told((CPU,)) == (
        "cpu",
        "cuda was offered but did not start; cpu runs",
    )
    with pytest.raises(VisionFailure, match="cuda was offered but did not start"):
        choose((CUDA, CPU), "cuda").told((CPU,))


def test_sessions_leave_the_processor_to_others() -> None:
    made = options(2)
    assert (made.intra_op_num_threads, made.inter_op_num_threads) == (2, 1)
    assert made.execution_mode == ort.ExecutionMode.ORT_SEQUENTIAL
    for kind in ("intra", "inter"):
        assert made.get_session_config_entry(f"session.{kind}_op.allow_spinning") == "0"
