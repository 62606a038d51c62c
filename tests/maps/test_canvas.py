"""A canvas is a site: the robot stands on its only floor, within a fence around all that may be."""

from __future__ import annotations

from pathlib import Path

import pytest

from maps import FREE, UNKNOWN
from maps.canvas import FLOOR_M, canvas_site
from maps.growing_map import read_growing_map
from planner.site import Site
from planner.site.site_view import facts_of

RADIUS_M = 0.3


@pytest.fixture(scope="module")
def canvas(tmp_path_factory: pytest.TempPathFactory) -> Site:
    folder = tmp_path_factory.mktemp("mapping") / "attic"
    canvas_site(RADIUS_M).write(folder)
    return Site.load(folder)


def test_the_planner_loads_it_with_the_robot_at_home(canvas: Site) -> None:
    assert (canvas.home.pose.x_m, canvas.home.pose.y_m) == (0.0, 0.0)
    assert canvas.rooms == ()


def test_floor_is_where_the_robot_stands_and_nowhere_else(canvas: Site) -> None:
    reach_m = RADIUS_M + FLOOR_M
    for x_m, y_m, kind in (
        (0.0, 0.0, FREE),
        (reach_m - 0.06, 0.0, FREE),
        (0.0, 0.06 - reach_m, FREE),
        (reach_m + 0.06, 0.0, UNKNOWN),
        (15.0, -15.0, UNKNOWN),
    ):
        assert canvas.grid.at(x_m, y_m) == kind, (x_m, y_m)


def test_canvases_of_two_marks_are_two_maps(canvas: Site, tmp_path: Path) -> None:
    for mark in ("attic_1", "attic_2"):
        canvas_site(RADIUS_M, mark=mark).write(tmp_path / mark)
    one, other = (Site.load(tmp_path / mark) for mark in ("attic_1", "attic_2"))
    assert len({canvas.map_id, one.map_id, other.map_id}) == 3
    assert one.grid == other.grid == canvas.grid


def test_it_is_known_as_a_map_that_grows(canvas: Site) -> None:
    assert facts_of(canvas).grows
    whole = Site.load(Path(__file__).resolve().parents[2] / "sites" / "two_room")
    assert not facts_of(whole).grows


def test_the_fence_lets_it_into_all_that_may_be_mapped(canvas: Site) -> None:
    assert all(canvas.fence.allows(x_m, y_m) for x_m in (-18.0, 18.0) for y_m in (-18.0, 18.0))
    assert not canvas.fence.allows(19.5, 0.0)


def test_a_map_has_begun_to_grow_on_it(canvas: Site) -> None:
    begun = read_growing_map(canvas.folder)
    assert begun is not None
    assert (begun.revision, begun.keyframes) == (0, 0)
    assert begun.paint_on(canvas.grid) == canvas.grid
    assert begun.grid.cells.count(FREE) == canvas.grid.cells.count(FREE)
