"""A goal's words are bounded in length and rate, and its numbers in kind; a stop in neither."""

from __future__ import annotations

from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.api import Access
from planner.api.goals import AT_ONCE
from planner.brain.model_replies import ReplyCollector, ReplyTurn
from planner.plan import GoToPose, Language
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of, code


@pytest.mark.parametrize("path", ["/v1/goals", "/v1/goals/g1/answer"])
def test_a_sentence_of_4_000_characters_is_taken_and_a_longer_one_refused(
    client: TestClient, services: FakeServices, path: str
) -> None:
    assert client.post(path, json={"text": "去" * 4_000}).is_success
    answer = client.post(path, json={"text": "去" * 4_001})
    assert (answer.status_code, code(answer)) == (422, "goal_too_long")
    assert "4001 characters; at most 4000" in answer.json()["detail"]
    assert set(answer.json()["message"]) == {"en", "zh"}
    assert len(services.goals.calls) == 1
    assert services.goals.stops == []


@pytest.mark.parametrize("text", ["stop! " + "a" * 100_000, "停！" + "啊" * 5_000])
def test_a_stop_that_is_too_long_for_a_goal_stops(
    client: TestClient, services: FakeServices, text: str
) -> None:
    answer = client.post("/v1/goals", json={"text": text})
    assert (answer.status_code, code(answer)) == (422, "goal_too_long")
    assert services.goals.stops == ["api"]
    assert "told to stop" in answer.json()["message"]["en"]


def test_goals_have_a_rate_and_stops_have_none(client: TestClient) -> None:
    refused: list[str] = []
    for number in range(AT_ONCE + 40):
        path = "/v1/goals" if number % 2 else "/v1/goals/g1/answer"
        answer = client.post(path, json={"text": "go to the kitchen"})
        refused += [code(answer)] if answer.status_code == 429 else []
        for stop in ("stop", "快停下"):
            assert client.post(path, json={"text": stop}).is_success
    assert refused
    assert set(refused) == {"too_many_goals"}


def test_one_address_takes_no_goals_from_another(services: FakeServices) -> None:
    hasty, other = client_of(services), client_of(services)
    answers = [hasty.post("/v1/goals", json={"text": "go"}) for _ in range(AT_ONCE + 20)]
    assert 429 in [answer.status_code for answer in answers]
    assert other.post("/v1/goals", json={"text": "go"}).status_code == 202


@pytest.mark.parametrize(
    ("key", "value"),
    [("dead_man", "yes"), ("dead_man", 1), ("dead_man", "true"), ("v_mps", "0.1"),
     ("w_radps", "0"), ("v_mps", True)],
)  # fmt: skip
def test_steering_takes_nothing_for_what_it_is_not(
    client: TestClient, services: FakeServices, key: str, value: object
) -> None:
    body = {"source": "page-1", "v_mps": 0, "w_radps": 0.1, "dead_man": True}
    assert client.post("/v1/teleop", json={**body, key: value}).status_code == 422
    assert services.robot.steers == []
    assert client.post("/v1/teleop", json=body).status_code == 202


@pytest.mark.parametrize("key", ["confirm", "replace"])
def test_an_option_of_a_goal_is_true_or_false(client: TestClient, key: str) -> None:
    assert client.post("/v1/goals", json={"text": "go", key: "yes"}).status_code == 422


MAP = "0123456789abcdef"


def test_points_of_the_map_are_given_with_its_id_and_in_a_row(
    client: TestClient, services: FakeServices
) -> None:
    points = [{"x_m": 1.5, "y_m": 2, "yaw_rad": 1.0}, {"x_m": 0.0, "y_m": -1.0, "look": True}]
    body = {"points": points, "map_id": MAP, "language": "zh", "replace": True}
    answer = client.post("/v1/goals", json=body, headers={"Idempotency-Key": "k"})
    assert answer.status_code == 202, answer.text
    row = (
        GoToPose(map_id=MAP, x_m=1.5, y_m=2.0, yaw_rad=1.0),
        GoToPose(map_id=MAP, x_m=0.0, y_m=-1.0, look=True),
    )
    assert services.goals.calls == [("give", row, Language.ZH, False, True, "k")]


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"text": "go", "points": [{"x_m": 1.0, "y_m": 2.0}], "map_id": MAP},
        {"points": [{"x_m": 1.0, "y_m": 2.0}]},
        {"text": "go", "map_id": MAP},
        {"points": [], "map_id": MAP},
        {"points": [{"x_m": 1.0, "y_m": 2.0}] * 21, "map_id": MAP},
        {"points": [{"x_m": 1.0}], "map_id": MAP},
        {"points": [{"x_m": "1", "y_m": 2.0}], "map_id": MAP},
        {"points": [{"x_m": 1e9, "y_m": 2.0}], "map_id": MAP},
        {"points": [{"x_m": 1.0, "y_m": 2.0, "yaw_rad": 7.0}], "map_id": MAP},
        {"points": [{"x_m": 1.0, "y_m": 2.0, "yaw_rad": 1.0, "look": True}], "map_id": MAP},
        {"points": [{"x_m": 1.0, "y_m": 2.0, "speed": 9.0}], "map_id": MAP},
        {"points": [{"x_m": 1.0, "y_m": 2.0}], "map_id": "../../etc"},
    ],
)
def test_what_is_no_row_of_points_is_refused_in_both_languages(
    client: TestClient, services: FakeServices, body: dict[str, Any]
) -> None:
    answer = client.post("/v1/goals", json=body)
    assert (answer.status_code, code(answer)) == (422, "invalid_request")
    assert set(answer.json()["message"]) == {"en", "zh"}
    assert services.goals.calls == []


def test_a_point_that_is_no_number_is_refused(client: TestClient, services: FakeServices) -> None:
    body = f'{{"points": [{{"x_m": NaN, "y_m": 2.0}}], "map_id": "{MAP}"}}'
    answer = client.post("/v1/goals", content=body, headers={"content-type": "application/json"})
    assert answer.status_code == 422
    assert services.goals.calls == []


def test_points_have_the_rate_of_goals(client: TestClient) -> None:
    body = {"points": [{"x_m": 1.0, "y_m": 2.0}], "map_id": MAP}
    answers = [client.post("/v1/goals", json=body) for _ in range(AT_ONCE + 20)]
    assert "too_many_goals" in [code(each) for each in answers if each.status_code == 429]


@pytest.mark.parametrize("text", ["yes", "好的", "go to the kitchen"])
@pytest.mark.parametrize("path", ["", "/g1/answer", "/g1/confirm", "/g1/resume"])
def test_a_yes_of_who_may_only_look_reaches_no_goal(
    services: FakeServices, path: str, text: str
) -> None:
    access = Access("127.0.0.1", operator_token="o" * 16, viewer_token="v" * 16)
    viewer = {"authorization": f"Bearer {'v' * 16}", "content-type": "application/json"}
    body = {"text": text} if path in ("", "/g1/answer") else {}
    with client_of(services, access) as viewing:
        answer = viewing.post(f"/v1/goals{path}", json=body, headers=viewer)
        assert (answer.status_code, code(answer)) == (403, "operator_needed")
        assert "needs the operator's" in answer.json()["detail"]
        told = answer.json()["message"]
        assert "operator's token" in told["en"]
        assert "操作员令牌" in told["zh"]
    assert services.goals.calls == []


def test_the_door_of_words_and_answers_is_passed_on(
    client: TestClient, services: FakeServices
) -> None:
    client.post("/v1/goals", json={"text": "go", "source": "page"})
    client.post("/v1/goals", json={"text": "go"})
    client.post("/v1/goals/g1/answer", json={"text": "the kitchen", "source": "cli"})
    client.post("/v1/goals/g1/confirm", json={"source": "page"})
    client.post("/v1/goals/g1/confirm", json={})
    assert services.goals.doors == ["page", "api", "cli", "page", "api"]


ACCESS = Access("127.0.0.1", operator_token="o" * 16, viewer_token="v" * 16)
OPERATES = {"authorization": f"Bearer {'o' * 16}"}
VIEWS = {"authorization": f"Bearer {'v' * 16}"}
PATH = "/v1/goals/g1/replies"


def services_with(most: int) -> FakeServices:
    services = FakeServices()
    services.replies = ReplyCollector(most)
    services.replies.keep("g1", "<b>{}</b>", model="m", turn=ReplyTurn.PLAN, used=False)
    return services


def test_what_is_kept_is_shown() -> None:
    with client_of(services_with(4)) as client:
        answer = client.get(PATH)
    assert answer.headers["content-type"] == "application/json"
    assert answer.headers["cache-control"] == "no-store"
    found = answer.json()
    assert found["kept"] == 4
    (reply,) = found["replies"]
    assert reply.pop("at")
    assert reply == {"model": "m", "turn": "plan", "text": "<b>{}</b>", "cut": False, "used": False}


def test_where_nothing_is_kept_that_is_told() -> None:
    with client_of(services_with(0)) as client:
        answer = client.get(PATH)
    assert (answer.status_code, answer.json()) == (200, {"kept": 0, "replies": []})


def test_an_unknown_goal_is_told_as_ever() -> None:
    with client_of(services_with(4)) as client:
        answer = client.get("/v1/goals/g9/replies")
    assert (answer.status_code, answer.json()["code"]) == (404, "unknown_goal")


WAYS = (PATH, f"{PATH}/", "/v1/goals/g%31/replies", "/v1/goals/g9/replies")


@pytest.mark.parametrize("path", WAYS)
def test_a_viewer_may_not_read_it(path: str) -> None:
    services = services_with(4)
    with client_of(services, ACCESS) as client:
        refused = client.get(path, headers=VIEWS)
        assert (refused.status_code, refused.json()["code"]) == (403, "operator_needed")
        assert "<b>" not in refused.text
        assert client.get("/v1/goals/g1", headers=VIEWS).status_code == 200
        assert client.get(PATH, headers=OPERATES).json()["replies"]
        assert client.get(PATH).status_code == 401
