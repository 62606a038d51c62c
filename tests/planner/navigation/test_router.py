"""Hold whole routes to their laws on the real sites and on small floors drawn for one question."""

from __future__ import annotations

from itertools import groupby, pairwise, permutations
from math import hypot, inf, nan, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.navigation import RouteFailure, RouteLimits, RouteRequest, RouteResult
from planner.navigation.costmap import Costmap, static_costmap
from planner.navigation.router import Router
from planner.site import OCCUPIED, Site
from tests.planner.navigation.floors import Outline, drawn
from wire import Pose2

LIMITS = RouteLimits()
OPEN = drawn(*["." * 24] * 24)
"""A floor of 6 m by 6 m."""
FURNITURE = ["." * 24] * 8 + ["." * 8 + "########" + "." * 8] * 8 + ["." * 24] * 8
IMPOSSIBLE = {"no_route", "start_blocked", "goal_blocked", "goal_occupied"}
TOUCHING_M = LIMITS.radius_m  # the disc's edge is at the wall


def at(x_m: float, y_m: float) -> Pose2:
    return Pose2(x_m, y_m, 0.0)


def ask(site: Site, request: RouteRequest) -> RouteResult:
    return Router(site, LIMITS).route(request)


def failure(site: Site, request: RouteRequest) -> RouteFailure:
    with pytest.raises(RouteFailure) as caught:
        ask(site, request)
    return caught.value


def samples(result: RouteResult) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return points every centimetre along a route."""
    line = np.asarray([(p.x_m, p.y_m) for p in result.points])
    pieces = [
        a + np.linspace(0, 1, max(2, int(hypot(*(b - a)) / 0.01) + 1))[:, None] * (b - a)
        for a, b in pairwise(line)
    ]
    return np.concatenate([line[:1], *pieces])


def check_laws(site: Site, costmap: Costmap, result: RouteResult) -> None:
    """Check what every route that began on free floor promises."""
    gaps = [hypot(b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(result.points)]
    assert all(0.05 <= gap <= 0.25 for gap in gaps[1:-1])
    assert all(0.01 <= gap <= 0.25 for gap in gaps)
    assert result.length_m == pytest.approx(sum(gaps))
    assert all(0.05 <= p.speed_mps <= LIMITS.max_speed_mps for p in result.points)
    for p in result.points:
        assert p.speed_mps <= max(0.05, site.fence.max_speed_mps(p.x_m, p.y_m))
    line = samples(result)
    assert float(costmap.clearance_at(line).min()) >= TOUCHING_M
    for x_m, y_m in line[:: max(1, len(line) // 200)].tolist():
        assert site.fence.allows(x_m, y_m)


def test_every_place_of_the_home_is_reached_from_every_other(
    home: Site, home_router: Router, home_costmap: Costmap
) -> None:
    for a, b in list(permutations(home.places, 2))[::13]:
        result = home_router.route(RouteRequest(a.pose, b.pose))
        check_laws(home, home_costmap, result)
        assert (result.points[0].x_m, result.points[0].y_m) == (a.pose.x_m, a.pose.y_m)
        assert (result.points[-1].x_m, result.points[-1].y_m) == (b.pose.x_m, b.pose.y_m)
        assert result.moved_goal_m == 0.0
        assert not result.start_escaped


def test_every_place_of_the_two_rooms_is_reached(
    two_room: Site, two_room_router: Router, two_room_costmap: Costmap
) -> None:
    for a, b in permutations(two_room.places, 2):
        result = two_room_router.route(RouteRequest(a.pose, b.pose))
        check_laws(two_room, two_room_costmap, result)


@given(st.floats(0, 12), st.floats(0, 10), st.floats(0, 12), st.floats(0, 10))
def test_any_two_points_of_the_home_give_a_lawful_route_or_a_typed_failure(
    home: Site, home_router: Router, home_costmap: Costmap,
    ax_m: float, ay_m: float, bx_m: float, by_m: float,
) -> None:  # fmt: skip
    try:
        result = home_router.route(RouteRequest(at(ax_m, ay_m), at(bx_m, by_m)))
    except RouteFailure as failed:
        if failed.code not in IMPOSSIBLE:
            raise
        return
    if not result.start_escaped:
        check_laws(home, home_costmap, result)
    assert result.moved_goal_m <= 0.5
    end = result.points[-1]
    assert hypot(end.x_m - bx_m, end.y_m - by_m) == pytest.approx(result.moved_goal_m)


points = st.tuples(st.floats(0.0, 3.0), st.floats(0.0, 6.0))


@given(st.lists(points, max_size=40))
def test_what_the_lidar_adds_is_kept_clear_of(
    two_room: Site, two_room_router: Router, two_room_costmap: Costmap,
    obstacles: list[tuple[float, float]],
) -> None:  # fmt: skip
    start, goal = two_room.places[0].pose, two_room.places[1].pose
    request = RouteRequest(start, goal, tuple(obstacles))
    seen = two_room_costmap.with_obstacles(obstacles, (start.x_m, start.y_m))
    try:
        result = two_room_router.route(request)
    except RouteFailure as failed:
        if failed.code not in IMPOSSIBLE:
            raise
        return
    if not result.start_escaped:
        check_laws(two_room, seen, result)


def test_routes_with_costs_worked_out_beforehand_are_as_long(two_room: Site) -> None:
    cold, warm = Router(two_room, LIMITS), Router(two_room, LIMITS)
    for _ in warm.warm():
        pass
    assert cold.goals_known == 0
    assert warm.goals_known >= len(two_room.places)
    for a, b in permutations(two_room.places, 2):
        one, two = (router.route(RouteRequest(a.pose, b.pose)) for router in (cold, warm))
        assert two.length_m == pytest.approx(one.length_m, rel=0.03)


def test_open_floor_is_crossed_straight() -> None:
    result = ask(OPEN, RouteRequest(at(1.0, 1.0), at(5.0, 3.0)))
    assert result.length_m == pytest.approx(hypot(4.0, 2.0), rel=0.002)
    assert max(p.speed_mps for p in result.points) == LIMITS.max_speed_mps


def test_a_door_is_passed_in_its_middle_and_slowly() -> None:
    # A wall at y = 2.0 to 2.5 m with a door 0.9 m wide, x from 2.0 to 2.9 m, drawn at 0.1 m.
    rows = ["." * 50] * 20 + ["#" * 20 + "." * 9 + "#" * 21] * 5 + ["." * 50] * 20
    site = drawn(*rows, square_m=0.1)
    result = ask(site, RouteRequest(at(0.6, 0.6), at(4.3, 3.9)))
    inside = [p for p in result.points if 2.0 <= p.y_m <= 2.5]
    assert len(inside) >= 4
    assert all(abs(p.x_m - 2.45) <= 0.06 for p in inside)
    assert all(p.speed_mps <= 0.35 for p in inside)
    assert max(p.speed_mps for p in result.points) > 0.45


def test_an_obstacle_in_one_door_sends_the_route_through_the_other(
    home: Site, home_router: Router
) -> None:
    start, goal = home.place("living_room"), home.place("study")
    assert start is not None
    assert goal is not None
    direct = home_router.route(RouteRequest(start.pose, goal.pose))
    middle = min(direct.points, key=lambda p: abs(p.x_m - 5.0))  # the wall between the two rooms
    person = tuple((middle.x_m + 0.1 * np.cos(a), middle.y_m + 0.1 * np.sin(a)) for a in range(6))
    around = home_router.route(RouteRequest(start.pose, goal.pose, person))
    assert around.length_m > direct.length_m + 1.0
    for p in around.points:
        assert hypot(p.x_m - middle.x_m, p.y_m - middle.y_m) > 0.4


def test_a_goal_in_furniture_moves_to_the_nearest_free_floor_and_says_so() -> None:
    rows = ["." * 24] * 10 + ["." * 10 + "####" + "." * 10] * 2 + ["." * 24] * 12
    site = drawn(*rows)  # a box, x 2.5 to 3.5 m, y 3.0 to 3.5 m
    result = ask(site, RouteRequest(at(1.0, 1.0), at(3.0, 3.1)))
    end = result.points[-1]
    assert 0.35 <= result.moved_goal_m <= 0.5
    assert hypot(end.x_m - 3.0, end.y_m - 3.1) == pytest.approx(result.moved_goal_m)
    assert end.y_m < 3.0


def test_a_goal_too_near_to_a_wall_to_be_stood_at_moves_a_little_away() -> None:
    site = drawn(*["#" * 24], *["." * 24] * 23)  # all above y 5.75 m
    tight = ask(site, RouteRequest(at(1.0, 1.0), at(3.0, 5.42)))
    end = tight.points[-1]
    assert 5.75 - end.y_m >= LIMITS.radius_m + 0.10 - 1e-6
    assert 0.0 < tight.moved_goal_m <= 0.15
    assert abs(end.x_m - 3.0) <= 0.05
    roomy = ask(site, RouteRequest(at(1.0, 1.0), at(3.0, 5.32)))
    assert roomy.moved_goal_m == 0.0


def test_a_goal_in_a_niche_without_more_room_stays_where_it_is() -> None:
    rows = ["#" * 20 + "." * 8 + "#" * 20] * 10 + ["." * 48] * 20
    result = ask(drawn(*rows, square_m=0.1), RouteRequest(at(1.0, 1.0), at(2.38, 2.5)))
    assert result.moved_goal_m == 0.0


def test_a_goal_in_furniture_moves_to_where_there_is_room_to_stand() -> None:
    rows = ["." * 24] * 10 + ["." * 10 + "####" + "." * 10] * 2 + ["." * 24] * 12
    result = ask(drawn(*rows), RouteRequest(at(1.0, 1.0), at(3.0, 3.02)))
    assert 3.0 - result.points[-1].y_m >= LIMITS.radius_m + 0.10 - 1e-6


def test_a_goal_deep_in_furniture_is_blocked() -> None:
    error = failure(drawn(*FURNITURE), RouteRequest(at(1.0, 1.0), at(3.0, 3.0)))
    assert error.code == "goal_blocked"
    assert "3.00" in error.message["en"]
    assert "3.00" in error.message["zh"]


def test_a_goal_never_moves_through_a_wall_into_the_next_room() -> None:
    # The wall is thin; below it lies furniture, so the nearest free floor is in the room above.
    rows = ["." * 40] * 18 + ["#" * 40] + ["." * 30 + "#" * 10] * 3 + ["." * 40] * 18
    rooms: dict[str, Outline] = {
        "above": ((0.0, 2.1), (4.0, 2.1), (4.0, 4.0), (0.0, 4.0)),
        "below": ((0.0, 0.0), (4.0, 0.0), (4.0, 2.1), (0.0, 2.1)),
    }
    goal = at(3.5, 2.09)
    closed = drawn(*rows, square_m=0.1, rooms=rooms)
    assert failure(closed, RouteRequest(at(1.0, 3.0), goal)).code == "goal_blocked"
    without = ask(drawn(*rows, square_m=0.1), RouteRequest(at(1.0, 3.0), goal))
    assert without.points[-1].y_m > 2.0


BED = ["." * 60] * 10 + ["." * 22 + "#" * 16 + "." * 22] * 20 + ["." * 60] * 30
"""A bed of 1.6 by 2 m in the middle of a floor of 6 m, drawn in squares of 0.1 m."""
MIDDLE = Pose2(3.0, 4.0, 0.0)


def sees(site: Site, end: tuple[float, float], thing: tuple[float, float]) -> bool:
    """Tell whether the line from an end to a thing crosses free floor, then at most the thing.

    A corner that it cuts by less than 3 cm hides nothing.
    """
    count = int(hypot(thing[0] - end[0], thing[1] - end[1]) / 0.005) + 2
    line = [(end[0] + s * (thing[0] - end[0]), end[1] + s * (thing[1] - end[1]))
            for s in np.linspace(0.0, 1.0, count)]  # fmt: skip
    runs = [(k, len(list(g))) for k, g in groupby(site.grid.at(*xy) == OCCUPIED for xy in line)]
    *before, _ = runs
    return all(not solid or long <= 6 for solid, long in before)


def test_large_furniture_is_gone_to_where_it_is_seen_from_and_faced() -> None:
    site = drawn(*BED, square_m=0.1)
    result = ask(site, RouteRequest(at(1.0, 1.0), MIDDLE, sees=(3.0, 4.0), sees_from_m=0.45))
    end = result.points[-1].x_m, result.points[-1].y_m
    assert 0.8 + LIMITS.radius_m <= result.moved_goal_m <= 1.4, "beside its nearest edge"
    assert result.faces == (3.0, 4.0)
    assert sees(site, end, (3.0, 4.0))
    clear_m = static_costmap(site, LIMITS.radius_m).clearance_at(np.asarray([end]))
    assert clear_m[0] >= LIMITS.radius_m + 0.10 - 1e-6, "no end inside what it keeps clear of"
    assert failure(site, RouteRequest(at(1.0, 1.0), MIDDLE)).code == "goal_blocked"


def test_furniture_at_a_wall_is_never_seen_from_the_next_room() -> None:
    """In front of the sofa more furniture stands: the nearest free floor is behind the wall."""
    rows = [*["." * 60] * 28, "#" * 50 + "." * 10, *["." * 20 + "#" * 20 + "." * 20] * 8,
            *["." * 12 + "#" * 36 + "." * 12] * 4, *["." * 60] * 20]  # fmt: skip
    sofa = Pose2(3.0, 2.9, 0.0)
    rooms: dict[str, Outline] = {
        "above": ((0.0, 3.25), (6.0, 3.25), (6.0, 6.1), (0.0, 6.1)),
        "below": ((0.0, 0.0), (6.0, 0.0), (6.0, 3.25), (0.0, 3.25)),
    }
    site = drawn(*rows, square_m=0.1, rooms=rooms)
    result = ask(site, RouteRequest(at(1.0, 5.0), sofa, sees=(3.0, 2.9)))
    end = result.points[-1].x_m, result.points[-1].y_m
    assert end[1] < 3.2, "in its own room, by the door at the side"
    assert sees(site, end, (3.0, 2.9))


def test_a_standing_point_behind_a_wall_moves_to_where_the_thing_is_seen_or_is_refused() -> None:
    rows = ["." * 60] * 28 + ["#" * 50 + "." * 10] + ["." * 60] * 31
    site, thing = drawn(*rows, square_m=0.1), (3.0, 2.9)
    behind = Pose2(3.0, 3.7, -pi / 2)
    refused = failure(site, RouteRequest(at(1.0, 5.0), behind, sees=thing))
    assert refused.code == "goal_blocked"
    assert "that sees (3.00, 2.90)" in refused.message["en"]
    before = ask(site, RouteRequest(at(1.0, 5.0), Pose2(3.0, 2.1, pi / 2), sees=thing))
    assert before.moved_goal_m == 0.0
    assert before.faces == thing
    near = ask(site, RouteRequest(at(1.0, 1.0), Pose2(*thing, 0.0), sees=thing, sees_from_m=0.45))
    end = near.points[-1]
    assert hypot(end.x_m - 3.0, end.y_m - 2.9) >= 0.45 - 1e-6
    assert failure(site, RouteRequest(at(1.0, 1.0), at(2.0, 2.0), sees=(nan, 1.0))).code == (
        "route_request_malformed"
    )
    off = failure(site, RouteRequest(at(1.0, 1.0), at(2.0, 2.0), sees=(99.0, 1.0)))
    assert off.code == "goal_outside_map"


@given(st.floats(0.2, 11.8), st.floats(0.2, 9.8), st.floats(0, 2 * pi))
def test_wherever_a_thing_is_the_way_ends_where_it_is_seen_from(
    home: Site, home_router: Router, home_costmap: Costmap, x_m: float, y_m: float, side: float
) -> None:
    thing = (x_m, y_m)
    goal = at(x_m + 0.8 * np.cos(side), y_m + 0.8 * np.sin(side))
    start = home.home.pose
    try:
        result = home_router.route(RouteRequest(start, goal, sees=thing, sees_from_m=0.45))
    except RouteFailure as failed:
        if failed.code not in IMPOSSIBLE | {"goal_outside_map"}:
            raise
        return
    end = result.points[-1].x_m, result.points[-1].y_m
    assert hypot(end[0] - x_m, end[1] - y_m) >= 0.45 - 0.05
    assert sees(home, end, thing)
    assert result.moved_goal_m <= 0.5
    check_laws(home, home_costmap, result)


def test_a_tight_start_is_left_by_the_shortest_way_out() -> None:
    result = ask(OPEN, RouteRequest(at(0.15, 3.0), at(4.0, 3.0)))
    assert result.start_escaped
    out = [p for p in result.points if p.x_m < 0.32]
    assert all(abs(p.y_m - 3.0) < 0.06 for p in out)
    assert all(p.speed_mps <= 0.25 for p in out)


@pytest.mark.parametrize(
    ("rows", "square_m", "start", "goal", "code"),
    [
        (FURNITURE, 0.25, at(3.0, 3.0), at(1.0, 1.0), "start_blocked"),
        # Between two walls 0.5 m apart; outside them there is room.
        (["." * 60] * 25 + ["#" * 60, *["." * 60] * 5, "#" * 60] + ["." * 60] * 25, 0.1,
         at(3.0, 2.85), at(3.0, 5.0), "start_blocked"),
        (["." * 50] * 20 + ["#" * 20 + "." * 5 + "#" * 25] * 5 + ["." * 50] * 20, 0.1,
         at(0.6, 0.6), at(4.3, 3.9), "no_route"),
    ],
    ids=["a start in a wall", "a tight start behind walls", "a door that no disc passes"],
)  # fmt: skip
def test_through_a_wall_there_is_no_way(
    rows: list[str], square_m: float, start: Pose2, goal: Pose2, code: str
) -> None:
    assert failure(drawn(*rows, square_m=square_m), RouteRequest(start, goal)).code == code


FENCE = ((1.0, 1.0), (5.0, 1.0), (5.0, 5.0), (1.0, 5.0))


def test_a_start_just_outside_the_fence_comes_back_in_without_a_point_outside() -> None:
    site = drawn(*["." * 24] * 24, allowed=(FENCE,))
    result = ask(site, RouteRequest(at(0.9, 3.0), at(4.0, 3.0)))
    assert result.start_escaped
    assert all(site.fence.allows(p.x_m, p.y_m) for p in result.points)
    assert hypot(result.points[0].x_m - 0.9, result.points[0].y_m - 3.0) <= 0.3


def test_a_start_far_outside_the_fence_is_refused() -> None:
    site = drawn(*["." * 24] * 24, allowed=(FENCE,))
    assert failure(site, RouteRequest(at(0.6, 3.0), at(4.0, 3.0))).code == "start_blocked"


def test_zones_slow_the_route_and_keep_outs_turn_it() -> None:
    zone = ((2.0, 0.0), (3.0, 0.0), (3.0, 6.0), (2.0, 6.0))
    hole = ((3.5, 2.0), (4.0, 2.0), (4.0, 4.0), (3.5, 4.0))
    site = drawn(*["." * 24] * 24, zones=((zone, 0.15),), keep_outs=(hole,))
    result = ask(site, RouteRequest(at(1.0, 3.0), at(5.0, 3.0)))
    check_laws(site, static_costmap(site, LIMITS.radius_m), result)
    assert result.length_m > 4.2
    assert all(p.speed_mps <= 0.15 for p in result.points if 2.0 < p.x_m < 3.0)


def test_a_route_to_where_one_stands_is_one_point() -> None:
    result = ask(OPEN, RouteRequest(at(2.0, 2.0), at(2.0, 2.004)))
    assert [(p.x_m, p.y_m) for p in result.points] == [(2.0, 2.004)]
    short = ask(OPEN, RouteRequest(at(2.0, 2.0), at(2.0, 2.03)))
    assert len(short.points) == 2


@pytest.mark.parametrize(
    ("start", "goal", "code"),
    [
        (at(-1.0, 2.0), at(2.0, 2.0), "start_outside_map"),
        (at(2.0, 2.0), at(2.0, 99.0), "goal_outside_map"),
        (at(nan, 2.0), at(2.0, 2.0), "route_request_malformed"),
        (at(2.0, 2.0), at(2.0, inf), "route_request_malformed"),
    ],
)
def test_ends_that_are_nowhere_are_refused(start: Pose2, goal: Pose2, code: str) -> None:
    error = failure(OPEN, RouteRequest(start, goal))
    assert error.code == code
    assert error.message["en"] != error.message["zh"]


def test_bends_are_slower_than_straights() -> None:
    # A corridor 0.9 m wide with one right-angled bend.
    rows = ["#" * 24] * 3 + ["#" * 3 + "." * 18 + "###"] * 4 + ["#" * 17 + "." * 4 + "###"] * 17
    site = drawn(*rows)
    result = ask(site, RouteRequest(at(1.5, 4.75), at(4.75, 0.75)))
    headings = [np.arctan2(b.y_m - a.y_m, b.x_m - a.x_m) for a, b in pairwise(result.points)]
    turns = [abs((q - p + pi) % (2 * pi) - pi) for p, q in pairwise(headings)]
    sharpest = int(np.argmax(turns)) + 1
    straight = max(p.speed_mps for p in result.points[2:-2])
    assert result.points[sharpest].speed_mps <= straight
    for p, turn in zip(result.points[1:-1], turns, strict=True):
        assert p.speed_mps * turn / 0.1 <= LIMITS.max_turn_radps * 1.2 or p.speed_mps <= 0.05


def test_the_home_map_is_not_all_obstacle(home: Site) -> None:
    assert 0 < home.grid.cells.count(OCCUPIED) < len(home.grid.cells) / 2


def test_a_goal_on_which_something_stands_is_moved_to_the_robots_side_or_not_at_all() -> None:
    """What lies behind a thing is not seen: floor there is no floor to end a drive on."""
    goal = at(3.0, 3.0)
    edge = tuple((3.0 + 0.05 * i, 3.1) for i in range(-3, 4))  # seen from below
    moved = ask(OPEN, RouteRequest(at(3.0, 1.0), goal, edge))
    assert moved.points[-1].y_m <= 3.0
    assert 0.2 <= moved.moved_goal_m <= 0.5
    person = tuple(
        (3.0 + 0.25 * np.cos(a), 3.0 + 0.25 * np.sin(a)) for a in np.arange(-2.6, 0, 0.1)
    )
    assert failure(OPEN, RouteRequest(at(3.0, 1.0), goal, person)).code == "goal_occupied"


def test_a_goal_that_the_map_itself_blocks_may_be_moved_to_any_side() -> None:
    rows = ["." * 24 for _ in range(24)]
    rows[12] = "." * 12 + "#" + "." * 11
    goal = at(3.1, 2.9)
    seen = ((5.0, 5.0),)
    plain = ask(drawn(*rows), RouteRequest(at(3.1, 5.0), goal))
    beside = ask(drawn(*rows), RouteRequest(at(3.1, 5.0), goal, seen))
    assert beside.points[-1].y_m == plain.points[-1].y_m
