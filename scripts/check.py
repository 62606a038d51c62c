"""Run all that CI runs and print each step's seconds.

Owns the order of the steps; knows no test.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

ROOT = Path(__file__).resolve().parents[1]
BIN = Path(sys.executable).parent
INTERRUPTED = 130


@dataclass(frozen=True, slots=True)
class Step:
    """Name one command of the check."""

    name: str
    command: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Result:
    """Say how one step ended."""

    step: Step
    code: int
    took_s: float


STEPS = (
    Step("format", (str(BIN / "ruff"), "format", "--check", ".")),
    Step("lint", (str(BIN / "ruff"), "check", ".")),
    Step("types", (str(BIN / "mypy"),)),
    Step("imports", (str(BIN / "lint-imports"),)),
    Step("generated", (sys.executable, "scripts/generated.py", "--check")),
    Step("page", (str(ROOT / "scripts" / "page.sh"), "check")),
    Step("test", ("make", "test")),
)


def main() -> int:
    """Run every step, cheapest first, and return 0 only if all passed."""
    interrupts: list[int] = []

    def note(signum: int, _frame: FrameType | None) -> None:
        # The running step got the same Ctrl-C and cleans up by itself; wait for it, then end.
        interrupts.append(signum)

    signal.signal(signal.SIGINT, note)
    results: list[Result] = []
    for step in STEPS:
        if interrupts:
            break
        results.append(run(step))
    print_table(results)
    if interrupts:
        return INTERRUPTED
    return max((abs(result.code) for result in results), default=0)


def run(step: Step) -> Result:
    """Run one step with its output shown as it comes."""
    print(f"== {step.name}: {' '.join(step.command)}", flush=True)
    started_s = time.monotonic()
    code = subprocess.Popen(step.command, cwd=ROOT).wait()
    return Result(step, code, time.monotonic() - started_s)


def print_table(results: list[Result]) -> None:
    """Print a line per step and the total in seconds."""
    print()
    for result in results:
        verdict = "ok" if result.code == 0 else f"FAILED ({result.code})"
        print(f"{result.step.name:<10} {result.took_s:7.1f} s  {verdict}")
    print(f"{'total':<10} {sum(result.took_s for result in results):7.1f} s", flush=True)


if __name__ == "__main__":
    sys.exit(main())
