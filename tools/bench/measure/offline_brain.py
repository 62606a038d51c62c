"""Measure the offline brain: time a sentence, allowed outcomes and wrong motions, on every suite.

The orders that others wrote are measured where their data lies beside the checkout, and said to be
missing where it does not. Plans only, in this process; the first sentence warms up and counts not.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from planner.brain import OfflineBrain
from pons.evals.score import score
from pons.evals.suites import MissingSuite
from tools.bench.report import ReportRow, row_of
from tools.evals.outside import load_any

if TYPE_CHECKING:
    from pons.evals.score import SentenceVerdict
    from tools.bench.context import BenchLab

NAME = "offline_brain"
TITLE = "offline brain: ms a sentence, outcomes allowed, wrong motions"
LONG_ONLY = False
GOAL_MS = "p99 <= 10"
GOAL_RIGHT = ">= 95 %"
GOAL_WRONG = "0"
SUITES = ("home_en", "home_zh", "gpsr", "zh")


def measure(lab: BenchLab) -> list[ReportRow]:
    """Score every suite a few times over; outcomes are the same each time, times are not."""
    rows: list[ReportRow] = []
    for name in SUITES:
        try:
            (suite,) = load_any(name)
        except MissingSuite as missing:
            rows.append(
                ReportRow(f"{name}", "", GOAL_RIGHT, value="not measured", note=str(missing))
            )
            continue
        asyncio.run(score(suite, OfflineBrain()))
        runs = [asyncio.run(score(suite, OfflineBrain())) for _ in range(lab.count(3, 10))]
        rows += _rows(name, runs)
    return rows


def _rows(name: str, runs: list[tuple[SentenceVerdict, ...]]) -> list[ReportRow]:
    times_ms = [verdict.seconds * 1e3 for run in runs for verdict in run]
    last = runs[-1]
    right, wrong = sum(v.right for v in last), sum(bool(v.wrong) for v in last)
    share = f"{100.0 * right / len(last):.1f}"
    return [
        row_of(f"{name}: a sentence", "ms", GOAL_MS, times_ms, f"{len(last)} sentences"),
        ReportRow(f"{name}: allowed", "%", GOAL_RIGHT, value=share, note=f"{right} of {len(last)}"),
        ReportRow(f"{name}: wrong motions", "", GOAL_WRONG, value=str(wrong)),
    ]
