"""Build the world that a plan is rehearsed in: the map, and all that was seen last stands in it.

What the planner remembers stands there for physics and lidar, and the planner there remembers it,
too. The robot is the one described, on wheels of the simulator's.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lockstep.driven_world import DrivenWorld
from lockstep.latencies import Pace
from lockstep.scene import scene
from planner.brain import ThinkResult
from planner.navigation.obstacle_memory import unpack_cells
from planner.plan import BrainTag, StepPlan
from planner.site.site_view import vocabulary_of
from sim.site.mapped import home_of_cells, occupied_cells
from wire import RobotDescription
from wire.drive_config import LINE_KEYS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from maps import GridMap
    from planner.brain import ThinkRequest
    from planner.brain.streamed_draft import Hear
    from planner.driven_rehearsal import DriveRequest
    from planner.plan import Step

BESIDE_M = 0.06
"""From the robot's rim: what is marked nearer is a cell's rounding, or the robot itself."""
PACE = Pace(planner_hears=2)
"""Statuses come every 50 ms: a look each 20 ms hears them in time, and costs half."""
_VIRTUAL = {"kind": "sim"}
_LIDAR_LINE = {"kind", "model", "port", "baud", "upside_down"}


class GivenPlan:
    """Be a brain that has one plan, which was accepted before."""

    tag = BrainTag(name="rehearsal", version="1")

    def __init__(self, steps: tuple[Step, ...]) -> None:
        self._steps = steps

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the plan, whatever is asked."""
        return ThinkResult(plan=StepPlan(steps=self._steps), brain=self.tag, by_grammar=True)


def virtual_robot(robot: RobotDescription) -> RobotDescription:
    """Return a robot on the simulator's wheels and lidar, else as described."""
    told = robot.model_dump(exclude_unset=True)
    drive = {k: v for k, v in told.get("drive", {}).items() if k not in LINE_KEYS}
    lidar = {k: v for k, v in told.get("lidar", {}).items() if k not in _LIDAR_LINE}
    kept = {name: told[name] for name in ("id", "base", "limits") if name in told}
    return RobotDescription.model_validate(
        {
            **kept,
            "drive": drive | _VIRTUAL,
            "lidar": lidar | _VIRTUAL,
            "inputs": {"imu": robot.inputs.imu},
            "localization": {"kind": "stand_in"},
        }
    )


def world_of(asked: DriveRequest, body: bytes, steps: tuple[Step, ...]) -> DrivenWorld:
    """Return the world of a request, its robot ready where the real one stands.

    Raises:
        SiteError, ConfigError: the site can't be read, or its map not be simulated.
        TooLong: the robot did not become ready.
    """
    robot, begins = virtual_robot(asked.robot), asked.begins
    plain = scene(Path(asked.site), robot)
    site = replace(plain.site, places=(*plain.site.places, *asked.places))
    plain = replace(plain, site=site, vocabulary=vocabulary_of(site))
    cells, suspicions = body[: asked.cells_bytes], body[asked.cells_bytes :]
    seen = _seen_cells(asked, site.grid, cells + suspicions, robot.base.radius_m)
    occupied = occupied_cells(site.grid) | seen
    home = home_of_cells(site.grid, occupied, begins, asked.site)
    world = DrivenWorld(
        ready=False, site=Path(asked.site), plain=plain, home=home, robot=robot,
        start=begins, brain=GivenPlan(steps), pace=PACE,
    )  # fmt: skip
    world.planner.obstacle_memory.recall(cells, suspicions)
    world.make_ready()
    if asked.marks is not None:
        drawn = world.planner.draw(asked.marks, world.now_s)
        world.run_until(lambda _: drawn.answer is not None, 5.0)
    return world


def _seen_cells(
    asked: DriveRequest, grid: GridMap, cells: bytes, radius_m: float
) -> NDArray[np.bool_]:
    """Return the cells that what was seen last fills, off the robot itself."""
    seen = unpack_cells(cells, (grid.height, grid.width))
    columns, rows = np.meshgrid(np.arange(grid.width), np.arange(grid.height))
    xs = grid.origin_x_m + (columns + 0.5) * grid.resolution_m
    ys = grid.origin_y_m + (rows + 0.5) * grid.resolution_m
    for x_m, y_m, disc_m in asked.discs:
        seen |= np.hypot(xs - x_m, ys - y_m) <= disc_m
    begins, off_m = asked.begins, radius_m + BESIDE_M
    seen[np.hypot(xs - begins.x_m, ys - begins.y_m) <= off_m] = False
    return seen
