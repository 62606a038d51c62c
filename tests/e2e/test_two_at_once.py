"""Two goals, two planners, two owners: one at a time, in order, and only the one that owns."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest

from pons.robot_processes import free_port
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ROOT
from wire import PROTOCOL, Grant, Heartbeat, Hello, Mode, Waypoint, Waypoints
from wire.keys import GRANT, HEARTBEAT, HELLO, WAYPOINTS, Party
from wire.session import open_session
from wire.sockets import Endpoints

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]

ROGUE = "rogue-planner"


def test_two_goals_are_done_in_the_order_given(robot: Robot) -> None:
    first, began_s = robot.elsewhere(), time.monotonic()
    one = robot.system.give(f"go to the {first.name.en}")
    two = robot.system.give("去厨房" if first.id != "kitchen" else "去充电桩")
    queued = robot.system.until_goal(two["id"], "queued", limit_s=3.0)
    assert queued["position"] == 0
    assert robot.system.goal(one["id"])["state"] == "running"
    ended = robot.system.until_goal(one["id"], "succeeded", limit_s=40.0)
    assert ended["outcome"]["reached"]["place"] == first.id
    second = robot.place("kitchen" if first.id != "kitchen" else "charging_dock")
    robot.arrive(second, two)
    robot.assert_stood_at(first, began_s)  # it left for the second at once


def test_a_second_planner_and_a_second_up_are_refused(robot: Robot) -> None:
    _, goal = robot.drive_off()
    system = robot.system
    words = [sys.executable, "-m", "planner", "--home", str(system.home), "--site",
             str(system.site), "--robot", str(ROOT / "robot.toml"), "--port", "1"]  # fmt: skip
    done = subprocess.run(
        words, cwd=ROOT, env=system.environment, capture_output=True, text=True, check=False,
        timeout=20,
    )  # fmt: skip
    assert done.returncode == 2
    assert "already_running" in done.stderr
    before = {process.pid for process in system.processes()}
    again = system.pons("up")
    assert again.returncode == 2, (again.stdout, again.stderr)
    assert "port_in_use" in again.stderr or "already_running" in again.stderr
    assert {process.pid for process in system.processes()} == before
    elsewhere = system.pons("up", "--port", str(free_port()))
    assert elsewhere.returncode == 2, (elsewhere.stdout, elsewhere.stderr)
    assert "already_running" in elsewhere.stderr
    assert {process.pid for process in system.processes()} == before
    assert system.goal(goal["id"])["state"] in ("running", "succeeded")


def test_a_stranger_who_claims_the_robot_moves_nothing(robot: Robot, home: Path) -> None:
    """The owner drives; a stranger at the bridge's own socket says everything an owner says."""
    place, goal = robot.drive_off()
    owner = robot.judge.status.owner
    assert owner is not None
    refused = []
    with open_session(Party.PLANNER, "r1", home, Endpoints(robot.system.home)) as stranger:
        says = [stranger.publisher(key) for key in (HELLO, GRANT, HEARTBEAT, WAYPOINTS)]
        for number in range(1, 41):
            for mouth, message in zip(says, lies(robot, number), strict=True):
                mouth.put(message)
            answers = robot.judge.status.answers
            refused += [a for a in answers if a.id == ROGUE]
            until(robot.judge.describe, 1.0, "a status")
            time.sleep(0.025)
    assert refused, robot.judge.describe()
    assert {(a.accepted, a.code) for a in refused} == {(False, "owner_alive")}
    assert robot.judge.status.owner == owner
    followed = {s.leg.mission for _, s in robot.judge.statuses.since(0.0) if s.leg is not None}
    assert ROGUE not in followed
    robot.arrive(place, goal)
    assert robot.judge.status.mode is Mode.HOLD


def lies(robot: Robot, number: int) -> tuple[Hello, Grant, Heartbeat, Waypoints]:
    """Return all that an owner says, well made, in the present epoch, with a stranger's name."""
    status = robot.judge.status
    pose = robot.judge.truth.base_in_map
    points = tuple(
        Waypoint(x_m=pose.x_m - 0.1 * step, y_m=pose.y_m, speed_mps=0.5) for step in range(1, 6)
    )
    who, map_id = ROGUE, status.map_id or ""
    return (
        Hello(planner_id=who, kind="planner", seen=status.seq, protocol=PROTOCOL,
              robot_hash=status.robot_hash, fence_hash=status.fence_hash, map_id=map_id),
        Grant(planner_id=who, epoch=status.epoch, seen=status.seq, mission=who, metres=10.0,
              seconds=60.0),
        Heartbeat(planner_id=who, epoch=status.epoch, seen=status.seq, used=status.seq),
        Waypoints(planner_id=who, epoch=status.epoch, seq=number, seen=status.seq, mission=who,
                  leg=1, map_id=map_id, ttl_s=0.5, points=points, final=False),
    )  # fmt: skip
