"""A goal thinks again: because its plan says so, or because a step failed; never for ever."""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from typing import Any

import pytest

from planner.language.catalogue import message
from planner.mission.events import Cancel, Confirm, Pause, Planned, Reply, Resume, Stopped
from planner.mission.replan import ROAMS, SAME_AGAIN
from planner.mission.state import Mission
from planner.plan import (
    AnswerPlan,
    Ask,
    Bilingual,
    Clarify,
    Code,
    ComeBack,
    Count,
    Decide,
    Find,
    Follow,
    GoalState,
    GoTo,
    GoToObject,
    GoToPoint,
    Look,
    MoveStraight,
    Outcome,
    Patrol,
    Refuse,
    ReturnHome,
    Say,
    Step,
    StepPlan,
    StepState,
    Turn,
    Wait,
    say_same,
)
from planner.skills import Eyesight
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.lockstep import (
    ANNA,
    CANCELLED,
    FAILED,
    PAUSED,
    RUNNING,
    SHUT,
    SUCCEEDED,
    Rethinking,
    Seeing,
    Together,
    given,
    go,
    rethinking,
)
from wire import CameraConfig, Pose2

DECIDE = Decide(question="where to?")
SAYS = Bilingual(en="It is gone.", zh="不见了。")
DOWN = Outcome(code=Code.MODEL_UNAVAILABLE, message=message(Code.MODEL_UNAVAILABLE))


def plan(*steps: Any) -> StepPlan:
    return StepPlan(steps=steps)


def shut(world: Rethinking, *places: str) -> Rethinking:
    """Leave no way to some places."""
    poses = [FACTS.targets[place].pose for place in places]
    world.way = lambda ask: SHUT if ask.request.goal in poses else None
    return world


def test_new_steps_replace_the_rest_and_know_what_was_heard() -> None:
    first = plan(Ask(question="Where to?"), DECIDE, Say(text="never said"))
    world, goal = given(first, go("kitchen"))
    world.event(Reply(goal, "to the kitchen"))
    done = world.run_until(goal, SUCCEEDED)
    assert [s.kind for s in done.steps] == ["ask", "decide", "go_to"]
    assert [s.state for s in done.steps] == [StepState.SUCCEEDED] * 3
    asked, decided = world.asked[1].observed
    assert (asked.step, asked.result) == ("ask", "answered")
    assert "to the kitchen" in asked.detail.en
    assert "where to?" in decided.detail.zh
    assert world.said == ["Where to?"]


def test_a_failed_step_is_thought_about_with_what_went_wrong() -> None:
    world = shut(rethinking(go("kitchen"), plan(Say(text="the door is shut"))), "kitchen")
    goal = world.give(None)
    done = world.run_until(goal, SUCCEEDED)
    assert [(s.kind, s.state) for s in done.steps] == [
        ("go_to", StepState.FAILED), ("say", StepState.SUCCEEDED)]  # fmt: skip
    assert done.steps[0].reason == "no_route"
    again = world.asked[1]
    assert (again.replan, again.observed[0].result) == (1, "failed")
    assert "no way to the kitchen" in again.observed[0].detail.en


def test_the_same_steps_again_end_with_the_first_failure_after_one_thought() -> None:
    """So it goes with the offline brain, whose answer to a sentence is always the same."""
    world, goal = given(go("kitchen"), go("kitchen"), go("kitchen"), shut=True)
    mission = world.goal(goal)
    assert (mission.state, mission.reason, len(world.asked)) == (FAILED, "no_route", 2)
    assert outcome_of(mission).code is Code.NO_ROUTE


def test_no_more_new_plans_than_the_rules_allow() -> None:
    thoughts = [plan(Say(text=f"try {i}"), GoTo(place="kitchen")) for i in range(9)]
    world, goal = given(*thoughts, shut=True)
    assert world.goal(goal).state is FAILED
    assert len(world.asked) == 1 + world.book.rules.replans
    assert world.said == ["try 0", "try 1", "try 2"]


def test_no_goal_decides_for_ever() -> None:
    thoughts = [plan(Say(text=f"hm {i}"), Wait(seconds=0.1), DECIDE) for i in range(9)]
    world, goal = given(*thoughts)
    mission = world.run_until(goal, FAILED)
    assert mission.reason == "thoughts"
    assert len(world.asked) == 1 + world.book.rules.decides
    assert outcome_of(mission).code is Code.OUT_OF_BUDGET
    en = outcome_of(mission).message.en
    assert en.endswith("I have used up what I may for this: 3 thoughts under way.")
    assert "distance" not in en, "neither distance nor time was used up"


def test_a_thought_that_is_paused_and_resumed_counts_once() -> None:
    world, goal = given(plan(DECIDE))
    for _ in range(world.book.rules.decides + 1):
        world.event(Pause(goal))
        world.event(Resume(goal))
    assert (world.goal(goal).state, world.goal(goal).decides) == (RUNNING, 1)


@pytest.mark.parametrize(
    ("thought", "state", "code"),
    [
        (AnswerPlan(text=SAYS), SUCCEEDED, Code.ANSWERED),
        (Refuse(code=Code.UNSAFE, reason=SAYS), GoalState.REFUSED, Code.UNSAFE),
        ("the same", FAILED, Code.BAD_PLAN),
        (go("cellar"), FAILED, Code.UNKNOWN_PLACE),
        (DOWN, FAILED, Code.MODEL_UNAVAILABLE),
    ],
)
@pytest.mark.parametrize("failed", [False, True])
def test_what_is_no_new_plan_ends_the_goal_and_a_failure_stays_the_failure(
    thought: Any, state: GoalState, code: Code, failed: bool
) -> None:
    first = go("kitchen") if failed else plan(DECIDE)
    world = rethinking(first, first if thought == "the same" else thought, shut=failed)
    mission = world.goal(world.give(None))
    told = (FAILED, Code.NO_ROUTE) if failed else (state, code)
    assert (mission.state, mission.outcome and mission.outcome.code) == told
    assert world.book.running is None


def test_an_answer_to_a_failure_is_told_behind_it() -> None:
    advice = AnswerPlan(text=Bilingual(en="Please open the door.", zh="请开门。"))
    world = rethinking(go("kitchen"), advice, shut=True)
    mission = world.goal(world.give(None))
    assert mission.state is FAILED
    assert outcome_of(mission).message.en.endswith("Please open the door.")
    assert "no way to the kitchen" in outcome_of(mission).message.en


def test_a_question_under_way_is_asked_and_its_answer_thought_about() -> None:
    question = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which dock?", zh="哪个？"))
    world, goal = given(plan(DECIDE), question, go("dock"))
    assert world.goal(goal).state is GoalState.NEEDS_CLARIFICATION
    world.event(Reply(goal, "the left one"))
    world.run_until(goal, SUCCEEDED)
    assert "the left one" in world.asked[2].observed[1].detail.en


@pytest.mark.parametrize(
    ("new", "named"),
    [
        (GoTo(place="dock"), "dock"),
        (ReturnHome(), "dock"),
        (ComeBack(), "where the goal was given"),
        (Find(object="red cup"), "looks for “red cup”"),
        (Count(object="cups"), "counts “cups”"),
        (Follow(object="me"), "follows “me”"),
        (GoToObject(object="sofa"), "goes to “sofa”"),
        (GoToPoint(x=500, y=700), "a spot in the picture"),
        (Look(question="look around"), "looks round"),
    ],
)
def test_another_destination_than_was_named_needs_a_yes(new: Any, named: str) -> None:
    world = shut(rethinking(go("kitchen"), plan(new)), "kitchen")
    world.engine.book = replace(world.book, eyes=Eyesight(CameraConfig()))
    goal = world.give(None)
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (GoalState.AWAITING_CONFIRMATION, "new_place")
    assert named in outcome_of(mission).message.en
    world.run(5.0)
    assert world.bridge.waypoints == []
    world.event(Confirm(goal))
    if new.kind in ROAMS:  # nothing shows pictures here: what comes of it is another story
        assert world.goal(goal).state is RUNNING
        return
    world.run_until(goal, SUCCEEDED)


@pytest.mark.parametrize(
    ("first", "again"),
    [
        (plan(GoTo(place="kitchen"), ReturnHome()), plan(Say(text="no"), GoTo(place="dock"))),
        (plan(GoTo(place="kitchen"), GoTo(place="dock")), plan(ReturnHome())),
        (plan(GoTo(place="kitchen"), ComeBack()), plan(ComeBack())),
    ],
)
def test_a_way_that_was_in_the_plan_needs_no_yes(first: StepPlan, again: StepPlan) -> None:
    world = shut(rethinking(first, again), "kitchen")
    world.run_until(world.give(None), SUCCEEDED)


@pytest.mark.parametrize(
    ("before", "again"),
    [
        (Find(object="red cup"), Find(object="Red cup ")),
        (Follow(object="me"), Follow(object="me")),
        (GoToPoint(x=500, y=700), GoToPoint(x=500, y=700)),
        (Look(question="look around"), Look(question="look around, who is there?")),
        (Say(text="on my way"), Look(question="what is ahead?")),
    ],
)
def test_what_the_plan_looked_for_before_is_looked_for_without_a_yes(
    before: Any, again: Any
) -> None:
    world = rethinking(plan(GoTo(place="kitchen"), before), plan(Say(text="oh"), again), shut=True)
    world.engine.book = replace(world.book, eyes=Eyesight(CameraConfig()))
    mission = world.goal(world.give(None))
    assert (mission.state, len(mission.steps)) == (RUNNING, 3)


@pytest.mark.parametrize(
    ("order", "state"), [(Cancel, CANCELLED), (Pause, PAUSED), (Stopped, PAUSED)]
)
def test_a_thinking_brain_is_interrupted_at_once_and_its_answer_changes_nothing(
    order: Any, state: GoalState
) -> None:
    world, goal = given(plan(DECIDE))
    assert world.goal(goal).state is RUNNING
    world.event(order(goal))
    assert (world.goal(goal).state, world.dropped) == (state, [goal])
    world.event(Planned(goal, go("kitchen")))
    world.run(2.0)
    assert world.bridge.waypoints == []
    if state is PAUSED:
        world.thoughts.append(plan(Say(text="on we go")))
        world.event(Resume(goal))
        assert (world.goal(goal).state, world.said) == (SUCCEEDED, ["on we go"])


def test_a_crash_while_it_thinks_about_a_failure_thinks_on_when_a_person_says_so() -> None:
    world, goal = given(go("kitchen"), shut=True)
    assert world.goal(goal).replans == 1
    after = world.restart()
    assert (after.goal(goal).state, after.goal(goal).reason) == (PAUSED, "planner_restarted")
    after.act()
    after.plans[goal] = plan(Say(text="another way"))
    after.event(Resume(goal))
    after.run_until(goal, SUCCEEDED)
    assert (after.goal(goal).replans, after.said) == (1, ["another way"])


DINNER = Say(text="dinner is ready")


def told(world: Rethinking, goal: str, *, state: Any = SUCCEEDED, code: Code | None = None) -> str:
    """Let a goal end, and return its sentence."""
    outcome = outcome_of(world.run_until(goal, state))
    assert code is None or outcome.code is code
    return outcome.message.en


MUCH = plan(DINNER, GoTo(place="kitchen"), Turn(angle_rad=1.0), MoveStraight(distance_m=0.5),
            Patrol(places=("hall", "kitchen")), Ask(question="tea?"))  # fmt: skip
NO = AnswerPlan(text=say_same("no"))


@pytest.mark.parametrize(
    ("first", "then", "place", "code", "en"),
    [
        (plan(GoTo(place="kitchen"), DINNER), plan(DINNER), "kitchen", Code.DONE,
         "I found no way to the kitchen. Instead: I said “dinner is ready”."),
        (go("kitchen", "hall"), go("hall"), "kitchen", Code.ARRIVED,
         "I found no way to the kitchen. Instead: Arrived: hall."),
        (go("hall", "dock", "kitchen", "dock"), NO, "kitchen", Code.NO_ROUTE,
         "Arrived: hall, then dock. I found no way to the kitchen. Not done: going to the dock."),
        (MUCH, MUCH, "kitchen", Code.NO_ROUTE,
         ("I said “dinner is ready”. I found no way to the kitchen. Not done: turning 57° to the "
          "left, driving 0.5 m forward, visiting hall, kitchen, asking “tea?”.")),
        (plan(Patrol(places=("hall", "kitchen", "dock"))), NO, "dock", Code.NO_ROUTE,
         "Visited one after the other: hall, kitchen. I found no way to the dock."),
    ],
    ids=["nobody_has_arrived", "another_place", "never_begun", "the_same_again", "patrol"],
)  # fmt: skip
def test_without_a_way_to_a_place_it_is_told_what_was_done_instead_and_what_was_not(
    first: StepPlan, then: Any, place: str, code: Code, en: str
) -> None:
    world = shut(rethinking(first, then), place)
    goal = world.give(None)
    state = FAILED if code is Code.NO_ROUTE else SUCCEEDED
    assert told(world, goal, state=state, code=code) == en
    if code is Code.DONE:
        zh = outcome_of(world.goal(goal)).message.zh
        assert zh == "找不到去kitchen的路。改为：我说了“dinner is ready”。"


def test_who_has_been_to_a_place_and_finds_no_way_back_has_not_arrived() -> None:
    world, goal = given(go("kitchen", "hall", "kitchen"), plan(DINNER))
    while world.goal(goal).step < 1:
        world.run()
    shut(world, "kitchen")
    assert told(world, goal, code=Code.DONE) == (
        "Been to: kitchen. Arrived: hall. I found no way to the kitchen. "
        "Instead: I said “dinner is ready”."
    )


def test_what_was_answered_is_told_whatever_a_brain_says_after_it() -> None:
    first = plan(GoTo(place="kitchen"), Ask(question="tea?"), Decide(question="what then?"))
    world, goal = given(first, AnswerPlan(text=say_same("I was told.")))
    while not world.goal(goal).outcome:
        world.run()
    world.event(Reply(goal, "green tea"))
    assert told(world, goal, code=Code.ANSWERED) == (
        "Arrived: kitchen. I asked “tea?”, and the answer was “green tea”. I was told."
    )


def test_a_cancelled_goal_tells_what_it_said_before() -> None:
    world, goal = given(plan(DINNER, GoTo(place="kitchen")))
    while not world.goal(goal).metres and world.bridge.pose.x_m < 1.0:
        world.run()
    world.event(Cancel(goal))
    assert told(world, goal, state=CANCELLED) == "I said “dinner is ready”. Cancelled."


def test_the_same_steps_again_are_named_in_both_languages() -> None:
    again = plan(Wait(seconds=0.1), Decide(question="?"))
    world, goal = given(again, again)
    en = told(world, goal, state=FAILED, code=Code.BAD_PLAN)
    outcome = outcome_of(world.goal(goal))
    assert SAME_AGAIN.en in en
    assert SAME_AGAIN.zh in outcome.message.zh
    assert SAME_AGAIN.en not in outcome.message.zh


def test_a_cause_is_told_to_a_later_thought_too() -> None:
    """The first failure's words outlive the second's."""
    first, second = go("kitchen", "dock"), go("dock")
    world = shut(rethinking(first, second, plan(DINNER)), "kitchen", "dock")
    world.run_until(world.give(None), SUCCEEDED)
    details = [each.detail.en for each in world.asked[2].observed]
    assert details == [f"I found no way to the {place}." for place in ("kitchen", "dock")]


SEEK, KITCHEN = Find(object="cup", place="kitchen"), GoTo(place="kitchen")
OK, LOST, LEFT_OUT = StepState.SUCCEEDED, StepState.FAILED, StepState.SKIPPED


@pytest.fixture
def away() -> Seeing:
    world = Seeing()
    world.open_eyes()
    world.bridge.pose = Pose2(0.4, -0.3, 0.0)
    world.run(0.2)
    return world


def states(mission: Mission) -> list[StepState]:
    return [step.state for step in mission.steps]


def near(world: Together, x_m: float, y_m: float) -> bool:
    return hypot(world.bridge.pose.x_m - x_m, world.bridge.pose.y_m - y_m) < 0.1


def test_nothing_found_is_told_where_the_order_was_given(away: Seeing) -> None:
    goal = away.give(plan(SEEK, Say(text="here it is"), ComeBack(), Say(text="I found it")))
    while states(away.goal(goal))[0] is not LOST:
        away.see(0.2)
    assert away.bridge.pose.x_m > 2.0
    assert (away.goal(goal).state, away.goal(goal).replans) == (RUNNING, 1)
    away.see_until(goal, FAILED)
    mission = away.goal(goal)
    assert near(away, 0.4, -0.3)
    assert states(mission) == [LOST, LEFT_OUT, OK, LEFT_OUT]
    assert (mission.reason, away.said) == ("not_found", [])
    assert outcome_of(mission).code is Code.NOT_FOUND
    assert outcome_of(mission).message.en == (
        "I saw no cup. I looked in the kitchen. Arrived: where you gave the order. "
        "Not done: saying “here it is”, saying “I found it”."
    )
    assert "没有看到杯子" in outcome_of(mission).message.zh
    assert "我到了：下达指令的地方。" in outcome_of(mission).message.zh
    assert outcome_of(mission).message.zh.endswith("没有做：说“here it is”、说“I found it”。")
    reached = outcome_of(mission).reached
    assert reached is not None
    assert reached.room == "hall"


@pytest.mark.parametrize(
    ("steps", "after", "at"),
    [
        ((SEEK, KITCHEN, ReturnHome()), [LOST, LEFT_OUT, OK], (0.0, 0.5)),
        ((SEEK, ComeBack(), ReturnHome()), [LOST, OK, LEFT_OUT], (0.4, -0.3)),
    ],
)
def test_the_first_way_back_is_driven_and_nothing_else(
    away: Seeing, steps: tuple[Step, ...], after: list[StepState], at: tuple[float, float]
) -> None:
    goal = away.give(plan(*steps))
    away.see_until(goal, FAILED)
    assert (states(away.goal(goal)), near(away, *at)) == (after, True)


def test_who_lost_a_person_comes_back(away: Seeing) -> None:
    away.things = (ANNA,)
    goal = away.give(plan(Follow(object="me"), ComeBack()))
    away.see(4.0)
    assert not near(away, 0.4, -0.3)
    away.things = ()
    away.see_until(goal, FAILED)
    outcome = outcome_of(away.goal(goal))
    assert (outcome.code, near(away, 0.4, -0.3)) == (Code.LOST_PERSON, True)


@pytest.mark.parametrize(("why", "step"), [("camera_silent", SEEK), ("no_route", KITCHEN)])
def test_any_other_failure_leaves_the_robot_where_it_stands(
    away: Seeing, why: str, step: Step
) -> None:
    goal = away.give(plan(GoTo(place="dock"), step, ComeBack()))
    while not near(away, 0.0, 0.5):
        away.see(0.2)
    if why == "no_route":
        away.way = lambda _: why
    else:
        away.blind = why
    away.see_until(goal, FAILED)
    mission = away.goal(goal)
    assert (mission.reason, states(mission)) == (why, [OK, LOST, LEFT_OUT])
    assert near(away, 0.0, 0.5)


def test_a_way_back_that_is_shut_is_told_after_what_was_looked_for(away: Seeing) -> None:
    goal = away.give(plan(SEEK, ComeBack(), ReturnHome()))
    while not away.goal(goal).returning:
        away.see(0.2)
    away.way = lambda _: "no_route"
    away.see_until(goal, FAILED)
    mission = away.goal(goal)
    assert states(mission) == [LOST, LOST, LEFT_OUT]
    assert (mission.reason, mission.steps[1].reason) == ("not_found", "no_route")
    assert outcome_of(mission).code is Code.NOT_FOUND
    assert outcome_of(mission).message.en.startswith("I saw no cup.")
    assert outcome_of(mission).message.en.endswith(
        "I found no way to where you gave the order. Not done: going to the dock."
    )


@pytest.mark.parametrize("crash", [False, True])
def test_the_way_back_keeps_its_place_over_a_pause_and_a_crash(away: Seeing, crash: bool) -> None:
    goal = away.give(plan(SEEK, Say(text="never"), ComeBack()))
    while not away.goal(goal).returning:
        away.see(0.2)
    away.see(1.0)
    world = away.restart() if crash else away
    if not crash:
        world.event(Pause(goal))
    world.run(0.2)
    assert world.goal(goal).state is PAUSED
    world.event(Resume(goal))
    world.act()
    mission = world.run_until(goal, FAILED)
    assert (states(mission), world.said) == ([LOST, LEFT_OUT, OK], [])
    assert near(world, 0.4, -0.3)
    assert outcome_of(mission).code is Code.NOT_FOUND
    assert FACTS.targets["kitchen"].name.en in outcome_of(mission).message.en
