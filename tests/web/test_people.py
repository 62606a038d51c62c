"""The owner lets a telephone in by a link, and what it does is the telephone's."""

from __future__ import annotations

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage, anywhere, set_off

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]


def test_a_link_makes_a_page_a_persons_until_it_is_taken_back(
    robot: Robot, open_page: OpenPage
) -> None:
    page = open_page()
    page.locator("#tab-robot").click()
    page.locator("#person-name").fill("Ana's phone")
    page.locator("#people").get_by_role("button", name="Add").click()
    page.locator("#people .qr").wait_for()
    token = page.locator("#pairing-link").inner_text().partition("#")[2]
    theirs = open_page(fragment=token)
    theirs.locator("#tab-robot").click()
    theirs.locator("#links").wait_for()
    assert theirs.locator("#people").count() == 0, "who may use the robot is the owner's to see"
    set_off(robot, anywhere(robot))
    theirs.keyboard.press("Space")
    until(lambda: robot.judge.status.held, 5.0, "the stop that holds the robot")
    page.locator("#tab-drive").click()
    paused = page.locator(".turn[data-state=paused]")
    paused.locator(".reason", has_text="stopped by anas-phone").wait_for()
    assert robot.system.goal(paused.get_attribute("data-goal") or "")["stopped_by"] == "anas-phone"
    page.locator("#tab-robot").click()
    people = page.locator("#people")
    people.get_by_role("button", name="Remove: Ana's phone").click()
    people.get_by_role("button", name="Yes, remove").click()
    people.locator("[data-person]").wait_for(state="detached")
    assert robot.system.http("GET", "/v1/people").body["people"] == []
