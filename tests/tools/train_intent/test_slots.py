"""Labels are learnt from chains, and the same seed learns the same."""

from __future__ import annotations

from planner.language.intent.intent_model import OTHER, THING
from tools.train_intent.generator import Example
from tools.train_intent.slots import fit_slots

THINGS = ("key", "lamp", "old shoe", "red pen")


def example(thing: str, place: str) -> Example:
    units = ("find", "my", *thing.split(), "in", place)
    labels = (OTHER, OTHER, *(THING for _ in thing.split()), OTHER, OTHER)
    return Example(units, "find_at", labels)


TAUGHT = [example(thing, place) for thing in THINGS for place in ("<0>", "there", "here")]


def test_a_thing_that_was_never_seen_is_labelled_by_what_stands_around_it() -> None:
    model = fit_slots(TAUGHT, seed=1, rounds=6)
    fresh = example("umbrella", "<0>")
    assert model.label(fresh.units, fresh.intent) == fresh.labels


def test_the_same_seed_learns_the_same() -> None:
    first, second = (fit_slots(TAUGHT, seed=3, rounds=2) for _ in range(2))
    assert [list(row) for row in first.slots] == [list(row) for row in second.slots]
    assert first.transitions == second.transitions
