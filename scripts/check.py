"""Run all that CI runs and print each step's seconds.

Owns the order of the steps; knows no test.
"""

from __future__ import annotations

import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import IO

ROOT = Path(__file__).resolve().parents[1]
BIN = Path(sys.executable).parent
INTERRUPTED = 130


@dataclass(frozen=True, slots=True)
class Step:
    """Name one command of the check."""

    name: str
    command: tuple[str, ...]
    beside: bool = False
    """Runs beside the one before it, whose processor it would else leave idle."""


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
    Step("page", (str(ROOT / "scripts" / "page.sh"), "check"), beside=True),
    Step("imports", (str(BIN / "lint-imports"),), beside=True),
    Step("generated", (sys.executable, "scripts/generated.py", "--check"), beside=True),
    Step("docs", (sys.executable, "-m", "scripts.docs_site"), beside=True),
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
    began_s = time.monotonic()
    for steps in rows(STEPS):
        if interrupts:
            break
        results += run(steps)
    print_table(results, time.monotonic() - began_s)
    if interrupts:
        return INTERRUPTED
    return max((abs(result.code) for result in results), default=0)


def rows(steps: Sequence[Step]) -> Iterator[tuple[Step, ...]]:
    """Return the steps by those that run at once."""
    row: list[Step] = []
    for step in steps:
        if row and not step.beside:
            yield tuple(row)
            row = []
        row.append(step)
    if row:
        yield tuple(row)


def run(steps: tuple[Step, ...]) -> list[Result]:
    """Run steps at once, the first one's output shown as it comes, the others' when all ended."""
    with ThreadPoolExecutor(len(steps)) as pool:
        waiting = [pool.submit(run_kept, step) for step in steps[1:]]
        print(f"== {steps[0].name}: {' '.join(steps[0].command)}", flush=True)
        results = [run_one(steps[0])]
    for step, kept in zip(steps[1:], waiting, strict=True):
        result, output = kept.result()
        print(f"== {step.name}: {' '.join(step.command)}", flush=True)
        with output:
            shutil.copyfileobj(output, sys.stdout.buffer)
        sys.stdout.flush()
        results.append(result)
    return results


def run_kept(step: Step) -> tuple[Result, IO[bytes]]:
    """Run one step and keep its output."""
    output = tempfile.TemporaryFile()  # noqa: SIM115  # whoever prints it closes it
    result = run_one(step, output)
    output.seek(0)
    return result, output


def run_one(step: Step, output: IO[bytes] | None = None) -> Result:
    """Run one step."""
    started_s = time.monotonic()
    code = subprocess.Popen(step.command, cwd=ROOT, stdout=output, stderr=output).wait()
    return Result(step, code, time.monotonic() - started_s)


def print_table(results: list[Result], took_s: float) -> None:
    """Print a line per step and what all took together, in seconds."""
    print()
    for result in results:
        verdict = "ok" if result.code == 0 else f"FAILED ({result.code})"
        print(f"{result.step.name:<10} {result.took_s:7.1f} s  {verdict}")
    print(f"{'total':<10} {took_s:7.1f} s", flush=True)


if __name__ == "__main__":
    sys.exit(main())
