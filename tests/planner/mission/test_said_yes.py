"""A plan that waits, a single offer and a hundred questions: yes and no in words, and room."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.brain.scripted import Reply
from planner.language.yes_no import consents
from planner.mission.state import MAX_OPEN
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    GoalState,
    GoTo,
    StepPlan,
)
from planner.site import Site
from tests.planner.mission.live import KITCHEN, planner, run
from tests.planner.mission.saying import (
    ASKS,
    CANCELLED,
    CONFIRMS,
    DRIVES,
    OFFERS,
    SUCCEEDED,
    WHICH,
    asking,
    heard,
    later,
    told,
)
from wire import OpRequest

BOTH_ROOMS = StepPlan(steps=(GoTo(place="kitchen"), GoTo(place="living_room")))


@pytest.mark.parametrize("text", ["yes", "no"])
def test_a_question_that_offers_several_orders_takes_neither_word(
    tmp_path: Path, site: Site, text: str
) -> None:
    several = OFFERS.model_copy(update={"options": (*OFFERS.options, *OFFERS.options)})

    async def story() -> None:
        async with planner(tmp_path, site, several) as world:
            await asking(world)
            await world.reach((await world.missions.submit(text)).id, ASKS)
            assert heard(world)[-1] == text, "it is a goal, as any sentence"
            assert world.brain.asked[-1].exchanges == ()
            assert world.bridge.waypoints == []

    run(story())


@pytest.mark.parametrize("text", ["yes", "no"])
def test_a_model_that_asks_alone_reads_the_word_with_its_question(
    tmp_path: Path, site: Site, text: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, WHICH, WHICH, WHICH) as world:
            goal = await asking(world, "go there")
            await world.missions.submit(text)
            await world.until(lambda: len(world.brain.asked) == 2)
            read = world.brain.asked[1]
            assert (read.order, read.exchanges[0].asked, read.text) == ("go there", "Which?", text)
            await world.reach(goal.id, ASKS)
            beside = await world.missions.submit("hm", source="somebody else")
            await world.reach(beside.id, ASKS)
            await world.missions.submit(text)
            await world.until(lambda: len(world.brain.asked) == 4)
            assert world.brain.asked[3].exchanges == (), "of two, neither is meant"

    run(story())


@pytest.mark.parametrize("by", ["sentence", "answer"])
@pytest.mark.parametrize(
    ("text", "reached"),
    [("yes", SUCCEEDED), ("嗯，好的", SUCCEEDED), ("no", CANCELLED), ("不用", CANCELLED)],
)
def test_a_plan_that_waits_for_its_yes_takes_it_in_words(
    tmp_path: Path, site: Site, text: str, reached: GoalState, by: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN) as world:
            plan = await world.missions.submit("go to the kitchen", confirm=True)
            await world.reach(plan.id, CONFIRMS)
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

    run(story())


@pytest.mark.parametrize("text", ["no", "不用，谢谢"])
def test_a_no_to_several_deeds_names_none_of_them_alone(
    tmp_path: Path, site: Site, text: str
) -> None:
    """The question may have named the last of them; an answer about the first would confuse."""

    async def story() -> None:
        async with planner(tmp_path, site, BOTH_ROOMS) as world:
            plan = await world.missions.submit(
                "go to the kitchen and the living room", confirm=True
            )
            await world.reach(plan.id, CONFIRMS)
            await world.missions.answer(plan.id, text)
            done = await world.reach(plan.id, CANCELLED)
            assert told(done)[1:] == (Code.DECLINED, "You said no, so I do not do that.")
            assert world.bridge.waypoints == []

    run(story())


def test_an_answer_that_is_neither_leaves_the_plan_waiting_and_asks_plainly(
    tmp_path: Path, site: Site
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN) as world:
            plan = await world.missions.submit("go to the kitchen", confirm=True)
            await world.reach(plan.id, CONFIRMS)
            for text in ("maybe", "tea", "yes?"):
                goal = await world.missions.answer(plan.id, text)
                asked = "Please answer yes or no. Shall I do “go to the kitchen”?"
                assert (goal.state, told(goal)[2]) == (CONFIRMS, asked)
            await later(world)
            assert world.bridge.waypoints == []
            await world.missions.answer(plan.id, "yes please")
            await world.reach(plan.id, SUCCEEDED)

    run(story())


@pytest.mark.parametrize("by", ["sentence", "answer"])
@pytest.mark.parametrize(
    "text", ["yes", "好呀可以", "yes please do that", "no thanks", "不用，谢谢"]
)
def test_a_single_offer_is_the_order_upon_a_yes_and_nothing_upon_a_no(
    tmp_path: Path, site: Site, text: str, by: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, OFFERS, KITCHEN) as world:
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

    run(story())


@pytest.mark.parametrize("by", ["sentence", "answer"])
@pytest.mark.parametrize("what", [DRIVES, KITCHEN, OFFERS])
@pytest.mark.parametrize("text", ["no", "不", "maybe"])
def test_an_answer_that_is_no_yes_clears_no_hold(
    tmp_path: Path, site: Site, text: str, what: StepPlan | Clarify, by: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, what, WHICH) as world:
            goal = await world.missions.submit("please see to it", confirm=what is KITCHEN)
            await world.reach(goal.id, ASKS, CONFIRMS)
            await world.missions.stop("test")
            act = OpRequest(id="a", source="test")
            if by == "answer" and not (text == "maybe" and what is OFFERS):
                await world.missions.answer(goal.id, text, act=act)
            elif text != "maybe":
                await world.missions.submit(text, act=act)
            await later(world)
            assert world.bridge.held is not None
            assert world.bridge.waypoints == []

    run(story())


def test_go_on_is_a_yes_where_nothing_is_paused(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES) as world:
            goal = await asking(world)
            await world.missions.submit("continue")
            await world.reach(goal.id, SUCCEEDED)

    run(story())


@pytest.mark.parametrize(
    ("question", "source"), [(WHICH, "api"), (OFFERS, None), (KITCHEN, None), (DRIVES, "api")]
)
def test_a_hundred_unclear_orders_keep_no_order_out(
    tmp_path: Path, site: Site, question: Reply, source: str | None
) -> None:
    """Of one person, of a hundred, of any kind of question: an order is always taken."""

    async def story() -> None:
        async with planner(tmp_path, site, *[question] * 100, KITCHEN) as world:
            newest = ""
            for number in range(100):
                by, confirm = source or f"by {number}", question is KITCHEN
                goal = await world.missions.submit(f"hm {number}", source=by, confirm=confirm)
                newest = (await world.reach(goal.id, ASKS, CONFIRMS)).id
            open_ = [g for g in world.missions.goals() if g.state in (ASKS, CONFIRMS)]
            assert 1 <= len(open_) <= MAX_OPEN
            assert open_[0].id == newest, "the newest is kept, and shown first"
            kept = source is not None and question in (WHICH, OFFERS)
            assert len(open_) == (1 if kept else MAX_OPEN)
            order = await world.missions.submit("go to the kitchen", source="last")
            await world.reach(order.id, SUCCEEDED)
            ended = [g for g in world.missions.goals(200) if g.reason == "superseded"]
            assert {g.state for g in ended} == {CANCELLED}
            assert all("before the next order came" in told(g)[2] for g in ended)

    run(story())


def test_open_goals_stand_first_in_every_list_however_old(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        said = AnswerPlan(text=Bilingual(en="Well.", zh="好吧。"))
        async with planner(tmp_path, site, KITCHEN, DRIVES, said) as world:
            plan = await world.missions.submit("go to the kitchen", confirm=True)
            await world.reach(plan.id, CONFIRMS)
            asks = await asking(world)
            for number in range(60):
                await world.reach((await world.missions.submit(f"hello {number}")).id, SUCCEEDED)
            assert [g.id for g in world.missions.goals(2)] == [asks.id, plan.id]
            listed = [goal["id"] for goal in world.missions.snapshot()["goals"]]
            assert listed[:3] == [asks.id, plan.id, "g62"], "each newest first"

    run(story())
