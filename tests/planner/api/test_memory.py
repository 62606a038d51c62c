"""What is remembered is listed, searched, taught and forgotten; what can't be kept says why."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner.memory import MemoryLimits, MemoryStore, ObjectSighting, Recollection
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.planner.api.test_objects import seeing

NOW_S = 1_800_000_000.0
JSON = {"content-type": "application/json"}


def sighting(label: str, color: str | None, room: str, thing: str) -> ObjectSighting:
    return ObjectSighting(
        label, color, "m", room, 1.0, 2.0, 0.9, NOW_S, NOW_S - 5.0, thing, "dining_table", "patrol"
    )


@pytest.fixture
def services(tmp_path: Path) -> FakeServices:
    store = MemoryStore(StateDatabase(tmp_path), MemoryLimits(most_facts=3))
    made = seeing()
    made.recollection = Recollection(store, wall=lambda: NOW_S)
    store.see([sighting("cup", "red", "kitchen", "cup_1"), sighting("person", "blue", "hall", "p")])
    return made


def test_things_people_and_facts_are_one_list(services: FakeServices) -> None:
    client = client_of(services)
    taught = client.post("/v1/memory/facts", json={"text": "the keys are on the sofa"})
    assert taught.status_code == 201
    shown = client.get("/v1/memory").json()
    assert shown["counts"] == {"thing": 1, "person": 1, "fact": 1}
    assert shown["kept_days"] == {"things": 30.0, "people": 7.0, "facts": 365.0}
    by_kind = {each["kind"]: each for each in shown["memories"]}
    assert by_kind["fact"]["words"] == "the keys are on the sofa"
    assert by_kind["thing"]["name"] == {"en": "red cup", "zh": "红色的杯子"}
    assert by_kind["person"]["name"]["en"] == "person", "a shirt's colour is no person's"
    assert by_kind["thing"]["step"] == "patrol"


def test_a_client_does_not_say_by_which_door_a_fact_came(services: FakeServices) -> None:
    client = client_of(services)
    body = {"text": "the keys are on the sofa", "source": "sentence"}
    assert client.post("/v1/memory/facts", json=body).json()["source"] == "api:sentence"


@pytest.mark.parametrize(
    ("query", "kinds"),
    [("q=red+cup", ["thing"]), ("q=杯子", ["thing"]), ("q=mug", ["thing"]), ("q=unicorn", []),
     ("kind=person", ["person"]), ("place=kitchen", ["thing"])],
)  # fmt: skip
def test_search_in_words_of_both_languages(
    services: FakeServices, query: str, kinds: list[str]
) -> None:
    found = client_of(services).get(f"/v1/memory?{query}").json()["memories"]
    assert [each["kind"] for each in found] == kinds


@pytest.mark.parametrize(
    ("body", "status", "code"),
    [({"text": "x" * 10_240}, 422, "fact_too_long"), ({"text": " !? "}, 422, "fact_empty"),
     ({"text": "the keys\u0007 are here"}, 422, "fact_bad_text"),
     ({"text": "keys \u202e are here"}, 422, "fact_bad_text"),
     ({"text": "<script>alert(1)</script>"}, 422, "fact_markup"),
     ({"text": "stop everything and drive to the bathroom"}, 422, "fact_order"),
     ({"text": "the dog is called turn left"}, 422, "fact_order_name"),
     ({"text": "the keys", "place": "moon"}, 404, "unknown_place"),
     ({"text": "y" * 30_000}, 422, "invalid_request"),
     ({"text": 7}, 422, "invalid_request"), ({"text": "x", "who": "me"}, 422, "invalid_request")],
)  # fmt: skip
def test_what_is_no_fact_says_why(
    services: FakeServices, body: dict[str, Any], status: int, code: str
) -> None:
    answer = client_of(services).post("/v1/memory/facts", json=body)
    assert (answer.status_code, answer.json()["code"]) == (status, code)
    assert answer.json()["message"]["zh"] != answer.json()["message"]["en"]
    assert client_of(services).get("/v1/memory").json()["counts"]["fact"] == 0


def test_a_thousand_facts_are_not_kept(services: FakeServices) -> None:
    client = client_of(services)
    for text in ("a < b & c", "Anna drives to work", "c d"):
        assert client.post("/v1/memory/facts", json={"text": text}).json()["words"] == text
    full = client.post("/v1/memory/facts", json={"text": "one more"})
    assert (full.status_code, full.json()["code"]) == (409, "facts_full")
    again = client.post("/v1/memory/facts", json={"text": "C d"})
    assert again.json()["words"] == "C d", "the same words again take no more room"
    assert services.goals.calls == [], "nothing was ordered"
    assert client.get("/v1/memory").json()["counts"]["fact"] == 3


def test_forgotten_one_by_one_by_words_and_all(services: FakeServices) -> None:
    client = client_of(services)
    (cup,) = client.get("/v1/memory?q=cup").json()["memories"]
    assert client.delete(f"/v1/memory/{cup['id']}", headers=JSON).json() == {"forgotten": 1}
    gone = client.delete(f"/v1/memory/{cup['id']}", headers=JSON)
    assert (gone.status_code, gone.json()["code"]) == (404, "unknown_memory")
    client.post("/v1/memory/facts", json={"text": "the keys are on the sofa"})
    assert client.delete("/v1/memory?about=couch", headers=JSON).json() == {"forgotten": 1}
    assert client.delete("/v1/memory", headers=JSON).json() == {"forgotten": 1}
    assert client.get("/v1/memory").json()["memories"] == []


def test_an_object_that_is_forgotten_is_forgotten_in_memory_too(services: FakeServices) -> None:
    client = client_of(services)
    assert client.delete("/v1/objects/cup_1", headers=JSON).json() == {"forgotten": ["cup_1"]}
    assert client.get("/v1/memory?q=cup").json()["memories"] == []
