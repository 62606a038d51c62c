"""However ``pons up`` ends, nothing is left running, and the next start works in the same home."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import CHILDREN, System

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(120)]


def test_a_finished_drive_replays_without_a_difference(home: Path) -> None:
    robot = Robot(home)
    try:
        robot.start()
        place, goal = robot.drive_off()
        robot.arrive(place, goal)
        robot.system.end(signal.SIGINT)
        recordings = sorted((home / "recordings").iterdir())
        assert len(recordings) == 1
        done = robot.system.pons("replay", str(recordings[0]))
        assert done.returncode == 0, (done.stdout, done.stderr)
        words = done.stdout.split()
        assert int(words[0]) > 500
        assert "0 differing, 0 gaps" in done.stdout
    finally:
        robot.system.destroy()
        robot.judge.close()


def test_after_a_kill_the_next_start_keeps_the_goal_and_moves_nothing(home: Path) -> None:
    robot = Robot(home)
    try:
        robot.start()
        place, goal = robot.drive_off()
        robot.system.end(signal.SIGKILL)  # children die with it
        robot.system.start()
        back = robot.system.until_goal(goal["id"], "paused")
        assert back["reason"] == "planner_restarted"
        robot.judge.assert_never_moves(1.0)
        assert back["plan"]["steps"][0]["place"] == place.id
        robot.system.end(signal.SIGTERM)
    finally:
        robot.system.destroy()
        robot.judge.close()


def test_an_end_in_the_middle_of_the_start_leaves_nothing(home: Path) -> None:
    system = System(home)
    try:
        system.launch()
        until(lambda: len(system.processes()) > 1, 10.0, "a first child", system.said)
        system.end(signal.SIGINT)
    finally:
        system.destroy()


@pytest.mark.parametrize("name", CHILDREN)
def test_every_child_is_started_by_the_one_up(robot: Robot, name: str) -> None:
    assert robot.system.child(name).ppid() == (robot.system.up and robot.system.up.pid)
