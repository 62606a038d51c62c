"""Measure localization by scans: error over drives, kidnappings, searches of the whole map.

All in lockstep with the simulator's physics and the real bridge core, on the default home; each
case and drive has a seed. Times are of the processor, so that a busy machine does not change them.
"""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass
from functools import partial
from math import hypot, pi
from random import Random
from typing import TYPE_CHECKING

import numpy as np

from localization.deskew import deskew
from localization.distance_field import DistanceField
from localization.global_search import GlobalSearch, is_sure
from localization.localizer import Localizer, LocalizerState
from localization.odometry_integration import OdometryTrail
from maps import load_map
from pons.settings import CHECKOUT
from sim import Hardware, SimRobot
from tools.bench.drive_record import pose_error
from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld
from wire import Pose2, RobotDescription, SimFault, wrap
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "localization"
TITLE = "where the robot is, by scans alone"
LONG_ONLY = True
SITE = CHECKOUT / "sites" / "home"
ROOMS = ("kitchen", "bedroom", "living room", "study", "bathroom", "hallway")
CASES = {
    "plain": Hardware(),
    "wheels 5 % wrong": Hardware(
        wheel_radius_m=0.105, wheel_separation_m=0.485, lidar_noise_m=0.03, lidar_dropout=0.1
    ),
    "sweep 0.1 s": Hardware(lidar_sweep_s=0.1),
    "people": Hardware(),
    "ice": Hardware(),
}
DRIVE_S = 600.0
CARRIES_PER_DRIVE = 10
LATTICE_POSES = 300
THINGS = 4
RIGHT_M, RIGHT_RAD = 0.15, 0.1


@dataclass(frozen=True, slots=True)
class DriveErrors:
    """Hold what one drive came to."""

    errors_m: list[float]
    errors_deg: list[float]
    work_ms: list[float]
    core_percent: float
    faults: int
    """Statuses with a row of the pose."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive each case, carry the robot away, search from random poses."""
    rows = []
    for case in CASES:
        taken = lab.slices(case, lab.count(1, 4), partial(_drive_record, case))
        drives = [DriveErrors(**one) for one in taken]
        errors_m = [error for one in drives for error in one.errors_m]
        errors_deg = [error for one in drives for error in one.errors_deg]
        faults = sum(one.faults for one in drives)
        note = f"{faults} statuses with a row of the pose"
        rows += [
            row_of(f"pose error, {case}", "m", "p95 <= 0.025", errors_m, note),
            row_of(f"yaw error, {case}", "deg", "p95 <= 0.5", errors_deg),
            row_of(f"scan work, {case}", "ms", "max <= 5", [m for d in drives for m in d.work_ms]),
            row_of(f"tracking, {case}", "% core", "<= 8", [d.core_percent for d in drives]),
        ]
    carried = [one for seed in range(lab.count(2, 10)) for one in kidnappings(seed)]
    rows.append(row_of("kidnapped: lost after", "s", "p95 <= 0.5", [one[0] for one in carried]))
    rows.append(row_of("kidnapped: right after", "s", "p95 <= 2", [one[1] for one in carried]))
    for things in (0, THINGS):
        right, false_sure, cpu_s = searches(lab.count(100, LATTICE_POSES), things)
        note = f"{right} right, {false_sure} wrong and sure"
        rows.append(row_of(f"global search, {things} unmapped", "s", "<= 1 CPU", cpu_s, note))
    return rows


def scans_world(seed: int, hardware: Hardware) -> LockstepWorld:
    """Return a world in the home whose robot localizes by scans."""
    robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
    return LockstepWorld(site=SITE, seed=seed, robot=robot, hardware=hardware)


def drive(case: str, seed: int) -> DriveErrors:
    """Drive from room to room for ten minutes."""
    world, random = scans_world(seed + 1, CASES[case]), Random(f"{case} {seed}")
    began_s = world.now_s
    faults, goal = 0, world.say(f"go to the {random.choice(ROOMS)}")
    errors_m: list[float] = []
    errors_deg: list[float] = []
    while world.now_s - began_s < DRIVE_S:
        if goal.has_ended:
            goal = world.say(f"go to the {random.choice(ROOMS)}")
        disturb(case, world, random, world.now_s - began_s)
        world.run(0.1)
        off_m, off_deg = pose_error(world)
        errors_m.append(off_m)
        errors_deg.append(off_deg)
        faults += any(row.row.startswith("POSE") for row in world.status.rows)
    process = world.localizer
    work_s = process.localizer.work_cpu_s if process is not None else []
    share = 100 * sum(work_s) / (world.now_s - began_s)
    return DriveErrors(errors_m, errors_deg, [1e3 * one for one in work_s], share, faults)


def _drive_record(case: str, seed: int) -> dict[str, object]:
    return asdict(drive(case, seed))


def disturb(case: str, world: LockstepWorld, random: Random, elapsed_s: float) -> None:
    """Do what a case does to the robot while it drives."""
    if case == "ice":
        slips = 10.0 <= elapsed_s % 30.0 < 13.0
        world.sim.break_down(*([SimFault.SLIP] if slips else []))
    if case == "people" and elapsed_s % 3.0 < 0.1:
        for index in range(2):
            world.put(f"person_{index}", _draw_beside(world.truth, random, 1.0, 3.0))


def _draw_beside(pose: Pose2, random: Random, near_m: float, far_m: float) -> Pose2:
    angle, far = random.uniform(-pi, pi), random.uniform(near_m, far_m)
    return Pose2(pose.x_m + far * float(np.cos(angle)), pose.y_m + far * float(np.sin(angle)), 0.0)


def kidnappings(seed: int) -> list[tuple[float, float]]:
    """Carry a driving robot away again and again; return when it was lost and right again [s]."""
    world, random = scans_world(seed + 1, Hardware()), Random(f"kidnap {seed}")
    spots = _spots(random, CARRIES_PER_DRIVE)
    found = []
    for spot in spots:
        world.say(f"go to the {random.choice(ROOMS)}")
        world.run(4.0)
        world.teleport(spot)
        localizer = world.localizer
        if localizer is None:
            return []
        core = localizer.localizer
        # A carry of a few decimetres is caught by tracking, which is never lost then.
        lost_s = world.run_until(partial(_is_lost_or_right, core), 20.0)
        found.append((lost_s, lost_s + world.run_until(partial(_is_right, core), 20.0)))
    return found


def _is_lost_or_right(core: Localizer, world: LockstepWorld) -> bool:
    return core.state is LocalizerState.LOST or _is_right(core, world)


def _is_right(core: Localizer, world: LockstepWorld) -> bool:
    return core.state is LocalizerState.TRACKING and pose_error(world)[0] < RIGHT_M


def _spots(random: Random, count: int) -> list[Pose2]:
    field = DistanceField.of_map(load_map(SITE / "map.yaml").grid)
    free = np.argwhere(field.free & (field.distance_m > 0.45))
    rows = [free[random.randrange(len(free))] for _ in range(count)]
    places = [field.cell_centre(row, column) for row, column in rows]
    return [Pose2(float(x_m), float(y_m), random.uniform(-pi, pi)) for x_m, y_m in places]


def searches(count: int, things: int) -> tuple[int, int, list[float]]:
    """Search from random poses; return how many were right, wrong and sure, and their time [s]."""
    random, robot, trail = Random(f"search {things}"), SimRobot(SITE, seed=1), OdometryTrail()
    search = GlobalSearch(DistanceField.of_map(load_map(SITE / "map.yaml").grid))
    names = ("person_0", "person_1", "crate_0", "crate_1")[:things]
    right = false_sure = 0
    cpu_s = []
    for spot in _spots(random, count):
        robot.place_robot(spot)
        for name in names:
            robot.place_thing(name, _draw_beside(spot, random, 0.6, 2.5))
        reports = robot.step_to(robot.time_s + robot.robot.lidar.scan_s)
        scan = next(one.scan for one in reversed(reports) if one.scan is not None)
        true = robot.base_in_map
        cloud = deskew(scan, robot.robot.lidar, trail)
        began_s = time.thread_time()
        found = search.everywhere(cloud.points_m, (0.0, 0.0))
        cpu_s.append(time.thread_time() - began_s)
        x_m, y_m, yaw = found[0].pose
        near = hypot(x_m - true.x_m, y_m - true.y_m) < RIGHT_M
        good = near and abs(wrap(yaw - true.yaw_rad)) < RIGHT_RAD
        right += good
        false_sure += is_sure(found) and not good
    return right, false_sure, cpu_s
