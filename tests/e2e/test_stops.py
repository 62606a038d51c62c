"""Whoever may speak may stop, by API, shell, sentence or wire; it holds until a person acts."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import FAR_M, Robot
from wire import Mode, Status, Stop
from wire.keys import STOP

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.nightly(keep=5)]


def by_api(robot: Robot) -> None:
    reply = robot.system.http("POST", "/v1/stop")  # as bare as a shell's curl may be
    assert reply.status == 200, reply
    assert reply.body["confirmed"] is True


def by_shell(robot: Robot) -> None:
    done = robot.system.pons("stop")
    assert done.returncode == 0, done.stderr
    assert "bridge confirmed" in done.stdout


def by_english(robot: Robot) -> None:
    goal = robot.system.give("Stop!")
    assert (goal["state"], goal["outcome"]["code"]) == ("succeeded", "stopped")


def by_chinese(robot: Robot) -> None:
    done = robot.system.pons("say", "停")
    assert done.returncode == 0, done.stderr


def by_wire(robot: Robot) -> None:
    mouth = robot.judge.session.publisher(STOP)
    stop = Stop(id=f"judge-{time.monotonic_ns()}", source="judge")

    def echoed() -> bool:
        mouth.put(stop)
        return any(answer.id == stop.id for answer in robot.judge.status.answers)

    until(echoed, 2.0, "the bridge's echo of a stop", robot.judge.describe)


WAYS = (by_api, by_shell, by_english, by_chinese, by_wire)


def held_by_stop(status: Status) -> bool:
    return status.held is not None and status.held.reason == "stop"


def assert_stopped(robot: Robot, goal_id: str, confirmed_s: float, epoch: str) -> None:
    """Hold that it stands, held, in a new epoch, its goal paused, and stays so."""
    stood_s = robot.assert_stops(confirmed_s)
    status = robot.judge.status
    assert held_by_stop(status), robot.judge.describe()
    assert status.epoch != epoch
    paused = robot.system.until_goal(goal_id, "paused", limit_s=3.0)
    assert paused["reason"] == "stop"
    robot.judge.assert_never_moves(0.4)
    robot.judge.assert_stood(stood_s)


@pytest.mark.parametrize("stop", WAYS, ids=lambda way: str(way.__name__))
def test_a_stop_holds_while_waypoints_keep_coming(
    robot: Robot, stop: Callable[[Robot], None]
) -> None:
    _, goal = robot.drive_off(robot.farthest())
    epoch = robot.judge.status.epoch
    stop(robot)
    assert_stopped(robot, goal["id"], time.monotonic(), epoch)


def test_a_stop_in_the_shell_needs_no_living_planner(robot: Robot) -> None:
    _, goal = robot.drive_off(robot.farthest())
    robot.system.freeze("planner")
    done = robot.system.pons("stop")
    assert done.returncode == 0, done.stderr
    assert "bridge confirmed" in done.stdout
    stood_s = robot.assert_stops(time.monotonic())
    assert held_by_stop(robot.judge.status), robot.judge.describe()
    robot.system.thaw("planner")
    paused = robot.system.until_goal(goal["id"], "paused", limit_s=5.0)
    assert paused["reason"] == "stop"
    robot.judge.assert_never_moves(0.5)
    robot.judge.assert_stood(stood_s)


def test_after_a_stop_a_new_goal_runs_at_once_and_those_before_it_wait(robot: Robot) -> None:
    place, first = robot.drive_off()
    second = robot.system.give("go to the kitchen")
    assert second["state"] in ("planning", "queued")
    queued = robot.system.until_goal(second["id"], "queued")
    assert queued["position"] == 0
    by_api(robot)
    robot.assert_stops(time.monotonic())
    robot.system.until_goal(first["id"], "paused")
    third = robot.system.give(f"go to the {place.name.en}")
    robot.arrive(place, third)
    assert robot.system.goal(first["id"])["state"] == "paused"
    assert robot.system.goal(second["id"])["state"] == "queued"
    robot.judge.assert_never_moves(0.5)
    robot.system.act(first["id"], "cancel")
    robot.judge.assert_never_moves(0.3)
    done = robot.system.pons("resume", second["id"])
    assert done.returncode == 0, done.stderr
    if robot.away_m(robot.place("kitchen")) > FAR_M:
        robot.judge.until_moving()
    robot.system.until_goal(second["id"], "running", "succeeded")


def test_pause_resume_and_cancel(robot: Robot) -> None:
    _, goal = robot.drive_off(robot.farthest())
    done = robot.system.pons("pause")
    assert done.returncode == 0, done.stderr
    stood_s = robot.assert_stops(time.monotonic())
    paused = robot.system.until_goal(goal["id"], "paused")
    assert paused["reason"] == "operator"
    assert robot.judge.status.held is None
    robot.judge.assert_never_moves(0.5)
    robot.judge.assert_stood(stood_s)
    done = robot.system.pons("resume")
    assert done.returncode == 0, done.stderr
    robot.judge.until_moving()
    done = robot.system.pons("cancel")
    assert done.returncode == 0, done.stderr
    robot.assert_stops(time.monotonic())
    ended = robot.system.until_goal(goal["id"], "cancelled")
    assert ended["outcome"] is None or ended["outcome"]["code"] == "cancelled"
    robot.judge.assert_never_moves(0.5)


def test_disarm_takes_the_torque_and_arm_gives_it_back(robot: Robot) -> None:
    _, goal = robot.drive_off(robot.farthest())
    done = robot.system.pons("disarm")
    assert done.returncode == 0, done.stderr
    stood_s = robot.assert_stops(time.monotonic())
    robot.judge.until_mode(Mode.DISARMED)
    until(lambda: not robot.judge.drives.last.enabled, 2.0, "torque off")
    paused = robot.system.until_goal(goal["id"], "paused")
    assert paused["reason"] == "disarmed"
    refused = robot.system.http("POST", f"/v1/goals/{goal['id']}/resume", {})
    assert refused.status in (200, 409), refused
    robot.judge.assert_never_moves(0.5)
    robot.judge.assert_stood(stood_s)
    robot.arm()
    robot.judge.assert_never_moves(0.3)
    robot.system.until_goal(goal["id"], "paused")
    assert robot.system.pons("resume").returncode == 0
    robot.judge.until_moving()
    assert robot.system.goal(goal["id"])["state"] == "running"


def test_a_protective_stop_is_latched_until_reset(robot: Robot) -> None:
    _, goal = robot.drive_off(robot.farthest())
    done = robot.system.pons("estop")
    assert done.returncode == 0, done.stderr
    stood_s = robot.assert_stops(time.monotonic())
    assert robot.judge.status.mode is Mode.ESTOPPED
    assert robot.system.until_goal(goal["id"], "paused")["reason"] == "estop"
    refused = robot.system.pons("arm")
    assert refused.returncode != 0
    assert "refused" in refused.stderr
    # The detector must be clean for 2 s and the robot standing before a reset counts.
    until(lambda: robot.system.pons("reset").returncode == 0, 8.0, "reset", robot.judge.describe)
    robot.judge.until_mode(Mode.DISARMED)
    until(lambda: not robot.judge.drives.last.enabled, 2.0, "torque off")
    robot.judge.assert_stood(stood_s)
    robot.arm()
    robot.judge.assert_never_moves(0.3)
    assert robot.system.pons("resume").returncode == 0
    robot.judge.until_moving()
    assert robot.system.goal(goal["id"])["state"] == "running"
