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
CHANGE_LIMIT_S = 90.0
"""All processes end and begin anew: as long as a start."""


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


def is_at(robot: Robot, mapping: str | None) -> bool:
    """Tell whether what runs now makes a map of that name, or none, and serves a page."""
    try:
        told = robot.system.http("GET", "/v1/wizard")
    except OSError:
        return False  # it changes over
    return told.status == 200 and bool(told.body["mapping"] == mapping)


def localization(robot: Robot) -> Json:
    """Return what the page says of where the robot is."""
    told: Json = robot.system.http("GET", "/v1/localization").body
    return told


def is_localized(robot: Robot) -> bool:
    """Tell whether the robot knows where it is on the map that it runs on now."""
    localizer = localization(robot).get("localizer") or {}
    return bool(localizer.get("state") == "tracking")


def change_over(robot: Robot, path: str, mapping: str | None) -> None:
    """Have the wizard begin or save a map, and wait until the robot stands ready on it."""
    asked = robot.system.http("POST", path, {"source": "page"})
    assert asked.status == 202, asked.body
    until(lambda: is_at(robot, mapping), CHANGE_LIMIT_S, path, robot.system.read_log)
    until(lambda: is_localized(robot), CHANGE_LIMIT_S, "a pose", lambda: localization(robot))
    robot.rest()


def test_the_wizard_maps_a_home_saves_it_and_the_robot_drives_in_it(home: Path) -> None:
    robot = Robot(home)
    try:
        robot.start()
        robot.rest()
        change_over(robot, "/v1/wizard/map", "home")
        again = robot.system.http("POST", "/v1/wizard/map", {"source": "page"})
        assert (again.status, again.code) == (409, "mapping_already")
        steer(robot, 0.0, 0.8, 8.0)
        robot.judge.until_standing(5.0)
        until(lambda: keyframes(robot) >= 2, 15.0, "a map that grows", lambda: keyframes(robot))
        change_over(robot, "/v1/wizard/map/save", None)
        assert (home / "sites" / "home" / "map.yaml").is_file()
        assert robot.system.http("GET", "/v1/map").body["growing"] is None
        goal = robot.system.give("go forward 0.3 metres")
        ended = robot.system.until_goal(goal["id"], *ENDED, limit_s=60.0)
        assert ended["state"] == "succeeded", (ended, robot.judge.describe())
    finally:
        robot.close()
