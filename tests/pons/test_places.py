"""``pons places`` lists, teaches and forgets, and says what the planner refused."""

from __future__ import annotations

import json
from typing import Any

import pytest

from planner.site.taught_places import TaughtFile
from pons import places
from pons.http import PlannerDown, PlannerProblem
from pons.settings import LaunchSettings, load

CORNER: dict[str, Any] = {
    "id": "corner",
    "name": {"en": "corner", "zh": "阅读角"},
    "pose": {"x_m": 1.0, "y_m": 2.0, "yaw_rad": 0.0},
    "map_id": "a" * 16,
    "by": "cli",
    "taught": "2026-11-21T10:11:12Z",
    "why_not": None,
    "message": None,
}
OTHER = {
    **CORNER,
    "id": "nook",
    "why_not": "other_map",
    "message": {"en": "it was taught on another map", "zh": "另一张地图"},
}
KNOWN = {
    "places": [{"id": "kitchen", "name": {"en": "kitchen", "zh": "厨房"}}, CORNER],
    "taught": [CORNER, OTHER],
    "most": 32,
}


class Planner:
    """Answer what the test says and keep what was asked."""

    def __init__(self, answer: Any) -> None:
        self.answer = answer
        self.asked: list[tuple[Any, ...]] = []

    def __call__(self, _: LaunchSettings, *asked: Any) -> Any:
        self.asked.append(asked)
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


@pytest.mark.parametrize(
    ("act", "name", "chinese", "answer", "asked", "said"),
    [
        ("list", None, None, KNOWN, ("GET", "/v1/places"), "1 of 32 taught on this map"),
        (
            "remember",
            "corner",
            "阅读角",
            CORNER,
            ("POST", "/v1/places", {"name": {"en": "corner", "zh": "阅读角"}, "source": "cli"}),
            "remembered corner: corner / 阅读角  at (1.00, 2.00) m",
        ),
        ("forget", "阅 a/b", None, CORNER, ("DELETE", "/v1/places/%E9%98%85%20a%2Fb"), "forgotten"),
    ],
)
def test_each_act_is_one_request(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    act: str,
    name: str | None,
    chinese: str | None,
    answer: Any,
    asked: tuple[Any, ...],
    said: str,
) -> None:
    planner = Planner(answer)
    monkeypatch.setattr(places, "call", planner)
    assert places.run(load(), act, name, chinese=chinese) == places.EXIT_DONE
    assert planner.asked == [asked]
    out = capsys.readouterr().out
    assert said in out
    if act == "list":
        assert out.count("corner    ") == 1  # the site's own, then the taught ones, each once
        assert "not used: it was taught on another map" in out


@pytest.mark.parametrize(
    ("failure", "status", "said"),
    [
        (PlannerProblem(409, "robot_moving", "x", {"en": "stand", "zh": "停稳"}), 3, "停稳"),
        (PlannerDown("gone"), 6, "pons up"),
    ],
)
def test_what_went_wrong_is_said(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    failure: Exception,
    status: int,
    said: str,
) -> None:
    monkeypatch.setattr(places, "call", Planner(failure))
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert places.run(load(), "remember", "corner") == status
    assert said in capsys.readouterr().err


def test_a_name_is_needed(capsys: pytest.CaptureFixture[str]) -> None:
    assert places.run(load(), "remember", None) == places.EXIT_USAGE
    assert places.run(load(), "forget", None, chinese="x") == places.EXIT_USAGE
    assert "no_name" in capsys.readouterr().err


def test_what_was_taught_is_exported_as_a_planner_takes_it_in(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(places, "call", Planner(KNOWN))
    assert places.run(load(), "export", None) == places.EXIT_DONE
    told = json.loads(capsys.readouterr().out)
    taught = TaughtFile.model_validate(told).places
    assert [place.id for place in taught] == ["corner", "nook"]
    assert taught[0].pose.y_m == CORNER["pose"]["y_m"]
