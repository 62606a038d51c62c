"""Measure drives from spot to spot on maps that others made, imported as a user would import them.

In lockstep; walls are made of the map's occupied cells, and localization is by scans. Spots are
drawn by seed on floor that a robot can reach and stand on. Skipped aloud where the maps are not
beside the checkout.
"""

from __future__ import annotations

from dataclasses import asdict
from math import pi
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from maps import FREE, load_map
from maps.cell_array import cell_array
from maps.new_site import new_site
from planner.navigation import RouteFailure, RouteLimits, RouteRequest
from planner.navigation.router import Router
from planner.site import Site
from pons.settings import CHECKOUT
from tools.bench.drive_record import RecordedDrive, TourRecord
from tools.bench.measure.domain import row_of_drives
from tools.bench.report import ReportRow
from tools.lockstep import LockstepWorld
from wire import Pose2, RobotDescription, load_robot
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from collections.abc import Mapping

    from tools.bench.context import BenchLab

NAME = "goals_elsewhere"
TITLE = "goals from spot to spot on maps of others"
LONG_ONLY = True
ROBOTS = CHECKOUT / "robots"
MAPS = CHECKOUT.parent / "shared" / "data" / "maps"
TURTLEBOT_WORLD = "turtlebot3_world/map.yaml"
SITES = {
    "small house": ("aws_small_house/map.yaml", None),
    "depot": ("nav2_depot/depot.yaml", None),
    "TurtleBot 3 world": (TURTLEBOT_WORLD, "turtlebot3_burger"),
    "TurtleBot 3 world, robot 0.6 m wide": (TURTLEBOT_WORLD, None),
}
"""Each with the preset that drives there; left out, the default robot. The third map's pillars
leave 0.75 m between them: 0.05 m more than the default robot and its margins need."""
EACH = 10
"""Goals of one drive; its seed is its number."""
SPOTS = (
    "alpha",
    "bravo",
    "charlie",
    "delta",
    "echo",
    "foxtrot",
    "hotel",
    "india",
    "juliet",
    "kilo",
)
SPARE_M = 0.15
"""Between the robot's disc and what bounds a spot: room to turn."""
GOAL = "reached >= 99 %, contacts 0, SPL >= 0.93, time x1.25"


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive 100 goals on each map in a long run, 10 in a quick one; one processor a drive."""
    missing = [where for where, _ in SITES.values() if not (MAPS / where).is_file()]
    if missing:
        note = f"not beside the checkout: {', '.join(missing)}"
        return [ReportRow("maps of others", "", GOAL, value="none", note=note, valid=False)]
    drives: dict[str, list[TourRecord]] = {site: [] for site in SITES}
    for taken in lab.side_by_side("drive", lab.count(1, 10) * len(SITES), take_drive):
        drives[taken["site"]].append(TourRecord(**taken["record"]))
    each = f"seeds of {EACH} goals"
    return [row_of_drives(site, drives[site], each, GOAL) for site in SITES]


def take_drive(index: int) -> dict[str, Any]:
    """Drive ten goals; the index says on which map with which seed, which draws its spots too."""
    site, seed = tuple(SITES)[index % len(SITES)], index // len(SITES) + 1
    where, preset = SITES[site]
    robot = RobotDescription() if preset is None else load_robot(ROBOTS / f"{preset}.toml")
    robot = robot.model_copy(update={"localization": LocalizationConfig(kind="scans")})
    with TemporaryDirectory(prefix="pb-") as parent:
        folder = Path(parent) / "site"
        loaded = load_map(MAPS / where)
        new_site(loaded, robot.base.radius_m).write(folder)
        spots = spots_of(folder, robot, seed)
        add_places(folder, spots)
        world = LockstepWorld(site=folder, seed=seed, robot=robot)
        named = {f"{name} spot": pose for name, pose in spots.items()}
        record = RecordedDrive(world, f"{site} {seed}", named).run(goals=EACH)
    return {"site": site, "record": asdict(record)}


def spots_of(folder: Path, robot: RobotDescription, seed: int) -> dict[str, Pose2]:
    """Draw poses that the robot can drive to from home, by name."""
    site, random = Site.load(folder), Random(f"spots {seed}")
    router, grid, home = Router(site, RouteLimits.of(robot)), site.grid, site.home.pose
    free = (cell_array(grid) == FREE).astype(np.uint8)
    room_m = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) * grid.resolution_m
    rows, columns = np.nonzero(room_m >= robot.base.radius_m + SPARE_M)
    spots: dict[str, Pose2] = {}
    while len(spots) < len(SPOTS):
        one = random.randrange(rows.size)
        x_m, y_m = grid.centre_of(int(columns[one]), int(rows[one]))
        pose = Pose2(x_m, y_m, random.uniform(-pi, pi))
        if not site.fence.allows(x_m, y_m):
            continue
        try:
            router.route(RouteRequest(home, pose))
        except RouteFailure:
            continue
        spots[SPOTS[len(spots)]] = pose
    return spots


def add_places(folder: Path, spots: Mapping[str, Pose2]) -> None:
    """Write spots into a site's places.yaml, as their owner would."""
    path = folder / "places.yaml"
    entries = "".join(
        f"- id: {name}_spot\n  kind: place\n"
        f'  name: {{en: "{name} spot", zh: "{name} 点"}}\n'
        f"  pose: {{x_m: {pose.x_m:.3f}, y_m: {pose.y_m:.3f}, yaw_rad: {pose.yaw_rad:.4f}}}\n"
        for name, pose in spots.items()
    )
    path.write_text(path.read_text("utf-8").rstrip("\n") + "\n" + entries, "utf-8")
