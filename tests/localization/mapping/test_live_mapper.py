"""The mapper places the robot while the map grows, and says when no scan holds it."""

from __future__ import annotations

from math import hypot

import numpy as np
import pytest

from localization.mapping.live_mapper import LiveMapper
from localization.mapping.map_builder import MapBuilder
from localization.quality import POOR_QUALITY
from tests.localization.rooms import MAP_ID, ROOM, cast, odometry_of, scan_of
from wire import Localization, Pose2, RobotDescription, between, compose, distance

LIDAR = RobotDescription().lidar.model_copy(update={"x_m": 0.0, "y_m": 0.0, "yaw_rad": 0.0})
START = Pose2(3.0, 2.0, 0.1)
TICK_S = 0.02


class Drive:
    """Drive round ROOM with wheels 5 % wrong, and let a mapper follow."""

    def __init__(self) -> None:
        self.mapper, self.builder = LiveMapper(LIDAR, MAP_ID), MapBuilder()
        self.true, self.wheels = START, Pose2(7.0, -3.0, 1.0)
        self.now_s = 100.0
        self.odom_id = "bridge-1"
        self.is_blind = False
        self.said: list[Localization] = []

    def go(self, seconds: float, v_mps: float = 0.3, w_radps: float = 0.4) -> None:
        """Drive along an arc; a scan comes five times a second."""
        for tick in range(round(seconds / TICK_S)):
            self.now_s += TICK_S
            step = Pose2(v_mps * TICK_S, 0.0, w_radps * TICK_S)
            self.true = compose(self.true, step)
            self.wheels = compose(self.wheels, Pose2(1.05 * step.x_m, 0.0, 1.03 * step.yaw_rad))
            self.mapper.hear_odometry(odometry_of(self.now_s, self.wheels, odom_id=self.odom_id))
            if tick % 10 == 9 and not self.is_blind:
                self.mapper.hear_scan(scan_of(cast(ROOM, self.true), self.now_s))
            self.mapper.work()
            for link in self.mapper.take_links():
                if self.builder.add(link):
                    self.mapper.hear_poses(self.builder.poses)
            answer = self.mapper.answer(self.now_s)
            if answer is not None:
                self.said.append(answer)

    def off_m(self) -> float:
        """Return how far what was said last is from the truth, in the frame of the start."""
        in_map = compose(self.said[-1].odom_in_map, self.wheels)
        return distance(in_map, between(START, self.true))


def test_it_follows_wheels_that_are_wrong() -> None:
    drive = Drive()
    drive.go(30.0)
    assert drive.off_m() < 0.06
    assert drive.said[-1].quality > 0.8
    assert drive.said[-1].map_id == MAP_ID
    assert len(drive.builder.keyframes) > 8
    wheels = between(Pose2(7.0, -3.0, 1.0), drive.wheels)
    assert distance(wheels, between(START, drive.true)) > 0.15, "by wheels alone"


def test_before_the_first_scan_it_says_nothing() -> None:
    drive = Drive()
    drive.is_blind = True
    drive.go(1.0)
    assert drive.said == []
    assert not drive.mapper.is_placed(drive.now_s)


def test_without_scans_its_quality_falls_until_the_robot_is_held() -> None:
    drive = Drive()
    drive.go(4.0)
    drive.is_blind = True
    drive.go(1.5)
    qualities = [one.quality for one in drive.said[-60:]]
    assert qualities == sorted(qualities, reverse=True)
    assert qualities[-1] < POOR_QUALITY
    drive.is_blind = False
    drive.go(1.0)
    assert drive.said[-1].quality > 0.8
    assert drive.off_m() < 0.06


def test_a_loop_that_moves_the_robot_is_declared_first() -> None:
    drive = Drive()
    drive.go(6.0)
    before = len(drive.said)
    turned = np.array([keyframe.pose for keyframe in drive.builder.keyframes])
    turned[:, 0] += 0.4  # as if a loop had moved all of it
    drive.mapper.hear_poses(turned)
    drive.go(0.3, 0.0, 0.0)
    told = drive.said[before:]
    assert [one.quality for one in told[:2]] == [0.0, 0.0]
    good = [one for one in told if one.quality >= POOR_QUALITY]
    here = compose(good[-1].odom_in_map, drive.wheels)
    assert hypot(here.x_m - between(START, drive.true).x_m - 0.4, 0.0) < 0.08


def test_a_bridge_that_began_anew_is_joined_on() -> None:
    drive = Drive()
    drive.go(5.0)
    drive.odom_id, drive.wheels = "bridge-2", Pose2(0.0, 0.0, 0.0)
    drive.go(3.0)
    assert drive.said[-1].odom_id == "bridge-2"
    assert drive.off_m() < 0.06
    assert drive.said[-1].quality > 0.8


def test_another_day_goes_on_from_where_a_search_found_it() -> None:
    first = Drive()
    first.go(25.0)
    known = first.builder.keyframes
    here = between(START, first.true)
    start = np.array((here.x_m + 0.05, here.y_m - 0.05, here.yaw_rad + 0.03))
    second = Drive()
    second.true = first.true
    second.mapper, second.builder = LiveMapper(LIDAR, MAP_ID, start, known), first.builder
    second.go(10.0)
    assert second.off_m() < 0.06
    assert len(second.builder.keyframes) > len(known)


@pytest.mark.parametrize("far_s", [0.3, 5.0])
def test_old_odometry_carries_no_pose(far_s: float) -> None:
    drive = Drive()
    drive.go(2.0)
    drive.mapper.hear_odometry(odometry_of(drive.now_s + TICK_S, drive.wheels))
    assert drive.mapper.answer(drive.now_s + TICK_S + far_s) is None
