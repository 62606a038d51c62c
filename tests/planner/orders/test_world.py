"""Events begin once, are armed again, and a low battery sends the robot home."""

from __future__ import annotations

import re
from itertools import count, pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.api.orders import order_view
from planner.orders.world import AWAY_S, EMPTY_S, Watch, WorldFacts, notice
from planner.plan.timing import WorldEvent
from tests.planner.orders.fakes import READY, kept_in
from tests.planner.orders.test_intake import say


class Day:
    """Play looks and scans in a row."""

    def __init__(self) -> None:
        self.watch, self.now_s, self.numbers = Watch(), 100.0, count(1)
        self.happened: list[WorldEvent] = []

    def tell(self, facts: WorldFacts, seconds: float = 1.0) -> None:
        self.now_s += seconds
        self.watch, events = notice(self.watch, facts, self.now_s)
        self.happened += events

    def look(self, person: bool, seconds: float, every_s: float = 2.0) -> None:
        for _ in range(max(1, round(seconds / every_s))):
            self.tell(WorldFacts(look=next(self.numbers), person=person), every_s)


def test_who_comes_in_is_seen_once_until_gone_for_a_while() -> None:
    day = Day()
    day.look(False, EMPTY_S + 4.0)
    day.look(True, 600.0)
    assert day.happened == [WorldEvent.PERSON_SEEN]
    day.look(False, AWAY_S / 2.0)
    day.look(True, 60.0)
    assert day.happened == [WorldEvent.PERSON_SEEN]
    day.look(False, AWAY_S + 4.0)
    day.look(True, 60.0)
    assert day.happened == [WorldEvent.PERSON_SEEN] * 2


def test_who_is_there_at_the_start_has_not_come_in() -> None:
    day = Day()
    day.look(True, 300.0)
    assert day.happened == []
    day.look(False, AWAY_S + 4.0)
    day.look(True, 10.0)
    assert day.happened == [WorldEvent.PERSON_SEEN]


def test_one_look_alone_may_be_a_mistake_and_a_look_counts_once() -> None:
    day = Day()
    day.look(False, 60.0)
    day.look(True, 2.0)
    for _ in range(50):  # the very same look, told again at each tick
        day.tell(WorldFacts(look=day.watch.person.newest, person=True), 0.1)
    day.look(False, 10.0)
    assert day.happened == []


def test_blind_eyes_neither_see_nor_find_a_room_empty() -> None:
    day = Day()
    day.look(False, 60.0)
    day.look(True, 10.0)
    for _ in range(300):
        day.tell(WorldFacts(), 1.0)
    day.look(True, 60.0)
    assert day.happened == [WorldEvent.PERSON_SEEN]


def test_the_battery_is_low_once_until_it_was_charged() -> None:
    day = Day()
    for charge in (0.5, 0.21, 0.19, 0.21, 0.19, 0.05, 0.29, 0.15, 0.31, 0.19):
        day.tell(WorldFacts(battery=charge))
    assert day.happened == [WorldEvent.BATTERY_LOW] * 2


def test_coming_home_and_goals_are_edges() -> None:
    day = Day()
    for home, done, failed in ((True, 0, 0), (None, 0, 0), (True, 1, 0), (False, 1, 0)):
        day.tell(WorldFacts(at_home=home, done=done, failed=failed))
    day.tell(WorldFacts(at_home=True, done=1, failed=1))
    assert day.happened == [
        WorldEvent.GOAL_DONE,
        WorldEvent.ARRIVED_HOME,
        WorldEvent.GOAL_FAILED,
    ]


@given(st.lists(st.tuples(st.booleans(), st.booleans(), st.floats(0.1, 60.0)), max_size=60))
def test_events_of_people_are_never_nearer_than_the_time_away(
    looks: list[tuple[bool, bool, float]],
) -> None:
    day, times = Day(), []
    for seen, blind, seconds in looks:
        before = len(day.happened)
        facts = WorldFacts() if blind else WorldFacts(look=next(day.numbers), person=seen)
        day.tell(facts, seconds)
        if len(day.happened) > before:
            times.append(day.now_s)
    assert all(b - a >= AWAY_S for a, b in pairwise(times))


CATALOGUES = Path(__file__).resolve().parents[3] / "web" / "src" / "i18n"


@pytest.mark.parametrize("language", ["en", "zh"])
async def test_the_pages_sentence_sends_it_home_on_a_low_battery(
    tmp_path: Path, language: str
) -> None:
    text = (CATALOGUES / f"{language}.ts").read_text("utf-8")
    found = re.search(r'"orders\.low_home_said":\s*"([^"]+)"', text)
    assert found is not None
    kept = await kept_in(tmp_path)
    await say(kept, found.group(1))
    view = order_view(kept.orders, kept.orders.keeper.book.orders["o1"])
    assert view["rule"]["event"] == "battery_low"
    assert [step["kind"] for step in view["may"]] == ["return_home"]


async def test_it_is_given_once_the_battery_is_low_and_not_again_before_it_was_charged(
    tmp_path: Path,
) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "when the battery is low, go home")
    for charge in (0.5, 0.15, 0.25, 0.15):
        drive = READY.drive.model_copy(update={"battery": charge})
        kept.missions.say_status(drive=drive)
        await kept.run_s(30.0, 1.0)
    assert [text for _, text, _, _ in kept.missions.given] == ["go home"]
