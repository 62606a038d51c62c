"""Everyday words for ways, moves and lost things mean the plain order that they are."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, GoTo, Look, Repeat, Say, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
PLACES = sampled_from(("kitchen", "study", "sofa"))


def _steps(text: str, home: Vocabulary) -> tuple[object, ...] | None:
    made = plan(text, home, WHOLE)
    return made.steps if isinstance(made, StepPlan) else None


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("just go forward a metre or so", "go forward one metre"),
        ("go forward two metres and then stop", "go forward two metres"),
        ("wait five minutes or so", "wait five minutes"),
        ("wait at the sofa for exactly ten minutes", "wait at the sofa for ten minutes"),
        ("spin round once and tell me everything you see", "spin round and tell me what you see"),
        ("go to the sofa and turn to face the other way", "go to the sofa and turn around"),
        ("go home and have a rest", "go home"),
        ("a step back, please", "move back 20 cm"),
        ("wake Emma up", "tell Emma to wake up"),
        ("check on the dog", "find the dog"),
        ("follow me and keep close", "follow me"),
        ("go a bit closer to the sofa and stop there", "go to the sofa"),
        ("first the kitchen, then go home to charge", "go to the kitchen, then go charge"),
        (
            "do three laps between the kitchen and the study",
            "go to the kitchen, then go to the study, three times",
        ),
    ],
)
def test_everyday_words_mean_the_plain_order(home: Vocabulary, said: str, plain: str) -> None:
    assert _steps(said, home) == _steps(plain, home) is not None


@pytest.mark.parametrize("said", ["go forward a metre or two", "go to the kitchen or so"])
def test_a_choice_stays_one(home: Vocabulary, said: str) -> None:
    assert _steps(said, home) is None


@given(
    sampled_from(("I can't find my cup. ", "I've lost my cup, ", "my cup has gone missing, ")),
    sampled_from(("check the {} first, then the {}", "look in the {} and the {}")),
    PLACES, PLACES,
)  # fmt: skip
def test_what_is_missed_is_what_is_looked_for(
    home: Vocabulary, lost: str, order: str, first: str, second: str
) -> None:
    if first == second:
        return
    steps = _steps(lost + order.format(first, second), home)
    assert steps is not None
    assert [step.place for step in steps if isinstance(step, GoTo)] == [first, second]
    looks = [step for step in steps if isinstance(step, Look)]
    assert len(looks) == 2
    assert all("my cup" in step.question for step in looks)


@given(
    sampled_from(("say", "call out", "shout")),
    sampled_from(("if the cat comes", "when you see me")),
)
def test_a_condition_behind_say_is_never_said(home: Vocabulary, verb: str, condition: str) -> None:
    steps = _steps(f"{verb} {condition}", home)
    assert steps is None or not any(isinstance(step, Say) for step in steps)


@given(sampled_from(("what's lying about", "who is at the door", "how many chairs there are")))
def test_say_what_is_there_looks(home: Vocabulary, asked: str) -> None:
    steps = _steps(f"say {asked}", home)
    assert steps is not None
    assert not any(isinstance(step, Say) for step in steps)


@given(PLACES, PLACES, sampled_from(("twice", "three times")))
def test_a_way_between_two_places_is_both(
    home: Vocabulary, first: str, second: str, often: str
) -> None:
    if first == second:
        return
    steps = _steps(f"go between the {first} and the {second} {often}", home)
    assert steps is not None
    assert isinstance(steps[0], Repeat)
    assert [step.place for step in steps[0].steps if isinstance(step, GoTo)] == [first, second]


@pytest.mark.parametrize(
    ("order", "said"),
    [
        ("say goodbye to Emma in the kitchen", "Goodbye, Emma!"),
        ("say good morning to everyone in the kitchen", "Good morning!"),
        ("say the kitchen is closed and go home", "the kitchen is closed"),
        ("say the cup is on the desk and then go home", "the cup is on the desk"),
    ],
)
def test_the_words_are_those_that_were_ordered(home: Vocabulary, order: str, said: str) -> None:
    steps = _steps(order, home)
    assert steps is not None
    assert [step.text for step in steps if isinstance(step, Say)] == [said]
