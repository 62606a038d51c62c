"""Whatever moves upon an answer moves upon a plain yes alone: in words, in silence, thought about.

Scripted goals in lockstep; a motion is a position that changed after the question was asked. The
last of them drive to a point of a picture, which a model gave.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planner.brain.interface import OFFLINE
from planner.language.catalogue import message
from planner.language.yes_no import consents
from planner.mission.conversation import list_observations
from planner.mission.events import Cancel, Confirm, Pause, Reply, Resume, Stopped, Tick, Told
from planner.mission.reducer import asked_about_picture
from planner.plan import (
    AnswerPlan,
    Ask,
    Bilingual,
    BrainTag,
    Clarify,
    Code,
    ComeBack,
    Decide,
    GoalState,
    GoTo,
    GoToObject,
    Outcome,
    Patrol,
    Refuse,
    ReturnHome,
    Say,
    StepPlan,
    StepState,
    Wait,
)
from planner.skills import Eyesight, ImageAnswer
from planner.skills.skill_state import GoToObjectState
from tests.planner.mission.fakes import outcome_of
from tests.planner.mission.lockstep import (
    CANCELLED,
    FAILED,
    PAUSED,
    QUEUED,
    SUCCEEDED,
    TAG,
    Rethinking,
    Seeing,
    Together,
    go,
    standing_still,
)
from wire import CameraConfig, HeldReason

ASKS, CONFIRMS = GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION
OFFLINE_TAG = BrainTag(name=OFFLINE, version="2")
SAYS = Bilingual(en="Well.", zh="好吧。")
DOWN = Outcome(code=Code.MODEL_UNAVAILABLE, message=message(Code.MODEL_UNAVAILABLE))
KITCHEN = GoTo(place="kitchen")
GATED: tuple[tuple[Any, ...], ...] = (
    (Ask(question="May I come in?"), KITCHEN),
    (Ask(question="Shall I?"), Say(text="off I go"), KITCHEN),
    (Ask(question="Tea or coffee?"), Wait(seconds=0.2), KITCHEN, ComeBack()),
    (Ask(question="要我去吗？"), Patrol(places=("kitchen", "hall"))),
    (Ask(question="Ready?"), KITCHEN, Ask(question="And on?"), GoTo(place="hall")),
)
YES = ("yes", "Yes, please!", "go", "嗯，好的", "好呀可以", "沒問題", "um yes")
NO = ("no", "no, not yet", "No thanks.", "不要", "不用了谢谢", "先別去", "nope, not now")
UNCLEAR = (
    "maybe",
    "yes?",
    "coffee",
    "yes but slowly",
    "what?",
    "好不好",
    "等我一下再去",
    "the red one",
)


def asked(*steps: Any, brain: BrainTag = OFFLINE_TAG, thoughts: tuple[Any, ...] = ()) -> Rethinking:
    """Give a goal of these steps, and wait until it asks."""
    world = Rethinking(thoughts=[StepPlan(steps=steps), *thoughts], tag=brain)
    world.run(0.2)
    world.run_until(world.give(None), ASKS)
    return world


def said(world: Together, goal: str = "g1") -> tuple[GoalState, Code | None, str]:
    outcome = world.goal(goal).outcome
    return (
        world.goal(goal).state,
        outcome.code if outcome else None,
        outcome.message.en if outcome else "",
    )


def moved(world: Together, seconds: float = 1.5) -> bool:
    return not standing_still(world, seconds)


@pytest.mark.parametrize(("steps", "answer"), list(product(GATED, YES)))
def test_a_plain_yes_goes_on(steps: tuple[Any, ...], answer: str) -> None:
    world = asked(*steps)
    world.event(Reply("g1", answer))
    assert moved(world)
    assert world.goal("g1").steps[0].answer == answer


@pytest.mark.parametrize("brain", [OFFLINE_TAG, TAG])
@pytest.mark.parametrize(("steps", "answer"), list(product(GATED, NO)))
def test_a_plain_no_moves_nothing_and_ends_the_goal(
    steps: tuple[Any, ...], answer: str, brain: BrainTag
) -> None:
    world = asked(*steps, brain=brain)
    world.event(Reply("g1", answer))
    state, code, told = said(world)
    assert (state, code, world.goal("g1").reason) == (CANCELLED, Code.DECLINED, "declined")
    assert "You said no, so I do not " in told
    states = [step.state for step in world.goal("g1").steps]
    assert states == [StepState.SUCCEEDED] + [StepState.SKIPPED] * (len(steps) - 1)
    assert not moved(world)
    assert len(world.asked) == 1, "no brain is asked about a no"


@pytest.mark.parametrize(("steps", "answer"), list(product(GATED, UNCLEAR)))
def test_what_is_neither_is_asked_once_more_and_then_ends(
    steps: tuple[Any, ...], answer: str
) -> None:
    world = asked(*steps)
    world.event(Reply("g1", answer))
    world.run_until("g1", ASKS)
    state, _, told = said(world)
    assert told.startswith(f"You said “{answer}”. Shall I ")
    assert world.said[-1] == told
    assert not moved(world)
    world.event(Reply("g1", answer))
    state, code, told = said(world)
    assert (state, code) == (CANCELLED, Code.DECLINED)
    assert "You said neither yes nor no, so I do not " in told
    assert not moved(world)


@pytest.mark.parametrize("steps", GATED)
def test_a_yes_to_the_second_asking_goes_on_and_both_answers_are_kept(
    steps: tuple[Any, ...],
) -> None:
    world = asked(*steps)
    world.event(Reply("g1", "coffee"))
    world.run_until("g1", ASKS)
    world.event(Reply("g1", "yes"))
    assert moved(world)
    assert world.goal("g1").steps[0].answer == "coffee; yes"


@pytest.mark.parametrize("steps", GATED)
@pytest.mark.parametrize("again", [False, True])
def test_silence_moves_nothing_and_ends_the_goal(steps: tuple[Any, ...], again: bool) -> None:
    world = asked(*steps)
    if again:
        world.event(Reply("g1", "hm"))
        world.run_until("g1", ASKS)
    world.now_s += world.book.rules.answer_s + 1.0
    world.event(Tick())
    assert said(world)[:2] == (FAILED, Code.NO_ANSWER)
    assert not moved(world)


THOUGHTS: tuple[tuple[Any, GoalState, Code], ...] = (
    (go("kitchen"), CONFIRMS, Code.CONFIRM),
    (go("hall"), CONFIRMS, Code.CONFIRM),
    (StepPlan(steps=(Say(text="well"), ReturnHome())), CONFIRMS, Code.CONFIRM),
    (StepPlan(steps=(Say(text="all right"),)), SUCCEEDED, Code.DONE),
    (AnswerPlan(text=SAYS), SUCCEEDED, Code.ANSWERED),
    (Refuse(code=Code.UNSAFE, reason=SAYS), GoalState.REFUSED, Code.UNSAFE),
    (Clarify(code=Code.AMBIGUOUS, question=SAYS), ASKS, Code.ASKED),
    (DOWN, ASKS, Code.ASKED),
    (go("nowhere"), ASKS, Code.ASKED),
    (StepPlan(steps=GATED[0]), ASKS, Code.ASKED),
)


@pytest.mark.parametrize("answer", UNCLEAR)
@pytest.mark.parametrize(("thought", "state", "code"), THOUGHTS)
def test_a_brain_that_reads_an_unclear_answer_moves_nothing_without_a_yes(
    answer: str, thought: Any, state: GoalState, code: Code
) -> None:
    world = asked(*GATED[0], brain=TAG, thoughts=(thought,))
    world.event(Reply("g1", answer))
    world.run(0.3)
    assert said(world)[:2] == (state, code)
    assert not moved(world)
    assert len(world.asked) == 2
    heard = world.asked[1].observed[-1]
    assert (heard.step, heard.result) == ("ask", "answered")
    assert answer in heard.detail.en
    if state is CONFIRMS:
        assert world.goal("g1").reason == "new_plan"
        world.event(Reply("g1", answer))
        assert not moved(world)
        world.event(Reply("g1", "yes"))
        assert moved(world) or thought == go("hall")


@pytest.mark.parametrize("answer", ["no", "不用"])
def test_a_no_to_the_new_plan_ends_it(answer: str) -> None:
    world = asked(*GATED[0], brain=TAG, thoughts=(go("kitchen"),))
    world.event(Reply("g1", "coffee"))
    world.event(Reply("g1", answer))
    state, code, text = said(world)
    assert (state, code) == (CANCELLED, Code.DECLINED)
    assert text.endswith("You said no, so I do not drive to “kitchen”.")
    assert not moved(world)


def test_a_thought_about_an_answer_is_counted_and_survives_a_pause() -> None:
    world = asked(*GATED[0], brain=TAG)
    world.event(Reply("g1", "coffee"))
    for _ in range(3):
        world.event(Pause("g1"))
        world.event(Resume("g1"))
    assert (world.goal("g1").state, world.goal("g1").decides) == (GoalState.RUNNING, 1)
    assert not moved(world)


@pytest.mark.parametrize("answer", [*YES, *NO, *UNCLEAR])
def test_an_answer_that_a_thought_reads_is_free(answer: str) -> None:
    """A ``decide`` between the question and any motion reads the answer, as it always did."""
    steps = (Ask(question="Where to?"), Decide(question="where?"), KITCHEN)
    world = asked(*steps, brain=TAG, thoughts=(StepPlan(steps=(Say(text="I see"),)),))
    world.event(Reply("g1", answer))
    world.run_until("g1", SUCCEEDED)
    assert world.goal("g1").steps[0].answer == answer
    assert not moved(world)


@pytest.mark.parametrize("answer", [*YES, *NO, *UNCLEAR])
def test_an_answer_upon_which_nothing_moves_is_free(answer: str) -> None:
    world = asked(Ask(question="Who are you?"), Say(text="I see"), Wait(seconds=0.2))
    world.event(Reply("g1", answer))
    world.run_until("g1", SUCCEEDED)


@pytest.mark.parametrize("answer", [*NO, *UNCLEAR])
def test_under_a_hold_no_answer_but_a_yes_moves_anything(answer: str) -> None:
    world = asked(*GATED[0])
    world.event(Stopped("test"))
    world.bridge.hold(HeldReason.STOP)
    world.run(0.2)
    world.event(Reply("g1", answer))
    ends = consents(answer) is False
    assert said(world)[0] is (CANCELLED if ends else QUEUED), "a no is told at once"
    assert not moved(world, 3.0)
    assert world.book.pardoned is None
    world.act()
    assert not moved(world, 3.0)


@pytest.mark.parametrize("answer", ["no", "coffee"])
def test_an_answer_of_before_a_crash_is_read_after_it(answer: str) -> None:
    before = asked(*GATED[0])
    before.event(Stopped("test"))
    before.bridge.hold(HeldReason.STOP)
    before.run(0.2)
    before.event(Reply("g1", answer))
    after = before.restart()
    after.act()
    if after.goal("g1").state is not CANCELLED:
        after.event(Resume("g1"))
        after.run_until("g1", ASKS)
        after.event(Reply("g1", "no"))
    assert said(after)[0] is CANCELLED
    assert not moved(after)


STEPS = st.sampled_from(
    (KITCHEN, GoTo(place="hall"), Say(text="x"), Wait(seconds=0.1), ComeBack(), ReturnHome())
)
ANSWERS = st.sampled_from([*NO, *UNCLEAR, None])


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.lists(STEPS, max_size=3),
    st.lists(ANSWERS, min_size=2, max_size=2),
    st.sampled_from([OFFLINE_TAG, TAG]),
    st.sampled_from([None, *(thought for thought, *_ in THOUGHTS)]),
)
def test_whatever_comes_after_a_question_nothing_moves_without_a_yes(
    rest: list[Any], answers: list[str | None], brain: BrainTag, thought: Any
) -> None:
    world = asked(Ask(question="Shall I?"), KITCHEN, *rest, brain=brain,
                  thoughts=(thought, thought))  # fmt: skip
    for answer in answers:
        if answer is not None and world.goal("g1").state in (ASKS, CONFIRMS):
            world.event(Reply("g1", answer))
        assert not moved(world, 0.5)


def test_a_yes_on_the_page_is_the_same_as_one_in_words() -> None:
    world = asked(*GATED[0], brain=TAG, thoughts=(go("kitchen"),))
    world.event(Reply("g1", "coffee"))
    world.event(Confirm("g1"))
    assert moved(world)


GUITAR = StepPlan(steps=(GoToObject(object="guitar"), GoTo(place="dock")))
POINTED = (4.0, 0.5, 0.4)
OFFER = "I think “guitar” is 4.0 m away, straight ahead (in the kitchen). Shall I drive there?"


def sees(world: Seeing) -> Seeing:
    eyes = Eyesight(CameraConfig(), ("cup",), model=True)
    world.engine.book = replace(world.book, eyes=eyes)
    world.run(0.2)
    return world


def pointing(world: Seeing, *, written: bool = True) -> str:
    """Give a goal to what only a model knows, and let it point; then the disk is slow, or not."""
    goal = world.give(GUITAR)
    while (ticket := asked_about_picture(world.book)) is None:
        world.see(0.2)
    world.disk = written
    world.event(Told(goal, ticket, ImageAnswer(at=POINTED)))
    return goal


def anew(world: Seeing) -> Seeing:
    """Return a new planner on the same disk, its eyes open."""
    after = world.restart()
    seeing = Seeing(bridge=after.bridge, now_s=after.now_s, plans=after.plans, planner_id="p2")
    seeing.engine, seeing.disk_entries = after.engine, [*world.disk_entries, *after.disk_entries]
    return sees(seeing)


@pytest.fixture
def world() -> Seeing:
    return sees(Seeing())


def test_it_stands_and_asks_and_drives_upon_a_yes(world: Seeing) -> None:
    goal = pointing(world)
    mission = world.goal(goal)
    assert (mission.state, mission.reason, world.said) == (ASKS, "asked", [OFFER])
    assert (outcome_of(mission).code, outcome_of(mission).message.en) == (Code.ASKED, OFFER)
    assert standing_still(world, 30.0)
    world.event(Reply(goal, "Yes, please."))
    world.see_until(goal, SUCCEEDED)
    step = world.goal(goal).steps[0]
    assert (step.state, step.answer) == (StepState.SUCCEEDED, "Yes, please.")
    assert step.reached is not None
    assert step.reached.x_m == pytest.approx(3.2, abs=0.15)
    assert world.said == [OFFER]
    seen = list_observations(world.book.facts, world.goal(goal))[0]
    assert (seen.step, seen.result) == ("go_to_object", "succeeded")


@pytest.mark.parametrize("replies", [("no",), ("what?", "hm"), ("what?", "不要")])
def test_without_a_plain_yes_it_ends_where_it_stands(
    world: Seeing, replies: tuple[str, ...]
) -> None:
    goal = pointing(world)
    for reply in replies:
        assert world.goal(goal).state is ASKS
        world.event(Reply(goal, reply))
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "point_declined")
    assert outcome_of(mission).code is Code.POINT_REFUSED
    assert [s.state for s in mission.steps] == [StepState.FAILED, StepState.SKIPPED]
    assert standing_still(world)
    assert len(world.said) == len(replies), "a second question is said, too"


def test_nobody_answers_and_nothing_moves(world: Seeing) -> None:
    goal = pointing(world)
    world.run(world.book.rules.answer_s + 1.0, every_s=0.25)
    world.event(Tick())
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "no_answer")
    assert OFFER in outcome_of(mission).message.en
    assert standing_still(world)


@pytest.mark.parametrize("written", [True, False])
def test_a_crash_neither_drives_nor_loses_the_question(written: bool) -> None:
    before = sees(Seeing())
    goal = pointing(before, written=written)
    after = anew(before)
    after.act()
    if not written:
        assert (after.goal(goal).state, after.goal(goal).reason) == (PAUSED, "planner_restarted")
        after.event(Resume(goal))
    after.see(3.0)
    mission = after.goal(goal)
    assert (mission.state, after.said) == (ASKS, []), "perhaps said before"
    assert isinstance(mission.skill_state, GoToObjectState)
    assert mission.skill_state.pointed == POINTED
    if written:
        assert outcome_of(mission).message.en == OFFER
    assert standing_still(after)
    after.event(Reply(goal, "yes"))
    after.see_until(goal, SUCCEEDED)


def test_a_yes_given_before_a_crash_waits_for_a_person_and_asks_nothing_twice(
    world: Seeing,
) -> None:
    goal = pointing(world)
    world.event(Reply(goal, "yes"))
    world.see(1.0)
    after = anew(world)
    after.act()
    assert after.goal(goal).state is PAUSED
    assert standing_still(after, 5.0)
    after.event(Resume(goal))
    after.see_until(goal, SUCCEEDED)
    assert after.said == []


def test_a_yes_to_a_point_of_another_map_is_none(world: Seeing) -> None:
    world.engine.book = replace(world.book, facts=replace(world.book.facts, map_id="m1"))
    goal = pointing(world)
    world.event(Reply(goal, "yes"))
    after = anew(world)
    after.act()
    after.event(Resume(goal))
    while (ticket := asked_about_picture(after.book)) is None:
        after.see(0.2)
    assert after.goal(goal).steps[0].answer == "yes"
    after.event(Told(goal, ticket, ImageAnswer(at=(2.0, 0.0, 0.4))))
    assert (after.goal(goal).state, after.goal(goal).steps[0].answer) == (ASKS, None)
    assert standing_still(after)


def test_a_pause_before_the_question_was_said_keeps_it(world: Seeing) -> None:
    goal = pointing(world, written=False)
    world.event(Pause(goal))
    world.disk = True
    world.sync()
    assert world.goal(goal).state is PAUSED
    assert standing_still(world)
    world.event(Resume(goal))
    world.see(1.0)
    assert world.goal(goal).state is ASKS
    assert standing_still(world)


def test_other_goals_drive_meanwhile_and_the_point_stays(world: Seeing) -> None:
    goal = pointing(world)
    other = world.give(go("kitchen"))
    world.run_until(other, SUCCEEDED)
    assert world.goal(goal).state is ASKS
    world.event(Reply(goal, "好的"))
    world.see_until(goal, SUCCEEDED)
    step = world.goal(goal).steps[0]
    assert step.reached is not None
    assert step.reached.x_m == pytest.approx(3.2, abs=0.9), "about the same point of the map"


def test_the_question_can_be_cancelled(world: Seeing) -> None:
    goal = pointing(world)
    world.event(Cancel(goal))
    assert world.goal(goal).state is CANCELLED
    assert standing_still(world)
