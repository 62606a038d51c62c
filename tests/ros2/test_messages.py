"""ROS messages are read whole or refused; only a beam may be null."""

from __future__ import annotations

import json
from math import inf, nan, pi
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2.messages import read_imu, read_odometry, read_scan
from ros2.robot_words import Unreadable
from tests.ros2.frames import imu, odometry, scan
from wire.bounded_types import MAX_BEAMS


@given(st.floats(-100, 100), st.floats(-100, 100), st.floats(-pi, pi))
def test_a_pose_comes_out_as_it_went_in(x_m: float, y_m: float, yaw_rad: float) -> None:
    read = read_odometry(odometry(1.0, x_m, y_m, yaw_rad))
    assert (read.x_m, read.y_m) == (x_m, y_m)
    assert abs((read.yaw_rad - yaw_rad + pi) % (2 * pi) - pi) < 1e-6


PATHS = (
    ("pose", "pose", "position", "x"),
    ("pose", "pose", "orientation", "w"),
    ("twist", "twist", "linear", "x"),
    ("twist", "twist", "angular", "z"),
    ("header", "stamp", "sec"),
)


@pytest.mark.parametrize("path", PATHS, ids=".".join)
@pytest.mark.parametrize("bad", [None, "1.0", nan, inf, 10**400, True, [], {}])
def test_odometry_with_a_hole_is_refused_by_the_name_of_the_hole(
    path: tuple[str, ...], bad: object
) -> None:
    message = odometry(1.0)
    inner: dict[str, Any] = message
    for part in path[:-1]:
        inner = inner[part]
    inner[path[-1]] = bad
    with pytest.raises(Unreadable, match=path[-1]):
        read_odometry(message)


def test_an_orientation_of_zeros_is_none() -> None:
    message = odometry(1.0)
    message["pose"]["pose"]["orientation"] = dict.fromkeys("xyzw", 0.0)
    with pytest.raises(Unreadable, match="orientation has length 0"):
        read_odometry(message)


def test_of_the_beams_null_and_not_a_number_are_no_return_and_minus_infinity_is_near() -> None:
    raw = json.loads(json.dumps(scan(1.0, ranges=[None, nan, inf, -inf, -1.0, 0.0, 9.0, 2.0])))
    assert read_scan(raw).ranges_m == (None, None, None, 0.0, 0.0, 0.0, None, 2.0)


def test_a_driver_that_says_zero_for_no_return_is_believed_where_robot_toml_says_so() -> None:
    assert read_scan(scan(1.0, ranges=[0.0, 1.0]), "nothing").ranges_m == (None, 1.0)
    assert read_scan(scan(1.0, ranges=[0.0, 1.0]), "near").ranges_m == (0.0, 1.0)


def test_a_scan_that_turns_clockwise_is_turned_round() -> None:
    read = read_scan(scan(1.0, angle_min=3.0, angle_increment=-0.5, ranges=[1.0, 2.0, 3.0]))
    assert read.clockwise
    assert read.angle_min_rad == pytest.approx(2.0)
    assert (read.angle_increment_rad, read.ranges_m) == (0.5, (3.0, 2.0, 1.0))


def test_of_more_beams_than_the_wire_carries_the_nearest_of_each_few_is_kept() -> None:
    beams = 2 * MAX_BEAMS
    ranges: list[float | None] = [5.0] * beams
    ranges[7], ranges[100], ranges[101] = 1.0, None, None
    read = read_scan(scan(1.0, angle_min=0.0, angle_increment=2 * pi / beams, ranges=ranges))
    assert len(read.ranges_m) == MAX_BEAMS
    assert (read.ranges_m[3], read.ranges_m[50], read.ranges_m[4]) == (1.0, None, 5.0)
    assert read.angle_increment_rad == pytest.approx(2 * pi / MAX_BEAMS)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"ranges": []}, "ranges holds"),
        ({"ranges": None}, "ranges holds"),
        ({"ranges": ["1.0"]}, "expected numbers"),
        ({"ranges": [True]}, "expected numbers"),
        ({"angle_increment": 0.0}, "no turn"),
        ({"angle_increment": 5.0}, "no turn"),
        ({"angle_increment": None}, "angle_increment"),
        ({"range_min": 9.0}, "no lidar's"),
        ({"range_max": None}, "range_max"),
        ({"time_increment": nan}, "time_increment"),
        ({"header": None}, "header.stamp"),
    ],
)
def test_a_scan_that_is_none_is_refused(wrong: dict[str, Any], says: str) -> None:
    with pytest.raises(Unreadable, match=says):
        read_scan(scan(1.0, **wrong))


def test_a_gyro_is_read_about_its_z_axis_or_refused() -> None:
    read = read_imu(imu(1.0, 0.25))
    assert (read.yaw_rate_radps, read.accel_x_mps2, read.accel_y_mps2) == (0.25, 0.1, 0.2)
    message = imu(1.0)
    message["angular_velocity"]["z"] = None
    with pytest.raises(Unreadable, match=r"angular_velocity\.z holds None"):
        read_imu(message)
