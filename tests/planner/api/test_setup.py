"""Set-up's routes relay, and refuse where there is none; what moves is never their word."""

from __future__ import annotations

from typing import cast

from starlette.testclient import TestClient

from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of as served
from tests.wire.examples import EXAMPLES, STATUS
from wire import Mode, TrialState

TRIAL = cast("TrialState", EXAMPLES[TrialState])


def asked(client: TestClient, act: str = "begin") -> tuple[int, str]:
    answer = client.post("/v1/trial", json={"act": act, "id": "page-1"})
    return answer.status_code, answer.json().get("code", "")


def test_an_order_reaches_set_up_as_it_came() -> None:
    services = FakeServices()
    services.robot.trial = TRIAL
    with served(services) as client:
        proof = {"nonce": "n1", "mac": "a" * 64}
        body = {"act": "begin", "id": "page-1", "source": "page", "proof": proof}
        assert client.post("/v1/trial", json=body).status_code == 202
        view = client.get("/v1/robot").json()["setup"]
    (order,) = services.robot.trial_orders
    assert (order.act, order.id) == ("begin", "page-1")
    assert order.proof is not None
    assert order.proof.mac == "a" * 64
    assert view["trial"]["phase"] == TRIAL.phase


def test_where_a_bridge_drives_or_set_up_is_deaf_it_says_so() -> None:
    services = FakeServices()
    with served(services) as client:
        assert asked(client) == (409, "no_setup")
        services.robot.trial, services.robot.takes_trial = TRIAL, False
        assert asked(client) == (503, "setup_silent")


def test_set_up_is_entered_disarmed_and_where_somebody_starts_it() -> None:
    services = FakeServices(STATUS.model_copy(update={"mode": Mode.HOLD}))
    with served(services) as client:
        answer = client.post("/v1/setup", json={})
        assert (answer.status_code, answer.json()["code"]) == (409, "not_disarmed")
        assert not services.setup.is_thrown
    services = FakeServices(STATUS.model_copy(update={"mode": Mode.DISARMED}))
    with served(services) as client:
        assert client.post("/v1/setup", json={}).status_code == 202
        assert services.setup.is_thrown
        services.setup.is_there = False
        assert client.post("/v1/setup", json={}).json()["code"] == "setup_unavailable"
