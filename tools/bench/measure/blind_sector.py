"""Hide a sector of a driving robot's lidar, and what stands in it; count contacts, needless holds.

In lockstep, told where it is. Contacts: robots and presets at several speeds, forwards and
backwards, the sector gone from the start or in mid-drive, 15 to 120 degrees wide. Needless holds:
tours of the default home, nothing broken, among walkers and doors that open and shut, with and
without spots that return nothing. The driven time that is told is time in ACTIVE.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from math import atan2, cos, hypot, pi, radians, sin
from random import Random
from typing import TYPE_CHECKING, Any

from bridge.core.sensing.blind_sector import SEEN_S
from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from lockstep.scene import folder_of, scene
from lockstep.world import STAND_IN_ROBOT
from planner.navigation import RouteFailure, RouteRequest
from pons.settings import CHECKOUT
from sim import Domain, Hardware
from sim.site import load_home, pose2
from tools.bench.figures import none_in, poisson_upper_95
from tools.bench.report import ReportRow
from tools.lockstep import TICK_S, LockstepWorld, TooLong
from wire import Mode, Pose2, RobotDescription, SimFault, load_robot
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "blind_sector"
TITLE = "a sector of the lidar goes blind: contacts; needless holds in tours among people and doors"
LONG_ONLY = True
ROW = "LIDAR_SECTOR.0"
RUNS, QUICK_RUNS = 200, 7
WIDTHS_DEG = (15, 20, 30, 45, 60, 90, 120)
SPEEDS_MPS = (0.25, 0.5, 0.8)
BEAMS = (180, 360, 450, 720, 1440)
THING_M = 0.25
"""Half of a crate, the radius of a person."""
AFTER_S = 15.0
SLICE_S, GOAL_S = 600.0, 120.0
SLICES, QUICK_SLICES = 60, 1
TOURS = {
    "4 walkers, 3 doors": Domain(polite_walkers=2, blind_walkers=2, doors=3),
    "2 walkers, 3 doors, 12 spots": Domain(polite_walkers=2, doors=3, lidar_null_patches=12),
}


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take the contact runs, then the tours; one processor each."""
    runs = list(lab.side_by_side("run", lab.count(QUICK_RUNS, RUNS), contact_run))
    rows = [_contact_row("all", runs)]
    for key in ("width_deg", "when", "way", "robot"):
        rows += [
            _contact_row(f"{key} {value}", [run for run in runs if run[key] == value])
            for value in sorted({run[key] for run in runs})
        ]
    count = lab.count(QUICK_SLICES, SLICES) * len(TOURS)
    tours = list(lab.side_by_side("tour", count, take_tour))
    return [
        *rows,
        *(_tour_row(name, [one for one in tours if one["name"] == name]) for name in TOURS),
    ]


def _contact_row(what: str, runs: list[dict[str, Any]]) -> ReportRow:
    touched, told = sum(run["contacts"] > 0 for run in runs), sum(run["told"] for run in runs)
    note = f"told in {told} of {len(runs)}; {none_in(len(runs))}" if not touched else f"told {told}"
    return ReportRow(f"contacts, {what}", "", "0", value=f"{touched} of {len(runs)}", note=note)


def _tour_row(name: str, tours: list[dict[str, Any]]) -> ReportRow:
    hours = sum(one["seconds"] for one in tours) / 3600
    driven = sum(one["driven_s"] for one in tours) / 3600
    holds = sum(len(one["holds"]) for one in tours)
    most = poisson_upper_95(holds) / hours if hours else 0.0
    ends = sum((Counter(one["ends"]) for one in tours), Counter[str]())
    note = (
        f"{hours:.2f} h, {driven:.2f} h in ACTIVE; under {most:.2f} an hour at 95 %; {dict(ends)}"
    )
    return ReportRow(f"needless holds, {name}", "", "<= 1 in 10 h", value=str(holds), note=note)


# Contacts -----------------------------------------------------------------------------------------


def robots() -> dict[str, RobotDescription]:
    """Return the default robot at several speeds, and each preset whose base has a line."""
    told = LocalizationConfig(kind="stand_in")
    known = {}
    for speed_mps in SPEEDS_MPS:
        limits = STAND_IN_ROBOT.limits.model_copy(update={"max_speed_mps": speed_mps})
        known[f"default {speed_mps}"] = STAND_IN_ROBOT.model_copy(update={"limits": limits})
    for name in preset_names():
        robot = load_robot(CHECKOUT / "robots" / f"{name}.toml")
        known[name] = robot.model_copy(update={"localization": told})
    return known


def contact_run(index: int) -> dict[str, Any]:
    """Hide a sector and a thing in it, let the robot drive on, and tell what came of it."""
    random = Random(f"blind sector {index}")
    known = robots()
    name = tuple(known)[random.randrange(len(known))]
    width_deg = WIDTHS_DEG[index % len(WIDTHS_DEG)]
    backwards, at_start = random.random() < 0.25, random.random() < 0.45
    middle_deg = random.uniform(-0.35, 0.35) * width_deg + 180.0 * backwards
    hardware = Hardware(
        lidar_beams=random.choice(BEAMS),
        lidar_sector_rad=radians(width_deg),
        lidar_sector_at_rad=radians((middle_deg + 180.0) % 360.0 - 180.0),
    )
    robot = known[name]
    start, words, point = _begin(random, robot, backwards=backwards)
    world = LockstepWorld(
        site="home", seed=index + 1, robot=robot, hardware=hardware, start=start, ready=False
    )
    if at_start:
        world.sim.break_down(SimFault.LIDAR_SECTOR)
    world.make_ready()
    thing, moved = random.choice(("crate_0", "person_0")), True
    if at_start:
        world.sim.place_obstacle(*point, random.uniform(-pi, pi), thing)
    goal = world.say(words)
    if not at_start:
        way = -1.0 if backwards else 1.0
        try:
            world.run_until(lambda w: way * w.twist.v_mps > 0.12, 30.0)
        except TooLong:
            moved = False
        world.run(random.uniform(0.0, 1.0 if backwards else 4.0))
        gap_m = random.uniform(_least_gap_m(robot, world.twist.v_mps), 2.0)
        world.sim.place_obstacle(*_before(robot, world.truth, gap_m, way), start.yaw_rad, thing)
        world.sim.break_down(SimFault.LIDAR_SECTOR)
    told, end_s = False, world.now_s + AFTER_S
    while world.now_s < end_s and not world.contacts:
        world.tick()
        told = told or ROW in world.bridge.state.rows
    return {
        "index": index, "robot": name, "width_deg": width_deg, "beams": hardware.lidar_beams,
        "when": "from the start" if at_start else "in mid-drive",
        "way": "backwards" if backwards else "forwards", "moved": moved,
        "contacts": world.contacts, "told": told, "end": world.describe() if world.contacts else "",
        "goal": f"{goal.state.value} {goal.record.reason or ''}".strip(),
    }  # fmt: skip


def _begin(
    random: Random, robot: RobotDescription, *, backwards: bool
) -> tuple[Pose2, str, tuple[float, float]]:
    """Return where to begin, what to say there, and a point on the way that this leads."""
    if backwards:
        yaw_rad, x_m = random.choice((0.0, pi)), random.uniform(4.0, 8.0)
        start = Pose2(x_m, 4.75 + random.uniform(-0.1, 0.1), yaw_rad)
        return start, "move back 2 metres", _before(robot, start, random.uniform(0.6, 1.5), -1.0)
    home = scene(folder_of("home"), robot)
    rooms = {room.name.en: pose2(room.pose) for room in load_home(home.folder).rooms.values()}
    while True:
        begin, end = random.sample(sorted(rooms), 2)
        pose = rooms[begin]
        try:
            route = home.router.route(RouteRequest(pose, rooms[end]))
        except RouteFailure:
            continue
        if route.length_m < 3.0:
            continue
        first, at_m = route.points[min(3, len(route.points) - 1)], random.uniform(1.0, 2.6)
        ahead = atan2(first.y_m - pose.y_m, first.x_m - pose.x_m)
        yaw_rad = random.choice((pose.yaw_rad, ahead))
        point = next(
            one for one in route.points if hypot(one.x_m - pose.x_m, one.y_m - pose.y_m) >= at_m
        )
        return Pose2(pose.x_m, pose.y_m, yaw_rad), f"go to the {end}", (point.x_m, point.y_m)


def _before(robot: RobotDescription, here: Pose2, gap_m: float, way: float) -> tuple[float, float]:
    """Return where a thing's middle is that leaves this gap before or behind the robot."""
    off_m = way * (robot.base.radius_m + gap_m + THING_M)
    return here.x_m + off_m * cos(here.yaw_rad), here.y_m + off_m * sin(here.yaw_rad)


def _least_gap_m(robot: RobotDescription, v_mps: float) -> float:
    """Return the way that goes before the robot stands for what it is about to be told."""
    before_s = robot.lidar.scan_s + SEEN_S + robot.drive.lag_s + 0.1
    return abs(v_mps) * before_s + v_mps**2 / (2 * robot.limits.max_decel_mps2) + 0.1


# Needless holds -----------------------------------------------------------------------------------


def take_tour(index: int) -> dict[str, Any]:
    """Drive one tour; the index says which kind with which seed."""
    return tour(tuple(TOURS)[index % len(TOURS)], index // len(TOURS))


def tour(name: str, index: int) -> dict[str, Any]:
    """Drive from room to room for ten minutes with a whole lidar, and note each hold of the row."""
    random = Random(f"blind sector {name} {index}")
    world = LockstepWorld(site="home", seed=index + 1, domain=replace(TOURS[name], seed=index + 1))
    rooms = sorted(room.name.en for room in world.sim.home.rooms.values())
    holds: list[str] = []
    ends: Counter[str] = Counter()
    began_s, driven, was_up = world.now_s, 0, False
    while world.now_s < began_s + SLICE_S:
        goal, given_s = world.say(f"go to the {random.choice(rooms)}"), world.now_s
        while not goal.has_ended and world.now_s < min(given_s + GOAL_S, began_s + SLICE_S):
            world.tick()
            driven += world.status.mode is Mode.ACTIVE
            is_up = ROW in world.bridge.state.rows
            if is_up and not was_up:
                holds.append(world.describe())
            was_up = is_up
        ends[goal.state.value] += 1
        if not goal.has_ended:
            world.cancel(goal)
        world.run(0.5)
    return {
        "name": name, "seconds": world.now_s - began_s, "driven_s": driven * TICK_S, "holds": holds,
        "ends": dict(ends), "contacts": world.contacts,
    }  # fmt: skip


def preset_names() -> list[str]:
    """Return the presets whose bases have a line."""
    paths = sorted((CHECKOUT / "robots").glob("*.toml"))
    return [path.stem for path in paths if load_robot(path).drive.kind in SERIAL_PROTOCOLS]
