"""What a person must answer for: restarts, questions, orders and holds; all ends by itself."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planner.mission import events
from planner.mission.open_questions import complete_order, has_room
from planner.mission.state import MAX_ENDED, MAX_OPEN, Mission
from planner.plan import (
    AnswerPlan,
    Ask,
    Bilingual,
    BrainTag,
    Clarify,
    Code,
    GoalState,
    GoTo,
    Language,
    Look,
    Option,
    Refuse,
    Say,
    StepPlan,
    StepState,
    plan_record,
    say_same,
)
from tests.planner.mission.fakes import outcome_of
from tests.planner.mission.leaning import FACTS, newest, order_asked_about, plan_of
from tests.planner.mission.lockstep import (
    CANCELLED,
    FAILED,
    PAUSED,
    QUEUED,
    SUCCEEDED,
    Rethinking,
    Together,
    driving,
    go,
    standing_still,
    talk,
)
from wire import HeldReason, Mode

ASKS, CONFIRMS = GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION


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
    after.event(events.Resume(goal))
    after.run_until(waiting, SUCCEEDED)
    after.event(events.Resume(thinking))
    assert after.goal(thinking).state is GoalState.PLANNING


def test_words_perhaps_said_before_a_crash_are_not_said_again() -> None:
    before = Together(disk=False)
    before.run(0.2)
    goal = before.give(talk("hi"))
    after = before.restart()
    after.run(0.2)
    after.event(events.Resume(goal))
    after.act()
    done = after.run_until(goal, SUCCEEDED)
    assert after.said == []
    assert (done.steps[0].state, done.steps[0].reason) == (StepState.SKIPPED, "perhaps_said")


def test_confirm_waits_for_a_yes(world: Together) -> None:
    goal = world.give(go("kitchen"), confirm=True)
    assert world.goal(goal).state is GoalState.AWAITING_CONFIRMATION
    assert standing_still(world)
    world.event(events.Confirm(goal))
    world.run_until(goal, SUCCEEDED)


def test_a_question_waits_for_an_answer_and_holds_nobody(world: Together) -> None:
    goal = world.give(None)
    question = Bilingual(en="Which one?", zh="哪一个？")
    world.event(events.Planned(goal, Clarify(code=Code.AMBIGUOUS, question=question)))
    assert world.goal(goal).state is GoalState.NEEDS_CLARIFICATION
    other = world.give(go("hall"), source="somebody else")
    world.run_until(other, SUCCEEDED)
    world.plans[goal] = go("kitchen")
    world.event(events.Reply(goal, "the kitchen"))
    world.run_until(goal, SUCCEEDED)


def test_answers_and_refusals_end_at_once(world: Together) -> None:
    said = Bilingual(en="In the hall.", zh="在走廊。")
    told, refused, lost = (world.give(None) for _ in range(3))
    world.event(events.Planned(told, AnswerPlan(text=said)))
    world.event(events.Planned(refused, Refuse(code=Code.NO_CAPABILITY, reason=said)))
    world.event(events.Planned(lost, None))
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
    offer = Option(label=say_same("so"), text="so", plan=plan)
    asks = Clarify(code=Code.NOT_UNDERSTOOD, question=say_same("So?"), options=(offer,))
    both: tuple[Any, ...] = (plan, asks)
    for made in both if plan.steps else both[:1]:  # it is not asked about in vain, either
        mission = world.goal(world.give(made))
        assert mission.state is GoalState.REFUSED
        assert outcome_of(mission).code is code
        assert mission.plan == plan_record(plan).model_copy(update={"steps": mission.steps})
        assert standing_still(world)


def test_an_order_to_stop_is_a_goal_that_is_done(world: Together) -> None:
    goal = driving(world)
    world.event(events.Submitted("s1", "stop", Language.EN, stop=True))
    assert world.goal("s1").state is SUCCEEDED
    assert world.goal(goal).state is PAUSED
    world.event(events.Submitted("s2", "stop", Language.EN, stop=True, echoed=False))
    assert (world.goal("s2").state, world.goal("s2").reason) == (FAILED, "bridge_silent")


def test_only_so_many_ended_goals_stay_at_hand(world: Together) -> None:
    running = driving(world)
    goals = [world.give(go("cellar")) for _ in range(MAX_ENDED + 5)]
    assert len(world.book.missions) == MAX_ENDED + 1
    assert goals[4] not in world.book.missions
    assert {goals[5], goals[-1], running} <= set(world.book.missions)


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
    world.event(events.Reply(goal, "yes, please"))
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
    world.event(events.Reply(goal, "yes"))
    world.run(0.2)
    assert world.book.running == goal
    world.run_until(waiting, SUCCEEDED)


def test_nobody_answers_and_the_robot_stays_where_it_is(world: Together) -> None:
    goal = asking(world)
    world.run(world.book.rules.answer_s - 5.0, every_s=0.25)
    world.event(events.Tick())
    assert world.goal(goal).state is ASKS
    world.run(6.0, every_s=0.25)
    world.event(events.Tick())
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "no_answer")
    assert [s.state for s in mission.steps][1:] == [StepState.FAILED, StepState.SKIPPED]
    assert "Shall I go on?" in outcome_of(mission).message.zh
    assert standing_still(world)
    assert world.book.asked_s == {}


def test_a_stop_while_it_asks_needs_no_more_than_the_answer_to_go_on(world: Together) -> None:
    goal = asking(world)
    world.event(events.Stopped("test"))
    world.bridge.hold(HeldReason.STOP)
    assert standing_still(world, 3.0)
    assert world.goal(goal).state is ASKS
    world.event(events.Reply(goal, "yes"))
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
        world.event(events.Pause(waiting))
    else:
        if what == "stop":
            world.event(events.Stopped("test"))
        world.bridge.hold(HeldReason.STOP)
        world.run(0.2)
    fresh = world.give(go("dock"))
    world.event(events.Reply(goal, "yes"))
    world.act()
    world.run_until(goal, SUCCEEDED)
    world.run_until(fresh, SUCCEEDED)
    assert standing_still(world)
    assert world.goal(waiting).held
    world.event(events.Resume(waiting))
    world.run_until(waiting, SUCCEEDED)


def test_a_question_can_be_cancelled(world: Together) -> None:
    goal = asking(world)
    world.event(events.Cancel(goal))
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
        after.event(events.Resume(goal))
    after.run(0.2)
    assert (after.goal(goal).state, after.said) == (ASKS, [])
    after.act()
    after.run(0.2)
    after.event(events.Reply(goal, "me"))
    assert after.run_until(goal, SUCCEEDED).steps[0].answer == "me"
    assert after.said == ["well"]


def test_a_pause_before_the_question_was_said_asks_it_silently() -> None:
    world = Together(disk=False)
    world.run(0.2)
    goal = world.give(StepPlan(steps=(Ask(question="Who?"),)))
    world.event(events.Pause(goal))
    world.event(events.Resume(goal))
    world.disk = True
    world.event(events.Journalled(world.book.written))
    assert (world.goal(goal).state, world.said) == (ASKS, [])


@pytest.mark.parametrize("asks", [False, True])
def test_forget_that_means_what_thinks_or_asks_where_nothing_runs(
    world: Together, asks: bool
) -> None:
    paused = world.give(go("hall"))
    world.event(events.Pause(paused))
    first = world.give(PLAN if asks else None)
    if asks:
        world.run_until(first, ASKS)
    second = world.give(go("kitchen"), replace=True)
    assert world.goal(first).state is CANCELLED
    assert world.goal(paused).state is PAUSED, "what a person paused keeps its place"
    assert world.dropped == ([] if asks else [first])
    world.run_until(second, SUCCEEDED)


SAYS = Bilingual(en="Which?", zh="哪个？")
WHICH = Clarify(code=Code.AMBIGUOUS, question=SAYS)
OFFERS = WHICH.model_copy(update={"options": (Option(label=say_same("x"), text="go there"),)})
STEP = StepPlan(steps=(Ask(question="Shall I?"), *go("kitchen").steps))
ORDER = go("kitchen")
KINDS = (WHICH, OFFERS, STEP, ORDER)


def waiting(*plans: Any, **more: Any) -> tuple[Rethinking, list[str]]:
    """Give goals that come to wait; a plan of steps that drive waits for its yes."""
    world = Rethinking(thoughts=list(plans))
    world.run(0.2)
    return world, [give(world, plan, **more) for plan in plans]


def give(world: Rethinking, plan: Any, **more: Any) -> str:
    goal = world.give(None, confirm=plan is ORDER, **more)
    if plan in KINDS:
        world.run_until(goal, ASKS, CONFIRMS)
    return goal


def later(world: Together, seconds: float) -> None:
    world.event(events.Tick())
    world.now_s += seconds
    world.event(events.Tick())


@pytest.mark.parametrize("plan", KINDS)
def test_what_nobody_answers_ends_after_its_time_and_says_what_was_asked(plan: Any) -> None:
    world, (goal,) = waiting(plan)
    later(world, world.book.rules.answer_s - 1.0)
    assert world.goal(goal).state in (ASKS, CONFIRMS)
    later(world, 2.0)
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "no_answer")
    asked = {ORDER: f"text {goal}", STEP: "Shall I?"}.get(plan, SAYS.en)
    assert asked in outcome_of(mission).message.en
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
    world.event(events.Reply(goal, "hm"))
    later(world, world.book.rules.answer_s - 1.0)
    assert world.goal(goal).state is ASKS


@pytest.mark.parametrize("source", ["api", "somebody else"])
@pytest.mark.parametrize(
    ("thought", "is_order"),
    [
        (ORDER, True),
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
    assert f"“text {new}”" in outcome_of(mission).message.zh
    assert SAYS.zh in outcome_of(mission).message.zh


def test_a_question_under_way_and_a_plan_outlive_newer_orders() -> None:
    world, (step, plan) = waiting(STEP, ORDER)
    world.thoughts.append(talk())
    world.give(None)
    assert (world.goal(step).state, world.goal(plan).state) == (ASKS, CONFIRMS)


def test_room_is_made_of_what_waits_questions_about_orders_first() -> None:
    world, _ = waiting(ORDER, STEP, source="a")
    world.thoughts += [WHICH, ORDER]
    third = give(world, WHICH, source="b")
    give(world, ORDER, source="c")
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


MUM = newest(order_asked_about("tell Mum that tea is ready"))


@pytest.mark.parametrize("answer", ["in the study", "she's in the study", "the study, I think"])
def test_a_place_completes_the_order(answer: str) -> None:
    assert complete_order(FACTS, MUM, answer) == "tell Mum in the study that tea is ready"


@pytest.mark.parametrize("answer", ["she's out", "not in the study", "go to the study", "yes"])
def test_another_answer_stays_as_it_was_said(answer: str) -> None:
    assert complete_order(FACTS, MUM, answer) == answer


def test_a_model_reads_the_answer_to_its_own_question() -> None:
    asked = MUM.model_copy(update={"brain": BrainTag(name="a model", version="1")})
    assert complete_order(FACTS, asked, "in the study") == "in the study"


def asked_where(order: str) -> Mission:
    """Return an order about whose place the built-in brain asks."""
    asks = plan_of(order)
    assert isinstance(asks, Clarify)
    return newest(order_asked_about(order, asks))


@pytest.mark.parametrize(
    ("order", "answer", "completed"),
    [
        ("go to the garage", "the kitchen", "go to the kitchen"),
        ("Go to my Garage", "no, the kitchen", "Go to the kitchen"),
        ("take me to the garage and say hi", "kitchen", "take me to the kitchen and say hi"),
        ("is there a cup in the garage?", "in the study", "is there a cup in the study?"),
        ("go to Anna's room", "the study, I think", "go to the study"),
        ("先去车库再去厨房", "书房", "先去书房再去厨房"),
        ("去车库", "the kitchen", "去厨房"),
        ("go to the garage", "the cellar", "the cellar"),
        ("go to the garage", "not the kitchen", "not the kitchen"),
        ("go to the garage", "the kitchen and the study", "the kitchen and the study"),
        ("tell Mum in the garage that the garage burns", "the study", "the study"),
    ],
)
def test_a_place_stands_in_for_the_one_nobody_knows(
    order: str, answer: str, completed: str
) -> None:
    assert complete_order(FACTS, asked_where(order), answer) == completed
