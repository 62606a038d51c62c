"""What stood is remembered, what left is forgotten, and what moves leaves no trail."""

from __future__ import annotations

from array import array
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.navigation import RouteFailure, RouteLimits, RouteRequest
from planner.navigation.obstacle_layer import MOVED_FADES_S, STOOD_FADES_S
from planner.navigation.obstacle_memory import ObstacleMemory
from planner.navigation.router import Router
from tests.planner.navigation.floors import drawn
from tests.planner.navigation.scans import Disc, seen_from
from wire import Pose2

WALL = "#" * 25
OPEN = "#" + "." * 23 + "#"
DOORS = "#" + "." * 11 + "#" + "." * 11 + "#"
PASS = "#" + "." * 23 + "#"
HALL = drawn(WALL, *[OPEN] * 14, WALL)  # 6.25 m x 4 m, a single room
ROOMS = drawn(WALL, *[DOORS] * 4, *[PASS] * 5, *[DOORS] * 5, *[PASS] * 4, *[DOORS] * 4, WALL)
"""Two rooms of 2.75 m with two doors: 1.25 m wide above, 1.0 m below."""
HERE, THERE = Pose2(1.0, 2.0, 0.0), Pose2(5.2, 2.0, 0.0)
BOX: Disc = (3.1, 2.0, 0.25)


@pytest.fixture(scope="module")
def hall() -> Router:
    return Router(HALL, RouteLimits())


@pytest.fixture(scope="module")
def rooms() -> Router:
    return Router(ROOMS, RouteLimits())


def cells(data: bytes) -> list[tuple[float, float]]:
    flat = array("H", data)
    return [
        ((c + 0.5) * 0.05, (r + 0.5) * 0.05) for c, r in zip(flat[::2], flat[1::2], strict=True)
    ]


def watch(
    router: Router, memory: ObstacleMemory, robot: Pose2, began_s: float, for_s: float, *discs: Disc
) -> float:
    """Show scans five times a second; return when the last was taken."""
    grid = router._site.grid  # the map it was made of
    steps = round(for_s * 5)
    for step in range(steps):
        router.observe(memory, seen_from(grid, robot, began_s + 0.2 * step, *discs))
    return began_s + 0.2 * (steps - 1)


def near(found: list[tuple[float, float]], disc: Disc) -> bool:
    return any((x - disc[0]) ** 2 + (y - disc[1]) ** 2 <= (disc[2] + 0.08) ** 2 for x, y in found)


def test_the_first_route_already_goes_round_what_was_seen(hall: Router) -> None:
    memory = hall.new_memory()
    request = RouteRequest(HERE, THERE)
    straight_m = hall.route(request, memory=memory).length_m
    watch(hall, memory, HERE, 0.0, 1.0, BOX)
    around = hall.route(request, memory=memory)
    assert around.length_m > straight_m
    assert all((p.x_m - 3.1) ** 2 + (p.y_m - 2.0) ** 2 > 0.5**2 for p in around.points)


def test_what_is_seen_to_be_gone_is_forgotten_at_once(hall: Router) -> None:
    memory = hall.new_memory()
    end_s = watch(hall, memory, HERE, 0.0, 5.0, BOX)
    report = hall.observe(memory, seen_from(HALL.grid, HERE, end_s + 0.2, BOX))
    assert near(cells(report.cells), BOX)
    watch(hall, memory, HERE, end_s + 0.4, 0.8)
    assert not cells(hall.observe(memory, seen_from(HALL.grid, HERE, end_s + 2.0)).cells)


def test_what_the_robot_turned_away_from_is_remembered_then_suspected(rooms: Router) -> None:
    """It stands behind the wall: nobody sees it, and nobody sees that it is gone."""
    memory, hidden = rooms.new_memory(), (5.4, 5.2, 0.2)
    end_s = watch(rooms, memory, Pose2(4.6, 5.0, 0.0), 0.0, 4.0, hidden)
    wall = Pose2(1.0, 3.2, 0.0)
    jumped = rooms.observe(memory, seen_from(ROOMS.grid, wall, end_s + 10.0, hidden))
    assert near(cells(jumped.cells), hidden)
    later = rooms.observe(memory, seen_from(ROOMS.grid, wall, end_s + STOOD_FADES_S + 20.0))
    assert not near(cells(later.cells), hidden)
    assert near(cells(later.suspicions), hidden)


def test_noise_that_lasted_no_time_fades_soon(rooms: Router) -> None:
    memory, passing = rooms.new_memory(), (5.4, 5.2, 0.2)
    end_s = watch(rooms, memory, Pose2(4.6, 5.0, 0.0), 0.0, 0.8, passing)
    wall = Pose2(1.0, 3.2, 0.0)
    kept = rooms.observe(memory, seen_from(ROOMS.grid, wall, end_s + 10.0))
    assert near(cells(kept.cells), passing)
    gone = rooms.observe(memory, seen_from(ROOMS.grid, wall, end_s + MOVED_FADES_S + 1.0))
    assert not near(cells(gone.cells), passing)
    assert not near(cells(gone.suspicions), passing)


def test_who_walks_by_leaves_no_trail_and_is_known_to_move(hall: Router) -> None:
    memory = hall.new_memory()
    report = None
    for step in range(20):
        walker = (2.0, 0.6 + 0.14 * step, 0.2)  # 0.7 m/s
        report = hall.observe(memory, seen_from(HALL.grid, HERE, 0.2 * step, walker))
    assert report is not None
    (mover,) = report.movers
    assert mover.vy_mps == pytest.approx(0.7, abs=0.2)
    assert abs(mover.vx_mps) < 0.3
    trail = [y for x, y in cells(report.cells) if y < 2.6]
    assert not trail


def test_a_way_that_is_closed_ahead_is_told_and_one_behind_a_walker_is_not(hall: Router) -> None:
    ahead = tuple((1.0 + 0.1 * k, 2.0) for k in range(31))
    memory = hall.new_memory()
    watch(hall, memory, HERE, 0.0, 2.0, BOX)
    report = hall.observe(memory, seen_from(HALL.grid, HERE, 2.0, BOX, ahead=ahead))
    assert report.blocked_ahead_m == pytest.approx(3.1 - 1.0 - 0.25 - 0.35, abs=0.15)
    empty = hall.new_memory()
    watch(hall, empty, HERE, 0.0, 2.0)
    assert hall.observe(empty, seen_from(HALL.grid, HERE, 2.0, ahead=ahead)).blocked_ahead_m is None


def test_a_way_out_of_a_tight_spot_is_not_closed_by_where_it_begins(hall: Router) -> None:
    """Somebody put a box beside the robot: its way begins too near to it, and leads away."""
    memory, box = hall.new_memory(), (1.0, 2.5, 0.2)
    watch(hall, memory, HERE, 0.0, 2.0, box)
    out = tuple((1.0 + 0.1 * k, 2.0) for k in range(31))
    assert hall.observe(memory, seen_from(HALL.grid, HERE, 2.0, box, ahead=out[1:])).cells
    kept = hall.observe(memory, seen_from(HALL.grid, HERE, 2.2, box, ahead=out))
    assert kept.blocked_ahead_m is None
    along = tuple((1.0, 2.0 + 0.1 * k) for k in range(11))
    into = hall.observe(memory, seen_from(HALL.grid, HERE, 2.4, box, ahead=along))
    assert into.blocked_ahead_m == pytest.approx(0.0, abs=0.11)


def test_a_strict_request_goes_through_nothing_that_is_remembered(rooms: Router) -> None:
    memory, robot = rooms.new_memory(), Pose2(1.0, 2.4, 0.0)
    upper, lower = (3.1, 1.3, 0.45), (3.1, 4.1, 0.5)
    doors = (upper, (3.1, 1.7, 0.3), lower, (3.1, 3.7, 0.3))
    end_s = watch(rooms, memory, robot, 0.0, 4.0, *doors)
    away = Pose2(0.7, 5.2, 0.0)
    rooms.observe(memory, seen_from(ROOMS.grid, away, end_s + 5.0, upper, lower))
    hoping = RouteRequest(away, Pose2(5.2, 2.4, 0.0))
    assert rooms.route(hoping, memory=memory).length_m > 3.0
    with pytest.raises(RouteFailure):
        rooms.route(replace(hoping, strict=True), memory=memory)


def test_a_remembered_door_that_is_the_only_way_is_tried_again(rooms: Router) -> None:
    memory, robot = rooms.new_memory(), Pose2(1.0, 2.4, 0.0)
    upper, lower = (3.1, 1.3, 0.45), (3.1, 4.1, 0.5)
    request = RouteRequest(robot, Pose2(5.2, 2.4, 0.0))
    end_s = watch(rooms, memory, robot, 0.0, 4.0, upper, (3.1, 1.7, 0.3), lower, (3.1, 3.7, 0.3))
    with pytest.raises(RouteFailure):
        rooms.route(replace(request, obstacles=((3.1, 1.3),)), memory=memory)  # no way round
    assert rooms.route(request, memory=memory).length_m > 3.0, "a first way is driven up to"
    away = Pose2(0.7, 5.2, 0.0)
    rooms.observe(memory, seen_from(ROOMS.grid, away, end_s + 5.0, upper, lower))
    assert rooms.route(RouteRequest(away, request.goal), memory=memory).length_m > 3.0


def test_a_robot_that_was_carried_forgets_what_lies_wrongly_now(hall: Router) -> None:
    memory = hall.new_memory()
    end_s = watch(hall, memory, HERE, 0.0, 4.0, BOX)
    carried = hall.observe(memory, seen_from(HALL.grid, Pose2(5.0, 3.0, 1.0), end_s + 0.2))
    assert not cells(carried.cells)


DOORS_90 = drawn(
    "#" * 61, *["#" + "." * 29 + "#" + "." * 29 + "#"] * 14, *["#" + "." * 59 + "#"] * 9,
    *["#" + "." * 29 + "#" + "." * 29 + "#"] * 14, "#" * 61, square_m=0.1,
)  # fmt: skip


@pytest.fixture(scope="module")
def doors_90() -> Router:
    return Router(DOORS_90, RouteLimits())


@given(seed=st.integers(0, 2**32))
def test_noise_closes_no_door_of_90_cm(doors_90: Router, seed: int) -> None:
    memory, robot = doors_90.new_memory(), Pose2(2.0, 1.9, 0.0)
    for step in range(8):
        seen = seen_from(DOORS_90.grid, robot, 0.2 * step, noise_m=0.02, seed=seed + step)
        doors_90.observe(memory, seen)
    request = RouteRequest(robot, Pose2(4.5, 1.9, 0.0))
    assert doors_90.route(request, memory=memory).length_m < 3.0
