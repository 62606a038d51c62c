"""Measure how late the idle bridge's ticks begin, beside cyclictest in the same minutes.

Slices alternate, so that what the host does to one it does to the other. Without cyclictest the
bridge's figures stand alone and the table says so.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import time
from statistics import median
from typing import TYPE_CHECKING, Any

from bench.figures import percentile
from bench.lab import until
from bench.report import Row, row_of
from bench.robot import Robot

if TYPE_CHECKING:
    from bench.lab import Lab

NAME = "tick_lateness"
TITLE = "lateness of a 100 Hz tick, idle"
LONG_ONLY = False
PAIRS = 10
SLICE_S = 2.0
PRIORITY = 60
BUCKETS_US = 30_000
_BUCKET = re.compile(r"^(\d+)\s+(\d+)\s*$")


def measure(lab: Lab) -> list[Row]:
    """Take pairs of slices; compare their medians."""
    present = shutil.which("cyclictest") is not None
    pairs = list(lab.slices("pair", lab.count(PAIRS, 3 * PAIRS), lambda i: _pair(lab, present)))
    rows = []
    for name in ("bridge", "cyclictest"):
        slices = [pair[name] for pair in pairs if pair[name]]
        if not slices:
            rows.append(Row(f"{name}", "us", "", value="absent", note="rt-tests not installed"))
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


def _pair(lab: Lab, present: bool) -> dict[str, Any]:
    bridge = _bridge(lab)
    return {"bridge": bridge, "cyclictest": _cyclictest() if present else []}


def _bridge(lab: Lab) -> list[float]:
    """Run the bridge alone: no robot, no planner, its loop turning in SELFTEST."""
    with lab.folder() as home, Robot(home, "two_room", tapped=True, only=("bridge",)) as robot:
        until(lambda: robot.status is not None, 20.0, "the bridge's first status")
        time.sleep(SLICE_S)
        late_us: list[float] = robot.end_bridge()["late_us"]
        return late_us[-round(SLICE_S * 100) :]


def _cyclictest() -> list[float]:
    """Run one thread at the same rate and rank; return every lateness, from its histogram."""
    loops = round(SLICE_S * 100)
    words = ["cyclictest", "-q", "-t1", "-i10000", f"-l{loops}", f"-h{BUCKETS_US}"]
    done = subprocess.run([*words, f"-p{PRIORITY}"], capture_output=True, text=True, check=False)
    if done.returncode != 0:  # no right to that rank: the bridge has none either
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    samples: list[float] = []
    for line in done.stdout.splitlines():
        found = _BUCKET.match(line.strip())
        if found:
            samples += [float(found[1])] * int(found[2])
    return samples
