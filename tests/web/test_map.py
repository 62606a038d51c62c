"""A person turns the map, reads its names, moves what they drew and what they taught on it.

The page is a real one on the planner's own routes; the robot stands, and is the test's.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from itertools import combinations
from math import cos, pi, sin
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, CDPSession, FloatRect, Page

from planner.memory import MemoryStore, Recollection
from planner.mission.given_points import RobotSurvey
from planner.site import KnownPlaces, TaughtPlaces
from planner.site.marks import marks_path
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices
from tests.planner.api.serving import Served, request, served
from tests.planner.api.test_place_routes import Heard
from tests.planner.mission.live import StraightRouter
from tests.web.conftest import expected
from tests.web.person import click_at, pixel_of
from tests.wire.examples import STATUS
from wire import Answer, Pose2, Twist2

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=2)]

PHONE, DESK = (390, 844), (1440, 900)
HOLD_MS, FRAMES_MS = 700, 300
FREE = ((0.9, 4.4), (0.9, 3.8))
BOX = [[2.0, 3.5], [2.6, 3.5], [2.6, 4.1], [2.0, 4.1]]
STANDS = {"base_in_map": Pose2(1.5, 1.5, 0.5), "measured": Twist2(0.0, 0.0)}

Open = Callable[..., Page]


@pytest.fixture
def planner(tmp_path: Path) -> Iterator[Served]:
    """Serve a planner that keeps places and marks, with a place and a mark on its map."""
    services = FakeServices()
    site = services.site
    status = STATUS.model_copy(update={**STANDS, "map_id": site.map_id})
    services.robot._status = status
    services.robot.verdict = Answer(id="x", kind="marks", accepted=True, code="ok", detail="")
    store = TaughtPlaces.in_home(tmp_path)
    services.memory = KnownPlaces(site, store, marks=marks_path(tmp_path, site.map_id))
    services.memory.use(RobotSurvey(Heard(services), StraightRouter()))
    services.recollection = Recollection(MemoryStore(StateDatabase(tmp_path)))
    with served(services) as server:
        x_m, y_m = FREE[0]
        plant = {"name": {"en": "plant", "zh": "植物"}, "point": {"x_m": x_m, "y_m": y_m}}
        assert http(server, "PUT", "/v1/places/plant", plant)[0] == 201
        marks = {"version": 1, "map_id": site.map_id, "keep_outs": [BOX]}
        assert http(server, "PUT", "/v1/marks", {"marks": marks})[0] == 200
        yield server


def http(server: Served, method: str, path: str, body: Any = None) -> tuple[int, Any]:
    """Ask the planner as the page does."""
    lines = ("Content-Type: application/json",) if body is not None else ()
    content = b"" if body is None else json.dumps(body).encode()
    return server.ask(request(method, path, content, *lines))


@pytest.fixture
def opened(browser: Browser, planner: Served) -> Iterator[Open]:
    """Return what opens the page; its console must stay empty."""
    complaints: list[str] = []

    def open_page(size: tuple[int, int], locale: str = "en-US", **more: Any) -> Page:
        viewport: Any = {"width": size[0], "height": size[1]}
        context = browser.new_context(viewport=viewport, locale=locale, **more)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("console", lambda line: complaints.append(line.text))
        page.goto(f"http://127.0.0.1:{planner.port}")
        page.locator("#map .name-place").first.wait_for(state="attached")
        page.locator("path.mark-out[d^=M]").wait_for(state="attached")
        return page

    yield open_page
    for context in browser.contexts:
        context.close()
    assert [line for line in complaints if not expected(line)] == []


def drag(
    page: Page, start: tuple[float, float], end: tuple[float, float], hold_ms: int = 0
) -> None:
    """Press at a point of the map [m], stay as long, and let go at another."""
    page.mouse.move(*pixel_of(page, *start))
    page.mouse.down()
    page.wait_for_timeout(hold_ms)
    page.mouse.move(*pixel_of(page, *end), steps=4)
    page.mouse.up()


def names(page: Page) -> list[FloatRect]:
    """Return the boxes of all names that are shown."""
    shown = page.locator("#map .nameplates > :not(.crowded) > span").all()
    return [box for name in shown if (box := name.bounding_box()) is not None]


def overlap(one: FloatRect, other: FloatRect) -> bool:
    across = min(one["x"] + one["width"], other["x"] + other["width"]) - max(one["x"], other["x"])
    down = min(one["y"] + one["height"], other["y"] + other["height"]) - max(one["y"], other["y"])
    return across > 1.0 and down > 1.0  # a pixel is the browser's own rounding


def plant(planner: Served) -> tuple[float, float]:
    [taught] = http(planner, "GET", "/v1/places")[1]["taught"]
    return taught["pose"]["x_m"], taught["pose"]["y_m"]


def keep_out(planner: Served) -> list[list[float]]:
    [outline] = http(planner, "GET", "/v1/marks")[1]["marks"]["keep_outs"]
    return list(outline)


@pytest.mark.parametrize("size", [PHONE, DESK], ids=["phone", "desk"])
def test_names_stand_upright_and_apart_however_the_map_is_turned(
    opened: Open, size: tuple[int, int]
) -> None:
    page = opened(size)
    page.focus("#map")
    for key in ("", "]", "]", "n", "+", "0"):
        if key:
            page.keyboard.press(key)
        page.wait_for_timeout(FRAMES_MS)
        boxes = names(page)
        assert len(boxes) >= 3, f"after {key!r}"
        assert not any(overlap(*pair) for pair in combinations(boxes, 2)), f"after {key!r}"
        assert all(box["height"] < 30 for box in boxes), f"after {key!r}"
        assert page.locator("#compass").count() == int(key == "]")


def test_a_menu_goes_with_the_map_and_esc_closes_it(opened: Open) -> None:
    page = opened(DESK)
    click_at(page, *FREE[1])
    menu = page.locator(".point-menu")
    before = menu.bounding_box()
    page.focus("#map")
    page.keyboard.press("+")
    page.wait_for_timeout(FRAMES_MS)
    assert menu.bounding_box() != before
    page.keyboard.press("]")  # a pixel is found again on a map that is turned
    page.keyboard.press("Escape")
    menu.wait_for(state="detached")


def test_a_saved_mark_is_changed_by_its_corners_and_holds_until_then(
    opened: Open, planner: Served
) -> None:
    page = opened(DESK)
    page.click("#layers summary")
    page.get_by_role("button", name="Change: Stay out 1").click()
    page.click("#layers summary")
    drag(page, (2.6, 4.1), (2.6, 4.6))
    click_at(page, 2.3, 3.3)  # one corner more, in the side that is nearest
    assert keep_out(planner) == BOX
    with page.expect_response("**/v1/marks"):
        page.click("#mark-save")
    page.locator("#announcer", has_text="Saved").wait_for()
    changed = keep_out(planner)
    assert len(changed) == 5
    assert changed[1] == pytest.approx([2.3, 3.3], abs=0.03)
    assert changed[3] == pytest.approx([2.6, 4.6], abs=0.03)


def test_a_place_is_dragged_or_moved_by_keys_and_stays_where_it_is_refused(
    opened: Open, planner: Served
) -> None:
    page = opened(DESK)
    with page.expect_response("**/v1/places/plant"):
        drag(page, *FREE, hold_ms=HOLD_MS)
    page.locator("#announcer", has_text="Moved").wait_for()
    assert plant(planner) == pytest.approx(FREE[1], abs=0.05)
    page.wait_for_timeout(2 * FRAMES_MS)  # the page learns of it
    with page.expect_response("**/v1/places/plant") as answered:
        drag(page, FREE[1], (0.0, 3.0), hold_ms=HOLD_MS)
    assert answered.value.status >= 400
    page.locator("#announcer .bad").wait_for()
    assert page.locator(".place-move").get_attribute("d") == ""
    assert plant(planner) == pytest.approx(FREE[1], abs=0.05)
    click_at(page, *FREE[1])
    page.click("#place-move")
    page.focus("#map")
    page.keyboard.press("ArrowRight")
    with page.expect_response("**/v1/places/plant"):
        page.keyboard.press("Enter")
    page.locator("#announcer", has_text="Moved").wait_for()
    assert plant(planner) != pytest.approx(FREE[1], abs=0.05)


def touch(session: CDPSession, kind: str, *points: tuple[float, float]) -> None:
    """Put fingers on the screen, move or lift them, as a touch screen does."""
    fingers = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)]
    session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})


def width_px(page: Page) -> float:
    """Return how wide the map is on the screen [px]; while it is not turned."""
    box = page.locator(".drawing").bounding_box()
    assert box is not None
    return box["width"]


def test_two_fingers_zoom_and_turn_the_map_and_are_no_tap(opened: Open) -> None:
    page = opened(PHONE, has_touch=True, is_mobile=True)
    box = page.locator("#map").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    screen = page.context.new_cdp_session(page)
    fitted, compass = width_px(page), page.locator("#compass svg")
    touch(screen, "touchStart", (x - 40, y), (x + 40, y))
    for way in range(45, 81, 5):
        touch(screen, "touchMove", (x - way, y), (x + way, y))
    touch(screen, "touchEnd")
    page.wait_for_timeout(FRAMES_MS)
    assert width_px(page) / fitted == pytest.approx(2.0, rel=0.1)
    assert compass.count() == 0, "two fingers that zoom turn nothing"
    touch(screen, "touchStart", (x - 60, y), (x + 60, y))
    for step in range(1, 13):
        dx, dy = 60 * cos(step * pi / 24), 60 * sin(step * pi / 24)
        touch(screen, "touchMove", (x - dx, y - dy), (x + dx, y + dy))
    touch(screen, "touchEnd")
    turned = float(compass.evaluate("e => parseFloat(e.style.rotate)"))
    assert pi / 4 < turned < pi / 2, "so far as the fingers turned, once they clearly did"
    assert page.locator(".point-menu").count() == 0
    page.locator("#compass").tap()
    compass.wait_for(state="detached")
    assert width_px(page) / fitted == pytest.approx(2.0, rel=0.1)
