"""A ROS 2 robot is played whole by its twin, behind the node that it has."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.e2e.robot import Robot
from tests.e2e.system import ROOT

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(150), pytest.mark.nightly]


@pytest.fixture
def ros2(home: Path) -> Iterator[Robot]:
    """Return a robot at rest whose wheels, scans and gyro go over one socket."""
    robot = Robot(home, PONS_ROBOT=str(ROOT / "robots" / "ros2_diff_drive.toml"))
    robot.system.arguments = ("--twin",)
    try:
        made = robot.system.pons("key", "new")  # metal is armed by a person, with a proof
        assert made.returncode == 0, made.stderr
        robot.start()
        robot.arm()
        robot.rest()
        yield robot
    finally:
        robot.close()


def test_it_arrives_by_a_sentence_and_stands_when_its_process_is_killed(ros2: Robot) -> None:
    place, goal = ros2.drive_off(ros2.farthest())
    ros2.arrive(place, goal, limit_s=60.0)
    ros2.drive_off(ros2.farthest())
    killed_s = ros2.system.kill("ros2")
    ros2.assert_stops(killed_s, path_m=0.3)  # 0.5 m/s for the dead-man's 0.2 s, then the brakes
    assert ros2.system.child("ros2").is_running()  # `pons up` started it again
    assert ros2.judge.path_m(killed_s, time.monotonic()) < 0.3, "it does not go on by itself"
    ros2.arm()  # a drive that began again is armed by a person
    said = ros2.system.pons("doctor").stdout
    (line,) = [line for line in said.splitlines() if line.split()[1:2] == ["ros2"]]
    assert line.startswith("ok"), said
