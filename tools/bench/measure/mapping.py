"""Measure mapping: drives through the home, mapped from scans and odometry without their poses.

In lockstep, with the cases of the bench of localization. Poses and walls are compared with the
simulator's truth in the frame in which the drive began; times are of the processor.
"""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass
from functools import partial
from random import Random
from typing import TYPE_CHECKING

import numpy as np

from localization.distance_field import DistanceField
from localization.mapping.keyframes import pose_after, pose_between
from localization.mapping.map_replay import MapReplay
from maps import OCCUPIED, load_map
from maps.cell_array import cell_array
from tools.bench.measure.localization import CASES, ROOMS, SITE, disturb, scans_world
from tools.bench.report import ReportRow, row_of
from wire import Odometry, Scan, keys
from wire.keys import Party

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from maps import GridMap
    from tools.bench.context import BenchLab
    from wire import Pose2

    Floats = NDArray[np.float64]

NAME = "mapping"
TITLE = "maps of drives, from scans"
LONG_ONLY = True
DRIVE_S = 400.0


@dataclass(frozen=True, slots=True)
class MappedDrive:
    """Hold what one drive came to."""

    errors_m: list[float]
    """Of the pose at each scan, before loops that close later."""
    wall_errors_m: list[float]
    """Of each occupied cell, from the nearest surface of the true map."""
    scan_ms: float
    keyframes: int
    loops: int


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive each case and map it."""
    rows = []
    for case in CASES:
        taken = lab.slices(case, lab.count(1, 3), partial(_drive_record, case))
        drives = [MappedDrive(**one) for one in taken]
        poses = [error for one in drives for error in one.errors_m]
        walls = [error for one in drives for error in one.wall_errors_m]
        p95 = f"p95 {np.percentile(poses, 95):.3f}"
        note = f"{p95}; {sum(d.keyframes for d in drives)} keyframes"
        wall_note = f"p95 {np.percentile(walls, 95):.3f}; {sum(d.loops for d in drives)} loops"
        rows += [
            row_of(f"pose error, {case}", "m", "p95 <= 0.05", poses, note),
            row_of(f"wall error, {case}", "m", "p95 <= 0.05", walls, wall_note),
            row_of(f"a scan, {case}", "ms", "mean <= 25", [one.scan_ms for one in drives]),
        ]
    return rows


def map_drive(case: str, seed: int, drive_s: float = DRIVE_S) -> MappedDrive:
    """Drive from room to room and map it on the way."""
    world, random = scans_world(seed + 1, CASES[case]), Random(f"{case} {seed}")
    port = world.bus.port(Party.LOCALIZATION)
    scans, odometry = port.subscriber(keys.SCAN), port.subscriber(keys.ODOM)
    replay, errors_m, work_s = MapReplay(world.scene.robot.lidar), [], 0.0
    start: Floats | None = None
    began_s, goal = world.now_s, world.say(f"go to the {random.choice(ROOMS)}")
    while world.now_s - began_s < drive_s:
        if goal.has_ended:
            goal = world.say(f"go to the {random.choice(ROOMS)}")
        disturb(case, world, random, world.now_s - began_s)
        for _ in range(10):
            world.run(0.01)
            before, began_cpu_s = replay.scans, time.thread_time()
            replay.hear(_motion(odometry.drain().items))
            replay.hear(_motion(scans.drain().items))
            work_s += time.thread_time() - began_cpu_s
            if replay.scans > before:
                true = _array(world.truth)
                start = true if start is None else start
                off = pose_between(pose_after(start, replay.pose), true)
                errors_m.append(float(np.hypot(off[0], off[1])))
    replay.builder.settle()
    walls = [] if start is None else _wall_errors_m(replay.builder.draw(), start)
    builder = replay.builder
    mean_ms = 1e3 * work_s / max(1, replay.scans)
    return MappedDrive(errors_m, walls, mean_ms, len(builder.keyframes), builder.loops)


def _drive_record(case: str, seed: int) -> dict[str, object]:
    return asdict(map_drive(case, seed))


def _motion(messages: Iterable[object]) -> list[Odometry | Scan]:
    return [one for one in messages if isinstance(one, Odometry | Scan)]


def _array(pose: Pose2) -> Floats:
    return np.array((pose.x_m, pose.y_m, pose.yaw_rad))


def _wall_errors_m(made: GridMap, start: Floats) -> list[float]:
    """Return how far each occupied cell lies from the true map's nearest surface [m]."""
    true = DistanceField.of_map(load_map(SITE / "map.yaml").grid)
    row, column = np.nonzero(cell_array(made) == OCCUPIED)
    x_m = made.origin_x_m + (column + 0.5) * made.resolution_m
    y_m = made.origin_y_m + (row + 0.5) * made.resolution_m
    at = pose_after(start, np.column_stack((x_m, y_m, np.zeros(len(x_m)))))
    return [float(one) for one in true.distance(at[:, 0], at[:, 1])]
