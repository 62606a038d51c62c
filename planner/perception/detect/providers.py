"""Choose where a model runs, among the installed onnxruntime's providers; report why.

An offer is what was compiled in; whether it works here shows only when a session opens, and what
then really runs is asked of the session. Azure's provider sends pictures away: it is never taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

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


def choose(offered: Sequence[str], wanted: str | None = None) -> Providers:
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
