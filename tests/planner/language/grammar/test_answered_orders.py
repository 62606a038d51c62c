"""What hangs on somebody's answer: a yes, a no, and nothing that is neither."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, Ask, ComeBack, Find, GoTo, If, StepPlan

if TYPE_CHECKING:
    from planner.plan import Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
ASKED = Ask(question="Mum, do you want tea?")
KITCHEN, BACK = (GoTo(place="kitchen"),), (ComeBack(),)
YES = ("if so", "if she says yes", "if she does", "if the answer is yes", "if she wants some")
NO = ("if not", "if she says no", "if she doesn't", "if the answer is no")


def steps(text: str, home: Vocabulary) -> tuple[object, ...] | None:
    made = plan(text, home, WHOLE)
    return made.steps if isinstance(made, StepPlan) else None


@pytest.mark.parametrize("join", [" and {}, ", ". {} ", ", {} then ", "; {}, please "])
@pytest.mark.parametrize(("conditions", "holds"), [(YES, True), (NO, False)])
def test_a_yes_or_a_no_chooses_the_branch(
    home: Vocabulary, join: str, conditions: tuple[str, ...], holds: bool
) -> None:
    for condition in conditions:
        text = f"ask Mum if she wants tea{join.format(condition)}go to the kitchen"
        alone = If(when=ASKED, **{"then" if holds else "otherwise": KITCHEN})
        assert steps(text, home) == (Find(object="Mum"), alone), text
        yes, no = (KITCHEN, BACK) if holds else (BACK, KITCHEN)
        both = If(when=ASKED, then=yes, otherwise=no)
        assert steps(f"{text}, otherwise come back", home) == (Find(object="Mum"), both)


def test_the_condition_may_stand_behind_its_order(home: Vocabulary) -> None:
    before = steps("ask Mum if she wants tea and if so go to the kitchen", home)
    assert before is not None
    assert steps("ask Mum if she wants tea and go to the kitchen if she says yes", home) == before


@pytest.mark.parametrize(
    "text",
    [
        "ask Tom what he wants and if he says yes come back",
        "ask Tom if he wants tea or coffee and if so go to the kitchen",
        "ask Mum if she wants tea and if it rains go to the kitchen",
        "ask Mum if she wants tea and if she likes cake go to the kitchen",
        "ask Mum if she wants tea and if she says yes make some",
        "ask Mum if she wants tea and if she says maybe come back",
    ],
)
def test_what_is_no_plain_answer_is_not_read(home: Vocabulary, text: str) -> None:
    assert steps(text, home) is None
