"""Stop works from the page by button, by Space and by Esc, and says what the bridge says."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from planner.api.schemas import OperatorProof
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage, anywhere, set_off
from tests.web.person import note_presses, pressed_s
from wire import sign

if TYPE_CHECKING:
    from playwright.sync_api import Page, Route, WebSocketRoute

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=2)]


def by_button(page: Page) -> None:
    page.click("#stop")


def by_space(page: Page) -> None:
    page.focus("#tab-robot")
    page.keyboard.press("Space")


def by_escape(page: Page) -> None:
    page.focus("#goal-text")
    page.keyboard.press("Escape")


def hang(page: Page) -> None:
    """Let no POST be answered: the socket alone must do."""
    page.route("**/v1/stop", lambda route: None)


def no_socket(page: Page) -> None:
    """Let the page see all and say nothing over its socket: the POST alone must do."""

    def mute(socket: WebSocketRoute) -> None:
        server = socket.connect_to_server()
        socket.on_message(lambda message: None)
        server.on_message(socket.send)

    page.route_web_socket("**/v1/events", mute)


@pytest.mark.parametrize(
    ("press", "lame"),
    [(by_button, None), (by_button, hang), (by_space, no_socket), (by_escape, None)],
)
def test_stop_stops(
    robot: Robot,
    open_page: OpenPage,
    press: Callable[[Page], None],
    lame: Callable[[Page], None] | None,
) -> None:
    page = open_page(before=lame)
    set_off(robot, anywhere(robot))
    page.wait_for_selector("#mode[data-mode=ACTIVE]")
    note_presses(page)
    press(page)
    page.locator("#stop-state.good", has_text="confirmed by the robot").wait_for()
    robot.assert_stops(pressed_s(page))
    status = robot.judge.status
    assert status.held is not None
    assert status.held.reason == "stop"
    page.locator(".turn[data-state=paused]").wait_for()


def test_space_and_letters_in_the_goal_box_are_text(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    page.focus("#goal-text")
    page.keyboard.type("go to the sofa")
    assert page.input_value("#goal-text") == "go to the sofa"
    assert page.inner_text("#stop-state") == ""
    held = robot.judge.status.held
    assert held is None or held.reason != "stop"


def test_a_stop_that_nobody_confirms_is_red_and_says_so(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    robot.system.freeze("planner")
    try:
        page.click("#stop")
        page.locator("#stop-state.bad", has_text="NOT confirmed").wait_for()
    finally:
        robot.system.thaw("planner")
    # What waited in the planner's sockets stops the robot after all, and the page tells.
    page.locator("#stop-state.good").wait_for()
    until(lambda: robot.judge.status.held is not None, 1.0, "a hold", robot.judge.describe)


def test_arming_is_another_act_and_takes_two(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    robot.system.operate("disarm")
    page.wait_for_selector("#mode[data-mode=DISARMED]")
    page.click("#notice-arm")
    page.keyboard.press("Space")  # a nervous thumb stops; it does not arm
    page.locator("#stop-state.good").wait_for()
    assert robot.judge.status.mode == "DISARMED"
    page.get_by_role("button", name="Yes, arm").click()
    page.wait_for_selector("#mode[data-mode=HOLD]")
    assert robot.judge.status.mode == "HOLD"


def test_a_proof_needs_a_key_on_metal(robot: Robot, open_page: OpenPage) -> None:
    sent: list[dict[str, object]] = []

    def metal(socket: WebSocketRoute) -> None:
        server = socket.connect_to_server()
        server.on_message(
            lambda text: socket.send(str(text).replace('"virtual":true', '"virtual":false'))
        )

    def keep(route: Route) -> None:
        sent.append(dict(route.request.post_data_json or {}))
        route.fulfill(json={})

    page = open_page(before=lambda page: page.route_web_socket("**/v1/events", metal))
    page.route("**/v1/arm", keep)
    page.click("#tab-robot")
    page.click("#robot-arm")
    yes = page.get_by_role("button", name="Yes, arm")
    assert yes.is_disabled()
    key = "a key of sixteen bytes or more"
    page.locator(".question input[type=password]").fill(key)
    page.keyboard.press("Tab")
    yes.click()
    until(lambda: len(sent) == 1, 5.0, "the order to arm")
    operator = OperatorProof.model_validate(sent[0]["operator"])
    status = robot.judge.status
    made = sign(key.encode(), "arm", status.robot, operator.proof.nonce, operator.id)
    assert operator.proof == made
    kept = page.evaluate("JSON.stringify([localStorage, sessionStorage, location.href])")
    assert key not in kept
