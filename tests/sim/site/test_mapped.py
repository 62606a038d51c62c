"""A site of a map alone is simulated: its occupied cells are solid, and nothing else is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from maps import OCCUPIED, load_map
from maps.cell_array import cell_array
from maps.new_site import new_site
from sim import SimRobot
from sim.site import check_fresh, load_home
from sim.site.mapped import wall_boxes
from wire import ConfigError


@pytest.fixture
def mapped(tmp_path: Path, repository: Path) -> Path:
    """Return a site that has the map of two_room and no declaration."""
    folder = tmp_path / "mine"
    new_site(load_map(repository / "sites" / "two_room" / "map.yaml"), 0.30).write(folder)
    return folder


@pytest.mark.parametrize("site", ["home", "two_room"])
def test_boxes_cover_each_occupied_cell_once_and_no_other(repository: Path, site: str) -> None:
    grid = load_map(repository / "sites" / site / "map.yaml").grid
    covered = np.zeros((grid.height, grid.width), int)
    for x0, y0, x1, y1 in wall_boxes(grid):
        left, low = (
            round(v / grid.resolution_m) for v in (x0 - grid.origin_x_m, y0 - grid.origin_y_m)
        )
        right, top = (
            round(v / grid.resolution_m) for v in (x1 - grid.origin_x_m, y1 - grid.origin_y_m)
        )
        covered[low:top, left:right] += 1
    assert np.array_equal(covered, (cell_array(grid) == OCCUPIED).astype(int))
    assert len(wall_boxes(grid)) < (cell_array(grid) == OCCUPIED).sum() / 20


def test_the_lidar_sees_the_maps_walls(mapped: Path, repository: Path) -> None:
    check_fresh(mapped)
    robot = SimRobot(mapped, seed=1)
    declared = SimRobot(repository / "sites" / "two_room", seed=1, start=robot.base_in_map)
    scans = [
        next(r.scan for r in one.step_to(0.2) if r.scan is not None) for one in (robot, declared)
    ]
    pairs = zip(*(scan.ranges_m for scan in scans), strict=True)
    off = [abs(a - b) for a, b in pairs if a is not None and b is not None]
    assert len(off) > 300
    assert np.quantile(off, 0.9) < 0.15  # a cell, and the noise of both
    assert robot.contacts_total == 0


def test_a_site_without_its_dock_is_refused(mapped: Path) -> None:
    places = mapped / "places.yaml"
    places.write_text(places.read_text().replace("home: home", "home: nowhere"))
    with pytest.raises(ConfigError, match="dock_unknown"):
        load_home(mapped)


def test_a_declaration_is_never_passed_over(mapped: Path) -> None:
    (mapped / "home.yaml").symlink_to("gone.yaml")
    with pytest.raises(ConfigError, match="home_missing"):
        load_home(mapped)
