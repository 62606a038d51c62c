"""Everyday English is the plain order that it is, and no less."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, Look, MoveStraight, Say, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
SAME = (
    ("kitchen first, then study", "go to the kitchen, then go to the study"),
    ("come over here to the fridge", "go to the fridge"),
    ("come here by the sofa", "go to the sofa"),
    ("turn right and go down the hallway", "turn right and go to the hallway"),
    ("go on back to the kitchen now", "go to the kitchen"),
    ("come back a wee bit, you're on my foot", "move back 20 cm"),
    ("go forward 1 m and stop there", "go forward 1 m"),
    ("move ahead two feet", "move forward 0.6096 m"),
    ("have a look round the whole flat", "patrol the house"),
    ("go round all the rooms", "patrol all rooms"),
    ("have a wander round the flat", "patrol the house"),
    ("go to the study, you look tired", "go to the study"),
    ("look round the whole flat for my ball", "find my ball"),
    ("I can't find my ball anywhere, can you look for it?", "find my ball"),
    ("where's the cat got to, can you find her", "find the cat"),
    (
        "count the cups in the kitchen and then the ones in the study",
        "count the cups in the kitchen and then count the cups in the study",
    ),
    (
        "go to the kitchen and see how many cups we've got left",
        "go to the kitchen and count the cups",
    ),
    ("how many cups have we got in the kitchen", "count the cups in the kitchen"),
    ("go to the study, look around, report to me here", "go to the study, look around, come back"),
)
ASKED = (
    "kitchen first, not the study",
    "don't go down the hallway",
    "go down the hallway or along the kitchen",
    "come back a bit later",
    "come back a bit, I can't see you",
    "do not stop there",
    "go to the kitchen and don't stop there",
    "I can't find my ball, don't look for it",
    "I can't find my ball, he will look for it",
    "have you seen my ball anywhere?",
    "if I can't find my ball, can you look for it",
    "don't look round the whole flat",
    "count the cups in the kitchen but not the ones in the study",
    "check the bedroom or the bathroom for my cup",
    "check the bedroom but not the bathroom for my cup",
    "move forward two feet per second",
    "say we'll be there if Dad asks",
)


@pytest.mark.parametrize(("said", "plain"), SAME)
def test_it_is_the_plain_order(said: str, plain: str, home: Vocabulary) -> None:
    one, other = plan(said, home, WHOLE), plan(plain, home, WHOLE)
    assert isinstance(one, StepPlan), said
    assert isinstance(other, StepPlan), plain
    looked = [step.model_dump(exclude={"question"}) for step in one.steps]
    assert looked == [step.model_dump(exclude={"question"}) for step in other.steps]


@pytest.mark.parametrize("said", ASKED)
def test_a_denial_a_choice_or_a_question_moves_nothing(said: str, home: Vocabulary) -> None:
    made = plan(said, home, WHOLE)
    assert not isinstance(made, StepPlan), made


@pytest.mark.parametrize(
    "said",
    [
        "check the bedroom and the bathroom for my cup",
        "have a look in the bedroom and then in the bathroom",
    ],
)
def test_two_rooms_are_looked_in_one_after_the_other(said: str, home: Vocabulary) -> None:
    made = plan(said, home, WHOLE)
    assert isinstance(made, StepPlan)
    looks = [step.place for step in made.steps if isinstance(step, Look)]
    assert looks == ["bedroom", "bathroom"]


@pytest.mark.parametrize("unit", ["foot", "ft"])
def test_a_foot_is_a_length(unit: str, home: Vocabulary) -> None:
    assert plan(f"move back 1 {unit}", home, WHOLE) == StepPlan(
        steps=(MoveStraight(distance_m=-0.3048),)
    )


@pytest.mark.parametrize("words", ["we'll be there in a minute", "I'll bring it"])
def test_words_of_somebody_are_said_as_they_are(words: str, home: Vocabulary) -> None:
    made = plan(f"go to the front door, say {words}, and come back", home, WHOLE)
    assert isinstance(made, StepPlan)
    (said,) = (step for step in made.steps if isinstance(step, Say))
    assert said.text.casefold() == words.casefold()
    assert made.steps[-1].kind == "come_back"
