"""The page says who planned, and stops the robot while the model hangs."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from planner.brain.model_error_codes import reason
from tests.e2e.robot import Robot
from tests.pons.mock_llm.mocks import RunningMock
from tests.web.conftest import OpenPage, anywhere, set_off
from tests.web.person import ended, give, note_presses, pressed_s
from tests.web.test_stop import by_button, by_escape, by_space

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]

SHORT = "wait 0.1 seconds"


@pytest.mark.parametrize("press", [by_button, by_space, by_escape])
def test_stop_stops_while_the_model_hangs(
    robot: Robot, model: RunningMock, open_page: OpenPage, press: Callable[[Page], None]
) -> None:
    page = open_page()
    set_off(robot, anywhere(robot))
    page.wait_for_selector("#mode[data-mode=ACTIVE]")
    model.set(fault="hang")
    page.fill("#goal-text", "go to the kitchen")
    page.get_by_role("button", name="Do this instead").click()
    page.locator(".turn[data-state=planning]").wait_for()
    note_presses(page)
    press(page)
    page.locator("#stop-state.good", has_text="confirmed by the robot").wait_for()
    robot.assert_stops(pressed_s(page))
    held = robot.judge.status.held
    assert held is not None
    assert held.reason == "stop"
    model.set()  # lets go of the call, which has no say any more
    robot.judge.assert_never_moves(0.5)


def test_a_plan_is_seen_as_it_is_written(
    robot: Robot, model: RunningMock, open_page: OpenPage
) -> None:
    page = open_page()
    model.set(tokens_per_s=15)
    planned = give(page, "wait 0.1 seconds then wait 0.2 seconds")
    draft = page.locator(f".turn[data-goal='{planned}'] .draft")
    draft.locator(".step", has_text="Wait 0 s").first.wait_for()
    asked = give(page, "where are you?")
    assert "I am in" in ended(page, asked)
    ended(page, planned)
    draft.wait_for(state="detached")
    page.locator("#meter", has_text="calls").wait_for()


@pytest.mark.parametrize(
    ("locale", "stands_in", "rests"),
    [
        ("en-US", "Planned by the robot itself, not by mock.", "The model mock rests"),
        ("zh-CN", "由机器人自己代替 mock 规划。", "模型 mock 暂停"),
    ],
)
def test_the_offline_brain_is_seen_standing_in(
    robot: Robot,
    model: RunningMock,
    open_page: OpenPage,
    locale: str,
    stands_in: str,
    rests: str,
) -> None:
    page = open_page(locale=locale)
    planned = give(page, SHORT)
    ended(page, planned)
    assert page.locator("#mind").count() == 0
    model.set(fault="status", status=500)
    goals = [give(page, SHORT) for _ in range(3)]
    for goal_id in goals:
        ended(page, goal_id)
    language = "en" if locale == "en-US" else "zh"
    why = robot.system.goal(goals[0])["brain"]["fallback_message"][language]
    past = page.locator(f".turn[data-goal='{goals[0]}']")
    past.locator("summary").click()
    assert past.locator(".fell").inner_text() == f"{stands_in} {why}"
    assert past.locator(".fell").get_attribute("data-reason") == "server_error"
    mind = page.locator("#mind[data-breaker=open]")
    mind.wait_for()
    assert rests in mind.inner_text()
    plain = reason("server_error").of(language)
    assert why.startswith(plain), "the server's own words stand behind it, at the goal alone"
    assert plain in mind.inner_text()
    # Well again, it is tried, believed, and nothing is said any more.
    model.set()
    page.locator("#mind[data-breaker=on_trial]").wait_for()
    for _ in range(2):
        ended(page, give(page, SHORT))
    page.locator("#mind").wait_for(state="detached")


@pytest.mark.parametrize(
    ("locale", "title", "used"),
    [("en-US", "What the model wrote", "plan · used"), ("zh-CN", "模型原文", "规划 · 已采用")],
)
def test_what_the_model_wrote_is_shown_on_request(
    robot: Robot, open_page: OpenPage, locale: str, title: str, used: str
) -> None:
    page = open_page(locale=locale)
    planned = give(page, SHORT)
    ended(page, planned)
    past = page.locator(f".turn[data-goal='{planned}']")
    assert past.locator(".replies").count() == 0, "of a goal that is not open nothing is fetched"
    past.locator("summary").click()
    past.get_by_text(title).click()
    reply = past.locator(".replies li[data-turn=plan]")
    assert used in reply.locator("p").inner_text()
    assert '"kind"' in reply.locator("pre").inner_text()
