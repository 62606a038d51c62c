"""Laws of kept pictures: bounded, aged, forgotten with what they show, one of each stop."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.memory import (
    KeptPicture,
    MemoryLimits,
    MemoryQuery,
    MemoryStore,
    ObjectSighting,
    PictureStore,
)
from planner.memory.pictures import MAX_PICTURE_BYTES
from planner.state_database import StateDatabase

NOW_S = 1_800_000_000.0
DAY_S = 86_400.0
JPEG = b"\xff\xd8" + b"x" * 98


def shot(stop: int = 0, *labels: str, goal: str = "g1", age_s: float = 0.0) -> KeptPicture:
    return KeptPicture(goal, 0, stop, "kitchen", labels, "image/jpeg", NOW_S - age_s)


def pictures_in(folder: Path, **limits: float) -> PictureStore:
    return PictureStore(StateDatabase(folder), MemoryLimits(**limits))  # type: ignore[arg-type]


def stops(store: PictureStore, goal: str | None = None) -> list[tuple[str, int]]:
    return [(each.goal, each.stop) for each in store.list(NOW_S, goal)]


def test_one_of_each_stop_that_shows_most(tmp_path: Path) -> None:
    store = pictures_in(tmp_path)
    assert store.list(NOW_S) == ()
    assert store.get(1, NOW_S) is None
    assert not store.forget(1)
    assert store.keep(shot(0), JPEG)
    assert store.keep(shot(0, "cup", "chair"), b"more")
    assert not store.keep(shot(0, "cup"), b"less")
    assert store.keep(shot(1), JPEG)
    assert stops(store) == [("g1", 0), ("g1", 1)]
    first = store.list(NOW_S)[0]
    found = store.get(first.id, NOW_S)
    assert found is not None
    assert (found[1], found[0].labels, found[0].size) == (b"more", ("cup", "chair"), 4)


def test_a_later_round_takes_the_place_of_the_one_before(tmp_path: Path) -> None:
    store = pictures_in(tmp_path)
    assert store.keep(shot(0, "cup", "chair", age_s=600.0), b"before")
    assert store.keep(shot(0), b"now")
    assert [each.size for each in store.list(NOW_S)] == [3]


def test_the_newest_patrol_comes_first_and_one_can_be_asked_for(tmp_path: Path) -> None:
    store = pictures_in(tmp_path)
    for goal, age_s in (("old", 900.0), ("new", 10.0)):
        for stop in (1, 0):
            assert store.keep(shot(stop, goal=goal, age_s=age_s), JPEG)
    assert stops(store) == [("new", 0), ("new", 1), ("old", 0), ("old", 1)]
    assert stops(store, "old") == [("old", 0), ("old", 1)]
    assert stops(store, "none") == []


@given(
    sizes=st.lists(st.integers(1, 400), max_size=12),
    most=st.integers(0, 6),
    kilobytes=st.integers(0, 2),
)
def test_count_and_bytes_are_bounded_and_the_newest_stay(
    tmp_path_factory: pytest.TempPathFactory, sizes: list[int], most: int, kilobytes: int
) -> None:
    store = pictures_in(
        tmp_path_factory.mktemp("p"), most_pictures=most, pictures_mb=kilobytes / 1000.0
    )
    for number, size in enumerate(sizes):
        store.keep(shot(number, age_s=float(len(sizes) - number)), b"x" * size)
    kept = store.list(NOW_S)
    assert len(kept) <= most
    assert sum(each.size for each in kept) <= kilobytes * 1000
    newest = sorted((each.stop for each in kept), reverse=True)
    assert newest == list(range(len(sizes) - 1, len(sizes) - 1 - len(newest), -1))


def test_what_is_too_large_or_not_wanted_is_not_kept(tmp_path: Path) -> None:
    assert not pictures_in(tmp_path).keep(shot(), b"x" * (MAX_PICTURE_BYTES + 1))
    assert not pictures_in(tmp_path).keep(shot(), b"")
    assert not pictures_in(tmp_path, things_days=0.0).keep(shot(), JPEG)
    assert not pictures_in(tmp_path, most_pictures=0).keep(shot(), JPEG)
    nobody = pictures_in(tmp_path, people_days=0.0)
    assert not nobody.keep(shot(0, "person"), JPEG)
    assert nobody.keep(shot(1, "cup"), JPEG)


def test_it_ages_as_memories_of_what_it_shows(tmp_path: Path) -> None:
    store = pictures_in(tmp_path, things_days=30.0, people_days=7.0)
    store.keep(shot(0, "person", "cup", age_s=8 * DAY_S), JPEG)
    store.keep(shot(1, "cup", age_s=8 * DAY_S), JPEG)
    store.keep(shot(2, "cup", age_s=31 * DAY_S), JPEG)
    assert stops(store) == [("g1", 1)]
    assert store.get(1, NOW_S) is None, "too old to be shown, before it is removed"
    assert store.prune(NOW_S) == 2
    assert stops(store) == [("g1", 1)]


def test_what_is_forgotten_takes_its_pictures_along(tmp_path: Path) -> None:
    database = StateDatabase(tmp_path)
    memory = MemoryStore(database)
    seen = ObjectSighting("cup", "red", "m", "kitchen", 1.0, 2.0, 0.9, NOW_S, NOW_S, "cup_1")
    ways: tuple[Callable[[], object], ...] = (
        lambda: memory.forget([memory.find(MemoryQuery("cup"), NOW_S)[0].id]),
        lambda: memory.forget_about("red cup"),
        lambda: memory.forget_things(["cup_1"]),
    )
    for forget in ways:
        memory.see([seen])
        memory.pictures.keep(shot(0, "cup", "chair"), JPEG)
        memory.pictures.keep(shot(1, "cupboard"), JPEG)
        forget()
        assert stops(memory.pictures) == [("g1", 1)]
    memory.pictures.keep(shot(2, "person"), JPEG)
    memory.forget_all(("fact",))
    assert len(stops(memory.pictures)) == 2
    memory.forget_all(("person",))
    assert stops(memory.pictures) == [("g1", 1)]
    memory.forget_all()
    assert stops(memory.pictures) == []
    database.close()
    files = b"".join(path.read_bytes() for path in tmp_path.iterdir())
    assert JPEG not in files, "it is gone from the disk as well"
