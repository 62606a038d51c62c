"""Measure exploring: homes nobody knows, mapped by one sentence said until it ends "explored".

In lockstep with the real bridge core, mapper and route search. The floor that counts is all that is
joined to where the robot begins, on the map that the simulator's home is drawn from; what stands on
it and is on no map (people, things) is not taken off. A cell counts as explored where the made map
has floor within 0.1 m of it, so that a wall drawn two cells off is no floor that was missed.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import cv2
import numpy as np

from localization.mapping.keyframes import pose_after, pose_between
from maps import FREE, load_map
from maps.canvas import canvas_site
from maps.cell_array import cell_array
from pons.settings import CHECKOUT
from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld, TooLong
from tools.lockstep.homes import made_home
from wire import RobotDescription
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from maps import GridMap
    from tools.bench.context import BenchLab
    from wire import Pose2

    Floats = NDArray[np.float64]

NAME = "exploration"
TITLE = "homes explored by one sentence"
LONG_ONLY = True
SITES = {"home": CHECKOUT / "sites" / "home", "two rooms": CHECKOUT / "sites" / "two_room"}
ORDERS = 3
ORDER_S = 900.0
NEAR_M = 0.1


@dataclass(frozen=True, slots=True)
class Exploration:
    """Hold what one home came to."""

    floor_m2: float
    first_share: float
    """Of the floor, after the first order."""
    share: float
    metres: float
    seconds: float
    orders: int
    contacts: int
    code: str
    """How the last order ended."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Explore each site from its dock, by seeds of noise; and homes that are drawn by seed."""
    rows = []
    for site, take in HOMES.items():
        taken = lab.side_by_side(site, lab.count(1, 4), take)
        homes = [Exploration(**one) for one in taken]
        ends = ", ".join(sorted({one.code for one in homes}))
        rows += [
            row_of(f"explored, {site}", "%", ">= 98", [100.0 * h.share for h in homes], ends),
            row_of(f"by one order, {site}", "%", "", [100.0 * h.first_share for h in homes]),
            row_of(f"driven, {site}", "m/m2", "<= 1.2", [h.metres / h.floor_m2 for h in homes]),
            row_of(f"time, {site}", "s/m2", "", [h.seconds / h.floor_m2 for h in homes]),
            row_of(f"contacts, {site}", "", "0", [float(h.contacts) for h in homes]),
        ]
    return rows


def explore_home(seed: int) -> dict[str, object]:
    """Explore the default home; return the figures as JSON can hold them."""
    return _explore_anew(SITES["home"], seed)


def explore_two_rooms(seed: int) -> dict[str, object]:
    """Explore the site of two rooms."""
    return _explore_anew(SITES["two rooms"], seed)


def explore_made_home(seed: int) -> dict[str, object]:
    """Explore a home that is drawn by this seed."""
    with TemporaryDirectory() as parent:
        return _explore_anew(made_home(Path(parent), seed + 1), seed)


HOMES = {"home": explore_home, "two rooms": explore_two_rooms, "made homes": explore_made_home}


def _explore_anew(site: Path, seed: int) -> dict[str, object]:
    with TemporaryDirectory() as parent:
        return asdict(explore(site, Path(parent) / "canvas", seed + 1))


def explore(site: Path, canvas: Path, seed: int) -> Exploration:
    """Say "explore the house" until that ends with nothing left.

    Raises:
        TooLong: an order did not end.
    """
    robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
    canvas_site(robot.base.radius_m).write(canvas)
    world = LockstepWorld(site=site, canvas=canvas, robot=robot, seed=seed)
    floor, start, began_s = true_floor(site, world.truth), world.truth, world.now_s
    shares, metres, code = list[float](), 0.0, ""
    while len(shares) < ORDERS and code != "explored":
        goal = world.say("explore the house")
        world.run_until(lambda _, goal=goal: goal.has_ended, ORDER_S)  # type: ignore[misc]
        outcome = goal.record.outcome
        if outcome is None:
            raise TooLong(f"the goal ended without an outcome; {world.describe()}")
        code, metres = outcome.code.value, metres + (outcome.metres or 0.0)
        shares.append(share_explored(world, floor, start))
    area_m2 = len(floor) * load_map(site / "map.yaml").grid.resolution_m ** 2
    seconds = world.now_s - began_s
    ends = (metres, seconds, len(shares), world.contacts, code)
    return Exploration(area_m2, shares[0], shares[-1], *ends)


def true_floor(site: Path, start: Pose2) -> Floats:
    """Return the middles of the floor's cells, shape (n, 2) in the true ``map`` [m]."""
    grid = load_map(site / "map.yaml").grid
    free = (cell_array(grid) == FREE).astype(np.uint8)
    _, labels = cv2.connectedComponents(free, connectivity=4)
    column, row = grid.cell_of(start.x_m, start.y_m)
    rows, columns = np.nonzero(labels == labels[row, column])
    x_m = grid.origin_x_m + (columns + 0.5) * grid.resolution_m
    y_m = grid.origin_y_m + (rows + 0.5) * grid.resolution_m
    return np.column_stack((x_m, y_m))


def share_explored(world: LockstepWorld, floor: Floats, start: Pose2) -> float:
    """Return the share of the floor that the map shows which was made from ``start``."""
    if world.mapping is None:
        return 0.0
    made: GridMap = world.mapping.paced.builder.draw()
    size = 2 * round(NEAR_M / made.resolution_m) + 1
    free = (cell_array(made) == FREE).astype(np.uint8)
    near = cv2.dilate(free, np.ones((size, size), np.uint8)) > 0
    at = np.column_stack((floor, np.zeros(len(floor))))
    begin = np.array((start.x_m, start.y_m, start.yaw_rad))
    in_map = pose_after(pose_between(begin, np.zeros(3)), at)
    column = np.floor((in_map[:, 0] - made.origin_x_m) / made.resolution_m).astype(np.intp)
    row = np.floor((in_map[:, 1] - made.origin_y_m) / made.resolution_m).astype(np.intp)
    inside = (column >= 0) & (column < made.width) & (row >= 0) & (row < made.height)
    return float(near[row[inside], column[inside]].sum()) / len(floor)
