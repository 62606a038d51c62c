"""Words that look like a condition or a speed change nothing; those that are one hold back."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
SAME = (
    ("spin round once and come back", "turn a full circle and come back"),
    ("turn around once, then go to the study", "turn a full circle, then go to the study"),
    ("go to the study, look around once and come back", "go to the study, look around, come back"),
    ("do a quick lap of the house", "patrol the house"),
    ("take a quick look in the study", "take a look in the study"),
    (
        "look in the study, and while you're at it count the cups too",
        "look in the study, and count the cups",
    ),
    (
        "go to the study and while you are there find the ball",
        "go to the study and find the ball",
    ),
)
HOLDS_BACK = (
    "go to the kitchen if you see it",
    "look in the kitchen and then on the sofa if you see it",
    "turn around once you see the cup",
    "turn around once and the door will open",
    "spin once the kids are there",
    "look around once I am gone",
    "drive quick round the house",
    "do not do a quick lap of the house",
    "go to the study and while you're at the desk look for a cup",
    "go to the study and while you're at it don't look for the ball",
)


@pytest.mark.parametrize(("said", "plain"), SAME)
def test_what_is_no_condition_changes_nothing(said: str, plain: str, home: Vocabulary) -> None:
    one, other = plan(said, home, WHOLE), plan(plain, home, WHOLE)
    assert isinstance(one, StepPlan), said
    assert isinstance(other, StepPlan), plain
    assert [step.kind for step in one.steps] == [step.kind for step in other.steps]


@pytest.mark.parametrize("said", HOLDS_BACK)
def test_what_an_order_hangs_on_is_kept(said: str, home: Vocabulary) -> None:
    assert not isinstance(plan(said, home, WHOLE), StepPlan)
