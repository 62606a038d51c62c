"""Bridge, simulator and localization may die too: nothing moves unasked, and all comes back."""

from __future__ import annotations

import time

import pytest

from planner.mission.status_monitor import SILENCE_S
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from wire import Image, Mode, keys
from wire.keys import Party
from wire.session import open_session

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=2)]

DEAD_MAN_PATH_M = 0.35
"""0.5 m/s for the 0.2 s of the drive's time-out, a period, the motors' lag and its ramp."""


def test_a_killed_bridge_is_stopped_by_the_drives_own_time_out(robot: Robot) -> None:
    place, goal = robot.drive_off()
    boot = robot.judge.status.boot
    killed_s = robot.system.kill("bridge")
    until(lambda: robot.judge.drives.last.timed_out, 2.0, "the drive's time-out")
    stood_s = robot.assert_stops(killed_s, DEAD_MAN_PATH_M)
    until(lambda: robot.judge.status.boot != boot, 15.0, "a new bridge", robot.system.read_log)
    robot.judge.until_mode(Mode.DISARMED)
    back_s = min(at_s for at_s, each in robot.judge.statuses.since(killed_s) if each.boot != boot)
    paused = robot.system.until_goal(goal["id"], "paused")
    reasons = {"disarmed"}
    if back_s - killed_s > SILENCE_S - 1.0:  # a busy machine starts it late: silence is told then
        reasons.add("fault(BRAIN_GONE)")
    assert paused["reason"] in reasons, back_s - killed_s
    robot.judge.assert_never_moves(1.0)
    robot.judge.assert_stood(stood_s)
    assert robot.judge.status.mode is Mode.DISARMED
    robot.arm()
    done = robot.system.pons("resume")
    assert done.returncode == 0, done.stderr
    robot.arrive(place, goal)


def test_a_killed_simulator_comes_back_and_waits_for_a_person(robot: Robot) -> None:
    _, goal = robot.drive_off()
    boot = robot.judge.truth.boot_id
    robot.system.kill("sim")
    until(lambda: robot.judge.truth.boot_id != boot, 20.0, "a new simulator", robot.system.read_log)
    back_s = time.monotonic()
    robot.judge.until_mode(Mode.DISARMED, Mode.FAULT)
    paused = robot.system.until_goal(goal["id"], "paused", "failed")
    assert paused["state"] == "paused", paused
    robot.judge.assert_never_moves(1.0)
    robot.judge.assert_stood(back_s)
    robot.rest()
    robot.drive_off()


def test_a_killed_localization_stops_the_robot_until_it_is_back(robot: Robot) -> None:
    place, goal = robot.drive_off()
    pid = robot.system.child("localization").pid
    killed_s = robot.system.kill("localization")
    robot.assert_stops(killed_s)
    assert "POSE_LOST" in {row.row for row in robot.judge.status.rows}, robot.judge.describe()
    until(
        lambda: robot.system.child("localization").pid != pid,
        15.0,
        "another localization",
        robot.system.read_log,
    )
    # The same planner, no stop, no disarm, under 5 s: going on needs no person.
    robot.arrive(place, goal)


def test_a_killed_camera_stops_nobody_and_comes_back(robot: Robot) -> None:
    pid = robot.system.child("sim.camera").pid
    with open_session(Party.JUDGE, "r1", robot.system.home) as session:
        pictures = session.image_subscriber(keys.CAMERA_COLOR)
        before = until(pictures.newest, 20.0, "a picture", robot.system.read_log)
        place, goal = robot.drive_off()
        robot.system.kill("sim.camera")
        robot.arrive(place, goal)
        until(
            lambda: robot.system.child("sim.camera").pid != pid,
            20.0,
            "another camera",
            robot.system.read_log,
        )
        assert isinstance(before, Image)
        boot = before.header.boot_id

        def another() -> bool:
            picture = pictures.newest()
            return isinstance(picture, Image) and picture.header.boot_id != boot

        until(another, 20.0, "its picture", robot.system.read_log)
