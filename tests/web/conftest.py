"""Open the page in a real browser on a really running two-room robot.

Owns one Chromium and one robot for all stories of the page, and what a failed story shows.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, sync_playwright

from tests.e2e.robot import Robot
from tests.e2e.system import new_home

ROOT = Path(__file__).resolve().parents[2]
CHROMIUM = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
LAPTOP = (1280, 800)

OpenPage = Callable[..., Page]


def chromium() -> str | None:
    """Return the system's Chromium, if there is one."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, CHROMIUM)), None)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Keep one headless Chromium, or skip aloud."""
    found = chromium()
    if found is None:
        pytest.skip(f"no Chromium here (looked for {', '.join(CHROMIUM)}); .ci/run installs it")
    if not (ROOT / "web" / "dist" / "index.html").is_file():
        pytest.skip("the page is not built; `make page` builds it")
    arguments = ["--no-sandbox"] if os.geteuid() == 0 else []  # root may not have its sandbox
    with sync_playwright() as playwright:
        made = playwright.chromium.launch(executable_path=found, args=arguments)
        yield made
        made.close()


@pytest.fixture(scope="session")
def running() -> Iterator[Robot]:
    """Keep one robot for all stories of the page."""
    with new_home() as home:
        robot = Robot(Path(home))
        try:
            robot.start()
            yield robot
        finally:
            robot.close()


@pytest.fixture
def robot(browser: Browser, running: Robot) -> Robot:
    """Return the robot at rest; after the browser, so that none is started in vain."""
    running.rest()
    return running


@pytest.fixture
def open_page(browser: Browser, robot: Robot) -> Iterator[OpenPage]:
    """Return what opens a page as a person has it: size, language, theme.

    Every page is held to the house's law: nothing said in the console, no request elsewhere.
    """
    contexts: list[BrowserContext] = []
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
        **more: Any,
    ) -> Page:
        viewport = {"width": size[0], "height": size[1]}
        context = browser.new_context(viewport=viewport, locale=locale, **more)  # type: ignore[arg-type]
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(15_000)
        watch(page)
        if before is not None:
            before(page)
        page.goto(address)
        page.wait_for_selector("#link[data-state=good]")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert complaints == []


# What a browser itself says where a planner is gone or refuses: no fault of the page.
_EXPECTED = re.compile(r"WebSocket connection to|Failed to load resource")


def expected(line: str) -> bool:
    return bool(_EXPECTED.search(line))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Show the ends of all logs beside a failed story."""
    report = yield
    robot = getattr(item, "funcargs", {}).get("robot")
    if getattr(report, "failed", False) and isinstance(robot, Robot):
        report.sections.append(("logs", robot.system.logs()))
    return report
