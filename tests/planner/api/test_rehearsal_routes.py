"""A rehearsal over HTTP moves nothing, makes no goal, and says why there is none to show."""

from __future__ import annotations

import pytest
from starlette.testclient import TestClient

from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of, code
from tests.planner.api.test_routes import FREE

JSON = {"content-type": "application/json"}


@pytest.fixture
def services() -> FakeServices:
    return FakeServices(FREE)


def test_a_sentence_is_shown_and_nothing_is_done(
    client: TestClient, services: FakeServices
) -> None:
    answer = client.post("/v1/rehearsals", json={"text": "go to the living room"})
    assert answer.status_code == 200
    told = answer.json()
    assert told["steps"][0]["name"]["en"] == "living room"
    assert told["narrowest_m"] == 0.84
    assert (services.goals.calls, services.robot.asked, services.robot.steers) == ([], [], [])


@pytest.mark.parametrize("text", ["hello", "stop", "where are you?"])
def test_what_moves_nothing_has_no_rehearsal(client: TestClient, text: str) -> None:
    answer = client.post("/v1/rehearsals", json={"text": text})
    assert (answer.status_code, code(answer)) == (409, "rehearsal_no_plan")
    assert answer.json()["message"]["zh"]


def test_a_goal_that_is_not_there_or_has_no_plan(client: TestClient) -> None:
    assert client.post("/v1/rehearsals", json={"goal": "g7"}).status_code == 404
    assert code(client.post("/v1/rehearsals", json={"goal": "g1"})) == "rehearsal_no_plan"


@pytest.mark.parametrize("body", [{}, {"text": "go home", "goal": "g1"}, {"text": "x" * 5_000}])
def test_one_of_sentence_and_goal(client: TestClient, body: dict[str, str]) -> None:
    assert client.post("/v1/rehearsals", json=body).status_code == 422


def test_without_a_bridge_there_is_no_way_to_show() -> None:
    answer = client_of(FakeServices(None)).post("/v1/rehearsals", json={"text": "go home"})
    assert (answer.status_code, code(answer)) == (409, "rehearsal_without_pose")


def test_a_plan_is_driven_in_the_simulator_on_demand_and_cancelled(
    client: TestClient, services: FakeServices
) -> None:
    assert code(client.get("/v1/rehearsals/drive")) == "rehearsal_none"
    assert code(client.delete("/v1/rehearsals/drive", headers=JSON)) == "rehearsal_none"
    begun = client.post("/v1/rehearsals/drive", json={"text": "go to the living room"})
    assert (begun.status_code, begun.json()["state"]) == (202, "running")
    assert begun.json()["shown"]["steps"][0]["does"] == "drives"
    again = client.post("/v1/rehearsals/drive", json={"text": "go home"})
    assert (again.status_code, code(again)) == (409, "rehearsal_running")
    assert again.json()["message"]["zh"]
    assert client.get("/v1/rehearsals/drive").json()["id"] == begun.json()["id"]
    ended = client.delete("/v1/rehearsals/drive", headers=JSON).json()
    assert (ended["state"], ended["left_out"]) == ("cancelled", ["localization", "people_stand"])
    assert (services.goals.calls, services.robot.asked) == ([], [])


def test_a_drive_is_refused_as_a_rehearsal_is(client: TestClient) -> None:
    assert code(client.post("/v1/rehearsals/drive", json={"text": "hello"})) == "rehearsal_no_plan"
    assert client.post("/v1/rehearsals/drive", json={"goal": "g7"}).status_code == 404
    lost = client_of(FakeServices(None)).post("/v1/rehearsals/drive", json={"text": "go home"})
    assert code(lost) == "rehearsal_without_pose"
