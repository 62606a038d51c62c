"""The planner may die or freeze at any instant: the robot stands, and goes on only as it may."""

from __future__ import annotations

import time

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from wire import Mode, Status

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]


def owner_of(status: Status) -> str:
    """Return who owns the robot, or nothing."""
    return status.owner.planner_id if status.owner is not None else ""


def test_a_killed_planner_moves_nothing_until_a_person_resumes(robot: Robot) -> None:
    place, goal = robot.drive_off()
    before = owner_of(robot.judge.status)
    killed_s = robot.system.kill("planner")
    stood_s = robot.assert_stops(killed_s)
    robot.system.until_served()
    until(
        lambda: owner_of(robot.judge.status) not in ("", before),
        10.0,
        "another planner owning the robot",
        robot.judge.describe,
    )
    paused = robot.system.until_goal(goal["id"], "paused")
    assert paused["reason"] == "planner_restarted"
    robot.judge.assert_never_moves(1.0)
    robot.judge.assert_stood(stood_s)
    status = robot.judge.status
    assert status.held is not None
    assert status.held.reason == "planner_restarted"
    if status.mode is Mode.DISARMED:  # a slow machine: away for over 5 s
        robot.arm()
    done = robot.system.pons("resume")
    assert done.returncode == 0, done.stderr
    robot.arrive(place, goal)


def test_a_planner_frozen_for_a_second_goes_on_by_itself(robot: Robot) -> None:
    place, goal = robot.drive_off()
    epoch, owner = robot.judge.status.epoch, owner_of(robot.judge.status)
    frozen_s = robot.system.freeze("planner")
    stood_s = robot.assert_stops(frozen_s)
    until(lambda: time.monotonic() >= frozen_s + 1.0, 2.0, "a second")
    lost = robot.judge.status
    assert lost.owner is None
    assert lost.epoch != epoch
    thawed_s = robot.system.thaw("planner")
    robot.judge.assert_stood(stood_s, thawed_s)
    robot.arrive(place, goal)
    # Nothing from before the freeze was obeyed: whatever moved, moved in a later epoch and under
    # the same planner's new hello and grant.
    moved = [s for _, s in robot.judge.statuses.since(thawed_s) if s.mode is Mode.ACTIVE]
    assert moved
    assert all(s.epoch != epoch for s in moved)
    assert all(owner_of(s) == owner and s.grant is not None for s in moved)
    codes = [e.code for _, e in robot.judge.events.since(frozen_s)]
    assert codes.index("owner_lost") < codes.index("owner") < codes.index("granted")


def test_a_planner_frozen_for_seven_seconds_needs_a_person(robot: Robot) -> None:
    place, goal = robot.drive_off()
    frozen_s = robot.system.freeze("planner")
    stood_s = robot.assert_stops(frozen_s)
    until(lambda: time.monotonic() >= frozen_s + 7.0, 8.0, "seven seconds")
    assert robot.judge.status.mode is Mode.DISARMED, robot.judge.describe()
    robot.system.thaw("planner")
    paused = robot.system.until_goal(goal["id"], "paused")
    # `pons up` starts a planner again that was silent for 5 s, about when the bridge disarms.
    assert paused["reason"] in ("disarmed", "fault(BRAIN_GONE)", "planner_restarted")
    robot.judge.assert_never_moves(1.0)
    robot.judge.assert_stood(stood_s)
    robot.arm()
    robot.judge.assert_never_moves(0.5)
    done = robot.system.pons("resume")
    assert done.returncode == 0, done.stderr
    robot.arrive(place, goal)
