"""What a sentence with a stop in it does by the real door, and what stands behind the stop."""

from __future__ import annotations

import pytest

from planner.brain.scripted import Reply
from planner.mission.conversation import situation_of
from planner.mission.events import Planned, Stopped
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Goal,
    GoalState,
    GoTo,
    PlanRole,
    Refuse,
    StepPlan,
)
from tests.planner.mission.fakes import outcome_of
from tests.planner.mission.live import KITCHEN, SOFA, Starter, Together
from tests.planner.mission.lockstep import Together as Lockstep
from tests.planner.mission.lockstep import go, talk
from tests.planner.mission.saying import CANCELLED, CONFIRMS, PAUSED, RUNNING, SUCCEEDED
from wire import HeldReason, OpRequest, Stop

SMALL_TALK = AnswerPlan(text=Bilingual(en="I see.", zh="好的。"))
UNREAD = Clarify(code=Code.NOT_UNDERSTOOD, question=Bilingual(en="What?", zh="什么？"))
OVER = (SUCCEEDED, GoalState.NEEDS_CLARIFICATION, GoalState.CANCELLED)
"""A question is given up for the next one of the same source."""
ACT = OpRequest(id="a", source="test")


def resumed(world: Together) -> list[str]:
    """Return the ids of the acts that reached the bridge."""
    return [answer.id for answer in world.bridge.answers if answer.kind == "resume"]


@pytest.mark.parametrize("hangs", [False, True])
@pytest.mark.parametrize(
    "text", ["uh robot, there is a child, please stop", "別過來啦", "no no no"]
)
async def test_it_stops_what_runs_whether_the_brain_answers_or_hangs(
    start: Starter, text: str, hangs: bool
) -> None:
    async with start(KITCHEN, UNREAD) as world:
        goal = await world.give("go to the kitchen", RUNNING)
        world.brain.hangs = hangs
        said = await world.missions.submit(text)
        assert world.missions.goal(goal.id).state is PAUSED
        assert world.bridge.held is not None
        if not hangs:
            done = await world.reach(said.id, SUCCEEDED)
            assert outcome_of(done).code is Code.STOPPED


@pytest.mark.parametrize("reply", [SMALL_TALK, UNREAD])
async def test_words_without_a_plan_bring_no_act_to_the_bridge(
    start: Starter, reply: AnswerPlan | Clarify
) -> None:
    async with start(reply, reply) as world:
        world.bridge.hold(HeldReason.STOP)
        both = [await world.missions.submit(text, act=ACT) for text in ("hello", "what now")]
        for goal in both:
            await world.reach(goal.id, *OVER)
        assert resumed(world) == []
        assert world.bridge.held is not None


async def test_a_plan_brings_the_act_that_came_with_its_words(start: Starter) -> None:
    async with start(KITCHEN) as world:
        world.bridge.hold(HeldReason.STOP)
        await world.until(lambda: (s := world.missions.link.status) is not None
                          and s.value.held is not None)  # fmt: skip
        await world.missions.submit("go to the kitchen", act=ACT)
        await world.until(lambda: resumed(world) == [ACT.id])


TIME = Bilingual(en="It is ten.", zh="十点了。")
NO_ARM = Refuse(code=Code.NO_CAPABILITY, reason=Bilingual(en="I have no arm.", zh="我没有手。"))


async def stop_a_drive(world: Together, text: str, *states: GoalState) -> tuple[Goal, Goal]:
    """Say something in mid-drive; return the goal of before and the sentence's own."""
    goal = await world.drive()
    said = await world.missions.submit(text)
    assert world.bridge.horizon is None, "the stop comes first"
    assert any(isinstance(each, Stop) for each in world.bridge.heard), "and the bridge has heard it"
    said = await world.reach(said.id, *states)
    return world.missions.goal(goal.id), said


@pytest.mark.parametrize(
    "text",
    ["stop, then go to the sofa", "stop following me and go to the sofa", "stop! go to the sofa",
     "停下，然后去沙发", "别跟着我了，去沙发"],
)  # fmt: skip
async def test_an_order_behind_a_stop_drives_after_a_yes(start: Starter, text: str) -> None:
    async with start(KITCHEN, SOFA) as world:
        before, said = await stop_a_drive(world, text, CONFIRMS)
        assert before.state is PAUSED
        assert text in outcome_of(said).message.en
        assert world.bridge.horizon is None, "nothing drives before the yes"
        await world.missions.confirm(said.id)
        assert (await world.reach(said.id, RUNNING)).plan is not None


@pytest.mark.parametrize(
    ("text", "reply", "told"),
    [
        ("stop, and then bring me a coffee", NO_ARM, "I have no arm."),
        ("stop. what time is it?", AnswerPlan(text=TIME), "It is ten."),
        ("stop, there is a child", UNREAD, "I have not done “there is a child”"),
        ("停下，然后去火星", UNREAD, "“去火星”"),
        ("wait, the grommet wants polishing", UNREAD, "“the grommet wants polishing”"),
        ("stop, where are you?", UNREAD, "I am "),
    ],
)
async def test_what_is_not_done_behind_a_stop_is_told(
    start: Starter, text: str, reply: Reply, told: str
) -> None:
    async with start(KITCHEN, reply, by_grammar=False) as world:
        before, said = await stop_a_drive(world, text, SUCCEEDED)
        assert before.state is PAUSED
        assert outcome_of(said).code is Code.STOPPED
        assert told in outcome_of(said).message.en
        assert outcome_of(said).message.en.startswith("Stop")


@pytest.mark.parametrize(
    "text",
    ["stop", "please stop, thank you", "stop here and wait", "don't come closer", "停下！别动！",
     "stop looking for the cup and the ball", "stop, stop, stop"],
)  # fmt: skip
async def test_a_mere_stop_is_told_as_before_and_no_brain_is_asked_of_a_plain_one(
    start: Starter, text: str
) -> None:
    async with start(KITCHEN, UNREAD) as world:
        _, said = await stop_a_drive(world, text, SUCCEEDED)
        assert outcome_of(said).message.en in (
            "Stopped.", "Stopping: the bridge has confirmed it.",
        )  # fmt: skip


@pytest.mark.parametrize("text", ["stop following me, go on with the others", "停下，继续做别的"])
@pytest.mark.parametrize("reply", [UNREAD, StepPlan(does=PlanRole.CANCEL, steps=())])
async def test_go_on_behind_a_stop_never_goes_on_with_what_was_stopped(
    start: Starter, text: str, reply: Reply
) -> None:
    async with start(KITCHEN, SOFA, reply, by_grammar=False) as world:
        goal = await world.give("go to the kitchen", RUNNING)
        other = await world.give("go to the sofa", GoalState.QUEUED)
        said = await world.give(text, SUCCEEDED)
        assert world.missions.goal(goal.id).state is CANCELLED
        assert "Say “go on”, and I do “go to the sofa”." in outcome_of(said).message.en
        await world.give("go on", SUCCEEDED)
        await world.reach(other.id, RUNNING)


async def test_a_stop_typed_into_an_answer_keeps_what_follows_it(start: Starter) -> None:
    asks = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))
    async with start(asks, SOFA, by_grammar=False) as world:
        goal = await world.give("go to the room", GoalState.NEEDS_CLARIFICATION)
        await world.missions.answer(goal.id, "stop, then go to the sofa")
        assert any(isinstance(each, Stop) for each in world.bridge.heard)
        newest = world.missions.goals()[0]
        assert (await world.reach(newest.id, CONFIRMS)).text == "stop, then go to the sofa"


CANCEL = StepPlan(does=PlanRole.CANCEL, steps=())
SOFA_INSTEAD = StepPlan(does=PlanRole.INSTEAD, steps=(GoTo(place="sofa"),))


def test_goals_run_in_the_order_of_asking_though_thoughts_end_the_other_way(
    world: Lockstep,
) -> None:
    asked = [world.give(None) for _ in range(3)]
    for goal in reversed(asked):
        world.event(Planned(goal, talk(goal)))
        world.run(0.1)
    for goal in asked:
        world.run_until(goal, SUCCEEDED)
    assert world.said == asked


def test_a_goal_waits_for_an_older_thought_that_comes_to_nothing(world: Lockstep) -> None:
    older, newer = world.give(None), world.give(go("hall"))
    world.run(1.0)
    assert (world.goal(newer).state, world.book.running) == (GoalState.QUEUED, None)
    world.event(Planned(older, SMALL_TALK))
    assert world.book.running == newer


def test_a_newer_thought_keeps_nobody_waiting(world: Lockstep) -> None:
    older = world.give(go("hall"))
    world.give(None)
    assert world.goal(older).state is RUNNING


def test_a_brain_is_told_what_others_asked_and_what_is_paused(world: Lockstep) -> None:
    stopped, waiting = world.give(go("hall")), world.give(go("dock"))
    world.event(Stopped("test"))
    thinking, own = world.give(None), world.give(None)
    told = situation_of(world.book, world.goal(own), world.now_s)
    assert told.thinking == (world.goal(thinking).text,)
    assert told.paused == (world.goal(stopped).text,)
    assert told.queue == (world.goal(waiting).text,)


@pytest.mark.parametrize("reply", [SMALL_TALK, CANCEL])
@pytest.mark.parametrize(
    "text",
    [
        "don't go there",
        "not the kitchen",
        "don't go to the kitchen",
        "别去厨房，宝宝在睡觉",
        "别去那儿",
        "等等，别去厨房",
    ],
)
async def test_a_drive_that_is_denied_ends_and_does_not_go_on(
    start: Starter, text: str, reply: Reply
) -> None:
    async with start(KITCHEN, reply, by_grammar=False) as world:
        goal = await world.drive()
        await world.give(text, SUCCEEDED)
        assert world.missions.goal(goal.id).state is CANCELLED
        assert world.bridge.horizon is None
        again = await world.missions.submit("go on")
        told = await world.reach(again.id, SUCCEEDED)
        assert "nothing" in outcome_of(told).message.en.lower()


async def test_a_model_ends_the_goal_that_the_very_sentence_has_stopped(start: Starter) -> None:
    async with start(KITCHEN, CANCEL, by_grammar=False) as world:
        goal = await world.drive()
        await world.give("don't go in there", SUCCEEDED)
        assert world.missions.goal(goal.id).state is CANCELLED


@pytest.mark.parametrize("agrees", [True, False])
async def test_after_a_no_to_a_models_plan_the_order_itself_is_offered(
    start: Starter, agrees: bool
) -> None:
    async with start(SOFA, by_grammar=False) as world:
        goal = await world.give("go to the kitchen", CONFIRMS)
        await world.missions.answer(goal.id, "no")
        offered = world.missions.goal(goal.id)
        assert offered.state is CONFIRMS
        assert "kitchen" in outcome_of(offered).message.en
        await world.missions.answer(goal.id, "yes" if agrees else "no")
        ended = await world.reach(goal.id, SUCCEEDED, CANCELLED)
        assert ended.state is (SUCCEEDED if agrees else CANCELLED)
        kinds = [step.place for step in ended.plan.steps] if ended.plan else []
        assert kinds == ["kitchen"]


@pytest.mark.parametrize("text", ["good morning", "hello robot"])
async def test_where_nothing_was_ordered_a_no_is_the_end(start: Starter, text: str) -> None:
    async with start(SOFA, by_grammar=False) as world:
        goal = await world.give(text, CONFIRMS)
        await world.missions.answer(goal.id, "no")
        assert world.missions.goal(goal.id).state is CANCELLED


async def test_a_cry_that_denies_no_way_keeps_the_drives_place(start: Starter) -> None:
    async with start(KITCHEN, CANCEL, by_grammar=False) as world:
        goal = await world.drive()
        await world.give("uh robot, there is a child, please stop", SUCCEEDED)
        assert world.missions.goal(goal.id).state is PAUSED


@pytest.mark.parametrize(
    "text", ["wait, not the kitchen, I meant the sofa", "等等，不是厨房，我说的是沙发"]
)
@pytest.mark.parametrize("plan", [SOFA, SOFA_INSTEAD])
async def test_a_correction_under_way_is_driven_without_a_yes(
    start: Starter, text: str, plan: StepPlan
) -> None:
    async with start(KITCHEN, plan, by_grammar=False) as world:
        goal = await world.drive()
        await world.give(text, SUCCEEDED, act=OpRequest(id="a", source="test"))
        assert world.missions.goal(goal.id).state is CANCELLED
        assert [a.id for a in world.bridge.answers if a.kind == "resume"] == ["a"]


@pytest.mark.parametrize("text", ["wait, not the kitchen", "no no no", "stop it, not there"])
async def test_a_correction_that_the_person_did_not_say_waits_for_a_yes(
    start: Starter, text: str
) -> None:
    async with start(KITCHEN, SOFA_INSTEAD, by_grammar=False) as world:
        await world.drive()
        said = await world.give(text, CONFIRMS, SUCCEEDED)
        assert world.missions.goal(said.id).state is not RUNNING
