"""However ``pons up`` ends, nothing is left running, and the next start works in the same home."""

from __future__ import annotations

import signal
from pathlib import Path

import psutil
import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import CHILDREN, System

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(120), pytest.mark.nightly(keep=1)]


def test_a_killed_up_takes_all_along_and_the_next_one_goes_on_when_asked(home: Path) -> None:
    robot = Robot(home)
    try:
        robot.start()
        place, goal = robot.drive_off()
        robot.system.end(signal.SIGKILL)  # its children die with it
        robot.system.start()
        back = robot.system.until_goal(goal["id"], "paused")
        assert back["reason"] == "planner_restarted"
        assert back["plan"]["steps"][0]["place"] == place.id
        robot.judge.assert_never_moves(1.0)
        assert robot.system.pons("resume").returncode == 0
        robot.arrive(place, goal)
        robot.system.end(signal.SIGTERM)
        replays_the_same(robot)
    finally:
        robot.system.destroy()
        robot.judge.close()


def replays_the_same(robot: Robot) -> None:
    """Hold that the newest recording, of a whole drive, comes out command by command."""
    recordings = (robot.system.home / "recordings").iterdir()
    newest = max(recordings, key=lambda path: path.stat().st_mtime)
    done = robot.system.pons("replay", str(newest))
    assert done.returncode == 0, (done.stdout, done.stderr)
    assert int(done.stdout.split()[0]) > 500
    assert "0 differing, 0 gaps" in done.stdout


def test_an_end_in_the_middle_of_the_start_leaves_nothing(home: Path) -> None:
    system = System(home)
    try:
        system.launch()
        until(lambda: len(system.processes()) > 1, 10.0, "a first child", system.read_log)
        system.end(signal.SIGINT)
    finally:
        system.destroy()


def test_a_home_that_cannot_be_written_for_a_while_ends_nobody(robot: Robot) -> None:
    (lock,) = (robot.system.home / "run").glob("**/localization.lock")
    logs = robot.system.home / "logs"
    aside = logs.rename(logs.with_name("logs.aside"))
    logs.touch()  # no log can be opened
    lock.unlink()
    lock.mkdir()  # nor a lock
    robot.system.kill("localization")
    refused = "localization ended (exit status 1)"
    until(lambda: refused in robot.system.read_log(), 20.0, refused, robot.system.read_log)
    assert robot.system.up is not None
    assert robot.system.up.poll() is None, robot.system.read_log()
    lock.rmdir()
    logs.unlink()
    aside.rename(logs)
    robot.system.until_served()
    robot.rest()
    robot.drive_off()


def test_every_child_is_started_by_the_one_up(robot: Robot) -> None:
    assert robot.system.up is not None
    parents = {name: robot.system.child(name).ppid() for name in CHILDREN}
    standby = parents["planner"]  # a fork of the planner serves
    parents["planner"] = psutil.Process(standby).ppid()
    assert standby != robot.system.up.pid
    assert parents == dict.fromkeys(CHILDREN, robot.system.up.pid)
