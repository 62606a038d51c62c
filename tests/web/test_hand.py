"""A person drives by hand from the page, and whatever takes the hand away stops the robot."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Page

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.web.conftest import TRIES, OpenPage
from wire import Mode

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=2)]

STANDS_S = 3.0
MOVING_MPS = 0.05
LIE_HIDDEN = """() => {
  Object.defineProperty(document, "visibilityState", { value: "hidden", configurable: true });
  document.dispatchEvent(new Event("visibilitychange"));
}"""
KEEP_SOCKETS = """() => {
  const Real = window.WebSocket;
  window.sockets = [];
  window.WebSocket = class extends Real {
    constructor(...given) { super(...given); window.sockets.push(this); }
  };
}"""
CLOSE_HAND = """() => window.sockets.filter((one) => one.url.endsWith("/v1/hand"))
  .forEach((one) => one.close())"""
PULL_OUT = """() => { window.pads = []; dispatchEvent(new Event("gamepaddisconnected")); }"""
FAKE_PAD = """() => {
  const button = { pressed: false };
  const pad = { id: "pad", connected: true, axes: [0, 0, 0, 0],
    buttons: Array.from({ length: 6 }, (_, n) => n === 4 ? button : { pressed: false }) };
  window.pads = [pad];
  navigator.getGamepads = () => window.pads;
}"""
HOLD_PAD = """() => {
  const [pad] = window.pads;
  pad.buttons[4].pressed = true;
  [pad.axes[0], pad.axes[1]] = [-0.7, -0.7];
}"""


@pytest.fixture
def page(robot: Robot, open_page: OpenPage) -> Iterator[Page]:
    """Open the page with its stick, ready to be held."""
    opened = open_page(before=lambda page: page.add_init_script(f"({KEEP_SOCKETS})()"))
    show_stick(opened)
    yield opened
    opened.mouse.up()


def show_stick(page: Page) -> None:
    page.click("#hand summary")
    page.locator("#hand-state", has_text="Ready").wait_for()
    page.locator("#stick").scroll_into_view_if_needed()


def middle(page: Page) -> tuple[float, float]:
    box = page.locator("#stick").bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2.0, box["y"] + box["height"] / 2.0


def hold_mouse(page: Page) -> None:
    """Press the stick in its middle and push it ahead and to the left."""
    x_px, y_px = middle(page)
    page.mouse.move(x_px, y_px)
    page.mouse.down()
    page.mouse.move(x_px - 50.0, y_px - 50.0, steps=4)


def hold_key(page: Page) -> None:
    page.focus("#stick")
    page.keyboard.down("KeyA")
    page.keyboard.down("KeyW")


def is_driven(robot: Robot) -> bool:
    judge = robot.judge
    return judge.status.mode is Mode.TELEOP and judge.truth.twist.v_mps > MOVING_MPS


def driven(robot: Robot, page: Page, hold: Callable[[Page], None]) -> None:
    """Hold until the robot really turns; a machine that stalls is asked again."""
    for _ in range(TRIES):
        hold(page)
        try:
            page.locator("#hand-state.good", has_text="You drive").wait_for(timeout=5_000)
            until(lambda: is_driven(robot), 10.0, "a hand that drives", robot.judge.describe)
        except Exception:  # noqa: BLE001  # whatever came between, the next try or the end says
            page.mouse.up()
            for key in ("KeyA", "KeyW"):
                page.keyboard.up(key)
            robot.rest()
        else:
            return
    raise AssertionError(robot.judge.describe())


WAYS_OUT: dict[str, tuple[Callable[[Page], object], str]] = {
    "release": (lambda page: page.mouse.up(), "Ready"),
    "blur": (lambda page: page.evaluate("dispatchEvent(new Event('blur'))"), "lost the focus"),
    "hidden": (lambda page: page.evaluate(LIE_HIDDEN), "hidden"),
    "socket": (lambda page: page.evaluate(CLOSE_HAND), "connection is lost"),
    "cancel": (
        lambda page: page.dispatch_event("#stick", "pointercancel", {"pointerId": 1}),
        "broken off",
    ),
    "escape": (lambda page: page.keyboard.press("Escape"), "Stop was pressed"),
}


@pytest.mark.parametrize("way_out", WAYS_OUT)
def test_a_held_stick_moves_the_robot_and_its_end_stops_it(
    robot: Robot, page: Page, way_out: str
) -> None:
    driven(robot, page, hold_mouse)
    end, words = WAYS_OUT[way_out]
    end(page)
    robot.judge.until_standing(STANDS_S)
    page.locator("#hand-state", has_text=words).wait_for()
    until(lambda: robot.judge.status.mode is Mode.HOLD, 2.0, "a hold", robot.judge.describe)
    page.wait_for_timeout(600)
    assert robot.judge.status.mode is Mode.HOLD, "a finger that stays down drives no more"


def test_keys_drive_while_the_stick_has_the_focus_and_no_longer(robot: Robot, page: Page) -> None:
    page.focus("#hand input[type=text]")
    page.keyboard.press("KeyA")
    page.locator("#hand input[type=text]").fill("")
    assert robot.judge.status.mode is Mode.HOLD
    driven(robot, page, hold_key)
    page.focus("#hand input[type=text]")
    robot.judge.until_standing(STANDS_S)
    page.locator("#hand-state", has_text="lost the focus").wait_for()
    page.keyboard.up("KeyA")


def test_a_gamepad_that_is_pulled_out_stops_the_robot(robot: Robot, page: Page) -> None:
    page.evaluate(FAKE_PAD)
    page.wait_for_timeout(300)  # it is seen neutral
    driven(robot, page, lambda shown: shown.evaluate(HOLD_PAD))
    page.evaluate(PULL_OUT)
    robot.judge.until_standing(STANDS_S)
    page.locator("#hand-state", has_text="gamepad is gone").wait_for()


def test_one_of_two_people_drives_and_the_other_is_told_who(
    robot: Robot, page: Page, open_page: OpenPage
) -> None:
    page.fill("#hand input[type=text]", "Ana <b>")
    page.locator("#hand input[type=text]").blur()
    other = open_page()
    show_stick(other)
    driven(robot, page, hold_mouse)
    other.locator("#hand-state", has_text="Ana <b> drives").wait_for()
    hold_mouse(other)
    refused = "Ana <b> drives. The stick is free once they let go."
    other.locator("#hand-state", has_text=refused).wait_for()
    other.mouse.up()
    page.wait_for_timeout(300)
    assert robot.judge.status.mode is Mode.TELEOP, "the other's release ends nothing"
    page.mouse.up()
    robot.judge.until_standing(STANDS_S)
    other.locator("#hand-state", has_text="Ready").wait_for()
    driven(robot, other, hold_mouse)
    page.locator("#hand-state", has_text="Somebody else drives").wait_for()
    other.mouse.up()
    robot.judge.until_standing(STANDS_S)


def test_a_goal_that_a_hand_interrupts_is_told_and_resumed(robot: Robot, page: Page) -> None:
    goal = robot.system.give(f"go to the {robot.elsewhere().name.en}")
    page.locator(".hand-goal", has_text="Taking the stick pauses it").wait_for()
    driven(robot, page, hold_mouse)
    page.locator(".hand-goal", has_text="is paused").wait_for()
    page.mouse.up()
    robot.judge.until_standing(STANDS_S)
    page.locator(".hand-goal button").click()
    until(
        lambda: robot.system.goal(goal["id"])["state"] in ("running", "succeeded"),
        10.0,
        "the goal going on",
        robot.judge.describe,
    )
