"""The page shows what the robot sees: picture with boxes, things on the map and in a list."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage
from tests.web.test_looks import PHONE, assert_fits, violations
from tests.web.test_rest import hide

if TYPE_CHECKING:
    from playwright.sync_api import Page, Request, Route, WebSocketRoute

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]

CUP: dict[str, Any] = {
    "id": "cup_1",
    "label": "cup",
    "name": {"en": "red cup", "zh": "红色的杯子"},
    "color": "red",
    "x_m": 1.0,
    "y_m": 1.0,
    "z_m": 0.5,
    "sigma_m": 0.06,
    "confidence": 0.9,
    "age_s": 0.2,
    "room": None,
    "sightings": 4,
}
BALL = {**CUP, "id": "ball_2", "name": {"en": "<b>ball</b>", "zh": "<b>球</b>"}, "color": "no such"}
BOXES = [
    {"label": "cup", "name": CUP["name"], "score": 0.8, "box": [10, 9, 60, 70], "color": "red",
     "id": "cup_1"},
    {"label": "ball", "name": BALL["name"], "score": 0.5, "box": [250, 0, 320, 240], "color": None,
     "id": None},
]  # fmt: skip


class Scene:
    """Stand between planner and page: what is seen is what a test says."""

    def __init__(self) -> None:
        self.sight: dict[str, Any] = {
            "version": 1,
            "blind": None,
            "message": None,
            # Told once, and young for as long as a slow browser takes to show it.
            "look": {"seq": 7, "age_s": -600.0, "width": 320, "height": 240, "placed": True,
                     "boxes": BOXES},
            "things": [],
        }  # fmt: skip
        self.objects = [CUP, BALL]
        self.asked: list[tuple[str, str]] = []
        self._socket: WebSocketRoute | None = None
        self._seq = 0

    def stand(self, page: Page) -> None:
        """Take the planner's place where eyes are concerned."""
        page.route_web_socket("**/v1/events", self._join)
        page.route("**/v1/objects", self._list)
        page.route("**/v1/objects/*", self._forget)
        page.route("**/v1/goals", self._refuse)
        page.on("request", self._note)

    def tell(self, **changes: Any) -> None:
        """Send the page what is seen now."""
        self.sight = {**self.sight, **changes}
        self._send({"kind": "sight", "sight": self.sight})

    def count(self, path: str) -> int:
        """Return how often the page asked for a path."""
        return sum(url.endswith(path) for _, url in self.asked)

    def _join(self, socket: WebSocketRoute) -> None:
        self._socket, server = socket, socket.connect_to_server()
        server.on_message(lambda text: self._send(json.loads(text)))

    def _send(self, frame: dict[str, Any]) -> None:
        if frame["kind"] == "snapshot":
            frame["sight"] = self.sight
        elif frame["kind"] == "sight" and frame["sight"] is not self.sight:
            return
        self._seq += 1
        assert self._socket is not None
        self._socket.send(json.dumps({**frame, "seq": self._seq}))

    def _list(self, route: Route) -> None:
        version = self.sight["version"]
        route.fulfill(json={"version": version, "blind": None, "objects": self.objects})

    def _forget(self, route: Route) -> None:
        self.objects = [one for one in self.objects if not route.request.url.endswith(one["id"])]
        route.fulfill(json={"forgotten": []})

    def _refuse(self, route: Route) -> None:
        route.fulfill(status=503, json={"code": "planner_silent", "detail": ""})

    def _note(self, request: Request) -> None:
        self.asked.append((request.method, request.url))


@pytest.mark.parametrize(
    ("size", "locale", "go", "forget", "order"),
    [
        ((1280, 800), "en-US", "Go to it: red cup", "Forget: red cup", "go to the red cup"),
        (PHONE, "zh-CN", "过去: 红色的杯子", "忘记: 红色的杯子", "去红色的杯子那里"),
    ],
    ids=["wide", "phone"],
)
def test_what_is_seen_is_shown_and_may_be_gone_to_and_forgotten(
    robot: Robot,
    open_page: OpenPage,
    size: tuple[int, int],
    locale: str,
    go: str,
    forget: str,
    order: str,
) -> None:
    scene = Scene()
    page = open_page(size, locale, before=scene.stand)
    language = "en" if locale == "en-US" else "zh"
    marks = page.locator("#map .thing")
    marks.nth(1).wait_for(state="attached")
    assert set(marks.all_text_contents()) == {CUP["name"][language], BALL["name"][language]}
    assert page.locator("#map .thing.color-red").count() == 1
    page.click("#tab-objects")
    page.locator("#objects li[data-thing=cup_1]").wait_for()
    page.get_by_role("button", name=go).focus()
    with page.expect_request("**/v1/goals") as given:
        page.keyboard.press("Enter")
    assert (given.value.post_data_json or {})["text"] == order
    page.get_by_role("button", name=forget).click()
    assert not any(method == "DELETE" for method, _ in scene.asked)  # it asks first
    with page.expect_request("**/v1/objects/cup_1") as forgotten:
        page.locator("#objects li[data-thing=cup_1] button.main").click()
    assert forgotten.value.method == "DELETE"
    scene.tell(version=2)
    page.locator("#objects li[data-thing=cup_1]").wait_for(state="detached")
    assert marks.count() == 1
    assert_fits(page)
    assert violations(page) == []


@pytest.mark.parametrize(("size", "locale"), [((1280, 800), "en-US"), (PHONE, "zh-CN")])
def test_the_picture_is_fetched_only_while_it_is_looked_at(
    robot: Robot, open_page: OpenPage, size: tuple[int, int], locale: str
) -> None:
    asked = ("GET", "/v1/camera.jpg")  # a camera is up after all else
    until(lambda: robot.system.http(*asked).status == 200, 30.0, "the camera's first picture")
    scene = Scene()
    page = open_page(size, locale, before=scene.stand)
    page.locator("#camera summary").wait_for()
    page.wait_for_timeout(500)
    assert scene.count("/v1/camera.jpg") == 0
    page.focus("#camera summary")
    page.keyboard.press("Enter")
    page.locator("#camera .boxes rect").nth(1).wait_for()
    assert CUP["name"]["en" if locale == "en-US" else "zh"] in page.inner_text("#camera figcaption")
    assert_fits(page)
    assert violations(page) == []
    page.wait_for_timeout(500)
    shown = scene.count("/v1/camera.jpg")
    page.wait_for_timeout(1000)
    assert scene.count("/v1/camera.jpg") == shown  # the same look, the same picture
    scene.tell(look={**scene.sight["look"], "seq": 8, "age_s": 1.1})
    until(lambda: _passed(page, scene, shown), 5.0, "another picture")
    page.locator("#camera .boxes").wait_for(state="detached")  # it is too old for them
    page.locator("#camera canvas").wait_for()
    hide(page, "hidden")
    shown = scene.count("/v1/camera.jpg")
    scene.tell(look={**scene.sight["look"], "seq": 9})
    page.wait_for_timeout(800)
    assert scene.count("/v1/camera.jpg") == shown
    hide(page, "visible")
    until(lambda: _passed(page, scene, shown), 5.0, "the picture that was missed")
    page.click("#camera summary")
    shown = scene.count("/v1/camera.jpg")
    scene.tell(look={**scene.sight["look"], "seq": 10})
    page.wait_for_timeout(800)
    assert scene.count("/v1/camera.jpg") == shown


def _passed(page: Page, scene: Scene, shown: int) -> bool:
    page.wait_for_timeout(50)  # the page's sockets are served while this waits
    return scene.count("/v1/camera.jpg") > shown


REASONS = {
    "camera_silent": ("No picture comes", "没有传来画面"),
    "camera_frozen": ("one and the same", "同一张画面"),
    "no_detector": ("Nothing is set that tells", "没有设置识别物体的模型"),
    "detector_down": ("does not answer", "没有响应"),
}


@pytest.mark.parametrize("locale", ["en-US", "zh-CN"])
def test_why_it_is_blind_is_said(robot: Robot, open_page: OpenPage, locale: str) -> None:
    scene = Scene()
    page = open_page(PHONE, locale, before=scene.stand)
    for code, words in REASONS.items():
        scene.tell(blind=code, look=None)
        page.locator("#blind", has_text=words[locale == "zh-CN"]).wait_for()
    assert_fits(page)
    page.click("#tab-objects")
    scene.tell(blind="no_camera")
    page.locator("#camera").wait_for(state="detached")
    said = page.locator("#objects .reason")
    said.get_by_text("no camera" if locale == "en-US" else "没有摄像头").wait_for()
