"""Measure what one core step costs its thread, with scans coming in, while really driving.

Lockstep feeds the step exactly what the bridge process would get. Each drive is a process of its
own (tools/bench/steps.py), so that no drive finds the memory warm that another left.
"""

from __future__ import annotations

import json
import subprocess
import sys
from typing import TYPE_CHECKING, Any

from tools.bench.context import MeasurementFailure
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "core_step"
TITLE = "bridge core: CPU time of one step"
LONG_ONLY = False
GOAL = "p50 <= 150"
SCAN_GOAL = "p50 <= 200"
ROUNDS = 5
LIMIT_S = 120.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive between rooms and time each step."""
    drives = list(lab.slices("drive", lab.count(ROUNDS, 4 * ROUNDS), _drive))
    scan_us = [us for drive in drives for us in drive["scan_us"]]
    other_us = [us for drive in drives for us in drive["other_us"]]
    note = "sites/home, lockstep"
    return [
        row_of("core step, all ticks", "us", GOAL, scan_us + other_us, note),
        row_of("core step, ticks with a scan", "us", SCAN_GOAL, scan_us, note),
    ]


def _drive(index: int) -> dict[str, Any]:
    done = subprocess.run(
        [sys.executable, "-m", "tools.bench.steps", str(index)],
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )
    if done.returncode != 0:
        raise MeasurementFailure(
            f"tools.bench.steps: {(done.stderr.strip().splitlines() or ['no word'])[-1]}"
        )
    found: dict[str, Any] = json.loads(done.stdout)
    return found
