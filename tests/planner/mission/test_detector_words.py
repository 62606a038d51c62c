"""What a detector knows is known to missions once words can be read in it, and not before."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Collection, Coroutine
from pathlib import Path
from typing import Any

import pytest

from planner.language import object_names
from planner.mission import detector_words
from planner.mission.detector_words import Wording
from planner.site import Site
from tests.planner.mission.live import LiveBridge, planner
from tests.planner.mission.test_missions_see import FakeEyes

OWN, OTHER = ("cup", "garden_gnome"), ("cup", "tin_soldier")


class Threads:
    """Prepare words as they are, and note in which thread."""

    def __init__(self) -> None:
        self.seen: list[threading.Thread] = []

    def __call__(self, classes: Collection[str]) -> None:
        self.seen.append(threading.current_thread())
        object_names.prepare(classes)


def test_words_are_prepared_once_beside_the_loop_and_then_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    threads = Threads()
    monkeypatch.setattr(detector_words, "prepare", threads)
    beside: list[Coroutine[Any, Any, None]] = []
    told: list[int] = []
    words = Wording(("cup",), beside.append, lambda: told.append(len(threads.seen)))

    async def story() -> None:
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

    asyncio.run(story())
    assert len(threads.seen) == 2
    assert threading.main_thread() not in threads.seen


class Gnomes(FakeEyes):
    """Be eyes whose detector says late that it knows gnomes."""

    known: tuple[str, ...] = ()

    @property
    def classes(self) -> tuple[str, ...]:
        return self.known


def test_a_detector_of_ones_own_is_read_without_a_pattern_made_on_the_loop(
    tmp_path: Path, site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    threads = Threads()
    monkeypatch.setattr(detector_words, "prepare", threads)
    bridge = LiveBridge()
    eyes = Gnomes(bridge)

    async def story() -> None:
        async with planner(tmp_path, site, bridge=bridge, eyes=eyes) as world:
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

    asyncio.run(story())
