"""Try the settings' routes: the owner's alone, each refusal with a code in both languages."""

from __future__ import annotations

import socket
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.people import People, Role
from planner.settings import FILE, Settings
from planner.settings_desk import SettingsDesk
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import PEOPLED, client_of
from tests.wire.examples import STATUS
from wire import Mode

OWNER = {"authorization": f"Bearer {'o' * 20}"}
VIEWER = {"authorization": f"Bearer {'v' * 20}"}
PATH = "/v1/settings"
KEY = "sk-secret-0123456789"


@pytest.fixture
def services(tmp_path: Path) -> FakeServices:
    made = FakeServices(STATUS.model_copy(update={"mode": Mode.HOLD}))
    database = StateDatabase(tmp_path)
    made.people = People(database)
    made.settings_desk = SettingsDesk(tmp_path, {}, Settings(), database, robot_mps=0.5)
    return made


@pytest.fixture
def client(services: FakeServices) -> TestClient:
    return client_of(services, PEOPLED)


def patch(client: TestClient, changes: dict[str, Any], revision: str = "") -> Any:
    revision = revision or client.get(PATH, headers=OWNER).json()["revision"]
    body = {"revision": revision, "changes": changes, "source": "page"}
    return client.patch(PATH, json=body, headers=OWNER)


def test_the_owner_sees_and_saves_and_no_answer_holds_a_key(client: TestClient) -> None:
    changes = {"model.preset": "ollama", "model.name": "<i>m</i>", "model.key": KEY}
    saved = patch(client, changes)
    assert saved.status_code == 200
    shown = {each["name"]: each for each in client.get(PATH, headers=OWNER).json()["fields"]}
    assert shown["model.name"]["value"] == "<i>m</i>"
    assert (shown["model.key"]["value"], shown["model.key"]["is_set"]) == (None, True)
    assert KEY not in saved.text
    assert saved.json()["changes"][0]["by"] == "page"
    assert saved.json()["changes"][0]["names"] == sorted(changes)


def test_nobody_but_the_owner_may_even_look(client: TestClient, services: FakeServices) -> None:
    _, token = services.people.add("Ana", Role.OPERATOR)
    for headers in (VIEWER, {"authorization": f"Bearer {token}"}):
        for method, path in (("GET", ""), ("PATCH", ""), ("POST", "/model/test"),
                             ("POST", "/restart")):  # fmt: skip
            refused = client.request(method, PATH + path, headers=headers, json={})
            assert (refused.status_code, refused.json()["code"]) == (403, "owner_needed")


@pytest.mark.parametrize(
    ("changes", "status", "code"),
    [
        ({"model.url": "http://u:pw@127.0.0.1/v1", "model.name": "m"}, 422, "model_url"),
        ({"model.url": "https://a.example/v1", "model.name": "m"}, 422, "model_offhost"),
        ({"model.name": "x" * 10_000}, 422, "invalid_request"),
        ({"drive.port": "x"}, 422, "settings_unknown"),
        ({"limits.max_speed_mps": 0.51}, 422, "settings_out_of_range"),
        ({"limits.max_speed_mps": [1]}, 422, "invalid_request"),
        ({"orders.notify.url": "http://169.254.169.254/"}, 422, "notify_url"),
        ({"speech.quiet": "soon"}, 422, "settings_malformed"),
        ({}, 422, "invalid_request"),
    ],
)
def test_bad_input_is_told_in_both_languages_and_changes_nothing(
    client: TestClient, tmp_path: Path, changes: dict[str, Any], status: int, code: str
) -> None:
    refused = patch(client, changes)
    assert (refused.status_code, refused.json()["code"]) == (status, code)
    assert refused.json()["message"]["zh"] != refused.json()["message"]["en"]
    assert "pw@" not in refused.text
    assert not (tmp_path / FILE).exists()


def test_two_people_saving_at_once_are_told_apart(client: TestClient) -> None:
    seen = client.get(PATH, headers=OWNER).json()["revision"]
    assert patch(client, {"orders.quiet": "22:00-07:00"}, seen).status_code == 200
    late = patch(client, {"orders.quiet": "20:00-07:00"}, seen)
    assert (late.status_code, late.json()["code"]) == (409, "settings_changed")
    assert "again" in late.json()["message"]["en"]


def test_a_disk_that_refuses_is_told(client: TestClient, tmp_path: Path) -> None:
    (tmp_path / f".{FILE}.new").mkdir()
    refused = patch(client, {"orders.quiet": "22:00-07:00"})
    assert (refused.status_code, refused.json()["code"]) == (503, "settings_unwritable")


def test_a_model_is_tried_saved_or_typed(client: TestClient) -> None:
    def tried(**body: str) -> Any:
        return client.post(f"{PATH}/model/test", json=body, headers=OWNER)

    assert tried().json()["code"] == "model_unset"
    assert tried(url="http://u:p@x/v1").json()["code"] == "model_url"
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        url = f"http://127.0.0.1:{port}/v1"
        assert tried(url=url).json() == {
            "name": "", "where": f"127.0.0.1:{port}", "is_reached": True, "trouble": None,
        }  # fmt: skip
        patch(client, {"model.url": url, "model.name": "m"})
        assert tried().json()["name"] == "m"
    assert tried().json()["is_reached"] is False


def test_the_next_start_is_asked_for_standing_and_where_somebody_starts_it(
    client: TestClient, services: FakeServices
) -> None:
    def asked() -> tuple[int, str]:
        answer = client.post(f"{PATH}/restart", json={}, headers=OWNER)
        return answer.status_code, answer.json().get("code", "")

    services.robot._status = STATUS.model_copy(update={"mode": Mode.ACTIVE})
    assert asked() == (409, "robot_moves")
    services.robot._status = STATUS.model_copy(update={"mode": Mode.HOLD})
    services.restart.is_there = False
    assert asked() == (409, "restart_unavailable")
    assert client.get(PATH, headers=OWNER).json()["can_restart"] is False
    services.restart.is_there = True
    assert (*asked(), services.restart.is_thrown) == (202, "", True)
