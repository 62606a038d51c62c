"""The robot is described in the fields that Home Assistant documents, and in no other."""

from __future__ import annotations

import json
from typing import Any

import pytest

from planner.plan import Language
from planner.settings import MqttSettings
from pons.mqtt.discovery import discovery, topics_of
from tests.pons.mqtt import schemas

SETTINGS = MqttSettings(host="broker")


def described(**more: Any) -> dict[str, Any]:
    chosen = SETTINGS.model_copy(update=more)
    return discovery(chosen, "r1", "0.1.0", has_camera=True)


@pytest.mark.parametrize("language", list(Language))
def test_every_entity_has_documented_fields_and_those_it_needs(language: Language) -> None:
    told = described(language=language)
    assert set(told) == {"device", "origin", "components"}
    assert set(told["device"]) <= schemas.DEVICE
    assert told["device"]["identifiers"]
    assert set(told["origin"]) <= schemas.ORIGIN
    for entity in told["components"].values():
        platform = entity["platform"]
        assert set(entity) <= schemas.FIELDS[platform]
        assert set(entity) >= schemas.REQUIRED[platform] | {"platform", "unique_id"}
        assert set(entity.get("message_expiry_interval", {})) <= schemas.EXPIRY
        for watched in entity["availability"]:
            assert set(watched) == {"topic"}
    assert json.loads(json.dumps(told)) == told


def test_ids_are_each_their_own_and_topics_are_the_robots() -> None:
    entities = described()["components"].values()
    ids = [entity["unique_id"] for entity in entities]
    assert len(set(ids)) == len(ids)
    topics = {
        value for entity in entities for key, value in entity.items() if key.endswith("topic")
    }
    assert all(topic.startswith("pons/r1/") for topic in topics)


def test_the_vacuum_offers_rooms_and_sentences() -> None:
    vacuum = described()["components"]["vacuum"]
    assert set(vacuum["supported_features"]) <= schemas.FEATURES
    assert vacuum["clean_segments_command_topic"] == "pons/r1/segments"
    assert vacuum["name"] is None  # the device's own


def test_commands_are_never_kept_and_go_stale() -> None:
    commanded = [e for e in described()["components"].values() if "command_topic" in e]
    assert len(commanded) == 2
    for entity in commanded:
        assert entity["retain"] is False
        assert entity["message_expiry_interval"] == {"seconds": 10}


def test_the_stop_button_needs_no_planner() -> None:
    components = described()["components"]
    assert components["stop"]["availability"] == [{"topic": "pons/r1/availability"}]
    assert {"topic": "pons/r1/planner"} in components["vacuum"]["availability"]


@pytest.mark.parametrize(("has_camera", "picture_s"), [(False, 10.0), (True, 0.0)])
def test_a_robot_that_shows_no_pictures_has_no_camera(has_camera: bool, picture_s: float) -> None:
    chosen = SETTINGS.model_copy(update={"picture_s": picture_s})
    assert "camera" not in discovery(chosen, "r1", "0", has_camera=has_camera)["components"]


def test_the_device_is_found_below_the_prefix_of_the_home() -> None:
    topics = topics_of(MqttSettings(host="b", prefix="a/b", discovery_prefix="ha"), "r-1")
    assert topics.config == "ha/device/pons_r_1/config"
    assert topics.birth == "ha/status"
    assert topics.of("state") == "a/b/r-1/state"
