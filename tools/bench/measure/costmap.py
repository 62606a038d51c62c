"""Measure the costmap and its search: time to replan, time to search large maps, noise in doors.

Replans run in lockstep on the default home, with a crate put in the way; what the route process
takes for its share is measured on the real process. Searches are timed on made office floors by
processor seconds. Passes through a door show simulated scans to the obstacle memory.
"""

from __future__ import annotations

import asyncio
import time
from array import array
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, cos, hypot, radians, sin
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

import numpy as np

from planner.mission.activity import Driving
from planner.mission.route_doubts import BENT
from planner.navigation import RouteFailure, RouteLimits, RouteRequest, RouteWorker, ScanObservation
from planner.navigation.coarse_search import floor_of
from planner.navigation.costmap import Costmap, static_costmap
from planner.navigation.router import LANDMARKS, MAX_FIELD_BYTES, Router
from planner.navigation.search import Lattice, costs_to, find_path
from planner.navigation.start_and_goal import Cell
from planner.site import FREE, OCCUPIED, GridMap, Site
from planner.site.fence import Fence
from planner.site.places import Names, Place
from pons.settings import CHECKOUT
from sim import SimRobot
from sim.site import Home
from sim.site.load import load_home
from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld
from tools.lockstep.homes import site_of
from wire import FenceFile, Pose2, RobotDescription

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.context import BenchLab

NAME = "costmap"
TITLE = "the costmap: replanning, searching, doors"
LONG_ONLY = True
SITE = CHECKOUT / "sites" / "home"
ROOMS = ("study", "bathroom", "living room", "kitchen")
CRATE_AHEAD_M, CRATE_ASIDE_M = (2.0, 2.8), 0.5
REPLANS, PASSES, PAIRS = 160, 1000, 40
SIDES = (1000, 4000)
"""Cells of a made floor, each way, at 0.05 m."""
DOOR_M = 0.90
SPEED_MPS = 0.5
SCAN_S = 0.2
POSE_SIGMA_M, POSE_SIGMA_RAD = 0.02, radians(0.4)
"""Of localization, the same throughout a pass, so that wrong marks fall into the same cells."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Replan, search and pass doors."""
    return [*_replan_rows(lab), *_search_rows(lab), *_door_rows(lab)]


# Replanning --------------------------------------------------------------------------------------


def _replan_rows(lab: BenchLab) -> list[ReportRow]:
    told = list(lab.slices("replan", lab.count(4, REPLANS), replan))
    bent = [one for one in told if one is not None]
    note = f"{len(told) - len(bent)} of {len(told)} crates bent no way"
    process = asyncio.run(time_process(lab.count(20, 200)))
    return [
        row_of("crate stands -> new horizon", "s", "", [one[0] for one in bent], note),
        row_of("deciding scan -> new horizon", "s", "p95 <= 0.15", [one[1] for one in bent]),
        row_of("route process: scan", "ms", "", [1e3 * one[0] for one in process]),
        row_of("route process: way round", "ms", "", [1e3 * one[1] for one in process]),
    ]


def replan(seed: int) -> tuple[float, float] | None:
    """Put a crate in a way; return when the next way was streamed, after that and its scan [s].

    None: the crate did not bend the way.
    """
    world, random = LockstepWorld(site=SITE, seed=seed + 1), Random(f"replan {seed}")
    goal = world.say(f"go to the {random.choice(ROOMS)}")
    world.run(random.uniform(2.0, 12.0))
    loop = world.planner.missions.loop
    way = loop.way_ahead()
    if way is None or not _put_ahead(world, way.points, random):
        return None
    put_s, asked_s, scan_s = world.now_s, float("-inf"), world.now_s
    while not (goal.has_ended or world.status.blocked):
        world.tick()
        activity = world.planner.book.activity
        if isinstance(activity, Driving) and activity.doubt_asked_s > asked_s:
            asked_s = activity.doubt_asked_s
            scan_s = _newest_shown_s(world)
        leg = loop.leg
        if leg is not None and leg.doubt is not None and leg.doubt.code == BENT:
            return world.now_s - put_s, world.now_s - scan_s
    return None


def _newest_shown_s(world: LockstepWorld) -> float:
    obstacles = world.planner.missions.obstacles
    if obstacles is None or obstacles.shown is None:
        return float("nan")
    return obstacles.shown.stamp_s


def _put_ahead(world: LockstepWorld, way: tuple[tuple[float, float], ...], random: Random) -> bool:
    """Stand a crate on the way or beside it; tell whether the way is long enough."""
    far_m, aside_m = random.uniform(*CRATE_AHEAD_M), random.uniform(-CRATE_ASIDE_M, CRATE_ASIDE_M)
    for (x_m, y_m), (next_x_m, next_y_m) in pairwise(way):
        if hypot(x_m - world.truth.x_m, y_m - world.truth.y_m) >= far_m:
            along = atan2(next_y_m - y_m, next_x_m - x_m)
            world.place_obstacle(x_m - aside_m * sin(along), y_m + aside_m * cos(along))
            return True
    return False


async def time_process(count: int) -> list[tuple[float, float]]:
    """Show scans to a real route process, and have ways searched; return the times of both [s]."""
    site, robot, random = Site.load(SITE), RobotDescription(), Random("process")
    worker = RouteWorker(SITE, site.map_id, RouteLimits.of(robot))
    await worker.start()
    sim = SimRobot(SITE, seed=1)
    rooms = [place for place in site.places if place.kind == "room"]
    taken: list[tuple[float, float]] = []
    try:
        for turn in range(count):
            start, goal = random.sample(rooms, 2)
            sim.place_robot(start.pose)
            sim.place_obstacle(start.pose.x_m + 1.0, start.pose.y_m)
            seen = _observe(sim, start.pose, 10.0 * turn)
            began_s = time.monotonic()
            await worker.observe(seen)
            seen_s = time.monotonic()
            try:
                await worker.route(RouteRequest(start.pose, goal.pose, strict=True))
            except RouteFailure:
                continue
            taken.append((seen_s - began_s, time.monotonic() - seen_s))
    finally:
        await worker.close()
    return taken


def _observe(sim: SimRobot, robot_in_map: Pose2, at_s: float) -> ScanObservation:
    """Return the simulator's next scan, as of a robot that believes it is there."""
    lidar = sim.robot.lidar
    reports = sim.step_to(sim.time_s + lidar.scan_s)
    scan = next(one.scan for one in reversed(reports) if one.scan is not None)
    return ScanObservation(
        base_in_map=robot_in_map,
        lidar_in_base=Pose2(lidar.x_m, lidar.y_m, lidar.yaw_rad),
        first_rad=scan.angle_min_rad,
        step_rad=scan.angle_increment_rad,
        range_min_m=scan.range_min_m,
        ranges_m=scan.ranges_m,
        at_s=at_s,
    )


# Searching ---------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class SearchTimes:
    """Hold processor times of searches over one floor [s], and what the ways cost."""

    landmarks: int
    plain_s: list[float]
    bounded_s: list[float]
    worst_ratio: float
    """The cost of the way found over the best one's."""


def _search_rows(lab: BenchLab) -> Iterator[ReportRow]:
    for side in SIDES[: lab.count(1, len(SIDES))]:
        times = search_times(side, lab.count(4, PAIRS))
        goal = "p50 <= 0.15" if side == SIDES[0] else "p50 <= 2.5"
        note = f"{times.landmarks} landmarks; worst cost over the best {times.worst_ratio:.5f}"
        yield row_of(f"search {side}²", "CPU s", goal, times.bounded_s, note)
        yield row_of(f"search {side}², no landmark", "CPU s", "", times.plain_s)


def search_times(side: int, pairs: int) -> SearchTimes:
    """Search between random free cells of an office floor, with landmarks as a router has them."""
    costmap = made_floor(side)
    lattice, random = Lattice.of(costmap.cost), Random(f"pairs {side}")
    floor = floor_of(costmap.cost, costmap.grid.resolution_m, RouteLimits().radius_m)
    most = min(LANDMARKS, MAX_FIELD_BYTES // (4 * len(floor.lattice.cost)))
    largest = costmap.labels == np.bincount(costmap.labels[costmap.free]).argmax()
    free = np.argwhere(largest)

    def draw() -> Cell:
        row, column = free[random.randrange(len(free))]
        return int(column), int(row)

    fields = _spread_landmarks(floor.lattice, floor.index(draw()), most)
    plain_s, bounded_s, worst = [], [], 1.0
    for _ in range(pairs):
        start, goal = draw(), draw()
        began_s = time.thread_time()
        plain = find_path(lattice, lattice.index(*start), lattice.index(*goal))
        middle_s = time.thread_time()
        bounded = floor.find_path(start, goal, fields)
        bounded_s.append(time.thread_time() - middle_s)
        plain_s.append(middle_s - began_s)
        if plain is None or bounded is None:
            raise ValueError("two cells of one part of the floor are not joined")
        found = way_cost(lattice, [lattice.index(*cell) for cell in bounded])
        worst = max(worst, found / max(1e-9, way_cost(lattice, plain)))
    return SearchTimes(len(fields), plain_s, bounded_s, worst)


def _spread_landmarks(lattice: Lattice, first: int, most: int) -> dict[int, array[float]]:
    """Return the costs to cells far from each other, as a router works them out while idle."""
    fields = {first: costs_to(lattice, first)} if most else {}
    while 0 < len(fields) < most:
        nearest = np.min([np.asarray(field) for field in fields.values()], axis=0)
        far = int(np.argmax(np.where(np.isfinite(nearest), nearest, -1)))
        fields[far] = costs_to(lattice, far)
    return fields


def way_cost(lattice: Lattice, cells: list[int]) -> float:
    """Return what a way of cells costs, in cells."""
    cost, total = lattice.cost, 0.0
    for before, after in pairwise(cells):
        (row, column), (row_b, column_b) = (
            divmod(before, lattice.stride),
            divmod(after, lattice.stride),
        )
        total += hypot(row - row_b, column - column_b) * (cost[before] + cost[after]) / 2
    return total


def made_floor(side: int, seed: int = 1) -> Costmap:
    """Make an office: walls every 4 to 6 m, a door in each stretch of them, crates in rooms."""
    random = np.random.default_rng(seed)
    cells = np.full((side, side), FREE, np.uint8)
    lines = [0]
    while lines[-1] < side - 130:
        lines.append(lines[-1] + int(random.integers(80, 121)))
    lines.append(side - 1)
    for line in lines:
        cells[max(0, line - 1) : line + 2, :] = OCCUPIED
        cells[:, max(0, line - 1) : line + 2] = OCCUPIED
    for line in lines[1:-1]:
        for low, high in pairwise(lines):
            for wall in (cells, cells.T):
                door = int(random.integers(low + 10, high - 34))
                wall[line - 1 : line + 2, door : door + 24] = FREE
    for low_row, high_row in pairwise(lines):
        for low, high in pairwise(lines):
            row, column = (
                random.integers(low_row + 30, high_row - 40),
                random.integers(low + 30, high - 40),
            )
            cells[row : row + 10, column : column + 10] = OCCUPIED
    grid = GridMap(side, side, 0.05, 0.0, 0.0, cells.tobytes())
    return static_costmap(_open_site(grid), RouteLimits().radius_m)


def _open_site(grid: GridMap) -> Site:
    far_m = max(grid.width, grid.height) * grid.resolution_m + 100.0
    outline = ((-far_m, -far_m), (far_m, -far_m), (far_m, far_m), (-far_m, far_m))
    record = FenceFile(version=1, map_id="0" * 16, allowed=(outline,), keep_outs=(), speed_zones=())
    home = Place(id="home", kind="place", name=Names(en="home", zh="家"), pose=Pose2(1, 1, 0))
    return Site(Path("/"), grid, "0" * 16, Fence(record, "0" * 16), (home,), home)


# Doors -------------------------------------------------------------------------------------------


def _door_rows(lab: BenchLab) -> list[ReportRow]:
    count = lab.count(20, PASSES)
    with lab.folder() as folder:
        closed = sum(DoorPasses(folder).is_closed(seed) for seed in range(count))
    bound = f"; 3/n = {3 / count:.3f}" if closed == 0 else ""
    note = f"{count} passes, poses {POSE_SIGMA_M} m and 0.4 degrees off{bound}"
    what = f"{DOOR_M:.2f} m door closed by noise"
    return [ReportRow(what, "passes", "0", value=str(closed), note=note)]


class DoorPasses:
    """Pass one narrow door again and again, with an empty memory each time."""

    def __init__(self, folder: Path) -> None:
        """Make two rooms with the door between them in a folder."""
        home = load_home(CHECKOUT / "sites" / "two_room").model_dump(
            mode="json", by_alias=True, exclude_none=True
        )
        self._door = home["doors"][0]
        self._door["width_m"] = DOOR_M
        site = site_of(folder, Home.model_validate(home))
        self._sim = SimRobot(site, seed=1)
        self._router = Router(Site.load(site), RouteLimits.of(self._sim.robot))

    def put_crate(self) -> None:
        """Close the door truly: what a pass must notice."""
        self._sim.place_obstacle(*self._door["at"])

    def is_closed(self, seed: int) -> bool:
        """Drive through in thought; tell whether the memory ever closed the way, or left none."""
        random, memory = Random(f"door {seed}"), self._router.new_memory()
        x_m, door_m = self._door["at"]
        off = [random.gauss(0.0, POSE_SIGMA_M), random.gauss(0.0, POSE_SIGMA_M)]
        turned = random.gauss(0.0, POSE_SIGMA_RAD)
        for step in range(round(2.4 / (SPEED_MPS * SCAN_S))):
            y_m = door_m - 1.6 + SPEED_MPS * SCAN_S * step
            yaw_rad = np.pi / 2 + random.gauss(0.0, 0.05)
            self._sim.place_robot(Pose2(x_m, y_m, yaw_rad))
            believed = Pose2(x_m + off[0], y_m + off[1], yaw_rad + turned)
            self._router.observe(memory, _observe(self._sim, believed, SCAN_S * step))
            if y_m < door_m - 0.4:
                try:
                    goal = Pose2(x_m, door_m + 0.8, 0.0)
                    asked = RouteRequest(Pose2(x_m, y_m, 0.0), goal, strict=True)
                    self._router.route(asked, memory=memory)
                except RouteFailure:
                    return True
        return False
