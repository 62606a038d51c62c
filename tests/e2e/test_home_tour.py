"""Drive through the whole default home, by sentences in both languages, and touch nothing."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest

from pons.terminal_text import figures
from tests.e2e.robot import Robot, resting_in
from tests.e2e.system import HOME_SITE

pytestmark = [pytest.mark.home, pytest.mark.timeout(600)]

ROOMS = ("entrance", "bedroom", "bathroom", "hallway", "study", "living_room", "kitchen")
"""By the shortest way from the dock through all of them: 31 m, of the 42 m of another order."""
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
