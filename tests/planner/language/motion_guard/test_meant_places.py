"""Hold what "it", "there" and a bare noun phrase may mean: one thing spoken of, never a choice."""

from __future__ import annotations

import pytest

from planner.language.motion_guard import PersonWords, find_unasked
from planner.plan import GoTo, GoToObject, Step, StepPlan
from tests.planner.brain.conftest import HOME

STUDY, KITCHEN = GoTo(place="study"), GoTo(place="kitchen")
HIM = GoToObject(object="person", place="study")
RED = GoToObject(object="红色的杯子", place="kitchen")
CUP = GoToObject(object="red cup", place="kitchen")


def is_asked(step: Step, *words: str, before: tuple[str, ...] = ()) -> bool:
    """Return whether a step that quotes the newest words waits for a yes."""
    person = PersonWords(words, before=before)
    return bool(find_unasked(StepPlan(steps=(step,), asked_by=(words[-1],)), person, HOME))


@pytest.mark.parametrize(
    ("text", "before", "step"),
    [
        ("go up to it", ("where did you see the red cup? | in the kitchen",), CUP),
        ("drive over to that", ("where is the red cup?", "go to the kitchen"), CUP),
        ("go to the red one", ("can you see my cup in the kitchen?",), CUP),
        ("do that again", ("go up to it", "where is the red cup? | in the kitchen"), CUP),
        ("go and ask him", ("is anybody in the study?",), HIM),
        ("go there", ("what is in the study?",), STUDY),
        ("去那儿", ("书房里有什么",), STUDY),
        ("靠近它", ("红色的杯子在哪儿 | 在厨房",), RED),
        ("去问问他", ("书房里的那个人在做什么",), HIM),
        ("再去一次", ("去书房",), STUDY),
    ],
)  # fmt: skip
def test_what_leans_on_the_order_before_is_asked_for(
    text: str, before: tuple[str, ...], step: Step
) -> None:
    assert not is_asked(step, text, before=before)
    assert is_asked(step, text), "it leans on nothing"
    assert is_asked(step, "say hello", before=before), "it does not lean"


@pytest.mark.parametrize(
    ("text", "before"),
    [
        ("go there", ("go to the kitchen, then to the study",)),
        ("go there", ("go to the kitchen", "what is in the study?")),
        ("go to the kitchen and look at it", ("what is in the study?",)),
        ("don't go there", ("what is in the study?",)),
        ("turn it off", ("what is in the study?",)),
        ("say it again", ("go to the study",)),
        ("count them again", ("go to the study",)),
        ("tell me that again", ("go to the study",)),
        ("wait there", ("what is in the study?",)),
        ("关掉它", ("书房里有什么",)),
        ("再说一次", ("去书房",)),
        ("is it nice there?", ("what is in the study?",)),
        ("别去那儿", ("书房里有什么",)),
    ],
)
def test_where_two_may_be_meant_or_nothing_is_ordered_it_waits(
    text: str, before: tuple[str, ...]
) -> None:
    assert is_asked(STUDY, text, before=before)


def test_a_noun_phrase_answers_which_one() -> None:
    bedroom = GoTo(place="bedroom")
    order = "go to the room with my things"
    assert not is_asked(bedroom, order, "the one with the bed")
    assert not is_asked(bedroom, order, "the room with the bed")
    assert not is_asked(bedroom, "去放我东西的那间", "有床的那间")
    assert is_asked(bedroom, order, "the one with the bed is hers")
    assert is_asked(bedroom, order, "not the one with the bed")
