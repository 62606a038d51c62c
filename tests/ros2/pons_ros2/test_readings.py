"""ROS messages become words of the wire, or are refused by the field that is wrong."""

from __future__ import annotations

import math
from types import SimpleNamespace as Made
from typing import Any

import pytest

from ros2.pons_ros2.pons_ros2.readings import (
    MAX_BEAMS,
    UnusableMessage,
    read_battery,
    read_frames,
    read_imu,
    read_map,
    read_odometry,
    read_scan,
    read_twist,
)

HEADER = Made(stamp=Made(sec=7, nanosec=500_000_000), frame_id="laser")


def odometry(**turn: float) -> Any:
    turned = {"x": 0.0, "y": 0.0, "z": math.sin(0.25), "w": math.cos(0.25)} | turn
    pose = Made(position=Made(x=1.0, y=2.0, z=0.0), orientation=Made(**turned))
    twist = Made(linear=Made(x=0.3, y=0.0), angular=Made(z=0.1))
    return Made(header=HEADER, pose=Made(pose=pose), twist=Made(twist=twist))


def scan(**more: Any) -> Any:
    made = {
        "header": HEADER, "angle_min": -1.0, "angle_increment": 0.5, "time_increment": 0.001,
        "range_min": 0.1, "range_max": 8.0, "ranges": [1.0, math.inf, -math.inf, 9.0, math.nan],
    }  # fmt: skip
    return Made(**made | more)


def test_a_pose_is_read() -> None:
    read = read_odometry(odometry())
    assert (read["stamp_s"], read["x_m"], read["y_m"]) == (7.5, 1.0, 2.0)
    assert (read["v_mps"], read["w_radps"]) == (0.3, 0.1)
    assert read["yaw_rad"] == pytest.approx(0.5)


@pytest.mark.parametrize("turn", [{"z": 0.0, "w": 0.0}, {"z": 3.0}, {"w": math.nan}])
def test_what_is_no_orientation_is_refused(turn: dict[str, float]) -> None:
    with pytest.raises(UnusableMessage, match="orientation"):
        read_odometry(odometry(**turn))


@pytest.mark.parametrize("hole", [math.nan, math.inf, 1e300])
def test_what_is_not_finite_is_refused(hole: float) -> None:
    made = odometry()
    made.pose.pose.position.x = hole
    with pytest.raises(UnusableMessage, match=r"position\.x"):
        read_odometry(made)
    accel = Made(x=0.1, y=0.2, z=9.81)
    with pytest.raises(UnusableMessage, match=r"angular_velocity\.z"):
        read_imu(Made(header=HEADER, angular_velocity=Made(z=hole), linear_acceleration=accel))


def test_too_near_is_no_free_floor_and_no_return_is_none() -> None:
    read = read_scan(scan())
    assert read["ranges_m"] == [1.0, None, 0.0, None, None]
    assert (read["frame"], read["clockwise"]) == ("laser", False)
    assert read_scan(scan(ranges=[0.0, 1.0]))["ranges_m"] == [0.0, 1.0]
    assert read_scan(scan(ranges=[0.0, 1.0]), "nothing")["ranges_m"] == [None, 1.0]


def test_a_lidar_that_counts_clockwise_is_turned_round() -> None:
    read = read_scan(scan(angle_min=1.0, angle_increment=-0.5, ranges=[1.0, 2.0, 3.0]))
    assert (read["ranges_m"], read["clockwise"]) == ([3.0, 2.0, 1.0], True)
    assert read["angle_min_rad"] == pytest.approx(0.0)


def test_of_too_many_beams_the_nearest_of_each_few_counts() -> None:
    ranges = [5.0] * (2 * MAX_BEAMS)
    ranges[1] = 0.5
    read = read_scan(scan(angle_increment=6.28 / len(ranges), ranges=ranges))
    assert (len(read["ranges_m"]), read["ranges_m"][0]) == (MAX_BEAMS, 0.5)


@pytest.mark.parametrize(
    "wrong", [{"ranges": []}, {"angle_increment": 0.0}, {"range_min": 9.0}, {"angle_min": math.nan}]
)
def test_what_is_no_lidars_scan_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(UnusableMessage):
        read_scan(scan(**wrong))


def test_either_twist_is_read() -> None:
    twist = Made(linear=Made(x=0.3, y=0.0), angular=Made(z=-0.5))
    assert read_twist(twist) == read_twist(Made(twist=twist)) == (0.3, 0.0, -0.5)


@pytest.mark.parametrize(("said", "full"), [(0.5, 0.5), (math.nan, None), (87.0, None)])
def test_a_battery_that_can_not_tell_tells_nothing(said: float, full: float | None) -> None:
    assert read_battery(Made(percentage=said)) == full


def grid(**turned: float) -> Any:
    turn = Made(**{"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0} | turned)
    origin = Made(position=Made(x=-3.0, y=0.0, z=0.0), orientation=turn)
    return Made(info=Made(resolution=0.05000000074505806, width=2, height=1, origin=origin))


def test_a_map_says_how_its_cells_lie_and_a_tilted_one_is_refused() -> None:
    read = read_map(grid())
    assert read == {
        "resolution_m": 0.05, "width": 2, "height": 1, "x_m": -3.0, "y_m": 0.0, "yaw_rad": 0.0,
    }  # fmt: skip
    assert read_map(grid(w=0.0))["yaw_rad"] == 0.0, "some map servers fill nothing in"
    assert read_map(grid(z=1.0, w=0.0))["yaw_rad"] == pytest.approx(math.pi)
    with pytest.raises(UnusableMessage, match="tilted"):
        read_map(grid(x=0.7, w=0.7))


def test_frames_are_read_and_one_that_is_not_finite_is_left_out() -> None:
    def one(x: float) -> Any:
        turn = Made(x=0.0, y=0.0, z=0.0, w=1.0)
        inner = Made(translation=Made(x=x, y=0.0, z=0.2), rotation=turn)
        return Made(child_frame_id="laser", header=Made(frame_id="base_link"), transform=inner)

    (frame,) = read_frames(Made(transforms=[one(0.1), one(math.nan)]))
    assert (frame["parent"], frame["child"]) == ("base_link", "laser")
    assert (frame["at_m"], frame["turned"]) == ([0.1, 0.0, 0.2], [0.0, 0.0, 0.0, 1.0])
