"""The page can be used by all: on a phone, by keyboard, by screen reader, whatever names hold."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from tests.e2e.robot import Robot
from tests.web.conftest import ROOT, OpenPage, set_off
from tests.web.person import click_at, give

if TYPE_CHECKING:
    from playwright.sync_api import Page, Route

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=3)]

AXE = ROOT / "web" / "node_modules" / "axe-core" / "axe.min.js"
PHONE = (360, 740)
LEAST_STOP_PX = 64
TABS = ("robot", "missions", "log", "orders", "places", "objects", "settings", "drive")


def assert_fits(page: Page) -> None:
    """Hold that nothing scrolls sideways and Stop is whole, large, on top and in view."""
    size = page.viewport_size
    assert size is not None
    wide = page.evaluate("document.scrollingElement.scrollWidth")
    assert wide <= size["width"], page.evaluate(_WIDE)
    box = page.locator("#stop").bounding_box()
    assert box is not None
    assert min(box["height"], box["width"]) >= LEAST_STOP_PX
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= size["width"]
    assert box["y"] + box["height"] <= size["height"]
    on_top = page.evaluate(
        "([x, y]) => document.elementFromPoint(x, y).closest('button')?.id",
        [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2],
    )
    assert on_top == "stop"


_WIDE = """() => [...document.querySelectorAll('*')]
  .filter((one) => one.getBoundingClientRect().right > innerWidth + 0.5)
  .map((one) => one.outerHTML.slice(0, 120))"""


@pytest.mark.parametrize(
    ("size", "locale"),
    [((1280, 800), "en-US"), (PHONE, "en-US"), (PHONE, "zh-CN"), ((740, 360), "zh-CN")],
)
def test_every_view_fits_and_has_a_large_stop(
    robot: Robot, open_page: OpenPage, size: tuple[int, int], locale: str
) -> None:
    page = open_page(size, locale)
    for tab in TABS:
        page.click(f"#tab-{tab}")
        assert_fits(page)
    page.click("#tab-robot")
    page.click("#robot-arm")
    assert_fits(page)


def test_a_phone_gives_a_goal_by_touch_and_stops_it(robot: Robot, open_page: OpenPage) -> None:
    page = open_page(PHONE, has_touch=True, is_mobile=True)
    place = robot.elsewhere()
    page.locator(".names summary").tap()
    set_off(robot, page.get_by_role("button", name=place.name.en, exact=True).tap)
    assert_fits(page)
    page.tap("#stop")
    page.locator("#stop-state.good").wait_for()
    robot.judge.until_standing(3.0)
    assert_fits(page)


def violations(page: Page) -> list[str]:
    """Return what axe finds; it is put in past the page's policy, as a person's extension is."""
    if not AXE.is_file():
        pytest.skip("axe-core is not installed (web/node_modules); `make dev` installs it")
    page.evaluate(AXE.read_text("utf-8"))
    found: list[dict[str, Any]] = page.evaluate("axe.run().then((done) => done.violations)")
    return [
        f"{one['id']}: {node['html'][:160]} {node['failureSummary']}"
        for one in found
        for node in one["nodes"]
    ]


@pytest.mark.parametrize(
    ("locale", "size", "scheme"),
    [("en-US", (1280, 800), "light"), ("zh-CN", PHONE, "dark")],
    ids=["wide", "phone"],
)
def test_axe_finds_nothing(
    robot: Robot, open_page: OpenPage, locale: str, size: tuple[int, int], scheme: str
) -> None:
    page = open_page(size, locale, color_scheme=scheme)
    give(page, "go to the moon")  # a question with its buttons
    page.locator("#asked .clarify").wait_for()
    found = violations(page)
    robot.system.operate("disarm")
    page.locator("#notice.asks").wait_for()
    for tab in TABS:
        page.click(f"#tab-{tab}")
        if tab == "robot":
            page.click("#robot-estop")  # a question about an order
        found += [f"{tab}: {one}" for one in violations(page)]
    robot.system.freeze("planner")
    try:
        page.locator("#lost").wait_for()
        found += [f"lost: {one}" for one in violations(page)]
    finally:
        robot.system.thaw("planner")
    assert found == []


def test_all_can_be_reached_by_keyboard(robot: Robot, open_page: OpenPage) -> None:
    page = open_page()
    page.click("#tab-log")
    page.evaluate("document.activeElement.blur()")
    page.focus("a.skip")
    page.keyboard.press("Enter")
    page.locator("#goal-text:focus").wait_for()
    page.keyboard.type("wait 0.1 seconds")
    page.keyboard.press("Enter")
    page.locator(".turn[data-state=succeeded]").first.wait_for()
    reached = set()
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.id || document.activeElement.tagName"))
    assert {"stop", "goal-text", "tab-drive"} <= reached
    page.focus("#tab-drive")
    page.keyboard.press("ArrowRight")
    page.locator("#tab-orders:focus").wait_for()
    page.keyboard.press("ArrowRight")
    page.locator("#teach-title").wait_for()
    page.focus("#teach-en")  # a name and Enter are enough: the rest of a place is where it stands
    page.keyboard.type("stop")
    page.keyboard.press("Enter")
    page.locator("#announcer", has_text="read as an order").wait_for()


TAG = '<img src=x onerror="document.title=`owned`"><script>document.title="owned"</script>'
NAMES = (TAG, "🛋️👩‍👩‍👧 ﷽ \u202eevil\u202c", "long " * 100, "x" * 500)


def spoiled(robot: Robot) -> dict[str, Any]:
    """Return the site's places with names that a hostile or careless person gave them."""
    content: dict[str, Any] = robot.system.http("GET", "/v1/places").body
    for place, name in zip(content["places"], NAMES * 4, strict=False):
        place["name"] = {"en": name, "zh": name}
    place = {**content["places"][0], "map_id": "0" * 16, "by": TAG, "taught": "none"}
    content["taught"] = [
        {**place, "id": f"t{n}", "name": {"en": name, "zh": TAG}, "why_not": None, "message": None}
        for n, name in enumerate(NAMES)
    ]
    return content


@pytest.mark.parametrize("size", [(1280, 800), PHONE], ids=["wide", "phone"])
def test_names_of_any_kind_are_text(
    robot: Robot, open_page: OpenPage, size: tuple[int, int]
) -> None:
    places = spoiled(robot)

    def serve(route: Route) -> None:
        route.fulfill(json=places)

    page = open_page(size, before=lambda page: page.route("**/v1/places", serve))
    page.locator("#map .name").first.wait_for(state="attached")
    if size == PHONE:
        page.locator(".names summary").click()
    chips = page.locator(".names .chips button").all_inner_texts()
    assert set(map(str.strip, NAMES)) & set(map(str.strip, chips))
    drawn = page.locator("#map .name span").all_text_contents()
    assert set(NAMES) & set(drawn)
    assert_fits(page)
    assert page.title() != "owned"
    assert page.locator("#page img[src=x], #page script").count() == 0
    click_at(page, robot.judge.truth.base_in_map.x_m, robot.judge.truth.base_in_map.y_m)
    page.locator(".map-choice button.main").click()
    page.locator(".turn").first.wait_for()
    assert_fits(page)
    page.click("#tab-places")
    page.locator("#taught li").nth(len(NAMES) - 1).wait_for()
    assert_fits(page)
    assert page.title() != "owned"
    assert page.locator("#page img[src=x], #page script").count() == 0


@pytest.mark.parametrize("text", [TAG, NAMES[1], "x" * 500], ids=["html", "emoji", "long"])
def test_orders_of_any_kind_are_text(robot: Robot, open_page: OpenPage, text: str) -> None:
    page = open_page(PHONE)
    goal_id = give(page, text)
    line = page.locator(f".turn[data-goal='{goal_id}'] .said")
    line.wait_for()
    assert json.dumps(line.inner_text().strip()) == json.dumps(text.strip())
    assert_fits(page)
    assert page.title() != "owned"
    assert page.locator("#page img[src=x], #page script").count() == 0
    robot.judge.assert_never_moves(0.3)
