"""``pons go`` and ``pons rehearse`` ask the planner what was meant, and tell its answer."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import replace
from math import pi

import pytest

from pons import pointing, rehearse
from pons.grammar import parser
from pons.settings import LaunchSettings, load
from tests.known import known
from tests.planner.api.serving import Served, served

pytestmark = pytest.mark.nightly(keep=5)


@pytest.fixture
def planner() -> Iterator[tuple[Served, LaunchSettings]]:
    with served() as running:
        yield running, replace(load(), host="127.0.0.1", port=running.port)


def said(*words: str) -> argparse.Namespace:
    return parser().parse_args(words)


@pytest.mark.parametrize(
    ("words", "text"),
    [("living room", "go to the living room"), ("LIVING_ROOM", "go to the living room"),
     ("客厅", "去客厅")],
)  # fmt: skip
def test_a_place_is_gone_to_by_any_of_its_names(
    planner: tuple[Served, LaunchSettings], words: str, text: str
) -> None:
    running, settings = planner
    assert pointing.run(settings, said("go", *words.split(), "--no-wait")) == 0
    assert text in json.dumps(running.services.goals.calls, default=str, ensure_ascii=False)


def test_a_place_that_is_not_there_is_refused_with_the_nearest(
    planner: tuple[Served, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    running, settings = planner
    assert pointing.run(settings, said("go", "livin", "room")) == 2
    assert "did you mean living room" in capsys.readouterr().err
    assert running.services.goals.calls == []


def test_a_point_is_of_the_robots_map_and_its_heading_in_degrees(
    planner: tuple[Served, LaunchSettings],
) -> None:
    running, settings = planner
    words = said("go", "-1.5", "4.2", "270", "--no-wait", "--map", "a" * 16)
    body, _ = pointing._goal_of(settings, words.where, words.map)
    assert body is not None
    assert body["points"] == [{"x_m": -1.5, "y_m": 4.2, "yaw_rad": pytest.approx(-pi / 2)}]
    own, _ = pointing._goal_of(settings, ["1", "2"], None)
    assert own is not None
    status = known(running.services.robot.status)
    assert own["map_id"] == status.map_id


@pytest.mark.parametrize("where", [["1"], ["1", "2", "3", "4"], ["nan", "2"]])
def test_what_is_no_point_is_refused(
    planner: tuple[Served, LaunchSettings], where: list[str]
) -> None:
    _, settings = planner
    assert pointing.run(settings, said("go", *where, "--no-wait")) in (2, 3)


def test_a_sentence_is_shown_with_its_figures(
    planner: tuple[Served, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    running, settings = planner
    assert rehearse.run(settings, said("rehearse", "go to the living room, then go home")) == 0
    told = capsys.readouterr().out
    assert "1. go_to living room: 2.0 m" in told
    assert "narrowest 0.84 m" in told
    assert "nothing has moved" in told
    assert running.services.goals.calls == []


def test_a_way_that_is_shut_is_status_1_and_told(
    planner: tuple[Served, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    assert rehearse.run(planner[1], said("rehearse", "go to the kitchen")) == 1
    assert "no_route" in capsys.readouterr().out


def test_what_is_no_plan_is_refused(planner: tuple[Served, LaunchSettings]) -> None:
    assert rehearse.run(planner[1], said("rehearse", "hello")) == 3
    assert rehearse.run(planner[1], said("rehearse", "--drive", "hello")) == 3
    assert rehearse.run(planner[1], said("rehearse")) == 2
    assert rehearse.run(planner[1], said("rehearse", "--goal", "g1", "go home")) == 2


def test_a_drive_is_followed_to_its_end_and_what_was_left_out_is_told(
    planner: tuple[Served, LaunchSettings],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(rehearse, "POLL_S", 0.05)
    words = ("rehearse", "--drive", "wait 1 second, then go home")
    assert rehearse.run(planner[1], said(*words)) == 1, "the small process ends under way"
    told = capsys.readouterr().out
    assert "1. wait: running, 1.0 m" in told
    assert "not simulated: finding itself on the map, people who walk" in told


def test_each_thing_that_is_left_out_has_words() -> None:
    from planner.driven_rehearsal import LeftOut

    assert set(rehearse.LEFT_OUT) == set(LeftOut)
