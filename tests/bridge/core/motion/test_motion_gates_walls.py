"""Drive at walls and fences through the gates, on a robot with lag and a slow lidar."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from math import cos, pi, sin, tau

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bridge.core.geometry.fence import build_fence
from bridge.core.geometry.kinematics import along_arc, saturate, scale_twist
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.geometry.stopping import reaction_s
from bridge.core.motion.limiter import shape, stopping_m
from bridge.core.motion.motion_gates import FENCE_MARGIN_M, fence_scale
from bridge.core.motion.obstacle_gate import ObstaclePass, obstacle_gate
from bridge.core.sensing.sensor_update import REACH_M, look_m, sight_m
from bridge.core.state_motion import AS_CONFIGURED, Braking, LimiterState
from tests.laws import at_least
from wire import IDENTITY, STILL, Pose2, Scan, Twist2
from wire.robot import RobotDescription

ROBOT = RobotDescription()


QUICK = RobotDescription.model_validate(
    {
        "base": {"radius_m": 0.25, "wheel_separation_m": 0.4},
        "limits": {"max_speed_mps": 0.9, "max_decel_mps2": 0.6, "stop_jerk_mps3": 4.0},
        "lidar": {"x_m": 0.15},
    }
)


BASE, LIMITS, LAG = ROBOT.base, ROBOT.limits, ROBOT.drive.lag_s

RADIUS = BASE.radius_m

STEP_RAD = tau / 360


Wall = tuple[float, float]
"""Distance [m] and direction [rad] of an endless wall, from the origin."""


def gap(walls: list[Wall], pose: Pose2) -> float:
    return min(d - pose.x_m * cos(a) - pose.y_m * sin(a) for d, a in walls)


def scan_of(ranges: Sequence[float | None]) -> Scan:
    return Scan(
        boot_id="a",
        seq=1,
        stamp_s=0.0,
        angle_min_rad=0.0,
        angle_increment_rad=STEP_RAD,
        range_min_m=0.12,
        range_max_m=8.0,
        ranges_m=tuple(ranges),
    )


def look(walls: list[Wall], pose: Pose2) -> ScanPicture:
    ranges = [7.0] * 360
    for d, a in walls:
        away, turned = d - pose.x_m * cos(a) - pose.y_m * sin(a), pose.yaw_rad - a
        for index, best in enumerate(ranges):
            toward = cos(turned + STEP_RAD * index)
            if toward > 1e-6 and away < best * toward:
                ranges[index] = max(0.0, away / toward)
    return ScanPicture.from_scan(scan_of(ranges), pose, ROBOT.lidar)


def run(
    walls: list[Wall], asked: list[Twist2], seconds: float, delay: int = 5
) -> tuple[float, Pose2, ObstaclePass]:
    """Ask one motion after another; scans come at 10 Hz and arrive ``delay`` ticks old.

    Returns the smallest gap from centre to wall [m], the last pose, and the last verdict.
    """
    pose, memory = IDENTITY, LimiterState()
    pipe = deque([STILL] * round(LAG / 0.01))
    coming = picture = look(walls, pose)
    taken = 0
    nearest, verdict, moving = gap(walls, pose), None, STILL
    ticks = round(seconds / 0.01)
    for tick in range(ticks):
        if tick % 10 == 0:
            coming = look(walls, pose)
        if tick % 10 == delay:
            picture, taken = coming, tick - delay
        wanted = saturate(asked[tick * len(asked) // ticks], BASE, LIMITS)
        verdict = obstacle_gate(picture, pose, wanted, moving, (tick - taken) * 0.01, ROBOT)
        memory = shape(verdict.twist, memory, BASE, LIMITS, 0.01, room_m=verdict.room_m)
        pipe.append(memory.sent)
        moving = pipe.popleft()
        pose = along_arc(pose, moving.v_mps * 0.01, moving.w_radps * 0.01)
        nearest = min(nearest, gap(walls, pose))
    assert verdict is not None
    return nearest, pose, verdict


@pytest.mark.parametrize("direction", [i * tau / 8 + 0.1 for i in range(8)])
@pytest.mark.parametrize("asked", [Twist2(0.5, 0.0), Twist2(-0.5, 0.0), Twist2(0.4, 0.5)])
def test_a_wall_at_any_angle_is_never_touched(direction: float, asked: Twist2) -> None:
    nearest, _, _ = run([(1.0, direction)], [asked], 3.5)
    assert nearest >= RADIUS + 0.02


@settings(max_examples=15, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.45, 1.5), st.floats(-pi, pi)), min_size=1, max_size=2),
    st.lists(st.builds(Twist2, st.floats(-0.5, 0.5), st.floats(-1, 1)), min_size=1, max_size=5),
)
def test_no_orders_bring_it_to_a_wall(walls: list[Wall], asked: list[Twist2]) -> None:
    nearest, _, _ = run(walls, asked, 4.0, delay=7)
    assert nearest >= RADIUS


def test_it_stands_at_the_margin_and_says_so() -> None:
    nearest, pose, verdict = run([(1.0, 0.0)], [Twist2(0.5, 0.0)], 6.0)
    assert RADIUS + 0.045 <= nearest <= RADIUS + 0.08
    assert verdict.shut
    assert verdict.scale == 0.0
    assert pose.y_m == 0.0


@pytest.mark.parametrize("lidar_x_m", [-0.2, 0.0, 0.2, 0.3])
def test_what_is_too_near_to_measure_stops_the_robot(lidar_x_m: float) -> None:
    blind_m = RADIUS + 0.05 - abs(lidar_x_m)  # the most that robot.toml takes
    most = {"lidar": {"x_m": lidar_x_m, "range_min_m": blind_m - 1e-12}}
    robot = RobotDescription.model_validate(most)
    near_m = RADIUS + 0.01 - lidar_x_m
    picture = ScanPicture.from_scan(scan_of([near_m] + [7.0] * 359), IDENTITY, robot.lidar)
    assert obstacle_gate(picture, IDENTITY, Twist2(0.5, 0.0), STILL, 0.1, robot).scale < 1e-6


def test_from_a_wall_one_may_back_away_and_turn_away() -> None:
    wall = [(1.0, 0.0)]
    at_wall = Twist2(0.5, 0.0)
    _, pose, _ = run(wall, [at_wall, at_wall, Twist2(-0.3, 0.0)], 9.0)
    assert gap(wall, pose) > 0.7
    _, pose, _ = run(wall, [at_wall, at_wall, Twist2(0.0, 1.0)], 9.0)
    assert abs(pose.yaw_rad) > 0.5
    # an arc away from the wall that loses clearance first: the turn in it passes, then the arc
    _, pose, _ = run(wall, [at_wall, Twist2(0.3, 0.6), Twist2(0.3, 0.6)], 15.0)
    assert gap(wall, pose) > 0.6


def test_beside_a_wall_it_drives_along() -> None:
    nearest, pose, _ = run([(0.45, pi / 2)], [Twist2(0.5, 0.0)], 4.0)
    assert pose.x_m > 1.0
    assert nearest == pytest.approx(0.45)


def test_a_shut_gate_still_lets_turn_slowly_either_way() -> None:
    picture = look([(0.353, 0.0)], IDENTITY)
    for asked, passed in ((0.5, 0.3), (-0.5, -0.3), (0.2, 0.2)):
        verdict = obstacle_gate(picture, IDENTITY, Twist2(0.4, asked), STILL, 0.05, ROBOT)
        assert verdict.twist == Twist2(0.0, passed)
        assert not verdict.shut


def test_rolling_away_from_what_is_near_does_not_hold_back() -> None:
    picture = look([(0.33, pi)], IDENTITY)
    verdict = obstacle_gate(picture, IDENTITY, Twist2(0.1, 0.2), Twist2(0.1, 0.0), 0.05, ROBOT)
    assert verdict.scale == 1.0


twists = st.builds(Twist2, st.floats(-0.6, 0.6), st.floats(-1.2, 1.2))


@at_least(300)
@given(
    st.lists(st.tuples(st.floats(0.2, 2.5), st.floats(-pi, pi)), max_size=3),
    st.lists(st.tuples(st.integers(0, 359), st.none() | st.floats(0.05, 2.0)), max_size=12),
    st.builds(Pose2, st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.floats(-pi, pi)),
    twists,
    twists,
    st.floats(0.0, 0.6),
    st.sampled_from([ROBOT, QUICK]),
)
def test_looking_no_further_than_it_takes_changes_nothing_that_passes(
    walls: list[Wall],
    posts: list[tuple[int, float | None]],
    here: Pose2,
    asked: Twist2,
    measured: Twist2,
    age_s: float,
    robot: RobotDescription,
) -> None:
    ranges: list[float | None] = list(look(walls, IDENTITY).ranges_m)
    for index, range_m in posts:
        ranges[index] = range_m
    wide = ScanPicture.from_scan(scan_of(ranges), IDENTITY, robot.lidar)
    near = ScanPicture.from_scan(scan_of(ranges), IDENTITY, robot.lidar, sight_m(robot))
    asked = saturate(asked, robot.base, robot.limits)
    passed = obstacle_gate(near, here, asked, measured, age_s, robot)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("bridge.core.motion.obstacle_gate.look_m", lambda *_: REACH_M)
        expected = obstacle_gate(wide, here, asked, measured, age_s, robot)
    assert (passed.twist, passed.scale, passed.known) == (
        expected.twist, expected.scale, expected.known
    )  # fmt: skip
    assert passed.free_m == min(expected.free_m, passed.free_m)
    limits = robot.limits
    hardest = Twist2(limits.max_speed_mps, limits.max_turn_radps)
    longest = stopping_m(hardest, 0.0, robot.base, limits, 0.02)
    assert passed.room_m == expected.room_m or passed.room_m >= longest


FENCE = build_fence("0" * 16, (((-2, -2), (2, -2), (2, 2), (-2, 2)),))

REACTION = reaction_s(0.0, 0.0, LAG, LIMITS) + 0.1


def fenced(start: Pose2, asked: Twist2, seconds: float) -> tuple[float, Pose2]:
    pose, memory = start, LimiterState()
    pipe = deque([STILL] * round(LAG / 0.01))
    least = FENCE.margin_m(pose.x_m, pose.y_m)
    for _ in range(round(seconds / 0.01)):
        scale = fence_scale(FENCE, pose, asked, BASE, LIMITS, REACTION)
        memory = shape(scale_twist(asked, scale), memory, BASE, LIMITS, 0.01)
        pipe.append(memory.sent)
        moving = pipe.popleft()
        pose = along_arc(pose, moving.v_mps * 0.01, moving.w_radps * 0.01)
        least = min(least, FENCE.margin_m(pose.x_m, pose.y_m))
    return least, pose


@pytest.mark.parametrize("yaw", [i * tau / 8 + 0.1 for i in range(8)])
@pytest.mark.parametrize("asked", [Twist2(0.5, 0.0), Twist2(-0.5, 0.0), Twist2(0.4, 0.2)])
def test_the_fence_is_never_crossed(yaw: float, asked: Twist2) -> None:
    least, _ = fenced(Pose2(0.5, 0.2, yaw), asked, 5.0)
    assert least >= FENCE_MARGIN_M - 0.01


@given(
    st.builds(Pose2, st.floats(), st.floats(), st.floats(-7, 7)),
    st.builds(Twist2, st.floats(), st.floats()),
    st.floats(),
)
def test_no_number_raises_at_the_fence(pose: Pose2, asked: Twist2, reaction: float) -> None:
    assert 0.0 <= fence_scale(FENCE, pose, asked, BASE, LIMITS, reaction) <= 1.0


WORSE = [Braking(0.25, 1.0), Braking(0.0, 0.45), Braking(0.1, 0.6)]

SQUARE = build_fence("0" * 16, (((-2, -2), (2, -2), (2, 2), (-2, 2)),))


class Metal:
    """Follow what is sent, late, and brake no harder than it can."""

    def __init__(self, braking: Braking) -> None:
        self._pipe = deque([STILL] * round((LAG + braking.lag_more_s) / 0.01))
        self._most = LIMITS.max_decel_mps2 * braking.decel_share * 0.01
        self.moving = STILL

    def turn(self, sent: Twist2) -> Twist2:
        self._pipe.append(sent)
        due, v = self._pipe.popleft(), self.moving.v_mps
        held = due.v_mps
        if v > 0.0:
            held = max(held, v - self._most)
        elif v < 0.0:
            held = min(held, v + self._most)
        kept = held / due.v_mps if due.v_mps else 1.0
        self.moving = Twist2(held, due.w_radps * kept)
        return self.moving


def test_the_metal_moves_and_brakes_as_weakly_as_it_is_told() -> None:
    metal = Metal(Braking(0.1, 0.5))
    for _ in range(50):
        metal.turn(Twist2(0.4, 0.2))
    assert metal.moving == Twist2(0.4, 0.2)
    for _ in range(16 + 20):
        metal.turn(STILL)
    assert metal.moving.v_mps == pytest.approx(0.4 - 0.2 * 0.5, abs=0.006)


def nearest_m(direction: float, asked: Twist2, metal: Braking, known: Braking) -> float:
    """Drive at a wall 1.2 m off; return the smallest gap from its centre [m]."""
    walls = [(1.2, direction)]
    pose, memory, real = IDENTITY, LimiterState(), Metal(metal)
    picture, nearest = look(walls, pose), 9.0
    for tick in range(450):
        if tick % 10 == 5:
            picture = look(walls, pose)
        age_s = 0.05 + (tick - 5) % 10 * 0.01
        verdict = obstacle_gate(picture, pose, asked, real.moving, age_s, ROBOT, known)
        memory = shape(verdict.twist, memory, BASE, LIMITS, 0.01, room_m=verdict.room_m)
        moving = real.turn(memory.sent)
        pose = along_arc(pose, moving.v_mps * 0.01, moving.w_radps * 0.01)
        nearest = min(nearest, gap(walls, pose))
    return nearest


@pytest.mark.parametrize("metal", WORSE, ids=str)
@pytest.mark.parametrize("asked", [Twist2(0.5, 0.0), Twist2(-0.5, 0.0)])
def test_what_was_learnt_keeps_the_margin(metal: Braking, asked: Twist2) -> None:
    direction = 0.1 if asked.v_mps > 0.0 else pi + 0.1
    knowing = nearest_m(direction, asked, metal, metal)
    assert RADIUS + 0.03 <= knowing <= RADIUS + 0.2, "and it gets there"
    assert knowing >= nearest_m(direction, asked, metal, AS_CONFIGURED)


@pytest.mark.parametrize("metal", WORSE, ids=str)
@pytest.mark.parametrize("yaw", [i * tau / 8 + 0.1 for i in range(4)])
def test_what_was_learnt_keeps_it_inside_the_fence(metal: Braking, yaw: float) -> None:
    pose, memory, real = Pose2(0.5, 0.2, yaw), LimiterState(), Metal(metal)
    reaction = reaction_s(0.1, 0.0, LAG + metal.lag_more_s, LIMITS)
    asked = Twist2(0.5, 0.0)
    for _ in range(800):
        scale = fence_scale(SQUARE, pose, asked, BASE, LIMITS, reaction, metal.decel_share)
        memory = shape(scale_twist(asked, scale), memory, BASE, LIMITS, 0.01)
        moving = real.turn(memory.sent)
        pose = along_arc(pose, moving.v_mps * 0.01, moving.w_radps * 0.01)
        # The gate judges what is asked; 0.31 s late the robot is still faster than that: 2 cm.
        assert SQUARE.margin_m(pose.x_m, pose.y_m) >= FENCE_MARGIN_M - 0.03
    assert SQUARE.margin_m(pose.x_m, pose.y_m) <= FENCE_MARGIN_M + 0.3, "and it gets there"


@pytest.mark.parametrize("odd", [float("nan"), float("inf")])
def test_a_motion_that_is_no_number_does_not_pass_the_fence(odd: float) -> None:
    for asked in (Twist2(odd, 0.0), Twist2(0.5, odd)):
        assert fence_scale(SQUARE, IDENTITY, asked, BASE, LIMITS, 0.3, 0.5) == 0.0


@pytest.mark.parametrize("metal", WORSE, ids=str)
def test_who_brakes_worse_looks_further(metal: Braking) -> None:
    assert look_m(ROBOT, metal) > look_m(ROBOT)
    assert sight_m(ROBOT, metal) > sight_m(ROBOT)
