"""An answer to a brain's question arrives with the order and the question, in every thought."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain.interface import Exchange, Observation, ThinkRequest
from planner.brain.offline_brain import TAG, OfflineBrain
from planner.mission.events import Confirm, Reply, Resume, Stopped, Submitted
from planner.mission.journal_records import read_mission
from planner.mission.state import MAX_ANSWERS
from planner.plan import (
    Ask,
    Bilingual,
    BrainTag,
    ChangedOrder,
    Clarify,
    Code,
    GoalState,
    GoTo,
    Language,
    Option,
    PlanRole,
    Refuse,
    StepPlan,
    say_same,
)
from tests.planner.brain.conftest import HOME
from tests.planner.mission.live import KITCHEN, Starter
from tests.planner.mission.lockstep import SUCCEEDED, given, go, rethinking

ASKS = GoalState.NEEDS_CLARIFICATION


def which(text: str, *options: str) -> Clarify:
    offers = tuple(Option(label=say_same(each), text=each) for each in options)
    return Clarify(code=Code.AMBIGUOUS, question=Bilingual(en=text, zh=text), options=offers)


def test_every_round_is_kept_and_told_in_later_thoughts_too() -> None:
    asks, drive = (which("Which room?"), which("Which side?")), go("kitchen")
    world, goal = given(*asks, drive, drive, shut=True)
    world.event(Reply(goal, "the one with the bed"))
    world.event(Reply(goal, "the left"))
    rounds = (
        Exchange(asked="Which room?", answer="the one with the bed"),
        Exchange(asked="Which side?", answer="the left"),
    )
    assert [a.exchanges for a in world.asked] == [(), rounds[:1], rounds, rounds]
    assert [a.text for a in world.asked][1:] == ["the one with the bed", "the left", "the left"]
    assert {a.order for a in world.asked} == {"text g1"}


def test_a_taken_offer_is_its_order_with_the_question_beside_it() -> None:
    world, goal = given(which("To the hall, then?", "go to the hall"), go("hall"))
    world.event(Reply(goal, "yes please"))
    assert world.asked[1].text == "go to the hall"
    assert world.asked[1].exchanges == (
        Exchange(asked="To the hall, then? Yes means: “go to the hall”.", answer="go to the hall"),
    )
    world.run_until(goal, SUCCEEDED)


def test_what_an_older_program_wrote_keeps_its_place() -> None:
    world, goal = given(which("One?"), which("Two?"), None)
    world.event(Reply(goal, "first"))
    mission = world.goal(goal).model_copy(update={"questions": ()})
    world.engine.book.missions[goal] = mission
    world.event(Reply(goal, "second"))
    assert world.asked[2].exchanges == (
        Exchange(asked="", answer="first"), Exchange(asked="Two?", answer="second")
    )  # fmt: skip


async def test_a_brain_behind_the_door_hears_it(start: Starter) -> None:
    async with start(which("Which room?"), KITCHEN) as world:
        goal = await world.give("go to my room", ASKS)
        assert (world.brain.asked[0].order, world.brain.asked[0].exchanges) == ("", ())
        await world.missions.answer(goal.id, "the one with the bed")
        await world.reach(goal.id, SUCCEEDED)
        heard = world.brain.asked[1]
        assert (heard.order, heard.text) == ("go to my room", "the one with the bed")
        assert heard.exchanges[0].asked == "Which room?"


def test_an_answer_that_names_one_of_the_grammars_offers_is_that_order() -> None:
    offers = ("go to the kitchen", "go to the hall")
    for brain, heard in (
        (TAG, "go to the hall"),
        (BrainTag(name="model", version="1"), "the hall, please"),
    ):
        world, goal = given(which("Which one?", *offers), go("hall"))
        mission = world.goal(goal).model_copy(update={"brain": brain})
        world.engine.book.missions[goal] = mission
        world.event(Reply(goal, "the hall, please"))
        assert world.asked[1].text == heard, "a model reads the answer itself"
        world.run_until(goal, SUCCEEDED)


async def test_an_order_in_place_of_the_answer_stands_alone(start: Starter) -> None:
    async with start(which("Which room?"), KITCHEN) as world:
        goal = await world.give("go to my room", ASKS)
        await world.missions.answer(goal.id, "forget that, go to the kitchen")
        await world.until(lambda: len(world.brain.asked) == 2)
        heard = world.brain.asked[1]
        assert (heard.text, heard.order, heard.exchanges) == (
            "forget that, go to the kitchen",
            "",
            (),
        )
        assert heard.changed == ChangedOrder(words="go to the kitchen")


def test_the_offline_brain_goes_on_with_nothing_after_an_answer_it_can_not_read() -> None:
    text = "go to the kitchen, ask who is there and come back"
    bare = ThinkRequest(text=text, vocabulary=HOME)
    plan = asyncio.run(OfflineBrain().think(bare)).plan
    assert isinstance(plan, StepPlan)
    kinds = [step.kind for step in plan.steps]
    assert kinds == ["go_to", "ask", "come_back"]
    assert isinstance(plan.steps[0], GoTo)
    assert isinstance(plan.steps[1], Ask)
    walked = (
        Observation(step="go_to", result="succeeded", detail=say_same("kitchen")),
        Observation(step="ask", result="answered", detail=say_same("Answer: “maybe”")),
    )
    again = asyncio.run(OfflineBrain().think(bare.model_copy(update={"observed": walked}))).plan
    assert isinstance(again, Refuse)


LAID = Option(
    label=say_same("to the hall"), text="the hall, if that is what you mean", plan=go("hall")
)
LAYS = Clarify(code=Code.NOT_UNDERSTOOD, question=say_same("To the hall?"), options=(LAID,))


@pytest.mark.parametrize("answer", ["yes please", "好的", LAID.text])
def test_a_plan_laid_before_a_person_is_done_as_it_stands_by_a_yes_or_its_own_words(
    answer: str,
) -> None:
    world, goal = given(LAYS)
    world.event(Reply(goal, answer))
    world.run_until(goal, SUCCEEDED)
    assert len(world.asked) == 1  # nobody reads the words of the button


def test_a_plan_laid_before_a_person_is_dropped_by_a_no() -> None:
    world, goal = given(LAYS)
    world.event(Reply(goal, "no"))
    assert world.book.missions[goal].state is GoalState.CANCELLED


def test_a_plan_laid_before_a_person_is_thought_about_after_any_other_answer() -> None:
    world, goal = given(LAYS, go("kitchen"))
    world.event(Reply(goal, "the one with the stove"))
    assert [a.text for a in world.asked][1:] == ["the one with the stove"]


@pytest.mark.parametrize("role", [PlanRole.NEW, PlanRole.INSTEAD])
def test_what_is_laid_in_place_of_what_runs_ends_that_by_a_yes_alone(role: PlanRole) -> None:
    plan = StepPlan(steps=(GoTo(place="hall"),), does=role)
    laid = LAYS.model_copy(update={"options": (LAID.model_copy(update={"plan": plan}),)})
    world = rethinking(go("kitchen"), laid)
    running, goal = world.give(None), world.give(None)
    assert world.goal(running).state is GoalState.RUNNING
    world.event(Reply(goal, "yes"))
    replaced = world.goal(running).state is GoalState.CANCELLED
    assert replaced is (role is PlanRole.INSTEAD)
    world.run_until(goal, SUCCEEDED)


def test_a_thought_is_told_the_order_before_it_and_never_itself() -> None:
    world = rethinking(go("kitchen"), which("Which?"), go("hall"))
    first, second = world.give(None), world.give(None)
    world.event(Reply(second, "the hall"))
    assert world.asked[0].newest is None
    for asked in world.asked[1:]:
        assert asked.newest is not None
        assert asked.newest.steps == go("kitchen").steps
    world.run_until(first, SUCCEEDED)


def test_what_was_answered_stays_beside_its_question_and_survives_the_journal() -> None:
    ask = StepPlan(steps=(Ask(question="Shall I go on?"),))
    world, goal = given(which("Which room?"), ask)
    world.event(Reply(goal, "the one with the bed", "page"))
    world.run(0.2)
    world.event(Reply(goal, "yes", "voice"))
    world.run_until(goal, SUCCEEDED)
    kept = read_mission(world.goal(goal).model_dump_json())
    told = [(a.asked.en if a.asked else "", a.said, a.by) for a in kept.answers]
    assert told == [
        ("Which room?", "the one with the bed", "page"),
        ("Shall I go on?", "yes", "voice"),
    ]
    assert kept.answers[0].unix_s < kept.answers[1].unix_s


def test_a_yes_by_a_button_has_no_words_and_answers_are_bounded() -> None:
    world = rethinking(go("kitchen"))
    goal = world.give(None, confirm=True)
    for _ in range(2 * MAX_ANSWERS):
        world.event(Reply(goal, "perhaps", "cli"))
    assert len(world.goal(goal).answers) == MAX_ANSWERS
    world.event(Confirm(goal, "page"))
    assert [(a.said, a.by) for a in world.goal(goal).answers][-2:] == [
        ("perhaps", "cli"),
        (None, "page"),
    ]


async def test_a_stopped_goal_tells_who_stopped_it_until_it_goes_on(start: Starter) -> None:
    async with start(KITCHEN) as world:
        goal = await world.give("go to the kitchen", GoalState.RUNNING, by="cli")
        await world.missions.stop("page")
        stopped = world.missions.goal(goal.id)
        assert (stopped.by, stopped.stopped_by, stopped.reason) == ("cli", "page", "stop")
        await world.missions.resume(goal.id)
        assert world.missions.goal(goal.id).stopped_by is None


def test_a_sentence_that_stops_tells_its_door_too() -> None:
    world, goal = given(go("kitchen"))
    world.event(Submitted("s", "stop", Language.EN, stop=True, by="voice"))
    assert world.goal(goal).stopped_by == "voice"
    world.event(Resume(goal))
    world.event(Stopped("cli"))
    assert world.goal(goal).stopped_by == "cli"
