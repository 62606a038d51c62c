"""Hold the costmap to geometry: discs, fences, and what the lidar may and may not add."""

from __future__ import annotations

from math import hypot

import numpy as np
import pytest

from maps import OCCUPIED
from planner.navigation.costmap import FENCE_MARGIN_M, MARGIN_M, static_costmap
from planner.navigation.raster import distance_m
from planner.site import Site
from tests.planner.navigation.floors import CELL_M, drawn

RADIUS_M = 0.30
OPEN = ("." * 16,) * 16  # 4 x 4 m


def test_no_free_cell_lets_the_disc_touch() -> None:
    site = drawn("........", "........", "...#....", "........", "........", square_m=0.5)
    costmap = static_costmap(site, RADIUS_M)
    grid = site.grid
    for row, column in np.argwhere(costmap.free):
        x_m, y_m = grid.centre_of(int(column), int(row))
        # The wall is the square from (1.5, 1.0) to (2.0, 1.5); outside the map nothing is known.
        away_m = hypot(max(1.5 - x_m, 0, x_m - 2.0), max(1.0 - y_m, 0, y_m - 1.5))
        edge_m = min(x_m, y_m, 4.0 - x_m, 2.5 - y_m)
        # Beside a corner the edge is up to 0.21 of a cell nearer than cells can tell.
        assert min(away_m, edge_m) >= RADIUS_M + MARGIN_M - 0.21 * CELL_M


def test_nothing_more_than_needed_is_blocked() -> None:
    costmap = static_costmap(drawn(*OPEN), RADIUS_M)
    inner = costmap.free[7:-7, 7:-7]  # 0.35 m from the edge
    assert inner.all()


def test_the_fence_bounds_the_centre_with_its_margin() -> None:
    outline = ((1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0))
    hole = ((1.9, 1.9), (2.1, 1.9), (2.1, 2.1), (1.9, 2.1))
    site = drawn(*OPEN, allowed=(outline,), keep_outs=(hole,))
    costmap = static_costmap(site, RADIUS_M)
    assert costmap.free.any()
    for row, column in np.argwhere(costmap.free):
        x_m, y_m = site.grid.centre_of(int(column), int(row))
        assert site.fence.allows(x_m, y_m)
        assert site.fence.border_distance_m(x_m, y_m) >= FENCE_MARGIN_M - 0.21 * CELL_M


def test_overlapping_outlines_are_one_floor() -> None:
    left = ((0.5, 0.5), (2.2, 0.5), (2.2, 3.5), (0.5, 3.5))
    right = ((1.8, 0.5), (3.5, 0.5), (3.5, 3.5), (1.8, 3.5))
    costmap = static_costmap(drawn(*OPEN, allowed=(left, right)), RADIUS_M)
    assert costmap.free[40, 15:65].all()


def test_the_middle_of_a_door_costs_least() -> None:
    site = drawn(*(["." * 20] * 6 + ["########..##########"] + ["." * 20] * 6), square_m=0.5)
    costmap = static_costmap(site, RADIUS_M)
    row = costmap.cost[6 * 10 + 5]
    free = np.flatnonzero(np.isfinite(row))
    assert free.tolist() == list(range(87, 93)) or len(free) > 0
    assert abs(float(free[np.argmin(row[free])]) - 89.5) <= 0.5


def test_a_new_obstacle_blocks_its_disc_and_leaves_the_mapped_floor_as_it_was() -> None:
    mapped = static_costmap(drawn(*OPEN), RADIUS_M)
    seen = mapped.with_obstacles([(2.0, 2.0)], (1.0, 1.0))
    assert mapped.free[40, 40]
    assert not seen.free[40, 40]
    assert not seen.free[40, 46]
    assert seen.free[40, 48]
    assert (seen.cost >= mapped.cost).all()


@pytest.mark.parametrize(
    "point",
    [
        (0.02, 2.0),  # the edge of the known floor, 0.1 m away
        (1.1, 1.0),  # inside the robot
        (-5.0, 2.0),  # off the map
        (float("nan"), 2.0),
        (2.0, float("inf")),
    ],
)
def test_what_is_explained_or_no_place_changes_nothing(point: tuple[float, float]) -> None:
    mapped = static_costmap(drawn(*OPEN), RADIUS_M)
    assert mapped.with_obstacles([point], (1.0, 1.0)) is mapped
    assert mapped.with_obstacles([], (1.0, 1.0)) is mapped


@pytest.mark.parametrize("yaw_rad", [-0.0175, 0.0, 0.0175])
@pytest.mark.parametrize("shift", [(0.04, 0.0), (0.0, -0.04), (-0.03, 0.03)])
def test_walls_seen_through_a_wrong_pose_take_no_floor_away(
    home: Site, yaw_rad: float, shift: tuple[float, float]
) -> None:
    """Show every mapped wall within the lidar's reach as a robot two sigma astray would see it."""
    mapped = static_costmap(home, RADIUS_M)
    random = np.random.default_rng(1)
    rows, columns = np.nonzero(mapped.occupied)
    walls = (np.column_stack([columns, rows]) + 0.5) * CELL_M + home.grid.origin_x_m
    for place in home.places[::3]:
        robot = np.array([place.pose.x_m, place.pose.y_m])
        seen = (walls - robot)[np.hypot(*(walls - robot).T) <= 8.0]
        turn = np.array([[np.cos(yaw_rad), np.sin(yaw_rad)], [-np.sin(yaw_rad), np.cos(yaw_rad)]])
        astray = seen @ turn + robot + shift + random.normal(0.0, 0.01, seen.shape)
        costmap = mapped.with_obstacles(
            [(x, y) for x, y in astray.tolist()], (float(robot[0]), float(robot[1]))
        )
        assert (costmap.free == mapped.free).all()


def test_points_beyond_the_map_are_blocked() -> None:
    costmap = static_costmap(drawn(*OPEN), RADIUS_M)
    outside = np.array([[-1.0, 2.0], [2.0, 99.0], [4.01, 2.0], [-0.001, 2.0]])
    assert np.isinf(costmap.cost_at(outside)).all()
    assert (costmap.clearance_at(outside) < 0).all()
    assert (costmap.fence_gap_at(outside) < 0).all()


@pytest.mark.parametrize("shift_m", [0.0, 0.001, 0.0125, 0.025, 0.0375, 0.049])
def test_a_door_of_090_stays_open_wherever_its_jambs_fall_on_the_grid(shift_m: float) -> None:
    """What wire.margins says: the gate's margin costs no door, though a jamb may cost a cell."""
    low_m, high_m = 1.0 + shift_m, 1.9 + shift_m
    edges_m = np.arange(60) * CELL_M
    covered = (edges_m < low_m - 1e-9) | (edges_m + CELL_M > high_m + 1e-9)
    cells = np.zeros((60, 20), np.uint8)
    cells[covered, 9:12] = OCCUPIED
    clear_m = distance_m(cells != OCCUPIED, CELL_M)
    middle = clear_m[20:38, 10]
    assert float(middle.max()) >= RADIUS_M + MARGIN_M
