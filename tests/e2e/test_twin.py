"""A robot of metal is played whole by twins: base and lidar at the far ends of serial lines."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.e2e.robot import Robot
from tests.e2e.system import ROOT

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(150)]

ROBOT_TOML = ROOT / "robots" / "pons_mcu_ld19.toml"


@pytest.fixture
def metal(home: Path) -> Iterator[Robot]:
    """Return a robot at rest whose bytes go over two pseudo-terminals."""
    robot = Robot(home, PONS_ROBOT=str(ROBOT_TOML))
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


def test_it_drives_by_a_sentence_and_stands_while_its_lidar_is_killed(metal: Robot) -> None:
    place, goal = metal.drive_off(metal.farthest())
    killed_s = metal.system.kill("sensors.lidar")
    metal.assert_stops(killed_s, path_m=0.8)  # scans may be 0.5 s old before the bridge stops
    assert metal.system.child("sensors.lidar").is_running()  # `pons up` started it anew
    metal.arrive(place, goal, limit_s=60.0)
    assert metal.judge.path_m(killed_s, time.monotonic()) > 0.0
    said = metal.system.pons("doctor").stdout
    (line,) = [line for line in said.splitlines() if line.split()[1:2] == ["lidar"]]
    assert line.startswith("ok"), said
