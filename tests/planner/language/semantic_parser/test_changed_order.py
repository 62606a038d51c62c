"""What the learned reader reads as a change of the newest order changes its steps, or nothing."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.semantic_parser.changed_order import CHANGES, change_order
from planner.language.semantic_parser.plan_grammar import FORMS, parse_plan
from planner.plan import GoTo, LastOrder, Patrol, PlanRole, Repeat, Step, Turn
from tests.planner.brain.conftest import HOME

ROUND = Patrol(places=("kitchen", "bedroom"))
LEFT = Turn(angle_rad=pi / 2)


def order(*steps: Step, ended: bool = True) -> LastOrder:
    return LastOrder(steps=steps, ahead=() if ended else steps, ended=ended, names=HOME)


@pytest.mark.parametrize(
    ("label", "last", "steps", "role"),
    [
        ("again", order(LEFT), (LEFT,), PlanRole.NEW),
        ("again(2 times)", order(LEFT), (Repeat(steps=(LEFT,), times=2),), PlanRole.NEW),
        ("more", order(LEFT), (Turn(angle_rad=pi / 6),), PlanRole.NEW),
        ("less", order(LEFT), (Turn(angle_rad=-pi / 6),), PlanRole.NEW),
        ("other", order(LEFT), (Turn(angle_rad=-pi),), PlanRole.NEW),
        ("skip(kitchen)", order(ROUND, ended=False), (Patrol(places=("bedroom",)),),
         PlanRole.INSTEAD),
        ("also(study)", order(GoTo(place="kitchen")), (GoTo(place="study"),), PlanRole.NEW),
        ("change_place(study)", order(GoTo(place="kitchen"), ended=False), (GoTo(place="study"),),
         PlanRole.INSTEAD),
    ],
)  # fmt: skip
def test_a_form_changes_the_one_slot_that_it_names(
    label: str, last: LastOrder, steps: tuple[Step, ...], role: PlanRole
) -> None:
    made = change_order(parse_plan(label)[0], last)
    assert made is not None
    assert made.does is role
    if label == "other":  # to the other side, and as far beyond
        assert isinstance(made.steps[0], Turn)
        assert made.steps[0].angle_rad < 0.0
    else:
        assert made.steps == steps


@given(st.sampled_from(sorted(CHANGES)))
def test_nothing_changes_where_no_order_was_before(form: str) -> None:
    named = {"again": "", "skip": "(kitchen)", "also": "(kitchen)", "change_place": "(kitchen)"}
    label = form + named.get(form, '("cup")' if FORMS[form].slots else "")
    assert change_order(parse_plan(label)[0], None) is None
    assert change_order(parse_plan(label)[0], order()) is None or form in ("also", "change_place")
