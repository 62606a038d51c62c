"""A person says where the robot is over HTTP; localization judges, and its verdict has a code."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from maps.growing_map import GROWING_MAP
from planner.site import KnownPlaces
from tests.planner.api.fakes import FakeServices
from tests.wire.examples import EXAMPLES
from wire import HintCode, LocalizerStatus


@pytest.fixture
def services() -> FakeServices:
    made = FakeServices()
    said = EXAMPLES[LocalizerStatus]
    assert isinstance(said, LocalizerStatus)
    made.robot.localizer = said
    return made


HINT = "/v1/localization/hint"


def test_a_point_without_a_heading_is_sought_with_every_one(
    client: TestClient, services: FakeServices
) -> None:
    answer = client.post(HINT, json={"point": {"x_m": 1.0, "y_m": 4.2}})
    assert answer.status_code == 200
    assert answer.json()["code"] == "accepted"
    (hint,) = services.robot.hints
    assert (hint.pose.x_m, hint.pose.y_m, hint.any_heading) == (1.0, 4.2, True)
    client.post(HINT, json={"point": {"x_m": 1, "y_m": 4.2, "yaw_rad": 0.5}})
    assert not services.robot.hints[-1].any_heading


def test_a_room_is_sought_within_its_outline(client: TestClient, services: FakeServices) -> None:
    room = services.site.rooms[0]
    assert client.post(HINT, json={"place": room.name.zh}).status_code == 200
    (hint,) = services.robot.hints
    assert hint.outline == room.polygon
    assert hint.any_heading


@pytest.mark.parametrize(
    ("code", "status"),
    [
        ("moving", 409),
        ("busy", 409),
        ("no_scan", 503),
        ("does_not_fit", 422),
        ("ambiguous", 422),
        (None, 503),
    ],
)
def test_a_verdict_is_a_problem_with_its_code(
    client: TestClient, services: FakeServices, code: HintCode | None, status: int
) -> None:
    services.robot.hint_code = code
    answer = client.post(HINT, json={"point": {"x_m": 1.0, "y_m": 4.2}})
    assert (answer.status_code, answer.json()["code"]) == (status, f"hint_{code or 'no_answer'}")
    assert answer.json()["message"]["zh"]


@pytest.mark.parametrize(
    ("state", "score", "told"),
    [
        ("tracking", 0.4, "(score 0.40, needs 0.60)"),
        ("tracking", 0.7, "fits there (0.70), but less well than where I take myself to be (0.90)"),
        ("lost", 0.4, "(score 0.40, needs 0.60)"),
    ],
)
def test_a_place_that_fits_less_well_than_the_pose_is_told_apart(
    client: TestClient, services: FakeServices, state: str, score: float, told: str
) -> None:
    said = services.robot.localizer
    assert said is not None
    services.robot.localizer = said.model_copy(update={"state": state, "score": 0.9})
    services.robot.hint_code, services.robot.hint_score = "does_not_fit", score
    answer = client.post(HINT, json={"point": {"x_m": 1.0, "y_m": 4.2}}).json()
    assert answer["code"] == "hint_does_not_fit"
    assert told in answer["detail"]
    assert ("0.70" in answer["message"]["zh"]) is ("less well" in told)


def test_a_room_that_looks_alike_from_both_ends_is_told_so(
    client: TestClient, services: FakeServices
) -> None:
    services.robot.hint_code, services.robot.hint_score = "ambiguous", 0.98
    answer = client.post(HINT, json={"point": {"x_m": 1.0, "y_m": 4.2}}).json()
    assert answer["code"] == "hint_ambiguous"
    assert "more than one place" in answer["detail"]
    assert "不止一处" in answer["message"]["zh"]
    assert "needs" not in answer["detail"], "the score is not what is lacking"


@pytest.mark.parametrize(
    ("body", "status", "code"),
    [
        ({"place": "attic"}, 404, "unknown_place"),
        ({"point": {"x_m": "2", "y_m": 1.0}}, 422, "invalid_request"),
        ({"point": {"x_m": True, "y_m": 1.0}}, 422, "invalid_request"),
        ({"point": {"x_m": 1.0, "y_m": 1.0, "yaw_rad": False}}, 422, "invalid_request"),
    ],
)
def test_what_is_no_place_is_refused(
    client: TestClient, services: FakeServices, body: object, status: int, code: str
) -> None:
    answer = client.post(HINT, json=body)
    assert (answer.status_code, answer.json()["code"]) == (status, code)
    assert answer.json()["message"]["zh"] != answer.json()["message"]["en"]
    assert not services.robot.hints


def test_a_robot_without_a_localizer_says_so(client: TestClient, services: FakeServices) -> None:
    services.robot.localizer, services.robot.takes_hints = None, False
    answer = client.post(HINT, json={"point": {"x_m": 1.0, "y_m": 4.2}})
    assert (answer.status_code, answer.json()["code"]) == (503, "hint_no_localizer")
    assert client.get("/v1/localization").json() == {"localizer": None, "trouble": None}
    robot = client.get("/v1/robot").json()
    assert (robot["localizer"], robot["match"]) == (None, None)


def test_while_a_map_grows_a_hint_is_refused_at_once(
    client: TestClient, services: FakeServices, tmp_path: Path
) -> None:
    (tmp_path / GROWING_MAP).touch()
    services.memory = KnownPlaces(replace(services.site, folder=tmp_path))
    room = services.site.rooms[0]
    for where in ({"point": {"x_m": 1.0, "y_m": 4.2}}, {"place": room.name.en}):
        answer = client.post(HINT, json=where)
        assert (answer.status_code, answer.json()["code"]) == (409, "hint_map_grows")
        assert "a map is being made" in answer.json()["message"]["en"]
        assert "正在建图" in answer.json()["message"]["zh"]
    assert not services.robot.hints, "the mapper would never answer"


def test_a_localizer_that_fell_silent_is_said_not_to_answer(
    client: TestClient, services: FakeServices
) -> None:
    services.robot.localizer, services.robot.hint_code = None, None
    answer = client.post(HINT, json={"point": {"x_m": 1.0, "y_m": 4.2}})
    assert (answer.status_code, answer.json()["code"]) == (503, "hint_no_answer")


def test_what_it_does_is_shown(client: TestClient) -> None:
    shown = client.get("/v1/localization").json()["localizer"]
    assert (shown["state"], len(shown["candidates"])) == ("lost", 1)
    robot = client.get("/v1/robot").json()
    assert robot["localizer"] == "lost"
    assert robot["match"] == {"score": shown["score"], "candidates": shown["candidates"]}


def test_why_there_is_no_pose_is_told_in_both_languages(
    client: TestClient, services: FakeServices
) -> None:
    said = services.robot.localizer
    assert said is not None
    services.robot.localizer = said.model_copy(update={"trouble": "carried_while_mapping"})
    trouble = client.get("/v1/localization").json()["trouble"]
    assert trouble["code"] == "carried_while_mapping"
    assert "Put me back where I was" in trouble["message"]["en"]
    assert "放回原处" in trouble["message"]["zh"]
    assert client.get("/v1/robot").json()["localizer_trouble"] == trouble


def test_another_map_of_the_localizer_is_shown(client: TestClient, services: FakeServices) -> None:
    assert client.get("/v1/robot").json()["localized_map"] is None
    services.robot.localized_map = "b" * 16
    robot = client.get("/v1/robot").json()
    assert (robot["localized_map"], robot["map_id"]) == ("b" * 16, services.site.map_id)
