"""Walk the branches of what guards motion that no drive is sure to pass."""

from __future__ import annotations

from dataclasses import replace
from math import nan

import pytest

from bridge.core.geometry.fence import build_fence
from bridge.core.geometry.path_profile import prepare
from bridge.core.motion.motion_gates import _inside_fence, _shut
from bridge.core.motion.pursuit import _progress
from bridge.core.motion.wheel_control import _correct
from bridge.core.state_orders import Grants
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.reached import reached
from tests.bridge.core.test_quick_core import ROBOT, dropped, tick_of
from wire import STILL, Pose2, Twist2, Waypoint


@pytest.mark.parametrize(
    ("asked", "passed", "shut"),
    [
        (Twist2(0.3, 0.0), Twist2(0.0, 0.0), True),
        (Twist2(0.3, 0.5), Twist2(0.0, 0.5), True),
        (Twist2(0.3, 0.0), Twist2(0.02, 0.0), False),
        (Twist2(-0.02, 0.0), Twist2(-0.0199, 0.0), True),
        (Twist2(-0.02, 0.0), Twist2(-0.02, 0.0), False),
        (Twist2(0.0, 0.5), Twist2(0.0, 0.0), True),
        (Twist2(0.0, -0.05), Twist2(0.0, 0.049), True),
        (Twist2(0.0, -0.5), Twist2(0.0, -0.05), False),
        (Twist2(0.0199, 0.049), Twist2(0.0, 0.0), False),
    ],
)
def test_a_way_is_shut_where_nothing_of_it_passes(
    asked: Twist2, passed: Twist2, shut: bool
) -> None:
    assert _shut(asked, passed) is shut


@pytest.mark.parametrize(("start", "least_mps"), [("active", 0.0), ("teleop", 0.2)])
def test_the_fence_slows_whoever_drives_and_a_hand_no_further(start: str, least_mps: float) -> None:
    world = reached(start)
    tick = tick_of(world)
    tick.robot_in_map = world.here
    ahead_m = world.here.x_m + 0.2
    square = ((-5.0, -5.0), (ahead_m, -5.0), (ahead_m, 5.0), (-5.0, 5.0))
    tick.config = replace(tick.config, fence=build_fence(MAP_ID, (square,)))
    passed = _inside_fence(tick, Twist2(0.4, 0.1))
    assert tick.s.motion.bound_by == "fence"
    assert passed.w_radps == pytest.approx(passed.v_mps / 4.0)
    assert passed.v_mps == pytest.approx(0.2) if least_mps else 0.0 <= passed.v_mps < 0.2
    crawl = Twist2(0.1, 0.0)
    assert _inside_fence(tick, crawl).v_mps <= 0.1
    tick.robot_in_map = None
    assert _inside_fence(tick, Twist2(0.4, 0.1)) == (Twist2(0.4, 0.1) if least_mps else STILL)


@pytest.mark.parametrize(
    ("left", "name"),
    [
        ((None, 0.0, 0.0, 0.0, 0.0), None),
        (("m", 1.0, 1.0, 1.0, 1.0), None),
        (("m", 0.0, 1.0, 1.0, 1.0), "mission's metres"),
        (("m", 1.0, 0.0, 1.0, 1.0), "mission's seconds"),
        (("m", 1.0, 1.0, 0.0, 1.0), "operator's metres"),
        (("m", 1.0, 1.0, 1.0, 0.0), "operator's seconds"),
        (("m", nan, 1.0, 1.0, 1.0), "mission's metres"),
    ],
)
def test_what_is_used_up_is_named(
    left: tuple[str | None, float, float, float, float], name: str | None
) -> None:
    mission, metres, seconds, operator_metres, operator_seconds = left
    grants = Grants(mission, metres, seconds, (), operator_metres, operator_seconds)
    assert grants.spent_part() == name


def test_a_horizon_of_before_a_jump_is_named() -> None:
    world = reached("active")
    assert world.planner is not None
    world.state.pose = replace(world.state.pose, jumped_s=world.now_s)
    world.planner.next_horizon_s = 0.0
    assert dropped(world, "before_jump")
    assert world.state.leg.refusal == "before_jump"


@pytest.mark.parametrize(
    ("at", "along", "expected"),
    [
        ((0.02, 0.01), 0.0, 0.02),
        ((-0.5, 0.0), 0.0, 0.0),
        ((9.0, 1.0), 0.1, 0.3),
        ((0.1, 0.0), 0.05, 0.1),
    ],
)
def test_the_nearest_point_ahead_is_found(
    at: tuple[float, float], along: float, expected: float
) -> None:
    points = tuple(Waypoint(x_m=0.1 * i, y_m=0.0, speed_mps=0.4) for i in range(4))
    path = prepare(points, ROBOT.limits)
    assert path is not None
    assert _progress(path, along, Pose2(*at, 0.0)) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("integral", "off", "spare", "expected"),
    [
        (1.0, 0.5, 2.0, (1.0, 1.0)),
        (-1.0, -0.5, 2.0, (-1.0, -1.0)),
        (0.5, nan, 2.0, (0.5, -1.0)),
        (0.5, 99.0, 2.0, (0.5, 1.0)),
        (0.5, -99.0, 2.0, (0.5, -1.0)),
    ],
)
def test_a_correction_ends_at_its_bound_and_what_is_no_number_brakes(
    integral: float, off: float, spare: float, expected: tuple[float, float]
) -> None:
    assert _correct(integral, off, spare, 0.01, ROBOT.drive) == pytest.approx(expected)


def test_points_in_one_place_are_passed_over() -> None:
    points = tuple(Waypoint(x_m=x, y_m=0.0, speed_mps=0.4) for x in (0.0, 0.0, 0.1, 0.1, 0.2))
    path = prepare(points, ROBOT.limits)
    assert _progress(path, 0.0, Pose2(0.17, 0.01, 0.0)) == pytest.approx(0.17)
