"""Try the people's routes: the owner's alone, and what is done is written down as theirs."""

from __future__ import annotations

from base64 import urlsafe_b64encode
from pathlib import Path

import pytest
from pydantic import AfterValidator
from starlette.testclient import TestClient

from planner.api import Access
from planner.api.schemas import Body, StopOrder
from planner.people import ASKER, People, Person, Role
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import PEOPLED, client_of, find_person

OWNER = {"authorization": f"Bearer {'o' * 20}"}


@pytest.fixture
def services(tmp_path: Path) -> FakeServices:
    made = FakeServices()
    made.people = People(StateDatabase(tmp_path))
    return made


@pytest.fixture
def client(services: FakeServices) -> TestClient:
    return client_of(services, PEOPLED)


def add(client: TestClient, name: str, role: str = "operator") -> dict[str, str]:
    made = client.post("/v1/people", json={"name": name, "role": role}, headers=OWNER)
    assert made.status_code == 201
    return {"authorization": f"Bearer {made.json()['token']}"}


def test_what_a_person_does_is_written_down_as_theirs(
    client: TestClient, services: FakeServices
) -> None:
    ana = add(client, "Ana's phone")
    assert client.post("/v1/stop", json={"source": "page"}, headers=ana).status_code == 200
    assert client.post("/v1/stop", json={"source": "page"}, headers=OWNER).status_code == 200
    assert services.goals.stops == ["anas-phone", "page"]
    token = ana["authorization"].removeprefix("Bearer ").encode()
    offered = ["pons.v1", f"bearer.{urlsafe_b64encode(token).decode().rstrip('=')}"]
    with client.websocket_connect(
        "/v1/events", subprotocols=offered, headers={"host": "127.0.0.1:8420"}
    ) as socket:
        socket.send_json({"stop": True})
        while socket.receive_json()["kind"] != "stopped":
            pass
    assert services.goals.stops.pop() == "anas-phone"
    client.post("/v1/goals", json={"text": "go to the kitchen"}, headers=ana)
    client.post("/v1/goals", json={"text": "go to the kitchen"}, headers=OWNER)
    assert services.goals.doors == ["anas-phone", "api"]


def test_a_viewer_looks_and_stops_and_a_removed_person_does_neither(client: TestClient) -> None:
    guest = add(client, "Guest", "viewer")
    assert client.get("/v1/robot", headers=guest).status_code == 200
    refused = client.post("/v1/goals", json={"text": "go home"}, headers=guest)
    assert (refused.status_code, refused.json()["code"]) == (403, "operator_needed")
    assert client.post("/v1/stop", headers=guest).status_code == 200
    assert client.delete("/v1/people/guest", headers={**OWNER}).status_code == 415
    gone = client.delete("/v1/people/guest", headers={**OWNER, "content-type": "application/json"})
    assert gone.json()["name"] == "Guest"
    assert client.get("/v1/robot", headers=guest).status_code == 401


def test_only_the_owner_lists_adds_and_removes_people(client: TestClient) -> None:
    ana = add(client, "Ana")
    for method, path in (("POST", "/v1/people"), ("DELETE", "/v1/people/ana")):
        refused = client.request(method, path, headers=ana, json={"name": "Bob"})
        assert (refused.status_code, refused.json()["code"]) == (403, "owner_needed")
    told = client.get("/v1/people", headers=ana).json()
    assert (told["you"]["id"], told["people"]) == ("ana", None)
    viewer = {"authorization": f"Bearer {'v' * 20}"}
    assert client.get("/v1/people", headers=viewer).json() == {"you": None, "people": None}
    listed = client.get("/v1/people", headers=OWNER).json()["people"]
    assert [(each["id"], each["role"]) for each in listed] == [("ana", "operator")]
    assert "token" not in listed[0]


@pytest.mark.parametrize(
    ("body", "status", "code"),
    [
        ({"name": "ana"}, 409, "person_exists"),
        ({"name": "!"}, 409, "person_unnamed"),
        ({"name": "Bob", "role": "king"}, 422, "invalid_request"),
        ({"name": "x" * 65}, 422, "invalid_request"),
    ],
)
def test_a_bad_person_is_refused_with_a_code(
    client: TestClient, body: dict[str, str], status: int, code: str
) -> None:
    add(client, "Ana")
    refused = client.post("/v1/people", json=body, headers=OWNER)
    assert (refused.status_code, refused.json()["code"]) == (status, code)
    assert refused.json()["message"]["zh"]


def test_from_here_without_any_token_the_owner_asks(services: FakeServices) -> None:
    client = client_of(services, Access("127.0.0.1", find_person=find_person))
    made = client.post("/v1/people", json={"name": "Ana"}).json()
    ana = {"authorization": f"Bearer {made['token']}"}
    assert client.get("/v1/people", headers=ana).json()["people"] is None
    assert len(client.get("/v1/people").json()["people"]) == 1


def test_every_body_that_names_its_asker_names_a_person_by_the_token() -> None:
    bodies = {each for each in descendants(Body) if "source" in each.model_fields}
    assert {"StopOrder", "NewGoal", "Marking", "Proposal", "NewPlace"} <= {
        b.__name__ for b in bodies
    }
    for body in bodies:
        checks = body.model_fields["source"].metadata
        assert any(isinstance(each, AfterValidator) for each in checks), body


def descendants(of: type[Body]) -> set[type[Body]]:
    return {each for child in of.__subclasses__() for each in (child, *descendants(child))}


def test_a_body_is_its_persons_only_while_their_request_is_served() -> None:
    ana = Person("ana", "Ana", Role.OPERATOR, "2026-01-01T00:00:00+00:00")
    token = ASKER.set(ana)
    try:
        assert {StopOrder().source, StopOrder(source="page").source} == {"ana"}
    finally:
        ASKER.reset(token)
    assert (StopOrder().source, StopOrder(source="page").source) == ("api", "page")
