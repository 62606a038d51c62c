"""The route process searches on what is known of a home, as soon as it is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from maps import FREE, OCCUPIED, GridMap
from maps.canvas import canvas_site
from maps.growing_map import GROWING_MAP, GrowingMap, write_growing_map
from planner.navigation import RouteFailure, RouteLimits, RouteRequest
from planner.navigation.process_main import GrowingRouter
from planner.site import Site
from wire import Pose2

AHEAD = RouteRequest(Pose2(0.0, 0.0, 0.0), Pose2(3.0, 0.0, 0.0))


def hall(wall_at_m: float | None = None) -> GridMap:
    """Return a hall of 6 m by 3 m around the robot, a wall across it where one is."""
    cells = bytearray([FREE]) * (120 * 60)
    if wall_at_m is not None:
        for row in range(60):
            cells[row * 120 + round((wall_at_m + 1.0) / 0.05)] = OCCUPIED
    return GridMap(120, 60, 0.05, -1.0, -1.5, bytes(cells))


def test_routes_follow_the_map_as_it_grows_and_its_walls(tmp_path: Path) -> None:
    folder = tmp_path / "attic"
    canvas_site(0.3).write(folder)
    found = GrowingRouter(Site.load(folder), RouteLimits())
    memory = found.router.new_memory()
    with pytest.raises(RouteFailure):
        found.router.route(AHEAD, memory=memory)  # nothing is known there yet
    write_growing_map(folder, GrowingMap(1, 5, 0, hall()))
    assert found.router.route(AHEAD, memory=memory).length_m == pytest.approx(3.0, abs=0.1)
    write_growing_map(folder, GrowingMap(2, 6, 0, hall(wall_at_m=1.5)))
    with pytest.raises(RouteFailure):
        found.router.route(AHEAD, memory=memory)
    before = found.router
    (folder / GROWING_MAP).write_bytes(b"spoilt")
    assert found.router is before, "the last that was whole"
    (folder / GROWING_MAP).unlink()
    assert found.router is before
