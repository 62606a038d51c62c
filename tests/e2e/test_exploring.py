"""A home nobody knows is explored upon one sentence, and becomes a site."""

from __future__ import annotations

from pathlib import Path

import pytest

from maps import FREE, load_map
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ENDED, TWO_ROOM, Json
from tests.e2e.test_mapping import keyframes

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.timeout(240), pytest.mark.nightly]

ORDERS, EXPLORE_S = 2, 110.0


def floor_m2(site: Path) -> float:
    """Return how much floor the map of a site has."""
    grid = load_map(site / "map.yaml").grid
    return grid.cells.count(FREE) * grid.resolution_m**2


def test_a_home_is_explored_by_a_sentence_and_made_a_site(home: Path) -> None:
    robot = Robot(home)
    robot.system.arguments = ("--map", "attic")
    try:
        robot.start()
        robot.rest()
        until(lambda: keyframes(robot) >= 1, 15.0, "a first look", lambda: keyframes(robot))
        ended: Json = {}
        for _ in range(ORDERS):
            goal = robot.system.give("explore the house")
            ended = robot.system.until_goal(goal["id"], *ENDED, limit_s=EXPLORE_S)
            robot.judge.assert_no_contact()
            assert ended["state"] == "succeeded", (ended, robot.judge.describe())
            if ended["outcome"]["code"] == "explored":
                break
        assert ended["outcome"]["code"] == "explored", ended
        made = robot.system.pons("map", "attic")
        assert made.returncode == 0, (made.stdout, made.stderr)
        checked = robot.system.pons("site", "rooms", "attic")
        assert checked.returncode == 0, (checked.stdout, checked.stderr)
        assert floor_m2(home / "sites" / "attic") > 0.9 * floor_m2(TWO_ROOM)
    finally:
        robot.close()
