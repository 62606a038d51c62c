"""The fence's routes: propose, read, say yes with a proof of the very text, say no."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.site import FenceProposals
from tests.planner.api.fakes import FakeServices
from tests.wire.examples import STATUS
from wire import VIRTUAL_KEY, Answer, authentic_fence, sign_fence

METAL = STATUS.model_copy(
    update={"drive": STATUS.drive.model_copy(update={"virtual": False, "kind": "serial"})}
)
KEEP_OUT = [[0.4, 3.4], [0.9, 3.4], [0.9, 3.9], [0.4, 3.9]]


@pytest.fixture
def services(tmp_path: Path) -> FakeServices:
    made = FakeServices(STATUS)
    made.fences = FenceProposals.in_home(tmp_path)
    return made


def body(services: FakeServices, **changes: Any) -> dict[str, Any]:
    fence = services.site.fence.record.model_dump(mode="json")
    return {"fence": {**fence, "keep_outs": [KEEP_OUT], **changes}, "source": "test"}


def proposed(client: TestClient, services: FakeServices) -> dict[str, Any]:
    services.robot._status = STATUS.model_copy(update={"base_in_map": services.site.home.pose})
    answer = client.post("/v1/fence/proposals", json=body(services))
    assert answer.status_code == 201, answer.text
    found: dict[str, Any] = answer.json()
    return found


def test_a_proposal_is_kept_with_what_it_would_change(
    client: TestClient, services: FakeServices
) -> None:
    item = proposed(client, services)
    assert (item["state"], item["by"]) == ("proposed", "test")
    assert item["diff"]["removed_m2"] == pytest.approx(0.25, rel=0.02)
    assert services.robot.offered == [], "nothing came into force"
    listed = client.get("/v1/fence/proposals").json()["proposals"]
    assert [other["id"] for other in listed] == [item["id"]]
    assert client.get(f"/v1/fence/proposals/{item['id']}").json() == item


def test_the_fence_says_whether_bridge_and_planner_agree(
    client: TestClient, services: FakeServices
) -> None:
    shown = client.get("/v1/fence").json()
    assert shown["fence_hash"] == services.site.fence.fence_hash
    assert shown["bridge_fence_hash"] == STATUS.fence_hash
    assert shown["agreed"] is False


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"map_id": "1" * 16}, "fence_of_another_map"),
        ({"keep_outs": [[[0, 0], [1, 1], [1, 0], [0, 1], [-1, 0.5]]]}, "fence_crosses_itself"),
        ({"keep_outs": [[[0.6, 0.6], [1.2, 0.6], [1.2, 1.2], [0.6, 1.2]]]}, "fence_excludes_place"),
        ({"unknown": 1}, "invalid_request"),
        ({"allowed": []}, "invalid_request"),
        ({"version": 2}, "invalid_request"),
    ],
)
def test_what_can_not_be_is_refused_with_its_code(
    client: TestClient, services: FakeServices, changes: dict[str, Any], code: str
) -> None:
    answer = client.post("/v1/fence/proposals", json=body(services, **changes))
    assert answer.status_code == 422
    assert answer.json()["code"] == code
    assert services.fences.list_all() == []


def test_a_fence_without_the_robot_is_refused(client: TestClient, services: FakeServices) -> None:
    pose = STATUS.base_in_map
    assert pose is not None
    assert not services.site.fence.allows(pose.x_m + 9.0, pose.y_m)
    services.robot._status = STATUS.model_copy(
        update={"base_in_map": pose.__class__(pose.x_m + 9.0, pose.y_m, 0.0)}
    )
    answer = client.post("/v1/fence/proposals", json=body(services))
    assert answer.json()["code"] == "fence_excludes_robot"


def test_on_a_virtual_drive_the_handler_signs_the_very_text(
    client: TestClient, services: FakeServices
) -> None:
    item = proposed(client, services)
    answer = client.post(f"/v1/fence/proposals/{item['id']}/accept", json={"source": "page"})
    assert answer.status_code == 200, answer.text
    (request,) = services.robot.offered
    assert request.fence == item["text"]
    assert authentic_fence(VIRTUAL_KEY, STATUS.robot, request)
    after = client.get(f"/v1/fence/proposals/{item['id']}").json()
    assert (after["state"], after["decided_by"]) == ("accepted", "page")


def test_on_metal_the_person_s_proof_is_relayed_and_none_is_made(
    client: TestClient, services: FakeServices
) -> None:
    item = proposed(client, services)
    services.robot._status = METAL
    where = f"/v1/fence/proposals/{item['id']}/accept"
    answer = client.post(where, json={})
    assert (answer.status_code, answer.json()["code"]) == (403, "operator_proof_needed")
    assert item["id"] in answer.json()["detail"]
    proof = sign_fence(b"k" * 32, STATUS.robot, STATUS.nonce, "p1", item["text"])
    given = {"id": "p1", "proof": proof.model_dump()}
    assert client.post(where, json={"source": "page", "operator": given}).status_code == 200
    (request,) = services.robot.offered
    assert request.proof == proof
    assert authentic_fence(b"k" * 32, STATUS.robot, request)
    swapped = request.model_copy(update={"fence": request.fence.replace("0.4", "0.3")})
    assert not authentic_fence(b"k" * 32, STATUS.robot, swapped), "a planner can't put in another"


def test_the_bridge_s_refusal_is_told_and_the_proposal_stays_open(
    client: TestClient, services: FakeServices
) -> None:
    item = proposed(client, services)
    services.robot.verdict = Answer(
        id="x", kind="fence", accepted=False, code="not_disarmed", detail="mode is HOLD"
    )
    answer = client.post(f"/v1/fence/proposals/{item['id']}/accept", json={})
    assert (answer.status_code, answer.json()["code"]) == (409, "not_disarmed")
    after = client.get(f"/v1/fence/proposals/{item['id']}").json()
    assert (after["state"], after["reason"]) == ("proposed", "not_disarmed")


def test_a_silent_bridge_is_said(client: TestClient, services: FakeServices) -> None:
    item = proposed(client, services)
    services.robot.verdict = None
    answer = client.post(f"/v1/fence/proposals/{item['id']}/accept", json={})
    assert (answer.status_code, answer.json()["code"]) == (503, "bridge_silent")
    services.robot._status = None
    assert client.post(f"/v1/fence/proposals/{item['id']}/accept", json={}).status_code == 503


def test_a_rejected_one_stays_rejected(client: TestClient, services: FakeServices) -> None:
    item = proposed(client, services)
    where = f"/v1/fence/proposals/{item['id']}/reject"
    assert client.post(where, json={"source": "page"}).json()["state"] == "rejected"
    again = client.post(where, json={})
    assert (again.status_code, again.json()["code"]) == (409, "fence_decided")


@pytest.mark.parametrize("name", ["0" * 16, "nonsense"])
def test_an_unknown_proposal_is_404(client: TestClient, name: str) -> None:
    for method, where in (("GET", ""), ("POST", "/accept"), ("POST", "/reject")):
        answer = client.request(method, f"/v1/fence/proposals/{name}{where}", json={})
        assert answer.status_code == 404
        assert answer.json()["code"] == "unknown_fence_proposal"


def test_a_proof_of_odd_shape_is_refused(client: TestClient, services: FakeServices) -> None:
    item = proposed(client, services)
    given = {"id": "p1", "proof": {"nonce": "n", "mac": "short"}}
    answer = client.post(f"/v1/fence/proposals/{item['id']}/accept", json={"operator": given})
    assert answer.json()["code"] == "invalid_request"
    assert services.robot.offered == []
