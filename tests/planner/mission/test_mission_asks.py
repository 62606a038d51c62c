"""A plan's own question stands still for its answer; the answer is kept, and nobody overtakes."""

from __future__ import annotations

import pytest

from planner.mission.events import Cancel, Journalled, Pause, Reply, Resume, Stopped, Tick
from planner.plan import Ask, Code, GoalState, GoTo, Say, StepPlan, StepState
from tests.planner.mission.driving import CANCELLED, FAILED, PAUSED, SUCCEEDED, standing_still
from tests.planner.mission.lockstep import Together, go
from wire import HeldReason

ASKS = GoalState.NEEDS_CLARIFICATION
PLAN = StepPlan(steps=(GoTo(place="dock"), Ask(question="Shall I go on?"), GoTo(place="kitchen")))


def asking(world: Together) -> str:
    goal = world.give(PLAN)
    world.run_until(goal, ASKS)
    return goal


def test_it_asks_once_waits_and_goes_on_with_the_answer_written_down(world: Together) -> None:
    goal = asking(world)
    mission = world.goal(goal)
    assert world.said == ["Shall I go on?"]
    assert (mission.reason, mission.outcome and mission.outcome.code) == ("asked", Code.ASKED)
    assert standing_still(world, 30.0)
    world.event(Reply(goal, "yes, please"))
    done = world.run_until(goal, SUCCEEDED)
    assert [s.state for s in done.steps] == [StepState.SUCCEEDED] * 3
    assert done.steps[1].answer == "yes, please"
    assert world.said == ["Shall I go on?"]


def test_who_waited_waits_on_and_a_goal_given_now_runs(world: Together) -> None:
    goal = world.give(PLAN)
    waiting = world.give(go("hall"))
    world.run_until(goal, ASKS)
    assert standing_still(world, 2.0)
    assert world.goal(waiting).held, "a question of the running goal holds the queue"
    fresh = world.give(go("hall"))
    world.run_until(fresh, SUCCEEDED)
    world.event(Reply(goal, "yes"))
    world.run(0.2)
    assert world.book.running == goal
    world.run_until(waiting, SUCCEEDED)


def test_nobody_answers_and_the_robot_stays_where_it_is(world: Together) -> None:
    goal = asking(world)
    world.run(world.book.rules.answer_s - 5.0, every_s=0.25)
    world.event(Tick())
    assert world.goal(goal).state is ASKS
    world.run(6.0, every_s=0.25)
    world.event(Tick())
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "no_answer")
    assert [s.state for s in mission.steps][1:] == [StepState.FAILED, StepState.SKIPPED]
    assert mission.outcome is not None
    assert "Shall I go on?" in mission.outcome.message.zh
    assert standing_still(world)
    assert world.book.asked_s == {}


def test_a_stop_while_it_asks_needs_no_more_than_the_answer_to_go_on(world: Together) -> None:
    goal = asking(world)
    world.event(Stopped("test"))
    world.bridge.hold(HeldReason.STOP)
    assert standing_still(world, 3.0)
    assert world.goal(goal).state is ASKS
    world.event(Reply(goal, "yes"))
    world.act()
    world.run_until(goal, SUCCEEDED)


@pytest.mark.parametrize("what", ["stop", "bridge", "pause", "restart"])
def test_an_answer_lets_nobody_go_whom_more_than_the_question_keeps(
    world: Together, what: str
) -> None:
    goal = world.give(PLAN)
    waiting = world.give(go("hall"))
    world.run_until(goal, ASKS)
    if what == "restart":
        world = world.restart()
        world.run(0.2)
    elif what == "pause":
        world.event(Pause(waiting))
    else:
        if what == "stop":
            world.event(Stopped("test"))
        world.bridge.hold(HeldReason.STOP)
        world.run(0.2)
    fresh = world.give(go("dock"))
    world.event(Reply(goal, "yes"))
    world.act()
    world.run_until(goal, SUCCEEDED)
    world.run_until(fresh, SUCCEEDED)
    assert standing_still(world)
    assert world.goal(waiting).held
    world.event(Resume(waiting))
    world.run_until(waiting, SUCCEEDED)


def test_a_question_can_be_cancelled(world: Together) -> None:
    goal = asking(world)
    world.event(Cancel(goal))
    assert world.goal(goal).state is CANCELLED
    assert standing_still(world)


@pytest.mark.parametrize("told", [False, True])
def test_after_a_crash_it_still_asks_and_says_nothing_twice(told: bool) -> None:
    before = Together(disk=False)
    before.run(0.2)
    goal = before.give(StepPlan(steps=(Ask(question="Who?"), Say(text="well"))))
    if told:
        before.sync()
        assert (before.said, before.goal(goal).state) == (["Who?"], ASKS)
    after = before.restart()
    after.act()
    if not told:
        assert (after.goal(goal).state, after.goal(goal).reason) == (PAUSED, "planner_restarted")
        after.event(Resume(goal))
    after.run(0.2)
    assert (after.goal(goal).state, after.said) == (ASKS, [])
    after.act()
    after.run(0.2)
    after.event(Reply(goal, "me"))
    assert after.run_until(goal, SUCCEEDED).steps[0].answer == "me"
    assert after.said == ["well"]


def test_a_pause_before_the_question_was_said_asks_it_silently() -> None:
    world = Together(disk=False)
    world.run(0.2)
    goal = world.give(StepPlan(steps=(Ask(question="Who?"),)))
    world.event(Pause(goal))
    world.event(Resume(goal))
    world.disk = True
    world.event(Journalled(world.book.written))
    assert (world.goal(goal).state, world.said) == (ASKS, [])


@pytest.mark.parametrize("asks", [False, True])
def test_forget_that_means_what_thinks_or_asks_where_nothing_runs(
    world: Together, asks: bool
) -> None:
    paused = world.give(go("hall"))
    world.event(Pause(paused))
    first = world.give(PLAN if asks else None)
    if asks:
        world.run_until(first, ASKS)
    second = world.give(go("kitchen"), replace=True)
    assert world.goal(first).state is CANCELLED
    assert world.goal(paused).state is PAUSED, "what a person paused keeps its place"
    assert world.dropped == ([] if asks else [first])
    world.run_until(second, SUCCEEDED)
