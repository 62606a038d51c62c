"""A person points at the map: goes to a point, by pointer or keys, and draws where to stay out."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

import pytest
from playwright.sync_api import Page

from tests.e2e.robot import Robot
from tests.e2e.system import ENDED
from tests.web.conftest import OpenPage, arrived, set_off
from tests.web.person import click_at, ended

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=2)]

PHONE, DESK = (390, 844), (1440, 900)
SPOTS = ((1.6, 4.6), (1.5, 1.7))
FENCED_OFF = ((2.0, 3.5), (2.6, 3.5), (2.6, 4.1), (2.0, 4.1))
REACHED_M = 0.10


@pytest.fixture
def unmarked(robot: Robot) -> Iterator[Robot]:
    """Return the robot with nothing drawn on its map, before and after."""
    yield robot
    shown = robot.system.http("GET", "/v1/marks").body
    if shown["marks_hash"] is not None:
        marks = {"version": 1, "map_id": shown["map_id"]}
        robot.system.http("PUT", "/v1/marks", {"marks": marks, "before": shown["marks_hash"]})


def away_m(robot: Robot, spot: tuple[float, float]) -> float:
    here = robot.judge.truth.base_in_map
    return hypot(here.x_m - spot[0], here.y_m - spot[1])


def newest(robot: Robot) -> str:
    return str(robot.system.goals()[0]["id"])


@pytest.mark.parametrize("size", [PHONE, DESK], ids=["phone", "desk"])
def test_a_tap_and_two_words_send_it_to_a_point(
    robot: Robot, open_page: OpenPage, size: tuple[int, int]
) -> None:
    spot = max(SPOTS, key=lambda each: away_m(robot, each))
    page = open_page(size)

    def go() -> None:
        click_at(page, *spot)
        page.click("#point-go")

    set_off(robot, go)
    page.locator("#to-go").wait_for()
    goal_id = newest(robot)
    told = arrived(robot, page, goal_id)
    assert "point (" in told
    assert "by the page" in told
    assert away_m(robot, spot) <= REACHED_M + 0.05  # by the simulator's truth, less the click's


def test_the_arrow_keys_and_enter_do_what_a_pointer_does(robot: Robot, open_page: OpenPage) -> None:
    page = open_page(DESK)
    page.focus("#map")
    for _ in range(2):
        page.keyboard.press("Shift+ArrowUp" if away_m(robot, SPOTS[0]) > 1.5 else "Shift+ArrowDown")
    page.keyboard.press("Enter")
    page.locator(".point-menu").wait_for()
    page.locator("#point-face").focus()
    page.keyboard.press("Enter")
    page.focus("#map")
    page.keyboard.press("Shift+ArrowRight")
    with page.expect_response("**/v1/goals") as answered:
        page.keyboard.press("Enter")
    goal_id = answered.value.json()["id"]
    page.locator(f".turn[data-goal='{goal_id}'] .step").first.wait_for(state="attached")
    step = robot.system.goal(goal_id)["plan"]["steps"][0]
    assert step["kind"] == "go_to_pose"
    assert step["yaw_rad"] == pytest.approx(0.0, abs=0.1)
    page.click("#stop")


@pytest.mark.parametrize("size", [PHONE, DESK], ids=["phone", "desk"])
def test_an_outline_is_drawn_saved_and_kept_to(
    unmarked: Robot, open_page: OpenPage, size: tuple[int, int]
) -> None:
    page = open_page(size)
    first, *others = FENCED_OFF
    click_at(page, *first)
    page.click("#mark-out")
    for corner in others:
        click_at(page, *corner)
    page.click("#mark-save")
    page.locator("#announcer", has_text="Saved").wait_for()
    page.wait_for_function("document.querySelector('path.mark-out').getAttribute('d') !== ''")
    shown = unmarked.system.http("GET", "/v1/marks").body
    assert len(shown["marks"]["keep_outs"]) == 1
    assert shown["agreed"]
    click_at(page, 2.3, 3.8)
    page.click("#point-go")
    page.locator("#announcer", has_text="stay out").wait_for()
    said = ended(page, newest(unmarked), "refused")
    assert "stay out" in said
    page.click("#layers summary")
    page.get_by_role("button", name="Delete: Stay out 1").click()
    page.locator("#announcer", has_text="Deleted").wait_for()
    assert unmarked.system.http("GET", "/v1/marks").body["marks"]["keep_outs"] == []


def test_a_robot_that_an_outline_holds_is_sent_out_and_the_outline_is_saved_then(
    unmarked: Robot, open_page: OpenPage
) -> None:
    here = unmarked.judge.truth.base_in_map
    page = open_page(PHONE)
    around = [(here.x_m + x, here.y_m + y) for x, y in ((-0.4, -0.4), (0.4, -0.4), (0.4, 0.4))]
    click_at(page, here.x_m - 0.4, here.y_m + 0.4)
    page.click("#mark-out")
    for corner in around:
        click_at(page, *corner)
    page.click("#mark-save")
    page.locator("#outline", has_text="I stand inside. Out of it are").wait_for()
    set_off(unmarked, lambda: page.click("#mark-leave"))
    page.locator("#announcer", has_text="Saved").wait_for(timeout=40_000)
    marks = unmarked.system.http("GET", "/v1/marks").body
    assert (len(marks["marks"]["keep_outs"]), marks["agreed"]) == (1, True)
    there = unmarked.judge.truth.base_in_map
    assert max(abs(there.x_m - here.x_m), abs(there.y_m - here.y_m)) > 0.4, "outside"
    back = {"map_id": marks["map_id"], "points": [{"x_m": SPOTS[0][0], "y_m": SPOTS[0][1]}]}
    goal = unmarked.system.http("POST", "/v1/goals", back).body
    unmarked.system.until_goal(goal["id"], *ENDED, limit_s=40.0)


def test_an_outline_that_crosses_itself_can_not_be_saved(
    unmarked: Robot, open_page: OpenPage
) -> None:
    page: Page = open_page(DESK)
    a, b, c, d = FENCED_OFF
    click_at(page, *a)
    page.click("#mark-out")
    for corner in (c, b, d):
        click_at(page, *corner)
    page.locator("#outline", has_text="crosses").wait_for()
    assert page.locator("#mark-save").is_disabled()
