"""Places are listed, taught and forgotten over HTTP, by an operator, with stable codes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.api import Access
from planner.api.live_state import Feed
from planner.bridge_client import Aged
from planner.mission.given_points import RobotSurvey
from planner.site import KnownPlaces, TaughtPlaces
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import BASE, client_of
from tests.planner.mission.live import StraightRouter
from tests.wire.examples import STATUS
from wire import Pose2, Status, Twist2

HERE = Pose2(1.0, 4.2, 0.5)


class Heard:
    """Hear what the fake robot says."""

    def __init__(self, services: FakeServices) -> None:
        self._services = services

    @property
    def status(self) -> Aged[Status] | None:
        status = self._services.robot.status
        return Aged(status, 0.0) if status is not None else None


@pytest.fixture
def services(tmp_path: Path) -> FakeServices:
    made = FakeServices()
    changes = {"base_in_map": HERE, "map_id": made.site.map_id, "measured": Twist2(0.0, 0.0)}
    made.robot._status = STATUS.model_copy(update=changes)
    made.memory = KnownPlaces(made.site, TaughtPlaces.in_home(tmp_path))
    made.memory.use(RobotSurvey(Heard(made), StraightRouter()))
    return made


def test_a_place_is_taught_listed_moved_and_forgotten(
    client: TestClient, services: FakeServices
) -> None:
    body: dict[str, Any] = {"name": {"en": "Grandma's chair", "zh": "奶奶的椅子"}, "source": "page"}
    made = client.post("/v1/places", json=body)
    assert made.status_code == 201, made.text
    place = made.json()
    assert (place["id"], place["by"], place["map_id"]) == (
        "grandma_s_chair",
        "page",
        services.site.map_id,
    )
    assert place["pose"] == {"x_m": 1.0, "y_m": 4.2, "yaw_rad": 0.5}
    assert place["taught"].endswith("Z")
    again = client.put(
        "/v1/places/grandma_s_chair", json={**body, "point": {"x_m": 1.0, "y_m": 1.5}}
    )
    assert again.status_code == 200, again.text
    assert again.json()["pose"] == {"x_m": 1.0, "y_m": 1.5, "yaw_rad": 0.5}  # the robot's heading
    shown = client.get("/v1/places").json()
    assert [p["id"] for p in shown["places"]][-1] == "grandma_s_chair"
    assert (shown["version"], shown["most"], shown["taught"][0]["why_not"]) == (2, 32, None)
    assert client.delete("/v1/places/奶奶的椅子", headers=JSON).json()["id"] == place["id"]
    assert client.get("/v1/places").json()["taught"] == []


JSON = {"content-type": "application/json"}


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "code"),
    [
        ("POST", "", {"name": {}}, 422, "place_name_malformed"),
        ("POST", "", {"name": {"en": "stop"}}, 422, "place_name_reserved"),
        ("POST", "", {"name": {"en": "go to the kitchen"}}, 422, "place_name_reserved"),
        ("POST", "", {"name": {"en": "every day at eight"}}, 422, "place_name_reserved"),
        ("POST", "", {"name": {"zh": "跟着我"}}, 422, "place_name_reserved"),
        ("POST", "", {"name": {"en": "<b>nook</b>"}}, 422, "place_name_malformed"),
        ("POST", "", {"name": {"en": "Kitchen"}}, 409, "place_name_taken"),
        ("POST", "", {"name": {"en": "x"}, "speed": 1}, 422, "invalid_request"),
        ("POST", "", {"name": {"en": "y"}, "point": {"x_m": 9, "y_m": 99}}, 422, None),
        ("PUT", "/kitchen", {"name": {"en": "nook"}}, 409, "place_of_site"),
        ("PUT", "/No", {"name": {"en": "nook"}}, 422, "invalid_request"),
        ("DELETE", "/nook", None, 404, "unknown_taught_place"),
        ("DELETE", "/kitchen", None, 409, "place_of_site"),
    ],
)
def test_refusals_are_problems(
    client: TestClient, method: str, path: str, body: Any, status: int, code: str | None
) -> None:
    answer = client.request(method, f"/v1/places{path}", json=body, headers=JSON)
    assert answer.status_code == status, answer.text
    problem = answer.json()
    assert code is None or problem["code"] == code
    if problem["code"] != "invalid_request":
        assert problem["message"].keys() == {"en", "zh"}


def test_a_viewer_may_look_but_not_teach(services: FakeServices) -> None:
    access = Access("127.0.0.1", operator_token="o" * 16, viewer_token="v" * 16)
    viewer = {**JSON, "authorization": f"Bearer {'v' * 16}"}
    with client_of(services, access) as client:
        assert client.get("/v1/places", headers=viewer).status_code == 200
        for method, path in (("POST", ""), ("PUT", "/nook"), ("DELETE", "/nook")):
            body = {"name": {"en": "nook"}}
            answer = client.request(method, f"/v1/places{path}", json=body, headers=viewer)
            assert answer.json()["code"] == "operator_needed"


def test_pages_hear_of_a_change(client: TestClient, services: FakeServices) -> None:
    feed = Feed(services, clock=lambda: 0.0)
    with client.websocket_connect("/v1/events", headers={"host": BASE[7:]}) as socket:
        assert socket.receive_json()["places_version"] == 0
    client.post("/v1/places", json={"name": {"zh": "阅读角"}})
    offered: list[tuple[str, dict[str, Any]]] = []
    feed._offer = lambda kind, content: offered.append((kind, content))  # type: ignore[method-assign]
    feed.look()
    feed.look()
    assert offered.count(("places", {"version": 1})) == 1


def test_a_question_needs_no_operators_act(client: TestClient, services: FakeServices) -> None:
    for text in ("where are you?", "记住这里是阅读角", "never mind", "stop"):
        client.post("/v1/goals", json={"text": text})
    client.post("/v1/goals", json={"text": "continue"})
    assert [act is None for act in services.goals.acts] == [True, True, True, True, False]


def test_a_place_has_one_spot(client: TestClient) -> None:
    """A room says its own spot: with a point besides, nobody knows which is meant."""
    point, name = {"x_m": 1.0, "y_m": 1.0}, {"en": "attic"}
    both = client.post("/v1/places", json={"name": name, "point": point, "room": "room_1"})
    assert (both.status_code, both.json()["code"]) == (422, "invalid_request")
    unknown = client.post("/v1/places", json={"name": name, "room": "room_1"})
    assert (unknown.status_code, unknown.json()["code"]) == (404, "unknown_room")
    assert client.get("/v1/places").json()["proposed_rooms"] == []
