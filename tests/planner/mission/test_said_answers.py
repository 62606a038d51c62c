"""A yes or a no in words: what it answers, and what is asked, kept or made room for without one."""

from __future__ import annotations

import pytest

from planner.brain.scripted import Reply
from planner.language.yes_no import consents
from planner.mission.errors import QueueFull
from planner.mission.state import MAX_OPEN
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, GoalState, GoTo, StepPlan, WaitFor
from tests.planner.mission.live import KITCHEN, Starter
from tests.planner.mission.saying import (
    ASKS,
    CANCELLED,
    CONFIRMS,
    DRIVES,
    OFFERS,
    PAUSED,
    REFUSED,
    RUNNING,
    SUCCEEDED,
    TWICE,
    WHICH,
    answer_of,
    asking,
    asking_on_the_way,
    heard,
    later,
    told,
)
from wire import OpRequest


@pytest.mark.parametrize("text", ["yes", "Yes, please.", "好的", "no", "不要"])
async def test_it_answers_the_one_question_and_is_told_so(start: Starter, text: str) -> None:
    async with start(DRIVES) as world:
        goal = await asking(world)
        said = await world.missions.submit(text)
        assert told(said) == (
            SUCCEEDED, Code.ANSWERED, "Taken as the answer for “please see to it”."
        )  # fmt: skip
        assert answer_of(world, goal) == text
        assert heard(world) == ["please see to it"], "no brain is asked"
        await world.reach(goal.id, SUCCEEDED if consents(text) else CANCELLED)
    async with start(prefix="h") as after:
        assert after.missions.goal(said.id) == said
        assert answer_of(after, goal) == text


@pytest.mark.parametrize("said", ["maybe", "yes?", "yes, but slowly", "the red one", "yes, hm"])
async def test_any_other_sentence_is_a_new_goal(start: Starter, said: str) -> None:
    async with start(DRIVES, WHICH) as world:
        goal = await asking(world)
        await world.give(said, ASKS)
        assert heard(world)[-1] == said
        assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)


@pytest.mark.parametrize("text", ["yes", "no"])
@pytest.mark.parametrize("other", [DRIVES, WHICH, KITCHEN])
async def test_where_two_may_be_meant_it_answers_neither_names_both_and_clears_no_hold(
    start: Starter, text: str, other: StepPlan | Clarify
) -> None:
    async with start(DRIVES, other) as world:
        first = await asking(world)
        second = await world.missions.submit("mind it", confirm=other is not DRIVES)
        before = await world.reach(second.id, ASKS, CONFIRMS)
        await world.missions.stop("test")
        act = OpRequest(id="a", source="test")
        said = await world.missions.submit(text, act=act)
        state, code, words = told(said)
        assert (state, said.reason, code) == (REFUSED, "ambiguous", Code.AMBIGUOUS)
        assert "“please see to it”, “mind it”" in words
        assert (world.missions.goal(first.id).state, answer_of(world, first)) == (ASKS, None)
        assert world.missions.goal(second.id) == before
        await later(world)
        assert world.bridge.held is not None
        assert heard(world) == ["please see to it", "mind it"]


@pytest.mark.parametrize("text", ["yes", "no"])
async def test_a_plan_that_waited_before_the_step_asked_may_be_meant_too(
    start: Starter, text: str
) -> None:
    async with start(KITCHEN, DRIVES) as world:
        plan = await world.give("go to the kitchen", CONFIRMS, confirm=True)
        await later(world)
        goal = await asking(world)
        assert told(await world.missions.submit(text))[:2] == (REFUSED, Code.AMBIGUOUS)
        assert answer_of(world, goal) is None
        assert world.missions.goal(plan.id).state is CONFIRMS
        assert world.bridge.waypoints == []


async def test_what_a_brain_asked_before_is_not_meant(start: Starter) -> None:
    async with start(WHICH, DRIVES) as world:
        unclear = await world.give("hm", ASKS, source="somebody else")
        await later(world)
        goal = await asking(world)
        await world.missions.submit("yes")
        await world.reach(goal.id, SUCCEEDED)
        assert world.missions.goal(unclear.id).state is ASKS


@pytest.mark.parametrize(("confirm", "replace"), [(True, False), (False, True)])
async def test_what_is_heard_unsurely_or_replaces_a_goal_answers_nothing(
    start: Starter, confirm: bool, replace: bool
) -> None:
    async with start(DRIVES, WHICH) as world:
        goal = await asking(world)
        await world.give("yes", ASKS, confirm=confirm, replace=replace)
        assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)


@pytest.mark.parametrize(
    ("text", "becomes"), [("no, stop", PAUSED), ("别动", PAUSED), ("don't go there", CANCELLED)]
)
async def test_an_order_about_what_runs_is_obeyed_and_is_no_answer(
    start: Starter, text: str, becomes: GoalState
) -> None:
    async with start(DRIVES, KITCHEN) as world:
        goal, driving = await asking_on_the_way(world)
        await world.missions.submit(text)
        await world.reach(driving.id, becomes)
        assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)


async def test_after_a_stop_it_is_the_persons_act_as_any_answer_is(start: Starter) -> None:
    async with start(DRIVES) as world:
        goal = await asking(world)
        await world.missions.stop("test")
        await world.missions.submit("yes", act=OpRequest(id="a", source="test"))
        await world.reach(goal.id, SUCCEEDED)


async def test_a_no_ends_nothing_that_runs(start: Starter) -> None:
    async with start(DRIVES, KITCHEN) as world:
        goal, driving = await asking_on_the_way(world)
        await world.missions.submit("no")
        assert answer_of(world, goal) == "no"
        assert world.missions.goal(driving.id).state is RUNNING
        await world.reach(driving.id, SUCCEEDED)


async def test_what_is_said_about_one_goal_answers_no_other(start: Starter) -> None:
    async with start(WHICH, DRIVES, WHICH) as world:
        unclear = await world.give("hm", ASKS, source="somebody else")
        goal = await asking(world)
        await world.missions.answer(unclear.id, "yes")
        await world.reach(unclear.id, ASKS)
        assert heard(world)[-1] == "yes"
        await world.missions.answer(unclear.id, "forget that, go there")
        await world.until(lambda: heard(world)[-1] == "forget that, go there")
        assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)


async def test_the_same_request_again_answers_no_second_question(start: Starter) -> None:
    async with start(TWICE) as world:
        goal = await asking(world)
        said = await world.missions.submit("yes", idempotency_key="k")
        await world.reach(goal.id, ASKS)
        assert (await world.missions.submit("yes", idempotency_key="k")).id == said.id
        plan = world.missions.goal(goal.id).plan
        assert plan is not None
        assert [step.answer for step in plan.steps] == ["yes", None]


async def test_a_full_queue_keeps_no_answer_out(start: Starter) -> None:
    async with start(DRIVES, *[KITCHEN] * MAX_OPEN) as world:
        goal = await asking(world)
        world.bridge.frozen = True
        for _ in range(MAX_OPEN - 1):
            await world.missions.submit("go to the kitchen")
        await world.missions.submit("yes")
        assert answer_of(world, goal) == "yes"
        with pytest.raises(QueueFull):
            await world.missions.submit("go to the kitchen")


MANY = MAX_OPEN + 3
BOTH_ROOMS = StepPlan(steps=(GoTo(place="kitchen"), GoTo(place="living_room")))


@pytest.mark.parametrize(("text", "state"), [("好的", ASKS), ("yes", ASKS), ("不", CANCELLED)])
async def test_of_several_orders_a_yes_asks_which_and_a_no_ends_it(
    start: Starter, text: str, state: GoalState
) -> None:
    several = OFFERS.model_copy(update={"options": OFFERS.options * 2})
    async with start(several) as world:
        goal = await world.give("please see to it", ASKS)
        said = await world.missions.submit(text)
        assert told(said)[2] == "Taken as the answer for “please see to it”."
        after = await world.reach(goal.id, state)
        assert state is CANCELLED or told(after)[2].startswith("Please say which one: ")
        assert heard(world) == ["please see to it"], "no brain is asked"


@pytest.mark.parametrize("text", ["yes", "no"])
async def test_a_model_that_asks_alone_reads_the_word_with_its_question(
    start: Starter, text: str
) -> None:
    async with start(WHICH, WHICH, WHICH) as world:
        goal = await asking(world, "go there")
        await world.missions.submit(text)
        await world.until(lambda: len(world.brain.asked) == 2)
        read = world.brain.asked[1]
        assert (read.order, read.exchanges[0].asked, read.text) == ("go there", "Which?", text)
        await world.reach(goal.id, ASKS)
        await world.give("hm", ASKS, source="somebody else")
        await world.missions.submit(text)
        await world.until(lambda: len(world.brain.asked) == 4)
        assert world.brain.asked[3].exchanges == (), "of two, neither is meant"


@pytest.mark.parametrize("by", ["sentence", "answer"])
@pytest.mark.parametrize(
    ("text", "reached"),
    [("yes", SUCCEEDED), ("嗯，好的", SUCCEEDED), ("no", CANCELLED), ("不用", CANCELLED)],
)
async def test_a_plan_that_waits_for_its_yes_takes_it_in_words(
    start: Starter, text: str, reached: GoalState, by: str
) -> None:
    async with start(KITCHEN) as world:
        plan = await world.give("go to the kitchen", CONFIRMS, confirm=True)
        if by == "answer":
            await world.missions.answer(plan.id, text)
        else:
            await world.missions.submit(text)
        done = await world.reach(plan.id, SUCCEEDED, CANCELLED)
        assert done.state is reached
        drove = any(w.points for w in world.bridge.waypoints)
        assert drove is (reached is SUCCEEDED)
        if not drove:
            assert told(done)[1:] == (
                Code.DECLINED, "You said no, so I do not drive to “kitchen”."
            )  # fmt: skip


@pytest.mark.parametrize("text", ["no", "不用，谢谢"])
async def test_a_no_to_several_deeds_names_none_of_them_alone(start: Starter, text: str) -> None:
    """The question may have named the last of them; an answer about the first would confuse."""
    async with start(BOTH_ROOMS) as world:
        plan = await world.give("go to the kitchen and the living room", CONFIRMS, confirm=True)
        await world.missions.answer(plan.id, text)
        done = await world.reach(plan.id, CANCELLED)
        assert told(done)[1:] == (Code.DECLINED, "You said no, so I do not do that.")
        assert world.bridge.waypoints == []


async def test_an_answer_that_is_neither_leaves_the_plan_waiting_and_asks_plainly(
    start: Starter,
) -> None:
    async with start(KITCHEN) as world:
        plan = await world.give("go to the kitchen", CONFIRMS, confirm=True)
        for text in ("maybe", "tea", "yes?"):
            goal = await world.missions.answer(plan.id, text)
            asked = "Please answer yes or no. Shall I do “go to the kitchen”?"
            assert (goal.state, told(goal)[2]) == (CONFIRMS, asked)
        await later(world)
        assert world.bridge.waypoints == []
        await world.missions.answer(plan.id, "yes please")
        await world.reach(plan.id, SUCCEEDED)


@pytest.mark.parametrize("by", ["sentence", "answer"])
@pytest.mark.parametrize(
    "text", ["yes", "好呀可以", "yes please do that", "no thanks", "不用，谢谢"]
)
async def test_a_single_offer_is_the_order_upon_a_yes_and_nothing_upon_a_no(
    start: Starter, text: str, by: str
) -> None:
    async with start(OFFERS, KITCHEN) as world:
        goal = await asking(world, "see to a cup")
        if by == "answer":
            await world.missions.answer(goal.id, text)
        else:
            await world.missions.submit(text)
        if consents(text):
            await world.reach(goal.id, SUCCEEDED)
            assert heard(world) == ["see to a cup", "go to the kitchen"]
            return
        done = await world.reach(goal.id, CANCELLED)
        assert told(done)[1:] == (Code.DECLINED, "You said no, so I do not do that.")
        assert world.bridge.waypoints == []
        assert heard(world) == ["see to a cup"]


@pytest.mark.parametrize("by", ["sentence", "answer"])
@pytest.mark.parametrize("what", [DRIVES, KITCHEN, OFFERS])
@pytest.mark.parametrize("text", ["no", "不", "maybe"])
async def test_an_answer_that_is_no_yes_clears_no_hold(
    start: Starter, text: str, what: StepPlan | Clarify, by: str
) -> None:
    async with start(what, WHICH) as world:
        goal = await world.give("please see to it", ASKS, CONFIRMS, confirm=what is KITCHEN)
        await world.missions.stop("test")
        act = OpRequest(id="a", source="test")
        if by == "answer" and not (text == "maybe" and what is OFFERS):
            await world.missions.answer(goal.id, text, act=act)
        elif text != "maybe":
            await world.missions.submit(text, act=act)
        await later(world)
        assert world.bridge.held is not None
        assert world.bridge.waypoints == []


async def test_go_on_is_a_yes_where_nothing_is_paused(start: Starter) -> None:
    async with start(DRIVES) as world:
        goal = await asking(world)
        await world.missions.submit("continue")
        await world.reach(goal.id, SUCCEEDED)


@pytest.mark.parametrize(
    ("question", "source"), [(WHICH, "api"), (OFFERS, None), (KITCHEN, None), (DRIVES, "api")]
)
async def test_more_unclear_orders_than_there_is_room_for_keep_no_order_out(
    start: Starter, question: Reply, source: str | None
) -> None:
    """Of one person, of many, of any kind of question: an order is always taken."""
    async with start(*[question] * MANY, KITCHEN) as world:
        newest = ""
        for number in range(MANY):
            by, confirm = source or f"by {number}", question is KITCHEN
            goal = await world.missions.submit(f"hm {number}", source=by, confirm=confirm)
            newest = (await world.reach(goal.id, ASKS, CONFIRMS)).id
        open_ = [g for g in world.missions.goals() if g.state in (ASKS, CONFIRMS)]
        assert 1 <= len(open_) <= MAX_OPEN
        assert open_[0].id == newest, "the newest is kept, and shown first"
        kept = source is not None and question in (WHICH, OFFERS)
        assert len(open_) == (1 if kept else MAX_OPEN)
        await world.give("go to the kitchen", SUCCEEDED, source="last")
        ended = [g for g in world.missions.goals(200) if g.reason == "superseded"]
        assert {g.state for g in ended} == {CANCELLED}
        assert all("before the next order came" in told(g)[2] for g in ended)


async def test_open_goals_stand_first_in_every_list_however_old(start: Starter) -> None:
    said = AnswerPlan(text=Bilingual(en="Well.", zh="好吧。"))
    async with start(KITCHEN, DRIVES, said) as world:
        plan = await world.give("go to the kitchen", CONFIRMS, confirm=True)
        asks = await asking(world)
        for number in range(60):
            await world.give(f"hello {number}", SUCCEEDED)
        assert [g.id for g in world.missions.goals(2)] == [asks.id, plan.id]
        listed = [goal["id"] for goal in world.missions.snapshot()["goals"]]
        assert listed[:3] == [asks.id, plan.id, "g62"], "each newest first"


@pytest.mark.parametrize(("said", "goes_on"), [("好了！", True), ("不好了", False)])
async def test_the_word_that_is_waited_for_is_taken_as_it_is_said(
    start: Starter, said: str, goes_on: bool
) -> None:
    waits = StepPlan(steps=(WaitFor(word="好了"), GoTo(place="kitchen")))
    async with start(waits, WHICH) as world:
        goal = await asking(world)
        await world.missions.submit(said)
        await later(world)
        assert (world.missions.goal(goal.id).state is ASKS) is not goes_on
