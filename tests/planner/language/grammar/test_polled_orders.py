"""Looks now and then, and a turn, until something is seen or it is that late."""

from __future__ import annotations

from math import pi

import pytest

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.language.schedule import ScheduleCommand, read_order_command
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Clarify,
    ClockTime,
    If,
    Look,
    Refuse,
    Repeat,
    Step,
    StepPlan,
    Turn,
    Wait,
)
from tests.planner.language.grammar.conftest import HOME


def plan(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(runnable=EVERY_KIND))


def only(text: str) -> Step:
    made = plan(text)
    assert isinstance(made, StepPlan), text
    (step,) = made.steps
    return step


@pytest.mark.parametrize(
    ("said", "pause_s"), [("每五分钟", 300), ("每隔两分钟", 120), ("每十分钟", 600)]
)
@pytest.mark.parametrize("until", ["直到有人为止", "直到看到有人", "一直到看见人为止"])
def test_it_looks_at_once_and_then_now_and_again(said: str, pause_s: float, until: str) -> None:
    step = only(f"{said}看一次厨房，{until}")
    seen = Look(question="厨房有没有人", place="kitchen")
    rounds = min(20, int(3600 // pause_s))
    again = Repeat(steps=(Wait(seconds=pause_s),), until=seen, times=rounds)
    assert step == If(when=seen, otherwise=(again,))


def test_an_hour_ends_the_rounds() -> None:
    step = only("每五分钟看一次厨房，直到晚上七点")
    assert isinstance(step, Repeat)
    assert step.until == ClockTime(after="19:00")
    assert step.times == 12
    assert step.steps[-1] == Wait(seconds=300)


def test_rounds_that_end_are_no_order_for_good() -> None:
    assert read_order_command("每五分钟看一次厨房，直到有人为止") is None
    assert isinstance(read_order_command("每五分钟看一次厨房"), ScheduleCommand)


@pytest.mark.parametrize(
    "said",
    ["每五分钟看一次厨房，直到没人为止", "每五分钟看一次厨房，直到妈妈来",
     "每五分钟看一次厨房，直到七点", "每半小时看一次厨房，直到有人为止",
     "每五分钟看一次厨房，直到下雨", "往前走到看见人为止",
     "转到看见妈妈为止", "转到看见鬼为止", "走到看见人为止"],
)  # fmt: skip
def test_an_end_that_no_look_and_no_clock_tells_moves_nothing(said: str) -> None:
    assert not isinstance(plan(said), StepPlan)


@pytest.mark.parametrize("thing", ["人", "杯子", "猫"])
def test_a_turn_until_something_is_seen_goes_round_once_at_most(thing: str) -> None:
    left = only(f"转到看见{thing}为止")
    assert isinstance(left, Repeat)
    assert left.until == Look(question=f"有没有{thing}")
    assert left.steps == (Turn(angle_rad=pi / 6),)
    assert left.times * pi / 6 == pytest.approx(2 * pi)
    assert only(f"在原地转，直到看到{thing}为止") == left
    right = only(f"向右转，直到看见{thing}为止")
    assert isinstance(right, Repeat)
    assert right.steps == (Turn(angle_rad=-pi / 6),)


def test_what_is_seen_on_the_look_before_is_a_condition_there() -> None:
    assert plan("看一次厨房，看到有人就回来") == plan("如果厨房有人，就回来")
    assert plan("去厨房看看，看到有人就告诉我") == plan("如果厨房有人，就告诉我")


@pytest.mark.parametrize(
    "text",
    ["every five minutes check the kitchen until somebody comes",
     "check the kitchen every five minutes until there is somebody",
     "please every five minutes look in the kitchen till you see somebody"],
)  # fmt: skip
def test_english_looks_now_and_then_until_somebody_is_seen(text: str) -> None:
    (round_,) = only_if(text).otherwise
    assert isinstance(round_, Repeat)
    assert round_.steps == (Wait(seconds=300.0),)
    assert isinstance(round_.until, Look)
    assert (round_.until.place, round_.times) == ("kitchen", 12)
    assert not isinstance(read_order_command(text), ScheduleCommand)


def only_if(text: str) -> If:
    step = only(text)
    assert isinstance(step, If)
    assert step.when == step.otherwise[0].until  # type: ignore[union-attr]
    return step


def test_english_looks_end_at_an_hour() -> None:
    step = only("check the kitchen every ten minutes until 6 pm")
    assert isinstance(step, Repeat)
    assert step.until == ClockTime(after="18:00")


@pytest.mark.parametrize(("side", "sign"), [("", 1.0), (" to the right", -1.0), (" left", 1.0)])
def test_an_english_turn_ends_at_what_is_seen_and_once_about(side: str, sign: float) -> None:
    step = only(f"keep turning{side} until you see a person")
    assert isinstance(step, Repeat)
    assert step.steps == (Turn(angle_rad=sign * pi / 6),)
    assert step.times == 12


@pytest.mark.parametrize(
    "text",
    ["turn until you see Tom", "spin around until you see nobody",
     "every five minutes check the kitchen until nobody is there",
     "every five minutes check the kitchen until I say banana",
     "every five minutes say hello until Tom comes",
     "every five minutes go to the kitchen and follow somebody until somebody comes"],
)  # fmt: skip
def test_an_english_end_that_nobody_can_tell_is_refused(text: str) -> None:
    assert not isinstance(plan(text), StepPlan)
