"""A home nobody knows is mapped by hand, and becomes a site."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ENDED, Json

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.timeout(240)]

STICK_PERIOD_S = 0.04


def steer(robot: Robot, v_mps: float, w_radps: float, seconds: float) -> None:
    """Hold a stick for so long, as the page sends it; then let it go."""
    let_go = {"source": "hand", "v_mps": 0.0, "w_radps": 0.0, "dead_man": False}
    held = {**let_go, "dead_man": True}
    order = {**held, "v_mps": v_mps, "w_radps": w_radps}
    for said, for_s in ((let_go, 0.4), (held, 0.4), (order, seconds), (held, 0.4), (let_go, 0.2)):
        end_s = time.monotonic() + for_s
        while time.monotonic() < end_s:
            assert robot.system.http("POST", "/v1/teleop", said).status == 202
            time.sleep(STICK_PERIOD_S)


def keyframes(robot: Robot) -> int:
    """Return how many keyframes the growing map shows."""
    growing: Json = robot.system.http("GET", "/v1/map").body["growing"]
    return int(growing["keyframes"])


def test_a_home_is_mapped_by_hand_driven_in_and_made_a_site(home: Path) -> None:
    robot = Robot(home)
    robot.system.arguments = ("--map", "attic")
    try:
        robot.start()
        robot.rest()
        steer(robot, 0.0, 0.8, 8.0)
        steer(robot, 0.3, 0.0, 3.0)
        robot.judge.until_standing(5.0)
        until(lambda: keyframes(robot) >= 3, 15.0, "a map that grows", lambda: keyframes(robot))
        driver = robot.system.child("localization")
        goal = robot.system.give("go home")
        ended = robot.system.until_goal(goal["id"], *ENDED, limit_s=60.0)
        assert ended["state"] == "succeeded", (ended, robot.judge.describe())
        robot.judge.assert_no_contact()
        assert driver.is_running()
        made = robot.system.pons("map", "attic")
        assert made.returncode == 0, (made.stdout, made.stderr)
        named = robot.system.pons("site", "name", "attic", "room_1", "attic", "--zh", "阁楼")
        assert named.returncode == 0, (named.stdout, named.stderr)
        checked = robot.system.pons("site", "check", "attic")
        assert checked.returncode == 0, (checked.stdout, checked.stderr)
    finally:
        robot.close()
