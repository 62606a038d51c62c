"""A person teaches a place on the page, sends the robot there, and has it forgotten."""

from __future__ import annotations

import pytest

from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage, arrived
from tests.web.person import click_at, give

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]


def test_a_place_is_taught_driven_to_and_forgotten(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    page.click("#tab-places")
    page.fill("#teach-en", "reading corner")
    page.fill("#teach-zh", "阅读角")
    page.get_by_role("button", name="A point on the map").click()
    point = robot.elsewhere().pose
    click_at(page, point.x_m, point.y_m)  # gives the point, and is no goal
    page.get_by_role("button", name="Remember this point").click()
    line = page.locator("#taught li[data-place=reading_corner]")
    line.wait_for()
    assert "阅读角" in line.inner_text()
    assert "running" not in {goal["state"] for goal in robot.system.goals()}
    page.click("#tab-drive")
    goal_id = give(page, "去阅读角")
    arrived(robot, page, goal_id)
    outcome = robot.system.goal(goal_id)["outcome"]
    assert outcome["message"]["en"] == "Arrived: reading corner."
    page.click("#tab-places")
    line.get_by_role("button", name="Forget").click()
    line.get_by_role("button", name="Yes, forget it").click()
    line.wait_for(state="detached")
    page.click("#tab-drive")
    give(page, "go to the reading corner")
    page.locator("#asked .clarify", has_text="reading corner").wait_for()
