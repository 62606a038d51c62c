"""Marks of the map by HTTP: checked, meant by an operator, in force at the bridge, then kept."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.site import KnownPlaces
from planner.site.marks import marks_hash, marks_path, read_marks
from tests.planner.api.fakes import FakeServices
from tests.wire.examples import STATUS
from wire import VIRTUAL_KEY, Answer, authentic_marks, sign_marks

METAL = STATUS.model_copy(
    update={"drive": STATUS.drive.model_copy(update={"virtual": False, "kind": "serial"})}
)
HOME = [[0.6, 0.6], [1.2, 0.6], [1.2, 1.2], [0.6, 1.2]]
BOX = [[0.4, 3.4], [0.9, 3.4], [0.9, 3.9], [0.4, 3.9]]
SLOW = {"polygon": BOX, "max_speed_mps": 0.2}
OK = Answer(id="x", kind="marks", accepted=True, code="ok", detail="")


@pytest.fixture
def services(tmp_path: Path) -> FakeServices:
    made = FakeServices(STATUS)
    made.memory = KnownPlaces(made.site, marks=marks_path(tmp_path, made.site.map_id))
    made.robot._status = STATUS.model_copy(update={"base_in_map": made.site.home.pose})
    made.robot.verdict = OK
    return made


def body(services: FakeServices, **changes: Any) -> dict[str, Any]:
    marks = {"version": 1, "map_id": services.site.map_id, "keep_outs": [BOX], **changes}
    return {"marks": marks, "source": "test"}


def test_marks_come_into_force_and_are_kept(
    client: TestClient, services: FakeServices, tmp_path: Path
) -> None:
    nothing = client.get("/v1/marks").json()
    assert (nothing["marks_hash"], nothing["marks"]["keep_outs"]) == (None, [])
    answer = client.put("/v1/marks", json=body(services, speed_zones=[SLOW]))
    assert answer.status_code == 200, answer.text
    (request,) = services.robot.drawn
    assert authentic_marks(VIRTUAL_KEY, STATUS.robot, request)
    kept = read_marks(marks_path(tmp_path, services.site.map_id), services.site.map_id)
    assert kept is not None
    assert answer.json()["marks_hash"] == marks_hash(kept)
    assert kept.keep_outs == (tuple(map(tuple, BOX)),)
    site = services.memory.site
    assert not site.fence.allows(0.6, 3.6)
    assert site.fence.max_speed_mps(0.6, 3.6) == 0.2
    assert services.site.fence.allows(0.6, 3.6), "the file's own stays"
    again = KnownPlaces(services.site, marks=marks_path(tmp_path, services.site.map_id))
    assert again.drawn.marks == kept


def test_one_who_drew_from_older_marks_overwrites_nothing(
    client: TestClient, services: FakeServices
) -> None:
    first = client.put("/v1/marks", json=body(services)).json()
    late = client.put("/v1/marks", json=body(services, keep_outs=[]))
    assert (late.status_code, late.json()["code"]) == (409, "marks_changed")
    elsewhere = client.put("/v1/marks", json=body(services, map_id="1" * 16))
    assert elsewhere.json()["code"] == "marks_of_another_map", "not as if somebody had changed them"
    after = client.put("/v1/marks", json={**body(services, keep_outs=[]),
                                          "before": first["marks_hash"]})  # fmt: skip
    assert after.status_code == 200
    assert after.json()["marks"]["keep_outs"] == []


def test_without_a_way_out_of_marks_that_is_said(
    client: TestClient, services: FakeServices
) -> None:
    asked = {"marks": body(services, keep_outs=[HOME])["marks"]}
    answer = client.post("/v1/marks/exit", json=asked)  # this planner has no pose yet
    assert (answer.status_code, answer.json()["code"]) == (409, "mark_without_exit")
    assert answer.json()["message"]["zh"]
    assert services.robot.drawn == []
    for changes, code in (({"map_id": "1" * 16}, "marks_of_another_map"),
                          ({"keep_outs": [BOX * 3] * 50}, "marks_too_many")):  # fmt: skip
        asked = {"marks": body(services, **changes)["marks"]}
        assert client.post("/v1/marks/exit", json=asked).json()["code"] == code


@pytest.mark.parametrize("way", ["check", "put"])
@pytest.mark.parametrize(
    ("changes", "code", "status"),
    [
        ({"map_id": "1" * 16}, "marks_of_another_map", 422),
        ({"keep_outs": [[[0, 0], [1, 1], [1, 0], [0, 1]]]}, "mark_crosses_itself", 422),
        ({"keep_outs": [[[0, 0], [0.05, 0], [0.05, 0.05]]]}, "mark_too_small", 422),
        ({"keep_outs": [HOME]}, "mark_holds_robot", 409),
        ({"keep_outs": [[[0, 0], [1, 1]]]}, "invalid_request", 422),
        ({"keep_outs": [BOX * 3] * 50}, "marks_too_many", 422),
        ({"keep_outs": [BOX] * 51}, "invalid_request", 422),
        ({"allowed": [BOX]}, "invalid_request", 422),
        ({"speed_zones": [{"polygon": BOX, "max_speed_mps": 0.0}]}, "invalid_request", 422),
    ],
)  # fmt: skip
def test_bad_marks_are_told_with_a_code_in_both_languages(
    client: TestClient, services: FakeServices, way: str, changes: Any, code: str, status: int
) -> None:
    sent = body(services, **changes)
    if way == "check":
        answer = client.post("/v1/marks/check", json={"marks": sent["marks"]})
    else:
        answer = client.put("/v1/marks", json=sent)
    assert (answer.status_code, answer.json()["code"]) == (status, code)
    message = answer.json()["message"]
    assert message["en"]
    assert message["zh"] != message["en"]
    assert services.robot.drawn == []


def test_no_number_is_no_corner(client: TestClient, services: FakeServices) -> None:
    text = f'{{"marks":{{"version":1,"map_id":"{services.site.map_id}",'
    text += '"keep_outs":[[[NaN,0],[1,0],[1,1]]]}}'
    answer = client.put("/v1/marks", content=text, headers={"content-type": "application/json"})
    assert answer.status_code == 422


def test_what_the_bridge_refuses_is_told_and_not_kept(
    client: TestClient, services: FakeServices
) -> None:
    services.robot.verdict = OK.model_copy(update={"accepted": False, "code": "mark_too_near"})
    answer = client.put("/v1/marks", json=body(services))
    assert (answer.status_code, answer.json()["code"]) == (409, "mark_too_near")
    assert "stop before it" in answer.json()["message"]["en"]
    services.robot.verdict = None
    assert client.put("/v1/marks", json=body(services)).status_code == 503
    assert services.memory.drawn.marks is None


def test_metal_needs_a_proof_of_the_very_text(client: TestClient, services: FakeServices) -> None:
    services.robot._status = METAL
    refused = client.put("/v1/marks", json=body(services))
    assert (refused.status_code, refused.json()["code"]) == (403, "operator_proof_needed")
    text = client.post("/v1/marks/check", json={"marks": body(services)["marks"]}).json()["text"]
    proof = sign_marks(b"k" * 32, STATUS.robot, STATUS.nonce, "page-1", text)
    given = {"id": "page-1", "proof": proof.model_dump()}
    assert client.put("/v1/marks", json={**body(services), "operator": given}).status_code == 200
    (request,) = services.robot.drawn
    assert authentic_marks(b"k" * 32, STATUS.robot, request)
