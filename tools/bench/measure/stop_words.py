"""Measure the stop lane: time a sentence, and orders of all suites that it takes for a stop.

The orders that others wrote count where their data lies beside the checkout. How many stops are
heard is not measured here: sentences that nobody has tuned on can't lie in the repository.
"""

from __future__ import annotations

import time

from planner.language.stop import StopReading, read_stop
from pons.evals.suites import Case, MissingSuite
from tools.bench.context import BenchLab
from tools.bench.report import ReportRow, row_of
from tools.evals.outside import load_any

NAME = "stop_words"
TITLE = "stop lane: us a sentence, orders taken for a stop"
LONG_ONLY = False
GOAL_US = "p99 <= 300"
GOAL_FALSE = "<= 0.1 %"
SUITES = ("home_en", "home_zh", "gpsr", "zh")
STOPPING = frozenset({"no", "negation", "stop"})
"""Groups of cases that hold denials and stops: they may stop the robot."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Read every sentence of the suites; the best of a few readings counts, for others run too."""
    cases: list[Case] = []
    for name in SUITES:
        try:
            (suite,) = load_any(name)
        except MissingSuite:
            continue
        cases += suite.cases
    rounds = lab.count(7, 30)
    times_us = [_best_us(case.text, rounds) for case in cases]
    orders = [
        written
        for case in cases
        if case.group not in STOPPING
        for written in (case.text, case.text.upper(), f"{case.text}!", f"please {case.text}")
    ]
    false = [text for text in orders if read_stop(text) is not StopReading.NONE]
    share = f"{100.0 * len(false) / len(orders):.2f}"
    bound = f"; 3/n {300.0 / len(orders):.2f} %" if not false else f": {false[:3]}"
    return [
        row_of("stop lane: a sentence", "us", GOAL_US, times_us, f"best of {rounds} readings"),
        ReportRow(
            "orders taken for a stop", "%", GOAL_FALSE, value=share, note=f"{len(orders)}{bound}"
        ),
    ]


def _best_us(text: str, rounds: int) -> float:
    best_ns = 10**12
    for _ in range(rounds):
        began_ns = time.perf_counter_ns()
        read_stop(text)
        best_ns = min(best_ns, time.perf_counter_ns() - began_ns)
    return best_ns / 1e3
