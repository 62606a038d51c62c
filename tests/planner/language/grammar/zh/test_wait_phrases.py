"""Chinese waits at a place: whoever comes counts, a name is called, other orders stay unread."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Clarify,
    GoTo,
    Refuse,
    ReturnHome,
    Say,
    Step,
    StepPlan,
    WaitFor,
)
from tests.planner.language.grammar.conftest import HOME

SOMEBODY = WaitFor(object="person")


def plan(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(runnable=EVERY_KIND))


def steps(text: str) -> tuple[Step, ...]:
    made = plan(text)
    assert isinstance(made, StepPlan), text
    return made.steps


@pytest.mark.parametrize(
    ("place", "id_"), [("厨房", "kitchen"), ("书房", "study"), ("沙发", "sofa")]
)
@pytest.mark.parametrize(
    "waits",
    ["在{p}等着，有人来了就", "去{p}守着，有人来就", "在{p}那儿等到有人来，然后",
     "守在{p}，看到人就",
     "去{p}等人，来了就", "你去{p}等着，要是有人来了你就"],
)  # fmt: skip
def test_it_goes_there_and_waits_until_somebody_comes(place: str, id_: str, waits: str) -> None:
    waited = waits.format(p=place)
    assert steps(f"{waited}说欢迎") == (GoTo(place=id_), SOMEBODY, Say(text="欢迎"))
    assert steps(f"{waited}跟他说妈妈不在家")[-1] == Say(text="妈妈不在家")
    assert steps(f"{waited}回去充电") == (GoTo(place=id_), SOMEBODY, ReturnHome())


@pytest.mark.parametrize("name", ["小明", "妈妈", "王阿姨"])
def test_for_one_by_name_anybody_counts_and_the_name_is_said(name: str) -> None:
    called = (GoTo(place="kitchen"), SOMEBODY, Say(text=f"{name}，吃饭了"))
    assert steps(f"去厨房等{name}，等{name}来了就说吃饭了") == called
    assert steps(f"在厨房等{name}，他来了就告诉他吃饭了") == called
    assert steps(f"在厨房等着，{name}回来了就跟她说吃饭了") == called
    assert steps(f"在厨房等{name}来") == called[:2]
    told = Say(text=f"有人来了，可能是{name}")  # who it is, no eye tells
    assert steps(f"在厨房等着，{name}来了就告诉我") == (*called[:2], told)


@pytest.mark.parametrize(
    "said",
    ["在厨房等着，小明来了就回去充电", "在厨房等着，小明来了就带他去书房",
     "在厨房等着，下雨了就回来", "在厨房等着，没人来就回来", "去厨房等水开了就告诉我",
     "在厨房等着，有人来了就别动", "在客厅等到天黑", "在客厅等到七点", "待在客厅看到晚上七点"],
)  # fmt: skip
def test_what_no_eye_and_no_clock_tells_moves_nothing(said: str) -> None:
    assert not isinstance(plan(said), StepPlan)


def test_what_hangs_on_a_sight_is_no_look() -> None:
    for said in ("去厨房，看到人就打招呼", "看到猫就回来"):
        assert not isinstance(plan(said), StepPlan)


@pytest.mark.parametrize("stays", ["在客厅等到晚上七点", "待在客厅到19:00", "去客厅守到晚上七点"])
def test_an_hour_ends_a_wait(stays: str) -> None:
    waited = (GoTo(place="living_room"), WaitFor(time="19:00"))
    assert steps(stays) == waited
    assert steps(f"{stays}，然后回去充电") == (*waited, ReturnHome())
