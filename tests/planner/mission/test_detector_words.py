"""What words and searches need is made beside the loop, before it is asked for."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Collection, Coroutine
from typing import Any

import pytest

from planner.language import object_names
from planner.language.changes import reader
from planner.language.changes.reader import read_changes
from planner.language.motion_guard import mentioned_names
from planner.mission import perception_requests
from planner.mission.perception_requests import Wording, warm_up
from planner.site import Site
from planner.site.known_places import KnownPlaces
from planner.skills import viewpoints
from tests.planner.mission.fakes import FACTS
from tests.planner.mission.live import LiveBridge, Starter
from tests.planner.mission.test_missions_see import FakeEyes

OWN, OTHER = ("cup", "garden_gnome"), ("cup", "tin_soldier")


class Threads:
    """Prepare words as they are, and note in which thread."""

    def __init__(self) -> None:
        self.seen: list[threading.Thread] = []

    def __call__(self, classes: Collection[str]) -> None:
        self.seen.append(threading.current_thread())
        object_names.prepare(classes)


async def test_words_are_prepared_once_beside_the_loop_and_then_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    threads = Threads()
    monkeypatch.setattr(perception_requests, "prepare", threads)
    beside: list[Coroutine[Any, Any, None]] = []
    told: list[int] = []
    words = Wording(("cup",), beside.append, lambda: told.append(len(threads.seen)))
    assert words.of(("cup",)) == ("cup",)
    assert not beside, "these were ready"
    assert [words.of(OWN) for _ in range(3)] == [(), (), ()]
    assert len(beside) == 1, "asked for once"
    await beside.pop()
    assert told == [1], "told once they are ready"
    assert words.of(OWN) == OWN
    assert words.of(OTHER) == (), "others are prepared anew"
    await beside.pop()
    assert words.of(OTHER) == OTHER
    assert len(threads.seen) == 2
    assert threading.main_thread() not in threads.seen


class Gnomes(FakeEyes):
    """Be eyes whose detector says late that it knows gnomes."""

    known: tuple[str, ...] = ()

    @property
    def classes(self) -> tuple[str, ...]:
        return self.known


async def test_a_detector_of_ones_own_is_read_without_a_pattern_made_on_the_loop(
    start: Starter, monkeypatch: pytest.MonkeyPatch
) -> None:
    threads = Threads()
    monkeypatch.setattr(perception_requests, "prepare", threads)
    bridge = LiveBridge()
    eyes = Gnomes(bridge)
    async with start(bridge=bridge, eyes=eyes) as world:
        book = world.missions.loop
        looking = asyncio.create_task(eyes.look_on())
        eyes.known = OWN
        await world.until(lambda: book.book.eyes.classes == OWN)
        looking.cancel()
        made = object_names._english_patterns.cache_info().misses
        assert object_names.resolve("the red garden gnome", None, OWN) == (
            "garden_gnome",
            "red",
        )
        assert object_names._english_patterns.cache_info().misses == made
        assert threads.seen
        assert threading.main_thread() not in threads.seen


def forget_rooms() -> None:
    for kept in (viewpoints._cover, viewpoints._before_the_feet, viewpoints._grid):
        kept.cache_clear()


async def test_the_spots_of_all_rooms_are_worked_out_beside_the_loop_before_any_goal(
    start: Starter, site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    forget_rooms()
    threads: list[threading.Thread] = []
    grid = viewpoints._grid

    def noted(
        outline: tuple[viewpoints.Point, ...], inset_m: float
    ) -> tuple[viewpoints.Point, ...]:
        threads.append(threading.current_thread())
        return grid(outline, inset_m)

    monkeypatch.setattr(viewpoints, "_grid", noted)
    async with start():
        began = len(threads)
        for target in KnownPlaces(site).facts.targets.values():
            if target.room:
                assert viewpoints.spots_in(target)
                viewpoints.near_spot(target)
        assert len(threads) == began > 0
        assert threading.main_thread() not in threads


def test_the_first_sentence_compiles_no_row_of_changes_and_no_names(site: Site) -> None:
    """108 rows took 82 ms of the loop, with whatever short sentence came first."""
    facts = KnownPlaces(site).facts
    for kept in (read_changes, reader._rows, mentioned_names._names):
        kept.cache_clear()
    warm_up(facts)
    made = [kept.cache_info().misses for kept in (reader._rows, mentioned_names._names)]
    assert made == [1, 1]
    read_changes("no, to the study", facts.names)
    assert [kept.cache_info().misses for kept in (reader._rows, mentioned_names._names)] == made


def test_a_search_that_begins_anywhere_lays_no_points_anew(site: Site) -> None:
    facts = KnownPlaces(site).facts
    forget_rooms()
    warm_up(facts)
    laid = viewpoints._grid.cache_info().misses
    for target in facts.targets.values():
        if target.room:
            began = target.pose.x_m + 0.123, target.pose.y_m - 0.077
            assert viewpoints.spots_in(target, began)[0].at == began
            viewpoints.near_spot(target, began)
    assert viewpoints._grid.cache_info().misses == laid > 0


def test_words_are_ready_to_be_read_too() -> None:
    patterns = (object_names._english_patterns, object_names._chinese_pattern)
    for pattern in patterns:
        pattern.cache_clear()
    warm_up(FACTS)
    made = [pattern.cache_info().misses for pattern in patterns]
    assert object_names.resolve("red cup") == ("cup", "red")
    assert object_names.resolve("红色的杯子") == ("cup", "red")
    assert [pattern.cache_info().misses for pattern in patterns] == made == [1, 1]
