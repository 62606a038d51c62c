"""Open the page in a real browser, on a really running robot that thinks with a mock model.

Owns one Chromium, robot and mock for all stories of the page, and what a failed story shows.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import pytest
from playwright.sync_api import Browser, BrowserContext, Error, Page, sync_playwright

from planner.settings import FILE
from scripts.browser import CHROMIUM, behind, chromium
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ENDED, new_home
from tests.pons.mock_llm.mocks import RunningMock, running_mock
from tests.web.person import ended

ROOT = Path(__file__).resolve().parents[2]
LAPTOP = (1280, 800)
ORDER = "go to the kitchen"
"""What Chromium's microphone hears."""
STORY_LIMIT_S = 120

MODEL = """
[model]
url = "{url}"
name = "mock"
timeout_s = 8
rest_s = 4
keep_replies = 5
"""

OpenPage = Callable[..., Page]


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Keep one headless Chromium, or skip aloud."""
    found = chromium()
    if found is None:
        pytest.skip(f"no Chromium here (looked for {', '.join(CHROMIUM)}); .ci/run installs it")
    if not (ROOT / "web" / "dist" / "index.html").is_file():
        pytest.skip("the page is not built; `make page` builds it")
    arguments = ["--no-sandbox"] if os.geteuid() == 0 else []  # root may not have its sandbox
    with TemporaryDirectory(prefix="pons-chromium-") as folder, sync_playwright() as playwright:
        arguments += ["--use-fake-device-for-media-stream", *heard_by(Path(folder))]
        command = behind(Path(folder), found)
        made = playwright.chromium.launch(executable_path=command, args=arguments)
        yield made
        made.close()


def heard_by(folder: Path) -> list[str]:
    """Return what lets Chromium's microphone hear ORDER, where a voice is installed."""
    if (voice := shutil.which("espeak-ng")) is None:
        return []
    sound = folder / "order.wav"
    subprocess.run([voice, "-v", "en-us", "-s", "140", "-w", str(sound), "--", ORDER], check=True)
    return [f"--use-file-for-fake-audio-capture={sound}%noloop"]


@pytest.fixture(scope="session")
def served() -> Iterator[RunningMock]:
    """Serve one mock model for all stories of the page."""
    with running_mock() as made:
        yield made


@pytest.fixture(scope="session")
def running(browser: Browser, served: RunningMock) -> Iterator[Robot]:
    """Keep one robot for all stories of the page; after the browser: none is started in vain."""
    assert browser.is_connected()
    with new_home() as home:
        (Path(home) / FILE).write_text(MODEL.format(url=served.url), "utf-8")
        robot = Robot(Path(home))
        try:
            robot.start()
            yield robot
        finally:
            robot.close()


@pytest.fixture
def robot(running: Robot, served: RunningMock) -> Robot:
    """Return the robot at rest, its model well and believed."""
    served.set()
    running.rest()
    until(lambda: _believed(running), 15.0, "the model being believed again")
    return running


@pytest.fixture
def model(robot: Robot, served: RunningMock) -> RunningMock:
    """Return the mock model that the robot thinks with."""
    return served


def _believed(robot: Robot) -> bool:
    """Tell whether the model is asked; where it is on trial, give it a goal to prove itself."""
    brain = robot.system.http("GET", "/v1/robot").body["brain"]
    if (brain["breaker"], brain["last_error"]) == ("closed", None):
        return True
    goal = robot.system.give("wait 0.1 seconds")
    robot.system.until_goal(goal["id"], *ENDED)
    return False


@pytest.fixture
def open_page(browser: Browser, robot: Robot) -> Iterator[OpenPage]:
    """Return what opens a page as a person has it: size, language, theme.

    Every page is held to the house's law: nothing said in the console, no request elsewhere.
    """
    contexts: list[BrowserContext] = []
    PAGES.clear()
    complaints: list[str] = []
    address = f"http://127.0.0.1:{robot.system.port}"

    def watch(page: Page) -> None:
        page.on("pageerror", lambda error: complaints.append(f"error: {error}"))
        page.on(
            "console",
            lambda line: complaints.append(line.text) if not expected(line.text) else None,
        )
        page.on(
            "request",
            lambda request: (
                complaints.append(f"asks {request.url}")
                if not request.url.startswith((address, "data:"))
                else None
            ),
        )

    def opened(
        size: tuple[int, int] = LAPTOP,
        locale: str = "en-US",
        before: Callable[[Page], Any] | None = None,
        fragment: str = "",
        **more: Any,
    ) -> Page:
        viewport = {"width": size[0], "height": size[1]}
        context = browser.new_context(viewport=viewport, locale=locale, **more)  # type: ignore[arg-type]
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(15_000)
        watch(page)
        PAGES.append(page)
        if before is not None:
            before(page)
        page.goto(f"{address}/#{fragment}" if fragment else address)
        page.wait_for_selector("#link[data-state=good]")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert complaints == []


PAGES: list[Page] = []
"""The pages of the newest story, for what a failed one shows."""


def seen(page: Page) -> str:
    try:
        return page.inner_text("body", timeout=2000)
    except Error as trouble:
        return f"cannot be read: {trouble.message}"


TRIES = 3


T = TypeVar("T")


def set_off(robot: Robot, order: Callable[[], T]) -> T:
    """Give an order until the robot really drives; return what the order returned.

    A machine that stalls for 0.25 s disarms the robot: then it rests, and the order is given again.
    """
    for _ in range(TRIES - 1):
        given = order()
        try:
            robot.judge.until_moving()
        except AssertionError:
            robot.rest()
        else:
            return given
    given = order()
    robot.judge.until_moving()
    return given


ARRIVAL_S = 60.0


def arrived(robot: Robot, page: Page, goal_id: str) -> str:
    """Wait until a goal has succeeded; return what its line in the page says.

    What a stall of this machine has stopped, a person lets go on: armed again, and Resume pressed.
    """

    def done() -> bool:
        page.wait_for_timeout(200)  # the page's own sockets are served meanwhile
        goal = robot.system.goal(goal_id)
        if goal["state"] == "paused" and goal["reason"].startswith(("fault", "disarmed")):
            robot.system.operate("reset" if robot.judge.status.mode == "FAULT" else "arm")
            resume = page.locator(f"#notice-resume, .turn[data-goal='{goal_id}'] button.main").first
            if robot.judge.status.mode == "HOLD" and resume.is_visible():
                resume.click()
        assert goal["state"] not in ("failed", "refused", "cancelled"), goal
        return bool(goal["state"] == "succeeded")

    until(done, ARRIVAL_S, f"goal {goal_id} succeeded", robot.judge.describe)
    return ended(page, goal_id)


def anywhere(robot: Robot) -> Callable[[], object]:
    """Return the order, over HTTP, to drive to the nearest place that is worth a drive."""
    return lambda: robot.system.give(f"go to the {robot.elsewhere().name.en}")


# What a browser itself says where a planner is gone or refuses: no fault of the page.
_EXPECTED = re.compile(r"WebSocket connection to|Failed to load resource")


def expected(line: str) -> bool:
    return bool(_EXPECTED.search(line))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Give stories longer than unit tests: a browser beside a robot is slow to start."""
    for item in items:
        if Path(__file__).parent in item.path.parents and not item.get_closest_marker("timeout"):
            item.add_marker(pytest.mark.timeout(STORY_LIMIT_S))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Show the ends of all logs beside a failed story."""
    report = yield
    robot = getattr(item, "funcargs", {}).get("robot")
    if report.failed and isinstance(robot, Robot):
        if report.when == "call":
            report.sections.extend(("page", seen(page)) for page in PAGES)
        report.sections.append(("logs", robot.system.logs()))
    return report
