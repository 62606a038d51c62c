"""A page below a path of a proxy drives and stops the robot, and asks nothing elsewhere."""

from __future__ import annotations

import pytest
from playwright.sync_api import Browser

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.web.conftest import expected
from tests.web.person import give
from tests.web.sub_path_proxy import below_a_path

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]


def test_a_page_below_a_path_drives_and_stops_the_robot(robot: Robot, browser: Browser) -> None:
    said: list[str] = []
    with below_a_path(robot.system.port) as proxy, browser.new_context() as context:
        page = context.new_page()
        page.set_default_timeout(45_000)
        page.on("console", lambda line: said.append(line.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.goto(proxy.address)
        page.wait_for_selector("#link[data-state=good]")
        page.wait_for_selector("#map .drawing")
        give(page, f"go to the {robot.elsewhere().name.en}")
        robot.judge.until_moving()
        with page.expect_request(f"{proxy.address}v1/stop"):
            page.click("#stop")
        until(robot.judge.standing, 5.0, "standing", robot.judge.describe)
        page.locator("#stop-state.good", has_text="confirmed by the robot").wait_for()
    assert proxy.beside == []
    assert [line for line in said if not expected(line)] == []
