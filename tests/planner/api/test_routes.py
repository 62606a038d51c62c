"""The routes translate: bodies are closed and capped, refusals are problems with stable codes."""

from __future__ import annotations

import asyncio
import base64
import json
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest
from starlette.testclient import TestClient

from maps import GridMap
from maps.growing_map import GROWING_MAP, GrowingMap, write_growing_map
from planner import openapi
from planner.api import build
from planner.api.interfaces import Services
from planner.brain import BrainDown, FallbackBrain, OfflineBrain, ScriptedBrain, ThinkRequest
from planner.plan import Vocabulary
from planner.skill_files.folder import FOLDER, SkillFolder
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import BASE, LOCAL, client_of, code
from tests.wire.examples import STATUS
from wire import VIRTUAL_KEY, Answer, authentic

METAL = STATUS.model_copy(
    update={"drive": STATUS.drive.model_copy(update={"virtual": False, "kind": "serial"})}
)
FREE = STATUS.model_copy(update={"held": None})
JSON = {"content-type": "application/json"}


@pytest.fixture
def services() -> FakeServices:
    return FakeServices(FREE)


def test_a_goal_is_accepted(client: TestClient, services: FakeServices) -> None:
    answer = client.post("/v1/goals", json={"text": "去厨房"}, headers={"Idempotency-Key": "k1"})
    assert answer.status_code == 202
    assert answer.json()["text"] == "去厨房"
    assert services.goals.calls == [("submit", "去厨房", None, False, False, "k1")]
    assert services.robot.asked == []


@pytest.mark.parametrize("path", ["", "/g1/resume", "/g1/answer"])
def test_a_goal_after_a_stop_carries_an_act_that_clears_the_hold(path: str) -> None:
    services = FakeServices(STATUS)
    body = {} if path.endswith("resume") else {"text": "go on"}
    client_of(services).post(f"/v1/goals{path}", json=body)
    (act,) = services.goals.acts
    assert act is not None
    assert authentic(VIRTUAL_KEY, "resume", STATUS.robot, act.proof, act.id)


def test_a_sentence_that_stops_clears_no_hold() -> None:
    services = FakeServices(STATUS)
    assert client_of(services).post("/v1/goals", json={"text": "停!"}).status_code == 202
    assert services.goals.acts == [None]


def test_on_metal_a_held_robot_needs_the_persons_proof_for_a_goal() -> None:
    services = FakeServices(METAL)
    answer = client_of(services).post("/v1/goals", json={"text": "go on"})
    assert (answer.status_code, code(answer)) == (403, "operator_proof_needed")
    assert services.goals.calls == []


@pytest.mark.parametrize(("text", "status"), [("no, thanks", 202), ("不用", 202), ("yes", 403)])
def test_on_metal_a_no_needs_no_proof(text: str, status: int) -> None:
    """It clears no hold; a yes may, and is an operator's act."""
    services = FakeServices(METAL)
    assert client_of(services).post("/v1/goals", json={"text": text}).status_code == status
    assert services.goals.acts == ([None] if status == 202 else [])


def test_on_metal_a_free_robot_takes_a_goal_without_an_act() -> None:
    services = FakeServices(METAL.model_copy(update={"held": None}))
    assert client_of(services).post("/v1/goals", json={"text": "go"}).status_code == 202
    assert services.goals.acts == [None]


@pytest.mark.parametrize(
    ("content", "status", "expected", "said"),
    [
        (b"{", 400, "malformed_json", ("no JSON", "at character 1", "expected an object")),
        (b"\x00\xff\x80", 400, "malformed_json", ("UTF-8", "expected a JSON object")),
        (b"", 422, "invalid_request", ("body: missing", "text?, source?, points?")),
        (b"[]", 422, "invalid_request", ("expected a JSON object", "got []", "text?, source?")),
        (b"{}", 422, "invalid_request", ("say text, points or steps",)),
        (b'{"text": 7}', 422, "invalid_request", ("body.text", "valid string", "got 7")),
        (b'{"text": "go", "speed": 3}', 422, "invalid_request",
         ("body.speed: unknown key", "3", "text?, source?, points?, map_id?, steps?")),
        (b'{"text": "' + b"a" * 300_000 + b'"}', 413, "body_too_large", ("262144",)),
    ],
    ids=["half", "bytes", "nothing", "list", "empty", "number", "unknown key", "300 kB"],
)  # fmt: skip
def test_malformed_goals_are_refused_and_told_what_was_expected(
    client: TestClient, services: FakeServices, content: bytes, status: int, expected: str,
    said: tuple[str, ...],
) -> None:  # fmt: skip
    answer = client.post("/v1/goals", content=content, headers=JSON)
    assert (answer.status_code, code(answer)) == (status, expected)
    assert [part for part in said if part not in answer.json()["detail"]] == [], answer.json()
    told = answer.json()["message"]
    assert told["en"] != told["zh"]
    assert services.goals.calls == []


@pytest.mark.parametrize(
    ("method", "path", "status", "expected"),
    [
        ("GET", "/v1/nothing", 404, "unknown_route"),
        ("GET", "/v1/goals/nope", 404, "unknown_goal"),
        ("POST", "/v1/goals/nope/cancel", 404, "unknown_goal"),
        ("POST", "/v1/goals/g1/confirm", 409, "bad_state"),
        ("DELETE", "/v1/goals", 405, "method_not_allowed"),
        ("GET", "/v1/stop", 405, "method_not_allowed"),
        ("GET", "/v1/goals?limit=0", 422, "invalid_request"),
        ("GET", "/v1/camera.jpg", 503, "no_camera"),
    ],
)
def test_wrong_requests_say_why(
    client: TestClient, method: str, path: str, status: int, expected: str
) -> None:
    answer = client.request(method, path, headers=JSON)
    assert (answer.status_code, code(answer)) == (status, expected)
    assert answer.json()["message"]["zh"] != answer.json()["message"]["en"]


def test_a_wrong_method_is_told_all_that_a_path_allows(client: TestClient) -> None:
    answer = client.delete("/v1/goals", headers=JSON)
    assert answer.headers["allow"] == "GET, POST"
    assert "GET, POST" in answer.json()["detail"]
    assert "/openapi.json" in client.get("/v1/nothing").json()["detail"]


@pytest.mark.parametrize("content_type", [None, "text/plain", "application/x-www-form-urlencoded"])
def test_a_goal_needs_json(client: TestClient, content_type: str | None) -> None:
    headers = {"content-type": content_type} if content_type else {}
    answer = client.post("/v1/goals", content=b'{"text":"go"}', headers=headers)
    assert (answer.status_code, code(answer)) == (415, "unsupported_media_type")
    assert (content_type or "no content type") in answer.json()["detail"]
    assert "expected application/json" in answer.json()["detail"]


@pytest.mark.parametrize(
    ("header", "value", "expected"),
    [("host", "evil.example", "foreign_host"), ("origin", "http://evil.example", "foreign_origin")],
)
@pytest.mark.parametrize("path", ["/", "/v1/robot", "/healthz", "/openapi.json", "/metrics"])
def test_strangers_are_refused_on_every_route(
    client: TestClient, path: str, header: str, value: str, expected: str
) -> None:
    answer = client.get(path, headers={header: value})
    assert (answer.status_code, code(answer)) == (403, expected)
    assert value in answer.json()["detail"]
    assert "127.0.0.1" in answer.json()["detail"].partition("allowed: ")[2]


def test_stop_needs_neither_body_nor_type(client: TestClient, services: FakeServices) -> None:
    assert client.post("/v1/stop").json() == {"confirmed": True, "mode": "ACTIVE"}
    assert client.post("/v1/stop", json={"source": "page"}).status_code == 200
    assert services.goals.stops == ["api", "page"]


@pytest.mark.parametrize(
    ("content", "headers"),
    [
        (b"{}", {"content-type": "application/x-www-form-urlencoded"}),
        (b"now!", {}),
        (b"{", JSON),
        (b"\xff\x00", JSON),
        (b"[]", JSON),
        (b'{"source": 7}', JSON),
        (b'{"reason": "fire"}', JSON),
        (b"a" * 400_000, JSON),
    ],
    ids=["curl -d", "words", "half", "bytes", "list", "number", "unknown key", "400 kB"],
)
def test_no_body_of_any_kind_refuses_what_stops(
    client: TestClient, services: FakeServices, content: bytes, headers: dict[str, str]
) -> None:
    assert client.post("/v1/stop", content=content, headers=headers).status_code == 200
    for kind in ("estop", "disarm"):
        assert client.post(f"/v1/{kind}", content=content, headers=headers).status_code == 200
    assert services.goals.stops == ["api"]
    assert [kind for kind, _ in services.robot.asked] == ["estop", "disarm"]


@pytest.mark.parametrize("kind", ["arm", "reset", "resume"])
def test_the_api_signs_for_a_virtual_drive(
    client: TestClient, services: FakeServices, kind: str
) -> None:
    assert client.post(f"/v1/{kind}", json={}).status_code == 200
    ((asked, request),) = services.robot.asked
    assert (asked, request.source) == (kind, "planner:api")
    assert authentic(VIRTUAL_KEY, asked, FREE.robot, request.proof, request.id)


@pytest.mark.parametrize("kind", ["arm", "reset", "resume"])
def test_on_metal_a_proof_is_needed(kind: str) -> None:
    services = FakeServices(METAL)
    answer = client_of(services).post(f"/v1/{kind}", json={})
    assert (answer.status_code, code(answer)) == (403, "operator_proof_needed")
    assert services.robot.asked == []


def test_on_metal_a_proof_is_relayed_as_it_is() -> None:
    services = FakeServices(METAL)
    given = {"id": "op-7", "proof": {"nonce": "boot1.2", "mac": "b" * 64}}
    assert client_of(services).post("/v1/arm", json={"operator": given}).status_code == 200
    ((_, request),) = services.robot.asked
    assert request.id == "op-7"
    assert request.proof is not None
    assert request.proof.mac == "b" * 64


@pytest.mark.parametrize("kind", ["disarm", "estop"])
def test_taking_power_away_needs_no_proof(kind: str) -> None:
    services = FakeServices(METAL)
    assert client_of(services).post(f"/v1/{kind}").status_code == 200


def test_the_bridges_refusal_keeps_its_code(client: TestClient, services: FakeServices) -> None:
    services.robot.verdict = Answer(
        id="x", kind="arm", accepted=False, code="lidar_stale", detail="no scan for 400 ms"
    )
    answer = client.post("/v1/arm", json={})
    assert (answer.status_code, code(answer)) == (409, "lidar_stale")
    services.robot.verdict = None
    answer = client.post("/v1/arm", json={})
    assert (answer.status_code, code(answer)) == (503, "bridge_silent")


def test_without_a_bridge_nothing_is_signed() -> None:
    services = FakeServices(None)
    answer = client_of(services).post("/v1/arm", json={})
    assert (answer.status_code, code(answer)) == (503, "bridge_silent")


def test_teleop_is_passed_on_within_bounds(client: TestClient, services: FakeServices) -> None:
    body = {"source": "page-1", "v_mps": 0.2, "w_radps": -0.1, "dead_man": True}
    assert client.post("/v1/teleop", json=body).status_code == 202
    (source, *speeds), *_ = services.robot.steers
    assert source.startswith("page-1:"), "two machines that say the same are two hands"
    assert speeds == [0.2, -0.1, True]
    too_fast = client.post("/v1/teleop", json={**body, "v_mps": 1e6})
    assert code(too_fast) == "invalid_request"


def test_a_hand_that_posts_is_told_that_another_steers(
    client: TestClient, services: FakeServices
) -> None:
    body = {"source": "pad", "v_mps": 0.2, "w_radps": 0.0, "dead_man": True}
    services.robot.driver = {"id": "pad:elsewhere", "name": "pad"}
    answer = client.post("/v1/teleop", json=body)
    assert (answer.status_code, code(answer)) == (409, "hand_taken")
    assert answer.json()["message"]["zh"]
    assert services.robot.steers == []
    assert client.post("/v1/teleop", json={**body, "dead_man": False}).status_code == 202
    services.robot.driver = {"id": services.robot.steers[0][0], "name": "pad"}
    assert client.post("/v1/teleop", json=body).status_code == 202
    assert client.get("/v1/robot").json()["driver"] == services.robot.driver


def test_the_robot_says_who_plans(client: TestClient, services: FakeServices) -> None:
    alone = {"name": "offline", "breaker": None, "rests_s": 0.0, "loads": False}
    alone |= {"last_error": None}
    assert client.get("/v1/robot").json()["brain"] == alone
    model = ScriptedBrain([BrainDown("401", why="bad_key")])
    services.brain = FallbackBrain(model, OfflineBrain(), clock=lambda: 0.0, rest_s=20.0)
    request = ThinkRequest(text="wait 1 second", vocabulary=Vocabulary())
    asyncio.run(services.brain.think(request))
    brain = client.get("/v1/robot").json()["brain"]
    assert (brain["name"], brain["breaker"], brain["rests_s"]) == ("scripted", "open", 20.0)
    assert brain["last_error"]["code"] == "bad_key"
    assert brain["last_error"]["message"]["zh"].endswith("。")


def test_the_map_is_whole(client: TestClient) -> None:
    body = client.get("/v1/map").json()
    assert len(base64.b64decode(body["cells"])) == body["width"] * body["height"]
    assert body["fence"]["map_id"] == body["map_id"]


def test_a_map_that_grows_in_the_sites_folder_is_shown_as_far_as_it_is_known(
    services: FakeServices, tmp_path: Path
) -> None:
    services.site = replace(services.site, folder=tmp_path)
    client = TestClient(build(cast("Services", services), LOCAL), base_url=BASE)
    fixed = client.get("/v1/map").json()
    assert fixed["growing"] is None
    for revision, cells in ((3, bytes([0, 1, 2, 0])), (4, bytes([0, 1, 0, 0]))):
        grown = GrowingMap(revision, 2, 1, GridMap(2, 2, 0.05, -0.1, 0.2, cells))
        write_growing_map(tmp_path, grown)
        body = client.get("/v1/map").json()
        assert base64.b64decode(body["cells"]) == cells
        assert body["origin"] == {"x_m": -0.1, "y_m": 0.2}
        assert body["growing"] == {"revision": revision, "keyframes": 2, "loops": 1}
        assert (body["map_id"], body["fence"]) == (fixed["map_id"], fixed["fence"])
    (tmp_path / GROWING_MAP).write_bytes(b"spoilt")
    assert base64.b64decode(client.get("/v1/map").json()["cells"]) == cells, (
        "the last that was whole"
    )


def test_places_have_names_in_both_languages(client: TestClient) -> None:
    body = client.get("/v1/places").json()
    assert {place["id"] for place in body["places"]} >= {"kitchen", "living_room", body["home"]}
    assert all(place["name"]["en"] and place["name"]["zh"] for place in body["places"])


def test_readiness_names_what_is_missing(client: TestClient) -> None:
    answer = client.get("/readyz")
    assert (answer.status_code, code(answer)) == (503, "not_ready")
    assert "scan" in answer.json()["waiting"]
    assert client.get("/healthz").status_code == 200


def test_metrics_are_prometheus_text(client: TestClient) -> None:
    text = client.get("/metrics").text
    assert 'pons_bridge_mode{mode="ACTIVE"} 1.0' in text
    assert 'pons_goals{state="running"} 1.0' in text


def test_events_begin_with_a_snapshot_and_count(client: TestClient, services: FakeServices) -> None:
    services.goals.changes = [{"goal": {"id": "g1"}}]
    with client.websocket_connect("/v1/events", headers={"host": "127.0.0.1:8420"}) as socket:
        first, second = socket.receive_json(), socket.receive_json()
    assert (first["seq"], first["kind"]) == (1, "snapshot")
    assert first["goals"][0]["id"] == "g1"
    assert first["robot"]["status"]["mode"] == "ACTIVE"
    assert second["seq"] == 2


def test_the_event_socket_stops_the_robot(client: TestClient, services: FakeServices) -> None:
    with client.websocket_connect("/v1/events", headers={"host": "127.0.0.1:8420"}) as socket:
        socket.send_text('{"stop": true}')
        kinds: list[str] = []
        while "stopped" not in kinds:
            kinds.append(socket.receive_json()["kind"])
    assert services.goals.stops == ["page"]


def test_the_committed_contract_is_fresh() -> None:
    assert openapi.main(["--check"]) == 0


def test_every_operation_has_its_own_id() -> None:
    paths = json.loads(openapi.TARGET.read_text("utf-8"))["paths"]  # fresh, as is shown above
    ids = [operation["operationId"] for path in paths.values() for operation in path.values()]
    assert len(ids) == len(set(ids))


def test_skills_and_what_is_wrong_in_the_others_are_listed(tmp_path: Path) -> None:
    services = FakeServices()
    services.skills = SkillFolder(tmp_path, lambda: services.memory.vocabulary)
    (tmp_path / FOLDER).mkdir()
    good = 'en = "do the evening round"\nsteps = [{kind = "return_home"}]\n'
    (tmp_path / FOLDER / "round.toml").write_text(good, "utf-8")
    (tmp_path / FOLDER / "bad.toml").write_text("\nen = ", "utf-8")
    asyncio.run(services.skills.look())
    told = client_of(services).get("/v1/skills")
    assert told.status_code == 200
    [skill], [problem] = told.json()["skills"], told.json()["problems"]
    assert (skill["name"], skill["kind"]) == ("round", "routine")
    assert skill["en"] == ["do the evening round"]
    assert (problem["file"], problem["line"], problem["code"]) == ("bad.toml", 2, "skill_not_toml")
    assert set(problem["message"]) == {"en", "zh"}
    assert told.json()["folder"] == str(tmp_path / FOLDER)
