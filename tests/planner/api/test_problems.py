"""Test that what an API refuses is told wholly in Chinese, too, whatever was sent."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.site_sentences import english_in
from tests.wire.examples import EXAMPLES
from wire import LocalizerStatus

HINT = "/v1/localization/hint"
WRONG: tuple[tuple[str, Any, str], ...] = (
    (HINT, {"point": {"x_m": 1e300, "y_m": 1}}, "应为不大于 10000"),
    (HINT, {"point": {"x_m": -1e300, "y_m": 1}}, "应为不小于 -10000"),
    (HINT, {"point": {"x_m": 1, "y_m": "x"}}, "应为数字，收到 'x'"),
    (HINT, {"point": {"x_m": 1}}, "body.point.y_m：缺少"),
    (HINT, {"point": {"x_m": 1, "y_m": 1, "z_m": 3}}, "未知的键"),
    (HINT, {"point": {"x_m": 1, "y_m": 1}, "place": "kitchen"}, "point 与 place"),
    (HINT, {}, "point 与 place"),
    (HINT, {"place": ""}, "至少 1 个字符"),
    (HINT, {"place": "x" * 300}, "至多 200 个字符"),
    (HINT, [1], "应为 JSON 对象，收到 [1]"),
    ("/v1/orders", {"when": {}, "text": "x"}, "cron、at、in_s"),
    ("/v1/orders", {}, "text 与 reminder"),
    ("/v1/orders", {"reminder": "tea"}, "reminder 需要 when"),
    ("/v1/places", {"name": {"en": "a", "zh": "b"}, "source": "api", "room": "room_1",
                    "point": {"x_m": 1, "y_m": 1}}, "point 与 room"),
    ("/v1/goals", {"text": 7, "source": "api"}, "body.text：应为文字，收到 7"),
    ("/v1/goals", {"text": "go", "speed": 3}, "body.speed：未知的键，值为 3"),
    ("/v1/goals", {}, "text、points 与 steps 三者给一个"),
)  # fmt: skip


@pytest.fixture
def client() -> Iterator[TestClient]:
    services = FakeServices()
    said = EXAMPLES[LocalizerStatus]
    assert isinstance(said, LocalizerStatus)
    services.robot.localizer = said
    with client_of(services) as made:
        yield made


@pytest.mark.parametrize(("route", "sent", "chinese"), WRONG)
def test_a_body_that_does_not_fit(client: TestClient, route: str, sent: Any, chinese: str) -> None:
    answer = client.post(route, json=sent)
    said = answer.json()
    assert (answer.status_code, said["code"]) == (422, "invalid_request")
    assert said["message"]["zh"].startswith("发来的内容无法接受：")
    assert chinese in said["message"]["zh"]
    assert english_in(said["message"]["zh"]) == ""
    assert said["detail"] in said["message"]["en"]


@pytest.mark.parametrize(
    ("raw", "chinese"),
    [
        (b"{x", "第 1 个字符处"),
        (b'{"place": "\xff"}', "不是 UTF-8 文本"),
        (b"[" * 100_000, "嵌套过深"),
    ],
)
def test_a_body_that_is_no_json(client: TestClient, raw: bytes, chinese: str) -> None:
    said = client.post(HINT, content=raw, headers={"content-type": "application/json"}).json()
    assert said["code"] == "malformed_json"
    assert chinese in said["message"]["zh"]
    assert english_in(said["message"]["zh"]) == ""


def test_a_route_and_a_method_that_there_are_not(client: TestClient) -> None:
    method = client.get(HINT).json()
    assert (method["code"], "可用的方法：POST" in method["message"]["zh"]) == (
        "method_not_allowed",
        True,
    )
    route = client.get("/v1/nowhere").json()
    assert (route["code"], english_in(route["message"]["zh"])) == ("unknown_route", "")
    assert route["message"]["en"] == route["detail"]


def test_known_places_have_the_names_of_the_sentences_language(client: TestClient) -> None:
    said = client.post(HINT, json={"place": "moon base"}).json()
    assert said["code"] == "unknown_place"
    assert "已知的地方：客厅" in said["message"]["zh"]
    assert "living_room" in said["detail"]
    assert "living_room" not in said["message"]["zh"] + said["message"]["en"]
