"""Measure mapping on logs of other people's robots: CARMEN logs beside this checkout, if any.

Such a log comes with poses that another program corrected. They are spoilt as wheels would (5 % of
the way, 3 % of the turn, noise of 3 % and 1.5 degrees a step) and given to the mapper as odometry.
Compared are places seen again: pairs of keyframes less than 3 m apart with ten others between. The
corrected poses themselves err by about 0.05 m, so less than that is claimed of none.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from itertools import pairwise
from math import degrees, radians
from typing import TYPE_CHECKING

import numpy as np

from localization.mapping.carmen_log import read_carmen
from localization.mapping.keyframes import pose_after, pose_between
from localization.mapping.map_replay import MapReplay
from pons.settings import CHECKOUT
from tools.bench.report import ReportRow, row_of
from wire.lidar_config import LidarConfig

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from tools.bench.context import BenchLab

    Floats = NDArray[np.float64]

NAME = "mapped_logs"
TITLE = "maps of other people's drives"
LONG_ONLY = True
LOGS = CHECKOUT.parent / "shared" / "data" / "lidar" / "carmen"
WAY, TURN = 1.05, 1.03
WAY_NOISE, TURN_NOISE_RAD = 0.03, radians(1.5)
REVISIT_M, REVISIT_APART = 3.0, 10


@dataclass(frozen=True, slots=True)
class MappedLog:
    """Hold what one log came to."""

    errors_m: list[float]
    """Of each revisit."""
    errors_deg: list[float]
    scan_ms: float
    keyframes: int
    loops: int


def measure(lab: BenchLab) -> list[ReportRow]:
    """Map each log with each seed of noise."""
    paths = sorted(LOGS.glob("*.log*")) if LOGS.is_dir() else []
    if not paths:
        return [ReportRow("revisits", "m", "mean <= 0.08", value="skipped", note=f"no {LOGS}")]
    rows = []
    for path in paths:
        drives = []
        for seed in range(lab.count(1, 3)):
            lab.say(f"{path.name} {seed + 1}")
            drives.append(map_log(path, seed))
        errors_m = [error for one in drives for error in one.errors_m]
        errors_deg = [error for one in drives for error in one.errors_deg]
        name = path.name.partition(".")[0]
        loops = sum(one.loops for one in drives)
        note = f"mean {np.mean(errors_m):.3f}; {np.mean(errors_deg):.2f} degrees; {loops} loops"
        rows += [
            row_of(f"revisits, {name}", "m", "mean <= 0.08", errors_m, note),
            row_of(f"a scan, {name}", "ms", "mean <= 25", [one.scan_ms for one in drives]),
        ]
    return rows


def map_log(path: Path, seed: int) -> MappedLog:
    """Map a log by spoilt odometry; compare places seen again with its own poses."""
    scans = list(read_carmen(path))
    true = np.array([one.laser_in_odom for one in scans])
    carried, replay = _spoil(true, seed), MapReplay(LidarConfig(), closes_loops=True)
    began_s = time.thread_time()
    for index, (scan, pose) in enumerate(zip(scans, carried, strict=True)):
        replay.place_scan(scan.points_m, pose, float(index))
    replay.builder.settle()
    scan_ms = 1e3 * (time.thread_time() - began_s) / len(scans)
    numbers = [round(one.stamp_s) for one in replay.builder.keyframes]
    off = _revisits(true[numbers], replay.builder.poses)
    return MappedLog(
        np.hypot(off[:, 0], off[:, 1]).tolist(),
        [abs(degrees(turn)) for turn in off[:, 2].tolist()],
        scan_ms,
        len(numbers),
        replay.builder.loops,
    )


def _spoil(poses: Floats, seed: int) -> Floats:
    random = np.random.default_rng(seed)
    carried = [poses[0]]
    for before, after in pairwise(poses):
        step = pose_between(before, after) * (WAY, WAY, TURN)
        step[:2] *= 1.0 + random.normal(0.0, WAY_NOISE)
        step[2] += random.normal(0.0, TURN_NOISE_RAD)
        carried.append(pose_after(carried[-1], step))
    return np.array(carried)


def _revisits(true: Floats, found: Floats) -> Floats:
    """Return how far relations between places seen again are off, shape (pairs, 3)."""
    one, other = np.triu_indices(len(true), REVISIT_APART)
    near = np.hypot(*(true[one, :2] - true[other, :2]).T) < REVISIT_M
    one, other = one[near], other[near]
    expected = pose_between(true[one], true[other])
    return pose_between(expected, pose_between(found[one], found[other]))
