"""Pictures of patrols are listed, shown and forgotten, by who may see the camera and may act."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.memory import KeptPicture, MemoryStore, Recollection
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.planner.api.test_objects import VIEWER, seeing

NOW_S = 1_800_000_000.0
JPEG = b"\xff\xd8 what the camera gave"
VIEWS = {"authorization": "Bearer " + VIEWER.viewer_token}


@pytest.fixture
def services(tmp_path: Path) -> FakeServices:
    store = MemoryStore(StateDatabase(tmp_path))
    for stop, labels in enumerate((("cup", "cup"), ())):
        picture = KeptPicture("g1", 0, stop, "kitchen", labels, "image/jpeg", NOW_S - 60.0)
        store.pictures.keep(picture, JPEG)
    made = seeing()
    made.recollection = Recollection(store, wall=lambda: NOW_S)
    return made


def test_they_are_listed_shown_and_forgotten(services: FakeServices) -> None:
    client = client_of(services)
    first, second = client.get("/v1/pictures?goal=g1").json()["pictures"]
    assert (first["goal"], first["step"], first["stop"], first["place"]) == ("g1", 0, 0, "kitchen")
    assert first["names"] == [{"en": "cup", "zh": "杯子"}]
    assert (second["names"], second["bytes"]) == ([], len(JPEG))
    shown = client.get(f"/v1/pictures/{first['id']}")
    assert (shown.content, shown.headers["content-type"]) == (JPEG, "image/jpeg")
    assert shown.headers["cache-control"] == "no-store"
    gone = client.request("DELETE", f"/v1/pictures/{first['id']}", json={})
    assert gone.json() == {"forgotten": 1}
    assert len(client.get("/v1/pictures").json()["pictures"]) == 1
    assert client.get("/v1/pictures?goal=other").json()["pictures"] == []


def test_a_number_that_is_none_says_so(services: FakeServices) -> None:
    client = client_of(services)
    for answer in (
        client.get("/v1/pictures/99"),
        client.request("DELETE", "/v1/pictures/99", json={}),
    ):
        assert (answer.status_code, answer.json()["code"]) == (404, "unknown_picture")
        assert answer.json()["message"]["zh"]
    assert client.get("/v1/pictures/0").status_code == 422
    assert client.get("/v1/pictures/x").status_code == 422


def test_who_may_view_sees_them_and_forgets_none(services: FakeServices) -> None:
    client = client_of(services, VIEWER)
    assert client.get("/v1/pictures").status_code == 401
    (first, _) = client.get("/v1/pictures", headers=VIEWS).json()["pictures"]
    assert client.get(f"/v1/pictures/{first['id']}").status_code == 401
    assert client.get(f"/v1/pictures/{first['id']}", headers=VIEWS).status_code == 200
    refused = client.request("DELETE", f"/v1/pictures/{first['id']}", json={}, headers=VIEWS)
    assert refused.status_code == 403


def test_a_disk_that_refuses_is_told(services: FakeServices, tmp_path: Path) -> None:
    spoilt = tmp_path / "spoilt"
    spoilt.mkdir()
    (spoilt / "state.sqlite").write_bytes(b"no database at all" * 100)
    services.recollection = Recollection(MemoryStore(StateDatabase(spoilt)))
    answer = client_of(services).get("/v1/pictures")
    assert (answer.status_code, answer.json()["code"]) == (503, "memory_unavailable")
