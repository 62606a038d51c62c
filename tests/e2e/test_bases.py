"""Bases of others, played by twins: they drive to a place, and stand when the bridge is killed."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ROOT
from wire import Mode, load_robot

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(200)]

PRESETS = ("waveshare_ugv_rover",)
"""One in real time; tests/tools/lockstep/test_drives.py has every kind."""
RAMP_M = 0.12
"""What a base rolls beside its dead-man, and a busy machine's share."""


@pytest.fixture(params=PRESETS)
def base(request: pytest.FixtureRequest, home: Path) -> Iterator[Robot]:
    """Return an armed robot whose bytes go over a pseudo-terminal."""
    robot = Robot(home, PONS_ROBOT=str(preset_of(request.param)))
    robot.system.arguments = ("--twin",)
    try:
        made = robot.system.pons("key", "new")
        assert made.returncode == 0, made.stderr
        robot.start()
        wake(robot)
        yield robot
    finally:
        robot.close()


def preset_of(name: str) -> Path:
    return ROOT / "robots" / f"{name}.toml"


def wake(robot: Robot) -> None:
    """Arm it and wait until it takes goals; a base without gyro is never free of rows."""
    robot.judge.until_mode(Mode.DISARMED, limit_s=20.0)
    robot.arm()
    until(
        lambda: robot.system.http("GET", "/readyz").status == 200,
        15.0, "ready", robot.judge.describe,
    )  # fmt: skip


def test_it_stands_when_its_bridge_is_killed_and_then_arrives(
    base: Robot, request: pytest.FixtureRequest
) -> None:
    described = load_robot(preset_of(request.node.callspec.params["base"]))
    place = base.farthest()
    base.system.give(f"go to the {place.name.en}")
    base.judge.until_moving(0.1)
    time.sleep(0.5)
    fastest_mps = min(described.limits.max_speed_mps, 0.3)
    killed_s = base.system.kill("bridge")
    stood_s = base.assert_stops(killed_s, fastest_mps * described.drive.dead_man_s + RAMP_M)
    rolled_m = base.judge.path_m(killed_s, stood_s)
    print(f"{described.drive.kind}: stood after {stood_s - killed_s:.2f} s and {rolled_m:.3f} m")
    wake(base)
    base.arrive(place, base.system.give(f"go to the {place.name.en}"), limit_s=80.0)
