"""Drive through the whole default home, by sentences in both languages, and touch nothing."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from math import hypot

import pytest

from pons.terminal_text import figures
from tests.e2e.robot import THERE_M, Robot, resting_in
from tests.e2e.system import ENDED, HOME_SITE

pytestmark = [pytest.mark.home, pytest.mark.timeout(600)]

ROOMS = ("hallway", "living_room", "kitchen", "study", "bathroom", "bedroom", "entrance")
DRIVE_LIMIT_S = 120.0


@pytest.fixture(scope="module")
def house() -> Iterator[Robot]:
    """Return a robot at rest in the default home."""
    with resting_in(HOME_SITE) as robot:
        yield robot


def test_seven_rooms_in_both_languages(
    house: Robot, record_property: Callable[[str, object], None]
) -> None:
    assert {room.id for room in house.site.rooms} == set(ROOMS)
    for number, room_id in enumerate(ROOMS):
        place, began_s = house.place(room_id), time.monotonic()
        text = f"go to the {place.name.en}" if number % 2 else f"去{place.name.zh}"
        ended = house.arrive(place, house.system.give(text), DRIVE_LIMIT_S)
        house.assert_figures(ended, place, began_s)
        outcome = ended["outcome"]
        assert outcome["reached"]["room"] == room_id
        record_property(room_id, figures(outcome))
        print(f"{text}: {figures(outcome)}")


def test_kitchen_then_bedroom_then_back(
    house: Robot, record_property: Callable[[str, object], None]
) -> None:
    began, began_s = house.judge.truth.base_in_map, time.monotonic()
    done = house.system.pons(
        "say", "go to the kitchen, then the bedroom, then come back", timeout_s=3 * DRIVE_LIMIT_S
    )
    assert done.returncode == 0, (done.stdout, done.stderr)
    goal = house.system.goals()[0]
    assert goal["state"] in ENDED
    kitchen, bedroom, back = goal["plan"]["steps"]
    assert kitchen["reached"]["room"] == "kitchen"
    assert bedroom["reached"]["room"] == "bedroom"
    assert back["kind"] == "come_back"
    pose = house.judge.truth.base_in_map
    assert hypot(pose.x_m - began.x_m, pose.y_m - began.y_m) < THERE_M
    house.judge.assert_no_contact()
    driven_m = house.judge.path_m(began_s)
    outcome = goal["outcome"]
    assert abs(outcome["metres"] - driven_m) < 0.1 + 0.1 * driven_m
    record_property("there and back", figures(outcome))
    print(f"{goal['text']}: {figures(outcome)}")
