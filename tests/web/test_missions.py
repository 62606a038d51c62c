"""The list of missions on the page: found, looked at, and its recording scrubbed by keyboard."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage, arrived, set_off
from tests.web.person import give

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]

PHONE = (390, 844)
STEPS = 5
"""Tab, mission, scrubber and two keys: what a person does to see the robot as it was."""


def to_missions(page: Page) -> None:
    page.click("#tab-missions")
    page.wait_for_selector("#missions")


def sideways(page: Page) -> int:
    return int(page.evaluate("document.documentElement.scrollWidth - innerWidth"))


@pytest.mark.parametrize(("size", "locale"), [((1440, 900), "en-US"), (PHONE, "zh-CN")])
def test_a_mission_is_found_and_its_recording_scrubbed(
    robot: Robot, open_page: OpenPage, size: tuple[int, int], locale: str
) -> None:
    place = robot.elsewhere()
    text = f"go to the {place.name.en}" if locale == "en-US" else f"去{place.name.zh}"
    page = open_page(size, locale)
    arrived(robot, page, set_off(robot, lambda: give(page, text)))
    to_missions(page)
    page.locator("button.mission").first.click()
    page.wait_for_selector(".mission-way polyline", timeout=30_000)
    page.locator(".scrub input").focus()
    before = page.locator("#mission .now").inner_text()
    for _ in range(STEPS):
        page.keyboard.press("ArrowRight")
    assert page.locator("#mission .now").inner_text() != before
    assert sideways(page) <= 0
    page.locator("#mission button").first.click()
    page.wait_for_selector("#missions")


def test_what_nobody_said_is_not_found_and_html_stays_text(
    robot: Robot, open_page: OpenPage
) -> None:
    page = open_page()
    give(page, "<b>what</b> can you do?")
    to_missions(page)
    page.wait_for_selector("button.mission")
    assert page.locator("button.mission b").count() == 0
    page.fill("#missions input[type=search]", "nobody said this")
    page.wait_for_selector("#missions p.fine")
    assert page.locator("button.mission").count() == 0
