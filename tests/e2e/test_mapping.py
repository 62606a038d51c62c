"""A home nobody knows is mapped by hand, and becomes a site."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ENDED, Json

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.timeout(240), pytest.mark.nightly]

STICK_PERIOD_S = 0.04
SEEN_ALL_ROUND = 6
"""Keyframes; a whole turn makes 13."""
TURNS_S = 60.0
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


def has_seen_all_round(robot: Robot) -> bool:
    """Turn on the spot and tell whether that became a map: a stalled machine lets the stick go."""
    steer(robot, 0.0, 0.8, 8.0)
    robot.judge.until_standing(5.0)
    return keyframes(robot) >= SEEN_ALL_ROUND


def proposed_rooms(robot: Robot) -> list[Json]:
    """Return the rooms of the map that wait for a name, or have one."""
    rooms: list[Json] = robot.system.http("GET", "/v1/places").body["proposed_rooms"]
    return rooms


def change_over(robot: Robot, path: str, mapping: str | None) -> None:
    """Have the wizard begin or save a map, and wait until the robot stands ready on it."""
    asked = robot.system.http("POST", path, {"source": "page"})
    assert asked.status == 202, asked.body
    until(lambda: is_at(robot, mapping), CHANGE_LIMIT_S, path, robot.system.read_log)
    until(lambda: is_localized(robot), CHANGE_LIMIT_S, "a pose", lambda: localization(robot))
    robot.rest()


def test_the_wizard_maps_a_home_its_room_is_named_and_the_robot_drives_in_it(home: Path) -> None:
    robot = Robot(home)
    try:
        robot.start()
        robot.rest()
        change_over(robot, "/v1/wizard/map", "home")
        again = robot.system.http("POST", "/v1/wizard/map", {"source": "page"})
        assert (again.status, again.code) == (409, "mapping_already")
        until(lambda: has_seen_all_round(robot), TURNS_S, "a map that grows", robot.judge.describe)
        change_over(robot, "/v1/wizard/map/save", None)
        assert (home / "sites" / "home" / "map.yaml").is_file()
        assert robot.system.http("GET", "/v1/map").body["growing"] is None
        names = {"name": {"en": "attic", "zh": "阁楼"}, "room": "room_1", "source": "page"}
        named = robot.system.http("POST", "/v1/places", names)
        assert named.status == 201, named.body
        assert next(one["known_as"] for one in proposed_rooms(robot)) == named.body["id"]
        goal = robot.system.give("go to the attic")
        ended = robot.system.until_goal(goal["id"], *ENDED, limit_s=60.0)
        assert ended["state"] == "succeeded", (ended, robot.judge.describe())
        robot.judge.assert_no_contact()
    finally:
        robot.close()
