"""Whatever waits for a person's word ends by itself, shows first, and keeps no order out."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planner.mission.events import Reply, Tick
from planner.mission.open_questions import has_room
from planner.mission.state import MAX_OPEN
from planner.plan import (
    AnswerPlan,
    Ask,
    Bilingual,
    Clarify,
    Code,
    GoalState,
    Option,
    Refuse,
    StepPlan,
    say_same,
)
from tests.planner.mission.driving import CANCELLED, FAILED, standing_still
from tests.planner.mission.lockstep import Together, go, talk
from tests.planner.mission.rethinking import Rethinking
from wire import HeldReason

ASKS, CONFIRMS = GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION
SAYS = Bilingual(en="Which?", zh="哪个？")
WHICH = Clarify(code=Code.AMBIGUOUS, question=SAYS)
OFFERS = WHICH.model_copy(update={"options": (Option(label=say_same("x"), text="go there"),)})
STEP = StepPlan(steps=(Ask(question="Shall I?"), *go("kitchen").steps))
PLAN = go("kitchen")
KINDS = (WHICH, OFFERS, STEP, PLAN)


def waiting(*plans: Any, **more: Any) -> tuple[Rethinking, list[str]]:
    """Give goals that come to wait; a plan of steps that drive waits for its yes."""
    world = Rethinking(thoughts=list(plans))
    world.run(0.2)
    return world, [give(world, plan, **more) for plan in plans]


def give(world: Rethinking, plan: Any, **more: Any) -> str:
    goal = world.give(None, confirm=plan is PLAN, **more)
    if plan in KINDS:
        world.run_until(goal, ASKS, CONFIRMS)
    return goal


def later(world: Together, seconds: float) -> None:
    world.event(Tick())
    world.now_s += seconds
    world.event(Tick())


@pytest.mark.parametrize("plan", KINDS)
def test_what_nobody_answers_ends_after_its_time_and_says_what_was_asked(plan: Any) -> None:
    world, (goal,) = waiting(plan)
    later(world, world.book.rules.answer_s - 1.0)
    assert world.goal(goal).state in (ASKS, CONFIRMS)
    later(world, 2.0)
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "no_answer")
    assert mission.outcome is not None
    asked = {PLAN: f"text {goal}", STEP: "Shall I?"}.get(plan, SAYS.en)
    assert asked in mission.outcome.message.en
    assert world.book.asked_s == {}
    assert standing_still(world)


@pytest.mark.parametrize("plan", KINDS)
def test_after_a_restart_the_time_runs_anew(plan: Any) -> None:
    before, (goal,) = waiting(plan)
    later(before, before.book.rules.answer_s - 1.0)
    after = before.restart()
    later(after, after.book.rules.answer_s - 1.0)
    assert after.goal(goal).state in (ASKS, CONFIRMS)
    later(after, 2.0)
    assert (after.goal(goal).state, after.goal(goal).reason) == (FAILED, "no_answer")


def test_after_an_answer_the_next_question_has_its_whole_time() -> None:
    world, (goal,) = waiting(WHICH)
    world.thoughts.append(WHICH)
    later(world, world.book.rules.answer_s - 1.0)
    world.event(Reply(goal, "hm"))
    later(world, world.book.rules.answer_s - 1.0)
    assert world.goal(goal).state is ASKS


@pytest.mark.parametrize("source", ["api", "somebody else"])
@pytest.mark.parametrize(
    ("thought", "is_order"),
    [
        (PLAN, True),
        (talk(), True),
        (WHICH, True),
        (AnswerPlan(text=SAYS), False),
        (Refuse(code=Code.UNSAFE, reason=SAYS), False),
        (None, False),
    ],
)
def test_only_an_order_of_the_same_source_closes_and_says_which(
    thought: Any, is_order: bool, source: str
) -> None:
    world, (goal,) = waiting(WHICH)
    world.thoughts.append(thought)
    new = world.give(None, source=source)
    mission = world.goal(goal)
    if not (is_order and source == "api"):
        assert mission.state is ASKS
        return
    assert (mission.state, mission.reason) == (CANCELLED, "superseded")
    assert mission.outcome is not None
    assert f"“text {new}”" in mission.outcome.message.zh
    assert SAYS.zh in mission.outcome.message.zh


def test_a_question_under_way_and_a_plan_outlive_newer_orders() -> None:
    world, (step, plan) = waiting(STEP, PLAN)
    world.thoughts.append(talk())
    world.give(None)
    assert (world.goal(step).state, world.goal(plan).state) == (ASKS, CONFIRMS)


def test_room_is_made_of_what_waits_questions_about_orders_first() -> None:
    world, _ = waiting(PLAN, STEP, source="a")
    world.thoughts += [WHICH, PLAN]
    third = give(world, WHICH, source="b")
    give(world, PLAN, source="c")
    world.bridge.hold(HeldReason.STOP)
    world.run(0.2)
    world.thoughts += [go("kitchen")] * (MAX_OPEN + 1)
    for _ in range(MAX_OPEN - 4):
        world.give(None, source="d")
    open_ = [m.id for m in world.book.missions.values() if not m.has_ended]
    assert len(open_) == MAX_OPEN
    gone = []
    for _ in range(4):
        assert has_room(world.book)
        world.give(None, source="d")
        gone += [i for i in open_ if world.goal(i).has_ended and i not in gone]
    assert gone == [third, "g1", "g4", "g2"], "unclear orders, plans, then questions under way"
    assert not has_room(world.book)
    assert sum(not m.has_ended for m in world.book.missions.values()) == MAX_OPEN


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(st.tuples(st.sampled_from(KINDS), st.sampled_from("abc")), min_size=MAX_OPEN))
def test_no_number_of_questions_keeps_an_order_out(given_: list[tuple[Any, str]]) -> None:
    world = Rethinking()
    world.run(0.2)
    for plan, source in given_:
        assert has_room(world.book)
        world.thoughts.append(plan)
        give(world, plan, source=source)
        open_ = sum(not m.has_ended for m in world.book.missions.values())
        assert open_ <= MAX_OPEN
    later(world, 0.0)
    later(world, world.book.rules.answer_s + 1.0)
    assert all(m.has_ended for m in world.book.missions.values())
