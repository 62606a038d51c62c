"""The page writes only what a person could see change: it rests while the robot does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage, anywhere, set_off
from tests.web.test_truth import watch

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

LOOKED_MS = 3000
MOST_WRITES = 30
"""In that time. The stand-in's error wanders a pixel now and then; 15 frames a second come."""

_COUNT = """(ms) => new Promise((done) => {
  let count = 0;
  const all = { attributes: true, characterData: true, childList: true, subtree: true };
  const watcher = new MutationObserver((writes) => (count += writes.length));
  watcher.observe(document, all);
  setTimeout(() => done(count), ms);
})"""
_HIDE = """(state) => {
  Object.defineProperty(document, "visibilityState", { configurable: true, value: state });
  document.dispatchEvent(new Event("visibilitychange"));
}"""
_DRAWN = """() => [
  document.querySelector(".robot").style.transform,
  document.querySelector(".scan").getAttribute("d"),
]"""


def writes(page: Page) -> int:
    """Return how often the page is written to within a while."""
    return int(page.evaluate(_COUNT, LOOKED_MS))


def hide(page: Page, state: str) -> None:
    """Let the page be ``hidden`` or ``visible``, as another tab in front makes it."""
    page.evaluate(_HIDE, state)


def test_the_page_of_a_standing_robot_rests(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    page.wait_for_timeout(500)
    assert writes(page) <= MOST_WRITES
    assert page.evaluate("document.getAnimations().length") == 0
    robot.judge.assert_never_moves(0.1)


def test_a_hidden_page_draws_no_map_and_shows_what_is_so_when_it_is_seen_again(
    robot: Robot, open_page: OpenPage
) -> None:
    page = open_page()
    set_off(robot, anywhere(robot))
    hide(page, "hidden")
    before = page.evaluate(_DRAWN)
    page.wait_for_timeout(1000)
    assert page.evaluate(_DRAWN) == before
    hide(page, "visible")
    assert page.evaluate(_DRAWN) != before
    watch(robot, page, 0.5)
