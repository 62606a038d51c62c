"""Measure how late wake-ups are, idle and under stress-ng: bridge, cyclictest, a C++ loop.

Each slice takes all of them one after another, so that what the host does to one it does to the
others, and is judged by itself: medians over slices are compared, not milliseconds.
"""

from __future__ import annotations

import shutil
from statistics import median
from typing import TYPE_CHECKING, Any

from tools.bench.figures import percentile, poisson_upper_95
from tools.bench.lateness import (
    bridge_late_us,
    compiled_loop,
    count_missed,
    cpp_late_us,
    cyclictest_late_us,
    pacer_late_us,
    stress_cores,
)
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "tick_stress"
TITLE = "lateness of wake-ups beside cyclictest and C++, idle and under stress-ng"
LONG_ONLY = True
SLICES = 12
SLICE_S = 4.0
PERIOD_US, FAST_US = 10_000, 1_000
ASLEEP = "cyclictest (--laptop)"
"""The same while cores may sleep, as they may beside the bridge: on an idle machine that counts."""
Slice = dict[str, list[float]]


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take slices idle, and loaded where stress-ng is installed."""
    rows = _rows("idle", list(lab.slices("idle", SLICES, lambda i: _slice(lab, stress=False))))
    if shutil.which("stress-ng") is None:
        return [
            *rows,
            ReportRow("stress", "us", "", value="absent", note="stress-ng not installed"),
        ]
    loaded = list(lab.slices("stress", SLICES, lambda i: _slice(lab, stress=True)))
    return [*rows, *_rows("stress", loaded)]


def _slice(lab: BenchLab, *, stress: bool) -> dict[str, Any]:
    taken: Slice = {"bridge": bridge_late_us(lab, SLICE_S, stress=stress)}
    with lab.folder() as folder, stress_cores(stress):
        loop = compiled_loop(folder)
        taken["cyclictest"] = cyclictest_late_us(SLICE_S, PERIOD_US)
        taken[ASLEEP] = cyclictest_late_us(SLICE_S, PERIOD_US, awake=False)
        taken["C++"] = cpp_late_us(loop, SLICE_S, PERIOD_US)
        taken["1 kHz cyclictest"] = cyclictest_late_us(SLICE_S / 4, FAST_US)
        taken["1 kHz C++"] = cpp_late_us(loop, SLICE_S / 4, FAST_US)
        taken["1 kHz pacer"] = pacer_late_us(SLICE_S / 4, FAST_US)
    return taken


def _rows(load: str, slices: list[Slice]) -> list[ReportRow]:
    rows: list[ReportRow] = []
    for name in (
        "bridge",
        "cyclictest",
        ASLEEP,
        "C++",
        "1 kHz pacer",
        "1 kHz cyclictest",
        "1 kHz C++",
    ):
        for label, share in (("p50", 0.5), ("p99", 0.99)):
            samples = [percentile(one[name], share) for one in slices if one[name]]
            rows.append(row_of(f"{load}: {name}: {label} of a slice", "us", "", samples))
    others = ("cyclictest", ASLEEP, "C++")
    return [*rows, *(row for other in others for row in _against(other, load, slices))]


def _against(other: str, load: str, slices: list[Slice]) -> list[ReportRow]:
    """Compare the bridge with one of the others, slice by slice."""
    both = [(one["bridge"], one[other]) for one in slices if one[other]]
    if not both:
        return [
            ReportRow(f"{load}: bridge above {other}", "us", "", value="absent", note="not here")
        ]
    rows = []
    for label, share, goal in (("p50", 0.5, "<= 60"), ("p99", 0.99, "<= 250")):
        added = [percentile(ours, share) - percentile(its, share) for ours, its in both]
        rows.append(row_of(f"{load}: bridge above {other}: {label}", "us", goal, added))
    ratio = median(percentile(ours, 0.99) / max(1.0, percentile(its, 0.99)) for ours, its in both)
    what = f"{load}: p99 of the bridge over {other}'s, median"
    rows.append(ReportRow(what, "x", "<= 2.5", value=f"{ratio:.2f}"))
    ours = sum(count_missed(one, PERIOD_US) for one, _ in both)
    its = sum(count_missed(one, PERIOD_US) for _, one in both)
    goal = f"<= {max(1.5 * its, poisson_upper_95(its)):.1f}"
    note = f"{other} missed {its}; each of {sum(len(one) for one, _ in both)} ticks"
    rows.append(
        ReportRow(f"{load}: ticks missed, beside {other}", "", goal, value=str(ours), note=note)
    )
    return rows
