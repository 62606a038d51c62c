"""The page never tells a person what is not so: whatever dies, what it shows as now is now."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from math import hypot
from threading import Event, Thread
from typing import TYPE_CHECKING

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage, anywhere, arrived, set_off
from tests.web.person import Claim, give, look, note_presses, pressed_s

if TYPE_CHECKING:
    from playwright.sync_api import Page, WebSocketRoute

    from wire import SimTruth

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=2)]

NEAR_M = 0.25
"""The stand-in's noise, and the pixel below which the page lets its robot be."""
PAST_S = 1.6
"""What is shown as now is at most a second old; the rest is the way there and a busy machine."""
SURE_MOVING_MPS = 0.10


def assert_true(robot: Robot, claim: Claim, at_s: float) -> None:
    """Hold that what the page showed as now was so within the last moments."""
    truths = [truth for _, truth in robot.judge.truths.since(at_s - PAST_S, at_s + 0.3)]
    assert truths, "no truth was heard"
    if claim.at_m is not None:
        away_m = min(_away_m(claim.at_m, truth) for truth in truths)
        assert away_m < NEAR_M, (claim, away_m)
    speeds = [abs(truth.twist.v_mps) + abs(truth.twist.w_radps) for truth in truths]
    if claim.moving is False:
        assert min(speeds) < SURE_MOVING_MPS, (claim, speeds[::10])
    if claim.moving is True:
        assert max(speeds) > 0.01, (claim, speeds[::10])


def _away_m(at_m: tuple[float, float], truth: SimTruth) -> float:
    return hypot(at_m[0] - truth.base_in_map.x_m, at_m[1] - truth.base_in_map.y_m)


def watch(robot: Robot, page: Page, seconds: float) -> list[Claim]:
    """Read the page for so long and hold every claim to the truth."""
    claims, end_s = [], time.monotonic() + seconds
    while time.monotonic() < end_s:
        at_s = time.monotonic()
        claims.append(look(page))
        assert_true(robot, claims[-1], at_s)
        page.wait_for_timeout(50)
    return claims


def test_a_killed_planner_is_told_and_nothing_goes_on_by_itself(
    robot: Robot, open_page: OpenPage
) -> None:
    page = open_page()
    place = robot.elsewhere()
    goal_id = set_off(robot, lambda: give(page, f"go to the {place.name.en}"))
    before = watch(robot, page, 0.5)
    assert before[-1].moving is True
    assert before[-1].link == "good"
    with away(robot):
        page.locator("#lost[data-why=planner]").wait_for()
        lost = watch(robot, page, 1.5)
        assert all(one.link == "bad" for one in lost)
        assert (lost[-1].mode, lost[-1].moving, lost[-1].at_m) == (None, None, None)
        assert lost[-1].goals is None
        assert "connection lost" in page.inner_text("#link")
        assert page.inner_text(".motion").startswith("Last heard")
        # Stop is there and says that nobody confirms it.
        page.keyboard.press("Escape")
        page.locator("#stop-state.bad").wait_for()
    page.wait_for_selector("#link[data-state=good]", timeout=60_000)
    page.locator(f".turn[data-goal='{goal_id}'][data-state=paused]").wait_for()
    assert "Pons was restarted" in page.inner_text("#said")
    page.locator("#notice.asks").wait_for()
    after = watch(robot, page, 1.5)
    assert after[-1].moving is False
    assert after[-1].at_m is not None
    assert after[-1].goals == {goal_id: "paused"}
    page.locator("#lost").wait_for(state="detached")
    # A person lets it go on from the page, and the page tells of the arrival.
    if robot.judge.status.mode == "DISARMED":  # it was away for over 5 s
        page.click("#notice-arm")
        page.get_by_role("button", name="Yes, arm").click()
        page.wait_for_selector("#mode[data-mode=HOLD]")
    page.get_by_role("button", name="Resume").click()
    assert place.name.en in arrived(robot, page, goal_id)
    robot.assert_there(place)


@contextmanager
def away(robot: Robot) -> Iterator[None]:
    """Kill the planner again and again, so that the one that comes back is not seen at once."""
    enough = Event()

    def kill() -> None:
        while not enough.is_set():
            robot.system.kill("planner")
            enough.wait(0.5)

    killer = Thread(target=kill)
    robot.system.kill("planner")
    killer.start()
    try:
        yield
    finally:
        enough.set()
        killer.join()


def test_what_is_old_is_grey_within_a_second(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    page.evaluate(_STAMP)
    until(lambda: page.evaluate("window.heardMs"), 5.0, "a frame")
    robot.system.freeze("planner")
    try:
        page.locator("#lost[data-why=planner]").wait_for()
        for what in ("#mode.stale", ".robot.stale", ".scan.stale", ".motion.stale", "#said.stale"):
            page.locator(what).wait_for(state="attached")
        took_ms = page.evaluate("window.greyMs - window.heardMs")
        assert took_ms < 1500, took_ms  # a second, and what a busy machine adds
        page.click("#tab-robot")
        links = page.locator("#links [data-source]")
        assert links.evaluate_all("all => all.every((one) => one.matches('.stale'))")
    finally:
        robot.system.thaw("planner")
    page.wait_for_selector("#link[data-state=good]")
    page.locator("#links [data-source=status]:not(.stale)").wait_for()


# When the newest frame came, and when the mode turned grey, on the page's own clock.
_STAMP = """() => {
  const parse = JSON.parse;
  JSON.parse = (text, ...more) => {
    if (typeof text === "string" && text.startsWith('{"seq"')) window.heardMs = performance.now();
    return parse(text, ...more);
  };
  const mode = document.querySelector("#mode");
  new MutationObserver(() => {
    if (mode.matches(".stale")) window.greyMs ??= performance.now();
  }).observe(mode, { attributes: true });
}"""


def test_only_what_is_old_is_grey(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    robot.system.freeze("localization")
    try:
        page.locator(".robot.stale").wait_for(state="attached")
        page.locator(".map-ages", has_text="Position").wait_for()
        assert "Lidar" not in page.inner_text(".map-ages")
        claim = look(page)
        assert (claim.mode is not None, claim.moving, claim.at_m) == (True, False, None)
        assert claim.link == "good"
    finally:
        robot.system.thaw("localization")
    page.locator(".robot:not(.stale)").wait_for()


def test_a_silent_bridge_is_told_while_the_planner_lives(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    robot.system.freeze("bridge")
    try:
        page.locator("#lost[data-why=bridge]").wait_for()
        claim = look(page)
        assert (claim.mode, claim.moving, claim.at_m) == (None, None, None)
        assert "robot silent" in page.inner_text("#link")
    finally:
        robot.system.thaw("bridge")
    page.wait_for_selector("#link[data-state=good]")


HALF = ('{"seq":5,"kind":"rob', "", "null", "[]", "7", '"x"', '{"seq":NaN}', '{"kind":"robot"}')
ODD = (
    '{"seq":1e999,"kind":"gap"}',
    '{"seq":6,"kind":"robot","robot":{"status":{}}}',
    "\x00",
    "{" * 9000,
)


def test_half_frames_change_nothing(robot: Robot, open_page: OpenPage) -> None:
    def spoil(socket: WebSocketRoute) -> None:
        server, broken = socket.connect_to_server(), iter((*HALF, *ODD))

        def passed(message: str | bytes) -> None:
            socket.send(message)
            if (half := next(broken, None)) is not None:
                socket.send(half)

        server.on_message(passed)

    page = open_page(before=lambda page: page.route_web_socket("**/v1/events", spoil))
    page.click("#tab-robot")
    page.locator("#ignored", has_text=str(len(HALF) + len(ODD))).wait_for()
    claim = look(page)
    assert (claim.mode, claim.moving, claim.link) == ("HOLD", False, "good")
    assert_true(robot, claim, time.monotonic())


def test_a_socket_that_is_lost_again_and_again_comes_back(
    robot: Robot, open_page: OpenPage
) -> None:
    dials: list[WebSocketRoute] = []

    def drop(socket: WebSocketRoute) -> None:
        dials.append(socket)
        server, left = socket.connect_to_server(), iter(range(4 if len(dials) < 4 else 10_000))

        def passed(message: str | bytes) -> None:
            if next(left, None) is None:
                socket.close()
            else:
                socket.send(message)

        server.on_message(passed)

    page = open_page(before=lambda page: page.route_web_socket("**/v1/events", drop))

    def dialled() -> bool:
        page.wait_for_timeout(50)  # the page's sockets are served while this waits
        return len(dials) == 4

    until(dialled, 20.0, "the fourth dial")
    page.wait_for_selector("#link[data-state=good]")
    claims = watch(robot, page, 1.0)
    assert claims[-1].link == "good"
    set_off(robot, anywhere(robot))
    page.wait_for_selector("#mode[data-mode=ACTIVE]")
    note_presses(page)
    page.click("#stop")
    page.locator("#stop-state.good").wait_for()
    robot.assert_stops(pressed_s(page))
