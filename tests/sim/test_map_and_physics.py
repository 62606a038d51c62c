"""What the map shows is what the physics holds, and a robot can get to every place of it."""

from __future__ import annotations

from math import cos, floor, hypot, pi, sin
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from sim import PERIODS, Hardware
from sim.site import load_home, solids
from sim.site.check import spots
from sim.site.objects import Upright
from sim.site.shapes import Disc, Solid
from sim.world import PhysicsWorld
from wire import Pose2, RobotDescription

RESOLUTION_M = 0.05
CELL_DIAGONAL_M = RESOLUTION_M * 2**0.5


class Picture:
    """Read map.pgm the plain way, apart from the code that wrote it."""

    def __init__(self, site_dir: Path) -> None:
        head, size, white, pixels = (site_dir / "map.pgm").read_bytes().split(b"\n", 3)
        columns, rows = map(int, size.split())
        assert (head, white) == (b"P5", b"255")
        self.cells = np.frombuffer(pixels, dtype=np.uint8).reshape(rows, columns)[::-1]
        text = (site_dir / "map.yaml").read_text("utf-8")
        origin = next(line for line in text.splitlines() if line.startswith("origin:"))
        self.x0_m, self.y0_m, _ = (float(part) for part in origin[9:-1].split(","))

    def at(self, x_m: float, y_m: float) -> int:
        row = floor((y_m - self.y0_m) / RESOLUTION_M)
        return int(self.cells[row, floor((x_m - self.x0_m) / RESOLUTION_M)])


@pytest.fixture(params=["home", "two_room"])
def site_dir(request: pytest.FixtureRequest, repository: Path) -> Path:
    return repository / "sites" / str(request.param)


def beams(count: int) -> NDArray[np.float64]:
    angles = np.arange(count) * 2 * pi / count + 0.01
    return np.stack((np.cos(angles), np.sin(angles), np.zeros(count)), axis=1)


def test_rays_end_where_the_map_is_occupied(site_dir: Path) -> None:
    home = load_home(site_dir)
    picture = Picture(site_dir)
    world = PhysicsWorld(solids(home), RobotDescription().base, Hardware(), PERIODS.step_s)
    standing = solids(home)
    directions = beams(180)
    for x_m, y_m, _ in spots(home).values():
        assert picture.at(x_m, y_m) == 254
        found = world.rays((x_m, y_m), directions, 30.0)
        assert np.all(found > 0.0), "a home is closed all around"
        for (dx, dy, _), reach in zip(directions, found, strict=True):
            behind = reach + 1e-4  # just inside what was hit
            assert picture.at(x_m + dx * behind, y_m + dy * behind) == 0
            clear = np.arange(0.0, reach - CELL_DIAGONAL_M, RESOLUTION_M / 2)
            passed = [(x_m + dx * s, y_m + dy * s) for s in clear]
            grazed = [point for point in passed if picture.at(*point) != 254]
            # A cell is occupied when a solid covers part of it: a ray may pass the other part.
            assert all(
                min(solid.shape.distance(*point) for solid in standing) < CELL_DIAGONAL_M
                for point in grazed
            )
            assert len(grazed) <= len(passed) / 4


def test_every_place_is_reached_by_a_disc_of_the_robots_radius(site_dir: Path) -> None:
    home = load_home(site_dir)
    picture = Picture(site_dir)
    radius_m = 0.30 + RESOLUTION_M
    reach = floor(radius_m / RESOLUTION_M)
    blocked = picture.cells != 254
    inflated = np.zeros_like(blocked)
    for row in range(-reach, reach + 1):
        for column in range(-reach, reach + 1):
            if hypot(row, column) * RESOLUTION_M <= radius_m:
                inflated |= np.roll(blocked, (row, column), axis=(0, 1))

    def cell(x_m: float, y_m: float) -> tuple[int, int]:
        return (
            floor((y_m - picture.y0_m) / RESOLUTION_M),
            floor((x_m - picture.x0_m) / RESOLUTION_M),
        )

    start = cell(*home.places[home.dock].pose[:2])
    seen, edge = {start}, [start]
    while edge:
        edge = [
            step
            for r, c in edge
            for step in ((r + 1, c), (r - 1, c), (r, c + 1), (r, c - 1))
            if not inflated[step] and step not in seen and not seen.add(step)  # type: ignore[func-returns-value]
        ]
    unreached = [name for name, pose in spots(home).items() if cell(pose[0], pose[1]) not in seen]
    assert unreached == []


def test_a_person_put_into_the_home_is_seen_and_taken_away(repository: Path) -> None:
    home = load_home(repository / "sites" / "two_room")
    world = PhysicsWorld(solids(home), RobotDescription().base, Hardware(), PERIODS.step_s)
    ahead = np.array([[0.0, 1.0, 0.0]])
    before = world.rays((1.5, 1.0), ahead, 30.0)[0]
    world.place_obstacle("person_0", 1.5, 2.5, 0.0)
    assert world.rays((1.5, 1.0), ahead, 30.0)[0] == pytest.approx(1.25, abs=1e-6)
    world.remove_obstacle("person_0")
    assert world.rays((1.5, 1.0), ahead, 30.0)[0] == before


def test_the_robot_does_not_see_itself(repository: Path) -> None:
    home = load_home(repository / "sites" / "two_room")
    world = PhysicsWorld(solids(home), RobotDescription().base, Hardware(), PERIODS.step_s)
    for yaw in (0.0, 1.0, pi):
        world.place_robot(Pose2(1.5, 1.9, yaw))
        direction = np.array([[cos(yaw), sin(yaw), 0.0]])
        assert world.rays((1.5, 1.9), direction, 30.0)[0] > 0.30


def test_a_home_may_call_its_things_as_the_physics_calls_its_own() -> None:
    names = ("floor", "chassis", "base", "wheel_left", "caster_front", "ballast")
    furniture = [Solid(name, Disc(3.0, 3.0, 0.2), 0.5) for name in (*names, "crate_0")]
    things = [Upright(name, Pose2(-3.0, 3.0, 0.0), (0.2, 0.2), 0.5, round=False) for name in names]
    world = PhysicsWorld(furniture, RobotDescription().base, Hardware(), PERIODS.step_s, things)
    assert set(names) <= set(world.carried)
