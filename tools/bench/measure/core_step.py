"""Measure what one core step costs its thread, with scans coming in, while really driving.

Lockstep feeds the step exactly what the bridge process would get. The compiled core and the plain
source are timed in turns, each in a process of its own (tools/bench/steps.py).
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import TYPE_CHECKING, Any

from bridge.compiled import find
from tools.bench.context import MeasurementFailure
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "core_step"
TITLE = "bridge core: CPU time of one step"
LONG_ONLY = False
GOAL = "p50 <= 100, p99 <= 250"
ROUNDS = 5
LIMIT_S = 120.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive between rooms and time each step, on each core that there is."""
    compiled = find()
    kinds = ["compiled", "plain"] if compiled.compiled else ["plain"]
    taken: dict[str, list[dict[str, Any]]] = {kind: [] for kind in kinds}
    named = f"both.{compiled.folder.name}" if compiled.folder is not None else "plain"
    for slice_ in lab.slices(named, lab.count(ROUNDS, 4 * ROUNDS), lambda i: _drive_both(i, kinds)):
        for kind in kinds:
            taken[kind].append(slice_[kind])
    rows = [row for kind in kinds for row in _rows(kind, taken[kind])]
    if not compiled.compiled:
        rows.append(
            ReportRow("core step, compiled", "", GOAL, value="not measured", note=compiled.text)
        )
    return rows


def _rows(kind: str, slices: list[dict[str, Any]]) -> list[ReportRow]:
    scan_us = [us for one in slices for us in one["scan_us"]]
    other_us = [us for one in slices for us in one["other_us"]]
    said = slices[0]["core"] if slices else kind
    return [
        row_of(f"core step, {kind}, all ticks", "us", GOAL, scan_us + other_us, said),
        row_of(f"core step, {kind}, ticks with a scan", "us", "", scan_us, "sites/home, lockstep"),
    ]


def _drive_both(index: int, kinds: list[str]) -> dict[str, Any]:
    """Take one drive on each core, the order changing from drive to drive."""
    order = kinds if index % 2 == 0 else kinds[::-1]
    return {kind: _drive(index, kind) for kind in order}


def _drive(index: int, kind: str) -> dict[str, Any]:
    wish = "plain" if kind == "plain" else ""
    done = subprocess.run(
        [sys.executable, "-m", "tools.bench.steps", str(index)],
        env={**os.environ, "PONS_CORE": wish},
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
    if found["core"].startswith("compiled") is not (kind == "compiled"):
        raise MeasurementFailure(f"wanted the {kind} core, ran: {found['core']}")
    return found
