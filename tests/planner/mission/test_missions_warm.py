"""What the first search needs is worked out when the missions start, not when it is asked for."""

from __future__ import annotations

import asyncio
import threading
from pathlib import Path

import pytest

from planner.mission.memory import Memory
from planner.mission.skills import rooms
from planner.mission.warm import warm_up
from planner.vision import labels
from planner.world import Site
from tests.planner.mission.fakes import FACTS
from tests.planner.mission.live import planner


def forget_rooms() -> None:
    for kept in (rooms._cover, rooms._before_the_feet, rooms._grid):
        kept.cache_clear()


def test_the_spots_of_all_rooms_are_worked_out_beside_the_loop_before_any_goal(
    tmp_path: Path, site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    forget_rooms()
    threads: list[threading.Thread] = []
    grid = rooms._grid

    def noted(outline: tuple[rooms.Point, ...], inset_m: float) -> tuple[rooms.Point, ...]:
        threads.append(threading.current_thread())
        return grid(outline, inset_m)

    monkeypatch.setattr(rooms, "_grid", noted)

    async def story() -> None:
        async with planner(tmp_path, site):
            began = len(threads)
            for target in Memory(site).facts.targets.values():
                if target.room:
                    assert rooms.spots_in(target)
                    rooms.near_spot(target)
            assert len(threads) == began > 0
            assert threading.main_thread() not in threads

    asyncio.run(story())


def test_a_search_that_begins_anywhere_lays_no_points_anew(site: Site) -> None:
    facts = Memory(site).facts
    forget_rooms()
    warm_up(facts)
    laid = rooms._grid.cache_info().misses
    for target in facts.targets.values():
        if target.room:
            began = target.pose.x_m + 0.123, target.pose.y_m - 0.077
            assert rooms.spots_in(target, began)[0].at == began
            rooms.near_spot(target, began)
    assert rooms._grid.cache_info().misses == laid > 0


def test_words_are_ready_to_be_read_too() -> None:
    patterns = (labels._english_patterns, labels._chinese_pattern)
    for pattern in patterns:
        pattern.cache_clear()
    warm_up(FACTS)
    made = [pattern.cache_info().misses for pattern in patterns]
    assert labels.resolve("red cup") == ("cup", "red")
    assert labels.resolve("红色的杯子") == ("cup", "red")
    assert [pattern.cache_info().misses for pattern in patterns] == made == [1, 1]
