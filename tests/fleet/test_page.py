"""Use the fleet's page as a person does: Chromium, the real service, robots that are servers."""

from __future__ import annotations

import itertools
import os
import re
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

from scripts.browser import CHROMIUM, chromium
from tests.fleet.conftest import ROOT, RunningFleet, StubRobot, until
from tests.known import known

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.long,
    pytest.mark.timeout(300),
    pytest.mark.nightly(keep=1),
]

OPERATOR, VIEWER = "operator-token-of-the-house", "viewer-token-of-the-house"
DESK, PHONE = (1440, 900), (390, 844)
LEAST_STOP_PX = 60
AXE = ROOT / "web" / "node_modules" / "axe-core" / "axe.min.js"
PATIENCE_MS = 30_000
EXPECTED = re.compile("Failed to load resource")  # what a browser says where a service is gone


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    found = chromium()
    if found is None:
        pytest.skip(f"no Chromium here (looked for {', '.join(CHROMIUM)}); .ci/run installs it")
    if not (ROOT / "web" / "dist" / "fleet.html").is_file():
        pytest.skip("the page is not built; `make page` builds it")
    with sync_playwright() as playwright:
        arguments = ["--no-sandbox"] if os.geteuid() == 0 else []
        made = playwright.chromium.launch(executable_path=found, args=arguments)
        yield made
        made.close()


@pytest.fixture
def house(file_fleet: RunningFleet) -> RunningFleet:
    """Return a fleet whose page asks for a token."""
    tokens = {"PONS_FLEET_TOKEN": OPERATOR, "PONS_FLEET_VIEWER_TOKEN": VIEWER}
    file_fleet.environment |= tokens
    file_fleet.client.headers["authorization"] = f"Bearer {OPERATOR}"
    file_fleet.start("fleet.watch.SILENT_S = 1.0", "fleet.page_api.AGAIN_S = 0.5")
    return file_fleet


@pytest.fixture
def open_page(browser: Browser, house: RunningFleet) -> Iterator[Callable[..., Page]]:
    """Return what opens the page; nothing is said in the console and nobody else is asked."""
    contexts, complaints = [], list[str]()
    address = f"http://127.0.0.1:{house.port}/"

    def opened(
        token: str = OPERATOR, size: tuple[int, int] = DESK, locale: str = "en-US", **more: Any
    ) -> Page:
        viewport: Any = {"width": size[0], "height": size[1]}
        context = browser.new_context(viewport=viewport, locale=locale, **more)
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(PATIENCE_MS)
        page.on("pageerror", lambda error: complaints.append(f"error: {error}"))
        page.on("console", lambda line: None if EXPECTED.search(line.text) else
                complaints.append(line.text))  # fmt: skip
        page.on("request", lambda asked: None if asked.url.startswith((address, "data:")) else
                complaints.append(f"asks {asked.url}"))  # fmt: skip
        page.goto(f"{address}#token={token}")
        page.wait_for_selector("#link[data-state=good]")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert complaints == []


def add(house: RunningFleet, *robots: StubRobot) -> None:
    """Add robots in a thread of its own: the browser's loop runs in this one."""
    with ThreadPoolExecutor(1) as pool:
        pool.submit(house.add, *robots).result()


def state_of(page: Page, robot: str) -> str:
    return page.locator(f"[data-robot='{robot}'] .chip").first.inner_text()


def say(page: Page, text: str) -> None:
    page.fill("#say", text)
    page.keyboard.press("Enter")


def assert_fits(page: Page, what: str = "") -> None:
    """Hold that nothing scrolls sideways, and Stop is large, on top and in view unscrolled."""
    size, box = page.viewport_size, page.locator("#stop").bounding_box()
    assert size is not None
    assert box is not None
    assert page.evaluate("document.scrollingElement.scrollWidth") <= size["width"], what
    assert min(box["height"], box["width"]) >= LEAST_STOP_PX, what
    assert box["y"] + box["height"] <= size["height"], what
    middle = [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2]
    at = "([x, y]) => document.elementFromPoint(x, y).closest('button')?.id"
    assert page.evaluate(at, middle) == "stop", what


def violations(page: Page) -> list[str]:
    if not AXE.is_file():
        pytest.skip("axe-core is not installed (web/node_modules); `make dev` installs it")
    page.evaluate(AXE.read_text("utf-8"))
    found: list[Any] = page.evaluate("axe.run().then((done) => done.violations)")
    return [f"{one['id']}: {node['html'][:160]}" for one in found for node in one["nodes"]]


def test_a_sentence_sends_the_right_robot_and_its_question_is_answered(
    house: RunningFleet, make_robot: Callable[[str], StubRobot], open_page: Callable[..., Page]
) -> None:
    near, far = make_robot("near"), make_robot("far")
    near.rule(length_m=1.0, ask=True)
    far.rule(length_m=9.0)
    add(house, near, far)
    page = open_page()
    expect(page.locator("#count")).to_have_text("2 of 2 robots answer")
    expect(page.locator(".robots .robot")).to_have_count(2)
    say(page, "look at the door")
    say_to = page.locator("[data-asks]")
    expect(say_to.locator(".question-words")).to_have_text("Which door?", timeout=PATIENCE_MS)
    expect(say_to.locator("h2")).to_have_text("near asks")
    say_to.locator("input").fill("the back one")
    say_to.locator("button[type=submit]").click()
    expect(page.locator("#missions [data-state=succeeded]")).to_have_count(1, timeout=PATIENCE_MS)
    assert "near" in page.locator("#missions [data-state=succeeded]").inner_text()
    page.fill("#say", "far:")
    page.keyboard.press("Enter")
    expect(page.locator("#announcer .bad")).to_contain_text("Nothing is left to do")


def test_a_stop_of_all_names_who_is_not_reached_until_it_is(
    house: RunningFleet, make_robot: Callable[[str], StubRobot], open_page: Callable[..., Page]
) -> None:
    robots = [make_robot(name) for name in ("r1", "r2", "r3")]
    for robot in robots:
        robot.rule(work_s=600.0)
    add(house, *robots)
    (mission,) = house.give("r3: go to the kitchen")
    house.await_state(mission["id"], "at_robot")
    page = open_page(size=PHONE)
    robots[2].kill()
    row = page.locator(f"[data-mission='{mission['id']}']")
    expect(row).to_have_attribute("data-state", "unknown", timeout=PATIENCE_MS)
    assert re.search(r"unknown since \d\d:\d\d", state_of(page, "r3"))
    page.locator("#stop").click()
    told = page.locator("#stop-state")
    expect(told).to_have_text("2 of 3 confirmed, r3 not reached", timeout=PATIENCE_MS)
    expect(page.locator("[data-robot=r3] .bad-words")).to_be_visible()
    assert_fits(page)
    row.locator("[data-act=give-up]").click()
    expect(row).to_have_attribute("data-state", "given_up", timeout=PATIENCE_MS)
    robots[2].start()
    expect(told).to_have_text("3 of 3 confirmed", timeout=PATIENCE_MS)
    expect(page.locator("[data-robot=r3] .bad-words")).to_have_count(0)


def test_a_viewer_may_look_and_stop_alone(
    house: RunningFleet, make_robot: Callable[[str], StubRobot], open_page: Callable[..., Page]
) -> None:
    robot = make_robot("r1")
    robot.rule(ask=True)
    add(house, robot)
    (mission,) = house.give("r1: look at the door")
    house.await_state(mission["id"], "asking")
    page = open_page(VIEWER)
    expect(page.locator("[data-asks] .question-words")).to_have_text("Which door?")
    assert page.locator("#say, [data-act], .clarify input").count() == 0
    page.keyboard.press("Escape")
    expect(page.locator("#stop-state")).to_have_text("1 of 1 confirmed", timeout=PATIENCE_MS)
    refused = page.evaluate(
        """(token) => fetch("v1/missions", {method: "POST", body: '{"text":"go home"}', headers:
        {"content-type": "application/json", authorization: `Bearer ${token}`}})
        .then((answer) => answer.status)""",
        VIEWER,
    )
    assert refused == 403


def test_a_hostile_robot_harms_no_other_and_writes_no_element(
    house: RunningFleet, make_robot: Callable[[str], StubRobot], open_page: Callable[..., Page]
) -> None:
    markup = "<img src=x onerror=alert(1)><b id=evil>"
    good, huge, garbage, odd = (make_robot(name) for name in ("good", "huge", "garbage", "odd"))
    huge.rule(map="endless")
    garbage.rule(map="garbage", site=markup, question=markup, ask=True)
    add(house, good, huge, garbage, odd)
    odd.rule(status=["not", {"a": "status"}])
    house.give("garbage: look")
    page = open_page()
    expect(page.locator("[data-asks] .question-words")).to_have_text(markup, timeout=PATIENCE_MS)
    expect(page.locator(".robots [data-robot=good]")).to_have_count(1)
    for name in ("huge", "garbage"):
        expect(page.locator(f"[data-robot={name}]").last).to_contain_text("can't be shown")
    expect(page.locator("[data-robot=garbage]").last).to_contain_text(markup)
    assert page.locator("#evil, img[src=x]").count() == 0
    until(lambda: house.states()["odd"] == "robot_silent")
    assert house.states()["good"] == "ready"
    status = Path(f"/proc/{known(house.process).pid}/status").read_text("ascii")
    peak = known(re.search(r"VmHWM:\s+(\d+) kB", status))
    assert int(peak[1]) < 250_000  # the 100 MB were not read


def test_stop_is_in_view_and_axe_finds_nothing_in_every_state(
    house: RunningFleet, make_robot: Callable[[str], StubRobot], open_page: Callable[..., Page]
) -> None:
    """Look at one fleet on eight pages at once: two sizes, two languages, light and dark."""
    kinds = list(itertools.product((DESK, PHONE), ("en-US", "zh-CN"), ("light", "dark")))
    pages = [open_page(size=size, locale=locale, color_scheme=scheme)
             for size, locale, scheme in kinds]  # fmt: skip
    found: list[str] = []

    def look(state: str) -> None:
        for kind, page in zip(kinds, pages, strict=True):
            assert_fits(page, f"{state}: {kind}")
            found.extend(f"{state}: {kind}: {one}" for one in violations(page))

    look("empty")
    robots = [make_robot(f"robot-with-a-long-name-{n}") for n in range(5)]
    robots[0].rule(ask=True, question="Shall I go through every room of the house? " * 40)
    robots[1].rule(work_s=600.0)
    add(house, *robots)
    words = "go to the kitchen " + "and then to the hall " * 30
    given = [house.give(f"{robot.name}: {words}")[0]["id"] for robot in robots]
    house.await_state(given[1], "at_robot")  # what was never sent is not unknown
    for page in pages:
        page.locator("[data-asks]").wait_for()
        field = page.locator("[data-asks] input").bounding_box()
        bar = page.locator(".stopbar").bounding_box()
        assert field is not None
        assert bar is not None
        assert field["y"] + field["height"] <= bar["y"], "the answer is below the fold"
    look("asking")
    robots[1].kill()
    for page in pages:
        page.locator("#missions [data-state=unknown]").wait_for()
        page.locator("#stop").click()
        page.locator("#stop-state.bad[data-phase=idle]").wait_for()
    look("not reached")
    house.kill()
    for page in pages:
        page.locator("#lost").wait_for()
        page.locator("#stop").click()
        page.locator("#stop-state[data-phase=doubtful]").wait_for()
    look("silent")
    assert found == []


def test_a_page_without_a_token_asks_for_it(house: RunningFleet, browser: Browser) -> None:
    page = browser.new_page()
    page.goto(f"http://127.0.0.1:{house.port}/")
    page.locator(".token input").fill(OPERATOR)
    assert_fits(page)
    page.locator(".token button").click()
    page.wait_for_selector("#link[data-state=good]")
    answer = until(lambda: house.client.get("/"))
    assert "script-src 'self'" in answer.headers["content-security-policy"]
    page.close()
