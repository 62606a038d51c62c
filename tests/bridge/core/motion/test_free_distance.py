"""Hold free length against brute force, and speeds against the stops they need."""

from __future__ import annotations

from math import cos, hypot, pi, sin, tau

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from bridge.core.geometry.kinematics import along_arc
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.geometry.stopping import speed_within
from bridge.core.motion.braking import speed_scale
from bridge.core.motion.free_distance import FreeLength, free_length
from bridge.core.sensing.sensor_update import MARGIN_M, REACH_M
from tests.laws import at_least
from wire.geometry import IDENTITY, Pose2, Twist2
from wire.lidar_config import LidarConfig
from wire.robot import Base, Limits
from wire.sensors import Scan

BASE, LIMITS, LIDAR = Base(), Limits(), LidarConfig()
RADIUS = BASE.radius_m
DISC = RADIUS + MARGIN_M


def picture(
    ranges: list[float | None], at: Pose2 = IDENTITY, lidar: LidarConfig = LIDAR
) -> ScanPicture:
    scan = Scan(
        boot_id="a",
        seq=1,
        stamp_s=0.0,
        angle_min_rad=0.0,
        angle_increment_rad=tau / 360,
        range_min_m=0.12,
        range_max_m=8.0,
        ranges_m=tuple(ranges),
    )
    return ScanPicture.from_scan(scan, at, lidar)


def wall(robot: Pose2, distance: float, direction: float) -> list[float | None]:
    """Return what a lidar on the robot sees of one endless wall, given in the world, else 7 m."""
    ranges: list[float | None] = []
    left = distance - robot.x_m * cos(direction) - robot.y_m * sin(direction)
    for index in range(360):
        toward = cos(robot.yaw_rad + index * tau / 360 - direction)
        ranges.append(min(7.0, max(0.0, left) / toward) if toward > 1e-6 else 7.0)
    return ranges


OPEN: list[float | None] = [7.0] * 360


def brute(made: ScanPicture, start: Pose2, twist: Twist2) -> float:
    """Walk the arc, two millimetres a step, until the disc touches a point."""
    points = [
        (x, y) for x, y in zip(made.xs_m, made.ys_m, strict=True) if hypot(x, y) < REACH_M + 1.5
    ]
    sign = 1.0 if twist.v_mps > 0 else -1.0
    flow = twist.w_radps / abs(twist.v_mps)
    for step in range(0, 2000, 2):
        s = step / 1000
        place = along_arc(start, sign * s, flow * s)
        if any(hypot(x - place.x_m, y - place.y_m) < DISC for x, y in points):
            return s
    return REACH_M


def test_an_open_room_is_free_as_far_as_one_looks() -> None:
    free = free_length(picture(OPEN), IDENTITY, Twist2(0.5, 0.1), RADIUS)
    assert free == FreeLength(REACH_M, known=True, covered=True, touching=False)


def test_a_wall_ahead_leaves_its_distance_less_disc_and_margin() -> None:
    made = picture(wall(IDENTITY, 1.0, 0.0))
    assert free_length(made, IDENTITY, Twist2(0.5, 0.0), RADIUS).s_m == pytest.approx(1 - DISC)
    assert free_length(made, IDENTITY, Twist2(-0.5, 0.0), RADIUS).s_m == REACH_M


directions = st.floats(-pi, pi)


@at_least(60)
@given(
    st.lists(st.tuples(st.integers(0, 359), st.floats(0.36, 3.0)), min_size=1, max_size=6),
    st.sampled_from([0.4, -0.4]),
    st.floats(-3, 3),
    st.builds(Pose2, st.floats(-0.1, 0.1), st.floats(-0.1, 0.1), directions),
)
def test_free_length_is_that_of_walking_the_arc(
    returns: list[tuple[int, float]], v: float, w: float, start: Pose2
) -> None:
    ranges: list[float | None] = [7.0] * 360
    for index, distance in returns:
        ranges[index] = distance
    made = picture(ranges)
    points = list(zip(made.xs_m, made.ys_m, strict=True))
    assume(all(hypot(x - start.x_m, y - start.y_m) >= DISC + 0.003 for x, y in points))
    walked = brute(made, start, Twist2(v, w))
    free = free_length(made, start, Twist2(v, w), RADIUS).s_m
    assert free == pytest.approx(walked, abs=0.004) or free <= walked <= free + 0.05


@given(st.floats(-1.4, 1.4), st.sampled_from([0.4, -0.4]), st.floats(-3, 3), directions)
def test_at_contact_there_is_no_way_round_the_circle(
    aside: float, v: float, w: float, yaw: float
) -> None:
    toward = yaw + aside if v > 0 else yaw + pi + aside
    made = ScanPicture(
        base_in_odom=IDENTITY,
        lidar_x_m=0.0,
        lidar_y_m=0.0,
        first_rad=toward,
        step_rad=tau,
        ranges_m=(DISC,),
        range_min_m=0.12,
        range_max_m=8.0,
        returns=1,
        sight_m=None,
        xs_m=(DISC * cos(toward),),
        ys_m=(DISC * sin(toward),),
        nearest_m=DISC,
    )
    free = free_length(made, Pose2(0.0, 0.0, yaw), Twist2(v, w), RADIUS)
    assert free.s_m <= 1e-6


@at_least(200)
@given(
    st.sets(st.integers(0, 359), max_size=40),
    st.integers(0, 359),
    st.integers(0, 60),
    st.floats(-0.2, 0.2),
    directions,
    st.floats(-6, 6),
    st.sampled_from([0.4, -0.4]),
)
def test_what_is_known_without_counting_is_known_by_counting(
    single: set[int], first: int, run: int, x: float, yaw: float, w: float, v: float
) -> None:
    missing = single | {(first + i) % 360 for i in range(run)}
    made = picture([None if i in missing else 7.0 for i in range(360)])
    start = Pose2(x, 0.1, yaw)
    quick = free_length(made, start, Twist2(v, w), RADIUS)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("bridge.core.motion.free_distance._few_missing", lambda *_: False)
        assert free_length(made, start, Twist2(v, w), RADIUS) == quick


@given(st.floats(), st.floats(), st.floats(-2, 2), st.floats(-2, 2), st.floats(-7, 7))
@example(0.5, 8.98846567431158e307, 0.0, 0.0, 0.0)  # w / v is infinite
@example(0.5, 8.9e307, 0.0, 0.0, 0.0)
def test_no_motion_raises(v: float, w: float, x: float, y: float, yaw: float) -> None:
    made = picture(wall(IDENTITY, 0.5, 1.0))
    free = free_length(made, Pose2(x, y, yaw), Twist2(v, w), RADIUS)
    assert 0.0 <= free.s_m <= REACH_M
    assert (
        0.0 <= speed_scale(free.s_m, Twist2(v, w), BASE, LIMITS, 0.3, touching=free.touching) <= 1.0
    )


@given(st.floats(0.001, 3), st.floats(0.05, 5), st.floats(0, 1))
def test_the_speed_within_a_length_stops_within_it(s: float, decel: float, late: float) -> None:
    v = speed_within(s, decel, late)
    assert v * late + v * v / (2 * decel) == pytest.approx(s)
