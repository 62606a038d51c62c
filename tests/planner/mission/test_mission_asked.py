"""Restarts, questions, orders and holds: what a person must answer for."""

from __future__ import annotations

import pytest

from planner.mission.events import (
    Confirm,
    Move,
    Pause,
    Planned,
    Reply,
    Resume,
    Submitted,
)
from planner.mission.state import MAX_ENDED
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    ComeBack,
    GoalState,
    GoTo,
    Language,
    Look,
    Refuse,
    StepPlan,
    StepState,
)
from tests.planner.mission.driving import FAILED, PAUSED, QUEUED, SUCCEEDED, driving, standing_still
from tests.planner.mission.fakes import FakeBridge, row
from tests.planner.mission.lockstep import Together, go, talk
from wire import Action, HeldReason, Mode
from wire import Answer as BridgeAnswer


def test_restart_brings_back_paused_and_never_driving() -> None:
    before = Together()
    before.run(0.2)
    goal = driving(before)
    waiting, thinking = before.give(go("hall")), before.give(None)
    after = before.restart()
    states = {m.id: (m.state, m.reason) for m in after.book.missions.values()}
    assert states[goal] == (PAUSED, "planner_restarted")
    assert states[thinking] == (PAUSED, "planner_restarted")
    assert states[waiting] == (QUEUED, None)
    after.bridge.mode = Mode.HOLD
    assert standing_still(after, 10.0)
    after.act()
    assert standing_still(after, 10.0), "queued goals wait for a person too"
    after.event(Resume(goal))
    after.run_until(waiting, SUCCEEDED)
    after.event(Resume(thinking))
    assert after.goal(thinking).state is GoalState.PLANNING


def test_words_perhaps_said_before_a_crash_are_not_said_again() -> None:
    before = Together(disk=False)
    before.run(0.2)
    goal = before.give(talk("hi"))
    after = before.restart()
    after.run(0.2)
    after.event(Resume(goal))
    after.act()
    done = after.run_until(goal, SUCCEEDED)
    assert after.said == []
    assert (done.steps[0].state, done.steps[0].reason) == (StepState.SKIPPED, "perhaps_said")


def test_confirm_waits_for_a_yes(world: Together) -> None:
    goal = world.give(go("kitchen"), confirm=True)
    assert world.goal(goal).state is GoalState.AWAITING_CONFIRMATION
    assert standing_still(world)
    world.event(Confirm(goal))
    world.run_until(goal, SUCCEEDED)


def test_a_question_waits_for_an_answer_and_holds_nobody(world: Together) -> None:
    goal = world.give(None)
    question = Bilingual(en="Which one?", zh="哪一个？")
    world.event(Planned(goal, Clarify(code=Code.AMBIGUOUS, question=question)))
    assert world.goal(goal).state is GoalState.NEEDS_CLARIFICATION
    other = world.give(go("hall"), source="somebody else")
    world.run_until(other, SUCCEEDED)
    world.plans[goal] = go("kitchen")
    world.event(Reply(goal, "the kitchen"))
    world.run_until(goal, SUCCEEDED)


def test_answers_and_refusals_end_at_once(world: Together) -> None:
    said = Bilingual(en="In the hall.", zh="在走廊。")
    told, refused, lost = (world.give(None) for _ in range(3))
    world.event(Planned(told, AnswerPlan(text=said)))
    world.event(Planned(refused, Refuse(code=Code.NO_CAPABILITY, reason=said)))
    world.event(Planned(lost, None))
    assert world.goal(told).state is SUCCEEDED
    assert world.goal(refused).state is GoalState.REFUSED
    assert world.goal(lost).state is GoalState.REFUSED
    assert world.bridge.granted is None


@pytest.mark.parametrize(
    ("plan", "code"),
    [
        (StepPlan(steps=(GoTo(place="hall"), Look(question="who?"))), Code.NO_CAMERA),
        (go("hall", "cellar"), Code.UNKNOWN_PLACE),
        (StepPlan(steps=()), Code.BAD_PLAN),
    ],
)
def test_what_cannot_be_walked_whole_is_refused_before_anything_moves(
    world: Together, plan: StepPlan, code: Code
) -> None:
    goal = world.give(plan)
    mission = world.goal(goal)
    assert mission.state is GoalState.REFUSED
    assert mission.outcome is not None
    assert mission.outcome.code is code
    assert standing_still(world)


def test_an_order_to_stop_is_a_goal_that_is_done(world: Together) -> None:
    goal = driving(world)
    world.event(Submitted("s1", "stop", Language.EN, stop=True))
    assert world.goal("s1").state is SUCCEEDED
    assert world.goal(goal).state is PAUSED
    world.event(Submitted("s2", "stop", Language.EN, stop=True, echoed=False))
    assert (world.goal("s2").state, world.goal("s2").reason) == (FAILED, "bridge_silent")


def test_a_late_or_repeated_status_changes_nothing(world: Together) -> None:
    driving(world)
    old = world.book.status
    assert old is not None
    world.run(0.5)
    newest = world.book.status
    world.engine.status(old, world.now_s)
    assert world.book.status is newest


def test_an_external_owner_is_never_pushed_aside() -> None:
    world = Together(bridge=FakeBridge(owner="p9"))
    goal = world.give(go("kitchen"))
    world.run(0.5)
    assert world.goal(goal).state is PAUSED or world.bridge.waypoints == []


def test_the_operators_budget_pauses_and_a_person_goes_on(world: Together) -> None:
    goal = driving(world)
    spent = {"operator_metres": 0.0, "rows": (row("BUDGET"),)}
    said = world.bridge.step().model_copy(update=spent)
    world.carry(world.engine.status(said, world.now_s + 0.05))
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "budget")
    world.event(Resume(goal))
    world.run_until(goal, SUCCEEDED)


@pytest.mark.parametrize("code", ["budget", "not_owner"])
def test_a_refused_grant_ends_the_mission_only_where_nothing_can_help(
    world: Together, code: str
) -> None:
    goal = driving(world)
    world.bridge.turn()
    refused = BridgeAnswer(id=goal, kind="grant", accepted=False, code=code, detail="")
    said = world.bridge.step().model_copy(update={"answers": (refused,)})
    world.carry(world.engine.status(said, world.now_s + 0.05))
    assert (world.goal(goal).state is FAILED) == (code == "budget")


def test_a_hold_by_fault_names_its_row(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("DRIVER_NACK", Action.STOP1),)
    world.bridge.hold(HeldReason.FAULT)
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(DRIVER_NACK)")


def test_a_protective_stop_pauses_by_its_own_name(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("ESTOP", Action.FAST1),)
    world.bridge.hold(HeldReason.FAULT)
    world.bridge.mode = Mode.ESTOPPED
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "estop")


def test_thinking_and_queued_goals_can_be_paused_and_resumed(world: Together) -> None:
    running, queued, thinking = driving(world), world.give(go("hall")), world.give(None)
    world.event(Pause(thinking))
    assert (world.goal(thinking).state, world.dropped) == (PAUSED, [thinking])
    world.event(Pause(queued))
    assert world.goal(queued).held
    world.run_until(running, SUCCEEDED)
    assert standing_still(world)
    world.event(Resume(queued))
    world.run_until(queued, SUCCEEDED)
    world.plans[thinking] = go("dock")
    world.event(Resume(thinking))
    world.run_until(thinking, SUCCEEDED)


def test_a_goal_put_last_is_last(world: Together) -> None:
    driving(world)
    second, third, fourth = (world.give(go("hall")) for _ in range(3))
    world.event(Move(second))
    assert world.book.queue == (third, fourth, second)
    assert world.disk_entries[-1].queue == world.book.queue, "the order outlives us"


def test_only_so_many_ended_goals_stay_at_hand(world: Together) -> None:
    running = driving(world)
    goals = [world.give(go("cellar")) for _ in range(MAX_ENDED + 5)]
    assert len(world.book.missions) == MAX_ENDED + 1
    assert goals[4] not in world.book.missions
    assert {goals[5], goals[-1], running} <= set(world.book.missions)


def test_coming_back_without_a_pose_to_come_back_to_fails(world: Together) -> None:
    world.bridge.localized = False
    world.run()
    goal = world.give(StepPlan(steps=(ComeBack(),)))
    assert (world.goal(goal).state, world.goal(goal).reason) == (FAILED, "no_route")


def test_a_goal_given_before_the_robot_is_localized_starts_once_it_is(world: Together) -> None:
    world.bridge.localized = False
    world.run()
    goal = world.give(go("kitchen"))
    world.run(2.0)
    assert world.routes == []
    world.bridge.localized = True
    world.run_until(goal, SUCCEEDED)
