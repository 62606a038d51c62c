"""What is seen is told: things, picture, events, figures; an operator has it forgotten."""

from __future__ import annotations

import asyncio
import json
from dataclasses import replace
from typing import Any

import pytest

from planner.api import Access
from planner.api.live_state import SAME_S, SIGHT_S, Feed
from planner.perception import Detection, LookSnapshot, Picture, Sight, Thing
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.planner.perception.scenes import image
from wire import Pose2

CUP = Thing("cup_1", "cup", "red", 1.234, 2.0, 0.8, 0.05, 0.912, 90.0, 40.0, 7, "kitchen")
CHAIR = Thing("chair_1", "chair", None, 3.0, 2.0, 0.4, 0.1, 0.5, 99.5, 99.0, 2, None)
LOOK = LookSnapshot(
    5, 99.9, Pose2(0.0, 0.0, 0.0), 320, 240,
    (Detection("cup", 0.8, (10.4, 20.0, 30.0, 40.0), "red", 1.0),
     Detection("chair", 0.3, (50.0, 60.0, 90.0, 99.0))), ("cup_1", ""),
)  # fmt: skip
VIEWER = Access("0.0.0.0", hosts=frozenset({"127.0.0.1"}), operator_token="o" * 16,
                viewer_token="v" * 16)  # fmt: skip


def seeing(blind: str | None = None) -> FakeServices:
    services = FakeServices()
    services.eyes.sight = Sight(LOOK, (CUP, CHAIR), blind)
    services.eyes.changed_s = {"cup_1": 90.0, "chair_1": 99.5}
    services.eyes.version = 4
    return services


def test_a_detector_refused_late_is_told_in_words() -> None:
    shown = client_of(seeing("model_broken")).get("/v1/objects").json()
    assert (shown["blind"], shown["message"]["zh"]) == (
        "model_broken",
        "onnxruntime 无法加载该模型",
    )


def test_things_are_listed_with_their_ages_and_names() -> None:
    shown = client_of(seeing("camera_frozen")).get("/v1/objects").json()
    assert shown["version"] == 4
    assert shown["blind"] == "camera_frozen"
    assert "摄像头" in shown["message"]["zh"]
    assert [one["id"] for one in shown["classes"]] == ["person", "cup"]
    cup = shown["objects"][0]
    assert cup["name"] == {"en": "red cup", "zh": "红色的杯子"}
    assert (cup["x_m"], cup["age_s"], cup["confidence"], cup["room"]) == (
        1.23,
        10.0,
        0.91,
        "kitchen",
    )
    assert shown["objects"][1]["room"] is None


def test_an_operator_forgets_one_or_all() -> None:
    services = seeing()
    client = client_of(services)
    client.headers["content-type"] = "application/json"
    missing = client.delete("/v1/objects/cup_9")
    assert (missing.status_code, missing.json()["code"]) == (404, "unknown_object")
    assert "cup_1" in missing.json()["detail"]
    assert client.delete("/v1/objects/cup_1").json() == {"forgotten": ["cup_1"]}
    assert client.delete("/v1/objects").json() == {"forgotten": ["chair_1"]}


def test_the_picture_is_given_as_it_came() -> None:
    services = seeing()
    services.eyes.picture = Picture(image(7, 0.0), None, 99.5)
    answer = client_of(services).get("/v1/camera.jpg")
    assert answer.content == services.eyes.picture.color.data
    assert answer.headers["content-type"] == "image/jpeg"
    assert answer.headers["cache-control"] == "no-store"
    assert (answer.headers["x-pons-seq"], answer.headers["x-pons-age-s"]) == ("7", "0.500")
    assert services.eyes.shown == 1


@pytest.mark.parametrize(
    ("blind", "picture", "code"),
    [
        ("no_camera", Picture(image(), None, 99.9), "no_camera"),
        (None, None, "camera_silent"),
        (None, Picture(image(), None, 90.0), "camera_silent"),  # too old to be a view
        (None, Picture(image(data=b"<html>"), None, 99.9), "camera_silent"),
    ],
)
def test_without_a_picture_it_is_said_why(
    blind: str | None, picture: Picture | None, code: str
) -> None:
    services = seeing(blind)
    services.eyes.picture = picture
    answer = client_of(services).get("/v1/camera.jpg")
    assert (answer.status_code, answer.json()["code"]) == (503, code)
    assert answer.json()["message"]["zh"]


def test_figures_tell_what_was_not_looked_at() -> None:
    text = client_of(seeing("camera_silent")).get("/metrics").text
    assert 'pons_eyes_skipped{reason="stale"} 2.0' in text
    assert 'pons_eyes_blind{reason="camera_silent"} 1.0' in text
    assert "pons_eyes_things 2.0" in text


def test_sight_is_told_when_it_changes_and_no_faster() -> None:
    told = asyncio.run(_told())
    assert [frame["look"]["seq"] for frame in told] == [5, 8, 9]
    first = told[0]
    assert first["look"]["boxes"][0] == {
        "label": "cup", "name": {"en": "red cup", "zh": "红色的杯子"}, "score": 0.8,
        "box": [10, 20, 30, 40], "color": "red", "id": "cup_1",
    }  # fmt: skip
    assert first["look"]["boxes"][1]["id"] is None
    assert [thing["id"] for thing in first["things"]] == ["chair_1"]  # the cup changed long ago
    assert len(json.dumps(first)) < 1_200


async def _told() -> list[dict[str, Any]]:
    services, now = seeing(), [0.0]
    feed = Feed(services, clock=lambda: now[0])
    listener = feed.listen()
    frames: list[dict[str, Any]] = []
    trembling = replace(LOOK.detections[0], box=(11.0, 22.0, 31.0, 40.0))
    gone = (LOOK.detections[1],)
    for at_s, look in (
        (0.0, LOOK),
        (SIGHT_S / 2, replace(LOOK, seq=6, detections=gone, here=("",))),  # too soon
        (SIGHT_S + 0.1, replace(LOOK, seq=7, detections=(trembling, *gone))),  # the same again
        (SIGHT_S + 0.2, replace(LOOK, seq=8, detections=gone, here=("",))),
        (SIGHT_S + 0.3 + SAME_S, replace(LOOK, seq=9, detections=gone, here=("",))),
    ):
        now[0] = at_s
        services.eyes.sight = replace(services.eyes.sight, look=look)
        feed.look()
        if listener._waiting:
            bodies = [json.loads("{" + body) for body in await listener.take()]
            frames += [body["sight"] for body in bodies if body["kind"] == "sight"]
    feed.leave(listener)
    return frames


def test_who_begins_to_watch_is_told_what_is_seen() -> None:
    with client_of(seeing()).websocket_connect(
        "/v1/events", headers={"host": "127.0.0.1:8420"}
    ) as socket:
        snapshot = socket.receive_json()
    assert snapshot["sight"]["look"]["seq"] == 5
    assert snapshot["sight"]["version"] == 4
