"""Measure how late the idle bridge's ticks begin, beside cyclictest in the same minutes.

Slices alternate, so that what the host does to one it does to the other. Without cyclictest the
bridge's figures stand alone and the table says so.
"""

from __future__ import annotations

from statistics import median
from typing import TYPE_CHECKING, Any

from tools.bench.figures import percentile
from tools.bench.lateness import bridge_late_us, cyclictest_late_us
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "tick_lateness"
TITLE = "lateness of a 100 Hz tick, idle"
LONG_ONLY = False
PAIRS = 10
SLICE_S = 2.0
PERIOD_US = 10_000


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take pairs of slices; compare their medians."""
    pairs = list(lab.slices("pair", lab.count(PAIRS, 3 * PAIRS), lambda i: _pair(lab)))
    rows = []
    for name in ("bridge", "cyclictest"):
        slices = [pair[name] for pair in pairs if pair[name]]
        if not slices:
            rows.append(
                ReportRow(f"{name}", "us", "", value="absent", note="rt-tests not installed")
            )
            continue
        note = f"each of {len(slices)} slices of {SLICE_S:.0f} s"
        for label, share in (("median", 0.5), ("p99", 0.99)):
            samples = [percentile(one, share) for one in slices]
            rows.append(row_of(f"{name}: {label} of a slice", "us", "", samples, note))
    both = [pair for pair in pairs if pair["cyclictest"]]
    if both:
        more = [median(pair["bridge"]) - median(pair["cyclictest"]) for pair in both]
        rows.append(row_of("bridge above cyclictest, medians", "us", "", more, "pair by pair"))
    return rows


def _pair(lab: BenchLab) -> dict[str, Any]:
    bridge = bridge_late_us(lab, SLICE_S, stress=False)
    return {"bridge": bridge, "cyclictest": cyclictest_late_us(SLICE_S, PERIOD_US)}
