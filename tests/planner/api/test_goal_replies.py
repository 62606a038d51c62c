"""Check that what a model wrote is shown to operators alone, and that nothing kept is said so."""

from __future__ import annotations

import pytest

from planner.api import Access
from planner.brain.model_replies import ReplyCollector, ReplyTurn
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of

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
