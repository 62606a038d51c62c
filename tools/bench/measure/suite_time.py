"""Measure ``make test`` on two cores, from this checkout with its environment made."""

from __future__ import annotations

import os
import subprocess
import time
from typing import TYPE_CHECKING, Any

from pons.machine import ROOT
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "suite_time"
TITLE = "make test"
LONG_ONLY = True


def measure(lab: BenchLab) -> list[ReportRow]:
    """Run it once or as often as a long run is repeated; a failed run is invalid."""
    runs = list(lab.slices("run", 1, lambda index: _run()))
    passed = all(run["exit"] == 0 for run in runs)
    cores = runs[0]["cores"]
    failed = next((run["tail"] for run in runs if run["exit"] != 0), "")
    note = f"{cores} cores" if passed else f"tests failed: {failed}"
    return [row_of("make test", "s", "<= 300", [r["took_s"] for r in runs], note, valid=passed)]


def _run() -> dict[str, Any]:
    cores = sorted(os.sched_getaffinity(0))[:2]
    began_s = time.monotonic()
    done = subprocess.run(
        ["make", "test"], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
        stderr=subprocess.STDOUT, check=False, errors="replace",
        preexec_fn=lambda: os.sched_setaffinity(0, cores),
    )  # fmt: skip
    took_s = time.monotonic() - began_s
    said = done.stdout.splitlines()
    failed = [line for line in said if line.startswith(("FAILED", "ERROR"))] or said[-1:]
    return {
        "took_s": took_s,
        "exit": done.returncode,
        "cores": len(cores),
        "tail": "; ".join(failed[:5]) if done.returncode != 0 else "",
    }
