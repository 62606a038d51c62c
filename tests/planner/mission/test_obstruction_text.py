"""What is said of an obstruction names the door, the room or the point, in both languages."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.mission.recovery import ShutWay
from planner.mission.spoken_status import spot_of, tell_obstruction, tell_occupied
from planner.plan import Bilingual
from tests.planner.mission.fakes import FACTS, room

SITE = replace(FACTS, targets={"hall": room("hall", 0.0), "kitchen": room("kitchen", 2.0)})


@pytest.mark.parametrize(
    ("point", "said"),
    [
        ((0.9, 0.0), "at the door between the hall and the kitchen"),
        ((1.1, 0.0), "at the door between the kitchen and the hall"),
        ((0.0, 0.0), "in the hall"),
        ((2.9, 0.0), "in the kitchen"),
        ((7.0, -1.25), "outside of every room"),
    ],
)
def test_a_spot_is_named(point: tuple[float, float], said: str) -> None:
    assert spot_of(SITE, point).en == said
    assert spot_of(SITE, point).zh


@pytest.mark.parametrize(
    ("since_unix_s", "offset_s", "time"),
    [(0.0, 0.0, "00:00"), (14 * 3600 + 3 * 60 + 59.9, 0.0, "14:03"), (1800.0, -3600.0, "23:30")],
)
def test_the_time_is_on_peoples_own_clock(since_unix_s: float, offset_s: float, time: str) -> None:
    way = ShutWay(start=(0.9, -0.2), end=(0.9, 0.3), since_unix_s=since_unix_s,
                  seen_unix_s=since_unix_s, local_offset_s=offset_s)  # fmt: skip
    said = tell_obstruction(SITE, way, Bilingual(en="kitchen", zh="厨房"))
    assert f"since {time}" in said.en
    assert time in said.zh
    assert "0.5 m wide" in said.en


def test_something_thin_is_not_told_as_nothing() -> None:
    way = ShutWay(start=(0.0, 0.0), end=(0.0, 0.0), since_unix_s=0.0, seen_unix_s=0.0)
    assert "0.1 m wide" in tell_obstruction(SITE, way, Bilingual(en="k", zh="厨")).en


def test_a_gap_of_the_map_is_told_as_too_narrow_with_its_width() -> None:
    way = ShutWay(start=(0.0, -0.4), end=(0.0, 0.35), gap=True, since_unix_s=0.0, seen_unix_s=0.0)
    said = tell_obstruction(SITE, way, Bilingual(en="kitchen", zh="厨房"))
    assert said.en == (
        "The way to the kitchen is too narrow for me in the hall: "
        "the map's walls leave 0.75 m there."
    )
    assert "0.75 米" in said.zh


def test_an_occupied_goal_names_how_near_the_robot_came() -> None:
    said = tell_occupied(Bilingual(en="kitchen", zh="厨房"), 0.62)
    assert "within 0.6 m of the kitchen" in said.en
    assert "0.6 米" in said.zh
