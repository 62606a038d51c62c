"""Laws of memory: forgotten stays forgotten, newest first, bounded; words find what they name."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.memory import (
    FACT,
    PERSON,
    THING,
    FactRefusal,
    MemoryLimits,
    MemoryQuery,
    MemoryStore,
    ObjectSighting,
    match_query,
)
from planner.state_database import StateDatabase

NOW_S = 1_800_000_000.0
CUP = ObjectSighting("cup", "red", "m", "kitchen", 1.0, 2.0, 0.9, NOW_S, NOW_S, "cup_1")


class QuietDatabase(StateDatabase):
    """Wait for no disk: a law of hundreds of examples is not about power cuts."""

    def compact(self) -> None:
        """Leave the log as it is."""


def store_in(folder: Path, **limits: float) -> MemoryStore:
    return MemoryStore(QuietDatabase(folder), MemoryLimits(**limits))  # type: ignore[arg-type]


@pytest.fixture
def store(tmp_path: Path) -> MemoryStore:
    return store_in(tmp_path)


@pytest.fixture(scope="module")
def reused(tmp_path_factory: pytest.TempPathFactory) -> MemoryStore:
    """Return the one store of all examples of a law, each of which empties it first."""
    return store_in(tmp_path_factory.mktemp("m"))


def at(seen: ObjectSighting, age_s: float, **changes: object) -> ObjectSighting:
    moment = NOW_S - age_s
    return replace(seen, seen_unix_s=moment, first_unix_s=moment, **changes)  # type: ignore[arg-type]


def words(store: MemoryStore, text: str, **more: object) -> list[str]:
    query = MemoryQuery(words=text, **more)  # type: ignore[arg-type]
    return [memo.words or memo.label for memo in store.find(query, NOW_S)]


def test_the_same_thing_at_the_same_spot_is_one_memory(store: MemoryStore) -> None:
    store.see([at(CUP, 600.0), at(CUP, 300.0, x_m=1.3), at(CUP, 0.0)])
    (memo,) = store.find(MemoryQuery("cup"), NOW_S)
    assert (memo.sightings, memo.last_unix_s, memo.first_unix_s) == (3, NOW_S, NOW_S - 600.0)
    store.see([at(CUP, 0.0, x_m=4.0), at(CUP, 0.0, color="blue"), at(CUP, 0.0, room="study")])
    assert len(store.find(MemoryQuery("cup"), NOW_S)) == 4
    store.see([at(CUP, 40 * 3600.0)])
    assert len(store.find(MemoryQuery("cup"), NOW_S)) == 5, "unseen for long: another memory"


def test_people_are_visits_without_colour(store: MemoryStore) -> None:
    somebody = replace(CUP, label="person", color="green", thing_id="person_1")
    store.see([at(somebody, 1500.0), at(somebody, 1100.0, x_m=9.0), at(somebody, 0.0)])
    found = store.find(MemoryQuery("somebody", kinds=(PERSON,)), NOW_S)
    assert [(memo.kind, memo.color, memo.sightings) for memo in found] == [
        (PERSON, None, 2), (PERSON, None, 1)
    ][::-1]  # fmt: skip


@pytest.mark.parametrize(
    ("asked", "found"),
    [("red cup", True), ("红色的杯子", True), ("红杯子", True),
     ("红的杯子", True), ("蓝杯子", False), ("小红的杯子", False),
     ("the mug", True), ("a cup", True), ("杯", True),
     ("blue cup", False), ("person", False), ("cupboard", False), ("书", False)],
)  # fmt: skip
def test_words_of_both_languages_find_a_thing(store: MemoryStore, asked: str, found: bool) -> None:
    store.see([CUP])
    fitting = [memo for memo in store.find(MemoryQuery(asked), NOW_S) if memo.fits]
    assert bool(fitting) is found
    if asked == "blue cup":
        assert words(store, asked) == ["cup"], "what comes nearest is told, and does not fit"


@pytest.mark.parametrize(
    ("fact", "asked"),
    [("the keys are on the sofa", "key"), ("the keys are on the sofa", "couch"),
     ("钥匙在沙发上", "钥匙"), ("钥匙在沙发上", "sofa"), ("眼镜在书房", "眼镜"),
     ("水管工星期五来", "水管工"), ("蓝杯子是丽丽的", "blue cup"),
     ("我叫小雨", "我叫"), ("Anna's room is upstairs", "Anna's room")],
)  # fmt: skip
def test_words_find_a_fact(store: MemoryStore, fact: str, asked: str) -> None:
    store.teach(fact, NOW_S, said_by="page")
    assert words(store, asked) == [fact]
    assert words(store, "umbrella") == []
    assert store.find(MemoryQuery("雨伞"), NOW_S) == ()


def test_one_character_names_a_kind_at_an_end_alone() -> None:
    assert match_query("书") == '"zkbook"'
    assert "zkbook" not in (match_query("书房") or "")


@pytest.mark.parametrize(
    "text", ['"', "cup OR person", "cup*", "NEAR(a b)", "-cup", "a:b", "^x", "("]
)
def test_no_word_is_a_query_language(store: MemoryStore, text: str) -> None:
    store.see([CUP])
    store.find(MemoryQuery(text), NOW_S)


def test_a_place_and_a_time_narrow(store: MemoryStore) -> None:
    store.see([at(CUP, 7200.0), at(CUP, 60.0, room="study")])
    assert words(store, "cup", place="kitchen") == ["cup"]
    assert words(store, "cup", since_unix_s=NOW_S - 3600.0) == ["cup"]
    assert words(store, "cup", since_unix_s=NOW_S - 3600.0, place="kitchen") == []
    assert words(store, "cup", until_unix_s=NOW_S - 3600.0) == ["cup"]


def test_nothing_older_than_the_owner_set_is_told_or_kept(tmp_path: Path) -> None:
    store = store_in(tmp_path, things_days=1.0, people_days=0.0, facts_days=2.0)
    store.see([at(CUP, 90_000.0), at(CUP, 80_000.0, room="study"), replace(CUP, label="person")])
    store.teach("the keys", NOW_S - 3 * 86_400.0, said_by="page")
    found = store.find(MemoryQuery(), NOW_S)
    assert [(memo.kind, memo.room) for memo in found] == [(THING, "study")]
    assert store.prune(NOW_S) == 2
    assert store.counts() == {THING: 1, PERSON: 0, FACT: 0}


def test_no_more_than_the_bounds_and_the_oldest_go(tmp_path: Path) -> None:
    store = store_in(tmp_path, most_sightings=3, most_facts=1)
    store.see([at(CUP, 100.0 * n, room=f"room_{n}") for n in range(6)])
    rooms = [memo.room for memo in store.find(MemoryQuery(), NOW_S)]
    assert rooms == ["room_0", "room_1", "room_2"]
    store.teach("a fact", NOW_S, said_by="page")
    with pytest.raises(FactRefusal) as full:
        store.teach("another fact", NOW_S, said_by="page")
    assert full.value.code == "facts_full"
    store.teach("A FACT", NOW_S, said_by="page")
    assert words(store, "fact") == ["A FACT"]


def test_facts_off_is_told(tmp_path: Path) -> None:
    with pytest.raises(FactRefusal) as off:
        store_in(tmp_path, facts_days=0.0).teach("a fact", NOW_S, said_by="page")
    assert off.value.code == "facts_off"


def test_what_was_forgotten_is_in_no_file(tmp_path: Path) -> None:
    store = MemoryStore(StateDatabase(tmp_path))
    for fact in ("grandmother hides a zeppelin", "the keys are on the sofa"):
        store.teach(fact, NOW_S, said_by="page")
    assert len(store.forget_about("zeppelin")) == 1
    for path in tmp_path.iterdir():
        assert b"zeppelin" not in path.read_bytes(), path.name
    assert words(store, "keys") == ["the keys are on the sofa"]


def test_the_objects_of_an_older_program_come_in_once(store: MemoryStore) -> None:
    assert store.see_once([at(CUP, 86_400.0)])
    assert not store.see_once([at(CUP, 50.0, room="study")])
    (memo,) = store.find(MemoryQuery(), NOW_S)
    assert memo.last_unix_s == NOW_S - 86_400.0


NAMES = ("cup", "chair", "book", "person")
SEEN = st.builds(
    lambda label, room, age: at(CUP, age, label=label, room=room, thing_id=f"{label}_{room}"),
    st.sampled_from(NAMES),
    st.sampled_from(("kitchen", "study")),
    st.floats(0.0, 5 * 86_400.0),
)
FACTS = st.sampled_from(("keys on the sofa", "书在书房", "the cup of tea is cold", "Anna sleeps"))


@given(
    seen=st.lists(SEEN, max_size=12),
    facts=st.lists(FACTS, max_size=4),
    about=st.sampled_from(NAMES),
)
def test_what_was_forgotten_is_never_answered(
    reused: MemoryStore, seen: list[ObjectSighting], facts: list[str], about: str
) -> None:
    store = reused
    store.forget_all()
    store.see(seen)
    for fact in facts:
        store.teach(fact, NOW_S, said_by="page")
    fitting = {memo.id for memo in store.find(MemoryQuery(about, limit=200), NOW_S) if memo.fits}
    before = {memo.id for memo in store.find(MemoryQuery(limit=200), NOW_S)}
    assert {memo.id for memo in store.forget_about(about)} == fitting
    after = {memo.id for memo in store.find(MemoryQuery(limit=200), NOW_S)}
    assert after == before - fitting, "this and nothing else"
    assert not any(memo.fits for memo in store.find(MemoryQuery(about), NOW_S))
    store.forget_all()
    assert store.find(MemoryQuery(), NOW_S) == store.find(MemoryQuery(about), NOW_S) == ()


@given(seen=st.lists(SEEN, max_size=15), text=st.sampled_from(("", *NAMES)))
def test_the_newest_comes_first_and_only_what_fits(
    reused: MemoryStore, seen: list[ObjectSighting], text: str
) -> None:
    reused.forget_all()
    reused.see(seen)
    found = reused.find(MemoryQuery(text, limit=200), NOW_S)
    ages = [memo.last_unix_s for memo in found]
    assert ages == sorted(ages, reverse=True)
    assert {memo.label for memo in found} == {s.label for s in seen if text in ("", s.label)}


@given(text=st.text(max_size=40))
def test_any_words_are_searched_without_an_error(reused: MemoryStore, text: str) -> None:
    reused.forget_all()
    reused.see([CUP])
    reused.find(MemoryQuery(text), NOW_S)
    reused.forget_about(text)
