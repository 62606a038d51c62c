"""Calibration in real processes: a robot.toml that is wrong on purpose, on the two-room site."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from scripts.scheduler_probe import Pulse, until_calm
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ROOT, TWO_ROOM
from wire import Mode, RobotDescription, load_robot

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(640), pytest.mark.nightly]

CALIBRATION_S = 150.0
TRIES = 3
"""A machine that stalls everything for a quarter of a second ends a run, and with it the whole."""
CALM_S = 60.0
"""At most between tries: another in the same bad stretch would end likewise."""

WRONG = {
    "wheel_radius_m = 0.1": "wheel_radius_m = 0.105",
    "wheel_separation_m = 0.5": "wheel_separation_m = 0.48",
    "dead_zone_radps = 0.05": "dead_zone_radps = 0.0",
    "lag_s = 0.06": "lag_s = 0.03",
}
METAL = "wheel_radius_m = 0.1\nwheel_separation_m = 0.5\n"


@pytest.fixture
def wrong(home: Path) -> Iterator[Robot]:
    """Start a robot whose robot.toml has a wrong radius, separation, dead zone and lag."""
    text = (ROOT / "robot.toml").read_text("utf-8")
    for said, instead in WRONG.items():
        assert f"\n{said}" in text
        text = text.replace(f"\n{said}", f"\n{instead}", 1)
    (home / "robot.toml").write_text(text, "utf-8")
    (home / "metal.toml").write_text(METAL, "utf-8")
    found = Robot(
        home,
        TWO_ROOM,
        PONS_ROBOT=str(home / "robot.toml"),
        PONS_METAL=str(home / "metal.toml"),
    )
    try:
        found.start()
        yield found
    finally:
        found.close()


def calibrated(robot: Robot) -> subprocess.CompletedProcess[str]:
    """Calibrate while a person resets and arms whenever a stalling machine stopped the robot."""
    ended = threading.Event()

    def arm() -> None:
        while not ended.wait(1.0):
            if robot.judge.status.mode is Mode.FAULT:
                robot.system.pons("reset")
            if robot.judge.status.mode in {Mode.FAULT, Mode.DISARMED}:
                robot.system.pons("arm")

    person = threading.Thread(target=arm)
    person.start()
    try:
        return robot.system.pons("calibrate", "--yes", "--shuttles", "2", timeout_s=CALIBRATION_S)
    finally:
        ended.set()
        person.join()


def written(robot: Robot) -> RobotDescription:
    return load_robot(robot.system.home / "robot.toml")


def test_a_wrong_description_is_measured_and_mended(wrong: Robot) -> None:
    home = wrong.system.home
    before = (home / "robot.toml").read_text("utf-8")
    done = calibrated(wrong)
    for _ in range(TRIES - 1):
        if done.returncode == 0:
            break
        assert (home / "robot.toml").read_text("utf-8") == before, "refused, yet written"
        with Pulse() as pulse:
            until_calm(pulse.look, CALM_S, time.monotonic)
        wrong.system.pons("reset")
        wrong.system.pons("arm")
        done = calibrated(wrong)
    assert done.returncode == 0, done.stdout + done.stderr
    robot = written(wrong)
    assert robot.base.wheel_radius_m == pytest.approx(0.1, rel=0.01)
    assert robot.base.wheel_separation_m == pytest.approx(0.5, rel=0.01)
    assert robot.drive.dead_zone_radps == pytest.approx(0.05, abs=0.015)
    assert 0.06 <= robot.drive.lag_s <= 0.12, "the motor's 0.06 s and the way there"
    assert 0.035 <= robot.drive.response_s <= 0.07, "0.049 s, or 0.012 s of it seen as delay"
    assert 0.85 <= robot.limits.max_decel_mps2 <= 1.0
    text = (home / "robot.toml").read_text("utf-8")
    assert "in 4 runs, against the simulator's truth" in text
    assert "# the drive stops by itself after so long without a command" in text
    (kept,) = home.glob("robot.toml.bak-*")
    assert kept.read_text("utf-8") == before
    assert "+wheel_radius_m" in done.stdout
    wrong.judge.assert_no_contact()
    assert wrong.judge.status.mode is Mode.HOLD


def test_disarmed_or_interrupted_it_stands_and_writes_nothing(
    wrong: Robot,
) -> None:
    home = wrong.system.home
    before = (home / "robot.toml").read_text("utf-8")
    wrong.system.pons("disarm")
    wrong.judge.until_mode(Mode.DISARMED)
    done = wrong.system.pons("calibrate")
    assert done.returncode == 3
    assert done.stderr.startswith("not_armed")
    assert "使能" in wrong.system.pons("calibrate", chinese=True).stderr
    wrong.arm()
    calibration = subprocess.Popen(
        [sys.executable, "-m", "pons", "calibrate", "--yes"],
        cwd=ROOT,
        env=wrong.system.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        until(lambda: wrong.judge.status.mode is Mode.TELEOP, 20.0, "teleop")
        until(lambda: abs(wrong.judge.truth.twist.w_radps) > 0.2, 10.0, "motion")
        calibration.send_signal(signal.SIGINT)
        said, _ = calibration.communicate(timeout=15.0)
    finally:
        calibration.kill()
    assert calibration.returncode == 130, said
    assert "nothing was written" in said
    wrong.judge.assert_never_moves(0.5)
    assert (home / "robot.toml").read_text("utf-8") == before
    assert not list(home.glob("robot.toml.*"))
