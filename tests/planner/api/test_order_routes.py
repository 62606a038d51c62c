"""Standing orders over HTTP: given, listed, shown, paused, removed; by an operator alone."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.api import Access
from planner.orders.order import MAX_ORDERS, Firing, FiringState
from planner.orders.store import OrderStore
from planner.plan import QuietHours
from planner.plan.timing import CronRule
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.planner.orders.fakes import NOON_UNIX_S, FakeMissions, MovedClocks, standing_orders

VIEWER = {"Authorization": "Bearer viewer-token-viewer"}
DAY_BEFORE_SUMMER_UNIX_S = 1_806_145_200.0
"""2027-03-27 12:00 in Berlin: at 02:00 of the next night clocks go on to 03:00."""


@pytest.fixture
def clock() -> MovedClocks:
    return MovedClocks()


@pytest.fixture
def services(tmp_path: Path, clock: MovedClocks) -> FakeServices:
    made = FakeServices()
    quiet = QuietHours(22 * 60, 7 * 60)
    made.orders = standing_orders(tmp_path, clock, FakeMissions(clock, "two_room"), quiet)
    return made


def give(client: TestClient, **body: Any) -> Any:
    return client.post("/v1/orders", json=body)


def test_an_order_is_given_listed_shown_paused_and_removed(client: TestClient) -> None:
    made = give(client, text="every evening at eight go to the kitchen", source="page")
    assert made.status_code == 201, made.text
    order = made.json()
    assert order["id"] == "o1"
    assert order["next"] == "2027-01-15T20:00:00+01:00"
    assert order["told"]["en"] == "Every day at 20:00 I will go to the kitchen. Next: today 20:00."
    assert order["told"]["zh"] == "每天 20:00，我会去厨房。下一次：今天 20:00。"
    assert [step["kind"] for step in order["may"]] == ["go_to"]
    listed = client.get("/v1/orders").json()
    assert listed["timezone"] == "Europe/Berlin"
    assert listed["quiet"] == "22:00–07:00"
    assert [each["id"] for each in listed["orders"]] == ["o1"]
    shown = client.get("/v1/orders/o1").json()
    assert shown["runs"][:2] == ["2027-01-15T20:00:00+01:00", "2027-01-16T20:00:00+01:00"]
    assert shown["history"] == []
    assert client.post("/v1/orders/o1/pause", json={}).json()["state"] == "paused"
    assert client.get("/v1/orders/o1").json()["runs"] == []
    assert client.get("/v1/orders/o1").json()["resumes"] is None
    assert client.post("/v1/orders/o1/resume", json={}).json()["state"] == "active"
    assert client.request("DELETE", "/v1/orders/o1", json={}).status_code == 200
    assert client.get("/v1/orders").json()["orders"] == []


def test_runs_of_all_orders_are_listed_and_bounded(client: TestClient) -> None:
    give(client, text="every evening at eight go to the kitchen")
    assert client.get("/v1/orders/firings").json() == {"firings": []}
    assert client.get("/v1/orders/firings?limit=0").status_code == 422


def test_a_run_that_was_missed_is_told_with_its_reason_in_both_languages(
    client: TestClient, tmp_path: Path
) -> None:
    order = give(client, text="every evening at eight go to the kitchen").json()["id"]
    missed = Firing(
        order=order, serial=1, due_unix_s=NOON_UNIX_S - 3_600.0, at_unix_s=NOON_UNIX_S,
        state=FiringState.MISSED, reason="disarmed",
    )  # fmt: skip
    OrderStore(StateDatabase(tmp_path)).keep([], [missed])
    [told] = client.get("/v1/orders/firings").json()["firings"]
    assert (told["state"], told["reason"]) == ("missed", "disarmed")
    assert told["text"] == "every evening at eight go to the kitchen"
    assert told["told"] == {
        "en": "Missed: “every evening at eight go to the kitchen” (today 11:00), "
        "because I was not armed.",
        "zh": "错过了：“every evening at eight go to the kitchen”（今天 11:00），因为我没有解锁。",
    }


def test_a_day_is_left_out_until_the_order_is_resumed(client: TestClient) -> None:
    give(client, text="every evening at eight go to the kitchen")
    skipped = client.post("/v1/orders/o1/skip", json={"day": "2027-01-15"}).json()
    assert skipped["skipped"] == ["2027-01-15"]
    assert skipped["when"]["en"] == "every day at 20:00 (not on Friday 2027-01-15)"
    assert skipped["when"]["zh"] == "每天 20:00（周五 2027-01-15除外）"
    assert client.get("/v1/orders/o1").json()["runs"][0] == "2027-01-16T20:00:00+01:00"
    over = client.post("/v1/orders/o1/skip", json={"day": "2027-01-14"})
    assert (over.status_code, over.json()["code"]) == (422, "order_change_none")
    assert client.post("/v1/orders/o1/resume", json={}).json()["skipped"] == []


def test_the_same_order_again_is_the_one_that_is_kept(client: TestClient) -> None:
    first = give(client, text="every evening at eight go to the kitchen")
    again = give(client, text="each evening at 8 pm go to the kitchen")
    assert (first.status_code, again.status_code) == (201, 200)
    assert again.json()["id"] == first.json()["id"]


@pytest.mark.parametrize(
    ("when", "kind"),
    [
        ({"cron": "0 20 * * 1-5"}, "cron"),
        ({"at": "2027-01-16T09:00:00+01:00"}, "at"),
        ({"in_s": 1200}, "at"),
        ({"every_s": 3600}, "every"),
        ({"event": "battery_low"}, "event"),
    ],
)
def test_a_time_may_be_given_apart(client: TestClient, when: dict[str, Any], kind: str) -> None:
    made = give(client, text="go to the kitchen", when=when)
    assert made.status_code == 201, made.text
    assert made.json()["rule"]["kind"] == kind


def test_a_reminder_may_be_given_apart(client: TestClient) -> None:
    made = give(client, reminder="stop the oven", when={"in_s": 600})
    assert made.status_code == 201, made.text
    assert made.json()["order"] == "say “stop the oven”"
    assert made.json()["does"]["en"] == "remind you: “stop the oven”"


@pytest.mark.parametrize(
    ("body", "status", "code"),
    [
        ({"text": "go to the kitchen"}, 422, "order_malformed"),
        ({"text": "every day, every hour go to the kitchen"}, 422, "order_nested"),
        ({"text": "daily at 9 say hello", "when": {"in_s": 60}}, 422, "order_nested"),
        ({"text": "every day go to the kitchen"}, 422, "order_time_missing"),
        ({"text": "every day at eight"}, 422, "order_empty"),
        ({"text": "today at nine go to the kitchen"}, 422, "order_in_past"),
        ({"text": "say hello", "when": {"at": "2020-01-01T00:00:00Z"}}, 422, "order_in_past"),
        ({"text": "say hello", "when": {"at": "2999-01-01T00:00:00Z"}}, 422, "order_too_far"),
        ({"text": "go to the kitchen", "when": {"cron": "* * * * *"}}, 422, "order_too_often"),
        ({"text": "go to the kitchen", "when": {"cron": "* * * * * *"}}, 422, "order_malformed"),
        ({"text": "go to the kitchen", "when": {"every_s": 1}}, 422, "order_too_often"),
        ({"text": "go to the kitchen", "when": {"cron": "30 3 * * *"}}, 422, "order_always_quiet"),
        ({"text": "go to the moon", "when": {"in_s": 60}}, 422, "order_unclear"),
        ({"text": "fly", "when": {"in_s": 60}}, 422, "order_unclear"),
        ({"text": "stop", "when": {"in_s": 60}}, 422, "order_stops"),
        ({"text": "今天九点去厨房"}, 422, "order_in_past"),
        ({"text": "every second go to the kitchen"}, 422, "order_too_often"),
        ({"text": "every minute go to the kitchen"}, 422, "order_too_often"),
        ({"text": "每秒去厨房"}, 422, "order_too_often"),
        ({"text": "每分钟去厨房"}, 422, "order_too_often"),
        ({"text": "每10秒去厨房"}, 422, "order_too_often"),
        ({"text": "every 10 seconds go to the kitchen"}, 422, "order_too_often"),
        ({"text": "每天，每小时去厨房"}, 422, "order_nested"),
        ({"text": "停", "when": {"in_s": 60}}, 422, "order_stops"),
        ({"text": "pause for now", "when": {"in_s": 60}}, 422, "order_is_command"),
        ({"text": "yes", "when": {"in_s": 60}}, 422, "order_is_command"),
        ({"text": "if you see a cup, " * 4 + "say hello", "when": {"in_s": 60}}, 422,
         "order_not_understood"),
        ({"text": "如果看到杯子，就" * 4 + "说你好", "when": {"in_s": 60}}, 422,
         "order_not_understood"),
        ({"text": "go to the kitchen", "when": {}}, 422, "invalid_request"),
        ({"text": "x", "when": {"in_s": 60, "every_s": 900}}, 422, "invalid_request"),
        ({"text": "x", "when": {"event": "full_moon"}}, 422, "invalid_request"),
        ({"text": "x", "when": {"in_s": 1e12}}, 422, "invalid_request"),
        ({"text": "x", "when": {"at": "2027-01-16T09:00:00"}}, 422, "invalid_request"),
        ({"reminder": "tea"}, 422, "invalid_request"),
        ({}, 422, "invalid_request"),
        ({"text": "say hello", "when": {"in_s": -60}}, 422, "invalid_request"),
        ({"text": "every day at noon say hello" + " and hello" * 30}, 422, "order_too_long"),
        ({"text": "每天中午" + "去厨房，" * 80}, 422, "order_too_long"),
        ({"text": "say " + "y" * 500, "when": {"in_s": 60}}, 422, "order_too_long"),
        ({"text": "y" * 10_240}, 422, "order_too_long"),
        ({"reminder": "y" * 301, "when": {"in_s": 60}}, 422, "order_too_long"),
        ({"text": "y" * 20_001}, 422, "invalid_request"),
    ],
)  # fmt: skip
def test_what_can_not_be_kept_is_refused_with_a_code(
    client: TestClient, services: FakeServices, body: dict[str, Any], status: int, code: str
) -> None:
    answer = give(client, **body)
    assert (answer.status_code, answer.json()["code"]) == (status, code), answer.text
    assert services.orders.keeper.book.orders == {}
    told = answer.json()["message"]
    assert told["en"] != told["zh"]


@pytest.mark.parametrize("path", ["/v1/orders", "/v1/goals", "/v1/memory/facts", "/v1/places"])
@pytest.mark.parametrize("body", ['{"text":%s}', '{"text":"say hello","when":%s,"name":%s}'])
def test_a_body_that_is_nested_without_end_is_refused_with_a_code(
    client: TestClient, services: FakeServices, path: str, body: str
) -> None:
    deep = body.replace("%s", "[" * 20_000 + "]" * 20_000)
    answer = client.post(path, content=deep, headers={"content-type": "application/json"})
    assert (answer.status_code, answer.json()["code"]) == (400, "malformed_json")
    assert "nested too deep" in answer.json()["detail"]
    assert services.goals.calls == []


def test_no_more_orders_are_kept_than_a_page_can_show(
    client: TestClient, services: FakeServices
) -> None:
    keeper, portal = services.orders.keeper, client.portal
    assert portal is not None
    first = give(client, text="say hello", when={"cron": "0 8 * * *"})
    (kept,) = keeper.book.orders.values()
    for number in range(2, MAX_ORDERS + 1):  # not by HTTP: requests have a rate
        rule = CronRule(cron=f"{number % 60} {9 + number // 60} * * *")
        order = kept.model_copy(update={"id": f"o{number}", "number": number, "rule": rule})
        portal.call(partial(keeper.keep, order))
    answers = [
        give(client, text=text, when={"cron": "0 20 * * *"}) for text in ("say hello", "去厨房")
    ]
    assert first.status_code == 201
    for full in answers:
        assert full.json()["code"] == "orders_full", full.text
        assert full.json()["message"]["en"] != full.json()["message"]["zh"]
    assert len(services.orders.keeper.book.orders) == MAX_ORDERS


def test_many_orders_at_once_are_a_few_and_each_other_says_why(
    client: TestClient, services: FakeServices
) -> None:
    answers = [
        give(client, text="say hello", when={"cron": f"{n % 60} {8 + n // 60 % 12} * * *"})
        for n in range(150)
    ]
    made = [each for each in answers if each.status_code == 201]
    assert 0 < len(made) == len(services.orders.keeper.book.orders) <= MAX_ORDERS
    codes = {each.json()["code"] for each in answers if not each.is_success}
    assert codes <= {"too_many_goals", "orders_full"}
    assert "too_many_goals" in codes


@pytest.mark.parametrize(
    "text", ["tomorrow at 2:30 say hello", "明天凌晨两点半说你好", "明天2点30分说你好"]
)
def test_a_time_that_tomorrow_skips_is_refused(
    services: FakeServices, client: TestClient, clock: MovedClocks, text: str
) -> None:
    clock.unix_s = DAY_BEFORE_SUMMER_UNIX_S
    answer = give(client, text=text)
    assert (answer.status_code, answer.json()["code"]) == (422, "order_time_unknown"), answer.text
    told = answer.json()["message"]
    assert "02:30" in told["en"]
    assert "02:30" in told["zh"]
    assert services.orders.keeper.book.orders == {}


def test_a_viewer_may_look_and_change_nothing(services: FakeServices) -> None:
    access = Access(
        "127.0.0.1", hosts=frozenset({"testserver", "127.0.0.1"}),
        operator_token="operator-token-operator", viewer_token="viewer-token-viewer",
    )  # fmt: skip
    with client_of(services, access) as client:
        assert client.get("/v1/orders", headers=VIEWER).status_code == 200
        for method, path in (
            ("POST", "/v1/orders"),
            ("POST", "/v1/orders/o1/pause"),
            ("POST", "/v1/orders/o1/resume"),
            ("DELETE", "/v1/orders/o1"),
            ("POST", "/v1/goals/g1/answer"),
            ("POST", "/v1/goals/g1/confirm"),
        ):
            body = {"text": "every day at eight go to the kitchen"}
            answer = client.request(method, path, json=body, headers=VIEWER)
            assert (answer.status_code, answer.json()["code"]) == (403, "operator_needed")
    assert services.orders.keeper.book.orders == {}
    assert services.goals.calls == []


@pytest.mark.parametrize("order_id", ["o7", "kitchen", "o" + "1" * 40])
def test_an_order_that_nobody_gave_is_unknown(client: TestClient, order_id: str) -> None:
    give(client, text="every evening at eight go to the kitchen")
    for answer in (
        client.get(f"/v1/orders/{order_id}"),
        client.post(f"/v1/orders/{order_id}/pause", json={}),
        client.request("DELETE", f"/v1/orders/{order_id}", json={}),
    ):
        assert (answer.status_code, answer.json()["code"]) == (404, "unknown_order")
        assert answer.json()["detail"].endswith("known: o1")
        assert order_id[:40] in answer.json()["message"]["zh"]


def test_a_calendar_is_told_first_and_kept_by_a_yes(client: TestClient) -> None:
    give(client, text="every evening at eight go to the kitchen")
    answer = client.get("/v1/orders.ics")
    assert answer.headers["content-type"] == "text/calendar; charset=utf-8"
    assert "DTSTART;TZID=Europe/Berlin:20270115T200000\r\nRRULE:FREQ=DAILY" in answer.text
    client.request("DELETE", "/v1/orders/o1", json={})
    told = client.post("/v1/orders.ics", json={"calendar": answer.text}).json()
    assert (told["kept"], told["refused"]) == ([], [])
    [proposed] = told["proposed"]
    assert proposed["when"]["en"] == "every day at 20:00"
    assert proposed["does"]["en"] == "go to the kitchen"
    assert client.get("/v1/orders").json()["orders"] == []
    other = client.post("/v1/orders.ics", json={"calendar": answer.text, "agreed": "0" * 32})
    assert (other.status_code, other.json()["code"]) == (409, "calendar_changed")
    agreed = {"calendar": answer.text, "agreed": told["agree"]}
    assert client.post("/v1/orders.ics", json=agreed).json()["kept"] == ["o2"]
    again = client.post("/v1/orders.ics", json={"calendar": answer.text}).json()
    assert [each["code"] for each in again["refused"]] == ["calendar_kept"]
    broken = client.post("/v1/orders.ics", json={"calendar": "hello"})
    assert (broken.status_code, broken.json()["code"]) == (422, "calendar_malformed")
