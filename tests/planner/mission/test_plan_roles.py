"""A model's plan acts on what runs as a person's words bear it: it can end nothing by itself."""

from __future__ import annotations

from typing import Any

import pytest

from planner.language.motion_guard.taking_back import takes_back
from planner.mission.events import Pause, Planned, Reply, Stopped, Submitted
from planner.plan import (
    Ask,
    BrainTag,
    Clarify,
    Code,
    GoalState,
    GoTo,
    Language,
    PlanRole,
    Say,
    StepPlan,
    check_plan,
    say_same,
)
from tests.planner.mission.fakes import outcome_of
from tests.planner.mission.lockstep import (
    CANCELLED,
    PAUSED,
    QUEUED,
    RUNNING,
    SUCCEEDED,
    Together,
    driving,
    go,
)

ASKS, CONFIRMS = GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION
MODEL = BrainTag(name="m", version="5", prompt="plan/5@0")
DOCK = GoTo(place="dock")


def say(
    world: Together, text: str, role: PlanRole, *steps: Any, unasked: tuple[int, ...] = ()
) -> str:
    """Give an order by a sentence, and let a model plan it with this role."""
    goal = f"said-{len(world.book.missions)}"
    world.event(Submitted(goal, text, Language.EN, local=True))
    made = StepPlan(steps=steps, does=role)
    world.event(Planned(goal, made, None, MODEL, unasked))
    return goal


def test_instead_takes_the_place_of_what_runs(world: Together) -> None:
    first = driving(world, "kitchen")
    second = say(world, "I meant the place where you charge", PlanRole.INSTEAD, DOCK)
    assert world.goal(first).state is CANCELLED
    world.run_until(second, SUCCEEDED)


@pytest.mark.parametrize("text", [
    "go to the dock",
    "go to the dock; if you can't get in, wait in the hall instead",
    "if the door is open, go to the dock instead",
    "say “forget that” and go to the dock",
])  # fmt: skip
def test_where_no_word_takes_anything_back_nothing_is_ended(world: Together, text: str) -> None:
    first = driving(world, "kitchen")
    second = say(world, text, PlanRole.INSTEAD, DOCK)
    assert (world.goal(first).state, world.goal(second).state) == (RUNNING, QUEUED)


def test_instead_of_something_unasked_waits_for_its_yes_and_ends_nothing_before(
    world: Together,
) -> None:
    first = driving(world, "kitchen")
    second = say(world, "no, not that", PlanRole.INSTEAD, DOCK, unasked=(0,))
    assert (world.goal(first).state, world.goal(second).state) == (RUNNING, CONFIRMS)


def test_after_goes_before_those_who_wait(world: Together) -> None:
    driving(world, "kitchen")
    waiting = world.give(go("dock"))
    after = say(world, "and when you are there, the dock", PlanRole.AFTER, DOCK)
    new = say(world, "go to the dock", PlanRole.NEW, DOCK)
    assert world.book.queue == (after, waiting, new)


def test_cancel_ends_what_a_person_takes_back(world: Together) -> None:
    first = driving(world, "kitchen")
    second = say(world, "oh forget about the whole thing", PlanRole.CANCEL)
    assert (world.goal(first).state, world.goal(second).state) == (CANCELLED, SUCCEEDED)
    assert "Cancelled" in told(world, second)


def test_cancel_without_a_word_of_it_is_asked_about_first(world: Together) -> None:
    first = driving(world, "kitchen")
    second = say(world, "what a nice day", PlanRole.CANCEL)
    assert (world.goal(first).state, world.goal(second).state) == (RUNNING, ASKS)
    assert "Shall I end" in told(world, second)
    plan = world.goal(second).plan
    assert plan is not None
    assert [option.text for option in plan.options] == ["cancel it"]


def test_cancel_with_nothing_to_end_says_so(world: Together) -> None:
    goal = say(world, "forget it all", PlanRole.CANCEL)
    assert world.goal(goal).state is SUCCEEDED
    assert "nothing to cancel" in told(world, goal)


def test_cancel_ends_the_goal_that_was_paused_last_where_nothing_else_is_open(
    world: Together,
) -> None:
    first = driving(world, "kitchen")
    world.event(Stopped("test"))
    second = say(world, "forget that", PlanRole.CANCEL)
    assert (world.goal(first).state, world.goal(second).state) == (CANCELLED, SUCCEEDED)


def paused_pair(world: Together) -> tuple[str, str]:
    kitchen = driving(world, "kitchen")
    world.event(Pause(kitchen))
    dock = driving(world, "dock")
    world.event(Pause(dock))
    assert [world.goal(each).state for each in (kitchen, dock)] == [PAUSED, PAUSED]
    return kitchen, dock


@pytest.mark.parametrize(
    ("words", "left"), [("cancel the kitchen one", 1), ("forget going to the dock", 0)]
)
def test_of_several_paused_goals_the_one_that_is_named_is_ended(
    world: Together, words: str, left: int
) -> None:
    pair = paused_pair(world)
    say(world, words, PlanRole.CANCEL)
    assert world.goal(pair[left]).state is PAUSED
    assert world.goal(pair[1 - left]).state is CANCELLED


def test_where_none_of_several_paused_goals_is_named_the_person_is_asked_which(
    world: Together,
) -> None:
    pair = paused_pair(world)
    goal = say(world, "forget that", PlanRole.CANCEL)
    assert world.goal(goal).state is ASKS
    assert "Which of these shall I end" in told(world, goal)
    assert [world.goal(each).state for each in pair] == [PAUSED, PAUSED]
    world.event(Reply(goal, "the kitchen one"))
    world.event(Planned(goal, StepPlan(steps=(), does=PlanRole.CANCEL), None, MODEL))
    assert [world.goal(each).state for each in pair] == [CANCELLED, PAUSED]


def test_a_paused_goal_that_is_named_is_ended_and_what_runs_goes_on(world: Together) -> None:
    kitchen = driving(world, "kitchen")
    world.event(Pause(kitchen))
    dock = driving(world, "dock")
    say(world, "cancel the kitchen one", PlanRole.CANCEL)
    assert [world.goal(each).state for each in (kitchen, dock)] == [CANCELLED, RUNNING]


def asking(world: Together) -> str:
    goal = world.give(StepPlan(steps=(Ask(question="Shall I drive?"), GoTo(place="kitchen"))))
    world.run(0.5)
    assert world.goal(goal).state is ASKS
    return goal


@pytest.mark.parametrize(("text", "state"), [
    ("yes", QUEUED),
    ("yes please", QUEUED),
    ("what a nice day", ASKS),
    ("the robot says yes to everything today", ASKS),
    ("I suppose somebody might agree", ASKS),
])  # fmt: skip
def test_an_answer_is_what_the_person_said_and_no_model_can_say_yes(
    world: Together, text: str, state: GoalState
) -> None:
    """Whatever a model takes for an answer: only a plain yes of the person's own words drives."""
    goal = asking(world)
    answer = say(world, text, PlanRole.ANSWER_TO)
    assert world.goal(answer).state is SUCCEEDED
    assert world.goal(goal).state in (state, RUNNING if state is QUEUED else state)
    if state is ASKS:
        world.run(3.0)
        assert world.bridge.waypoints == []


def test_an_answer_to_nothing_or_to_several_answers_none(world: Together) -> None:
    alone = say(world, "the left one", PlanRole.ANSWER_TO)
    assert world.goal(alone).state is GoalState.REFUSED
    first, second = asking(world), asking(world)
    both = say(world, "yes to that", PlanRole.ANSWER_TO)
    outcome = outcome_of(world.goal(both))
    assert outcome.code is Code.AMBIGUOUS
    assert [world.goal(each).state for each in (first, second)] == [ASKS, ASKS]


def test_an_answer_about_an_order_is_thought_about_with_it(world: Together) -> None:
    goal = "which"
    world.event(Submitted(goal, "bring my things", Language.EN))
    asked = Clarify(code=Code.AMBIGUOUS, question=say_same("Which room?"))
    world.event(Planned(goal, asked, None, MODEL))
    say(world, "the one with the bed", PlanRole.ANSWER_TO)
    mission = world.goal(goal)
    assert (mission.state, mission.replies) == (GoalState.PLANNING, ("the one with the bed",))
    assert mission.questions == ("Which room?",)


@pytest.mark.parametrize("role", [PlanRole.CANCEL, PlanRole.ANSWER_TO])
def test_what_ends_or_answers_moves_nothing_besides(role: PlanRole) -> None:
    moving = StepPlan(steps=(DOCK,), does=role)
    rejection = check_plan(moving, {"dock"})
    assert rejection is not None
    assert (rejection.first.code, rejection.repairable) == (Code.BAD_PLAN, True)
    assert check_plan(StepPlan(steps=(), does=role), ()) is None
    assert check_plan(StepPlan(steps=()), ()) is not None
    assert check_plan(StepPlan(steps=(Say(text="x"),), does=PlanRole.AFTER), ()) is None


@pytest.mark.parametrize(("text", "back"), [
    ("no, the other room", True), ("不对，我说的是另一间", True), ("forget it", True),
    ("don't go there, go home", True), ("go home", False), ("去厨房", False),
    ("if it is locked go to the hall instead", False), ("如果锁了就改去客厅", False),
    ("is there no milk in the kitchen", False), ("what does that mean", False),
    ("厨房里有没有人", False), ("hm, no, rather the sofa", True), ("还是去书房吧", True),
])  # fmt: skip
def test_words_that_take_back(text: str, back: bool) -> None:
    assert takes_back(text) is back


def test_a_paused_goal_is_not_ended_by_a_new_one(world: Together) -> None:
    first = driving(world, "kitchen")

    world.event(Pause(first))
    assert world.goal(first).state is PAUSED
    say(world, "no, the dock", PlanRole.INSTEAD, DOCK)
    assert world.goal(first).state is PAUSED


def told(world: Together, goal: str) -> str:
    outcome = world.goal(goal).outcome
    return outcome.message.en if outcome is not None else ""
