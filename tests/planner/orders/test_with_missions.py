"""Standing orders and the missions together: said, kept, fired, held to what was said, stopped."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from planner.brain.scripted import Reply
from planner.language.grammar.context import Context
from planner.language.order_sentence import offer_order
from planner.language.readers import OrderWords, read_order
from planner.language.sentence import parse
from planner.orders.errors import OrderRefusal
from planner.orders.factory import StandingOrders, standing_orders_of
from planner.orders.interfaces import OrderClocks
from planner.orders.new_order import order_of_text
from planner.orders.order import key_of
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    ComeBack,
    Goal,
    GoalState,
    Option,
    Recall,
    Say,
    StepPlan,
)
from planner.settings import OrderSettings
from planner.site import Site
from planner.site.site_view import vocabulary_of
from planner.state_database import StateDatabase
from tests.planner.mission import live
from tests.planner.mission.live import Together
from tests.planner.orders.fakes import NOON_UNIX_S, ROOT
from wire import Pose2

SITE = Site.load(ROOT / "sites" / "two_room")
KITCHEN, SOFA = live.KITCHEN, live.SOFA
HELLO = StepPlan(steps=(Say(text="hello"),))
ENDED = (GoalState.SUCCEEDED, GoalState.REFUSED, GoalState.FAILED, GoalState.CANCELLED)


@dataclass
class Home:
    """Hold a planner's missions and its standing orders, whose clock a test moves."""

    together: Together
    orders: StandingOrders
    unix_s: float = NOON_UNIX_S

    async def say(self, text: str, *states: GoalState) -> Goal:
        given = await self.together.missions.submit(text)
        return await self.together.reach(given.id, *(states or ENDED))

    async def pass_s(self, seconds: float) -> None:
        """Let the orders' clocks go on; the missions' own goes by itself."""
        self.unix_s += seconds
        self.orders.keeper.turn()
        await self.orders.keeper.work_off()

    def fired(self) -> list[Goal]:
        missions = self.together.missions.loop.book.missions.values()
        found = [m.id for m in missions if m.source.startswith("order:")]
        return [self.together.missions.goal(i) for i in found]


@asynccontextmanager
async def home(
    folder: Path, *replies: Reply, by_grammar: bool = True, prefix: str = "g"
) -> AsyncIterator[Home]:
    bridge = live.LiveBridge(pose=Pose2(1.0, 4.2, 0.0))
    async with live.planner(
        folder, SITE, *replies, bridge=bridge, by_grammar=by_grammar, prefix=prefix
    ) as together:
        settings = OrderSettings(timezone="Europe/Berlin")
        database = StateDatabase(folder)
        orders = standing_orders_of(settings, folder, database, together.missions)
        made = Home(together, orders)
        numbers = iter(range(1000))
        # The two clocks part by design: the missions' is the bridge's, the orders' the test's.
        orders.keeper.clocks = OrderClocks(
            bridge.now_s,
            lambda: made.unix_s,
            lambda: f"{prefix}-order-{next(numbers)}",
            bridge.now_s,
        )
        await orders.keeper.start(rounds=False)
        try:
            yield made
        finally:
            await orders.keeper.close()
            database.close()


def told(goal: Goal) -> str:
    assert goal.outcome is not None
    return goal.outcome.message.en


async def test_an_order_is_said_kept_listed_and_driven(tmp_path: Path) -> None:
    async with home(tmp_path, KITCHEN) as made:
        kept = await made.say("every day at 12:10 go to the kitchen")
        assert kept.outcome is not None
        assert kept.outcome.code is Code.ANSWERED
        assert told(kept).startswith("Every day at 12:10 I will go to the kitchen. Next: today")
        assert made.together.bridge.waypoints == []
        assert "o1: every day at 12:10" in told(await made.say("what do you do every day?"))
        await made.pass_s(599.0)
        assert made.fired() == []
        await made.pass_s(2.0)
        [goal] = made.fired()
        assert goal.text == "go to the kitchen"
        await made.together.reach(goal.id, GoalState.SUCCEEDED)
        await made.pass_s(1.0)
        assert made.together.bridge.waypoints != []


async def test_what_the_learned_reader_offers_is_kept_by_a_yes_and_done_by_its_steps(
    tmp_path: Path,
) -> None:
    said = "love, would you stand in front of the sofa"
    able = Context(runnable=frozenset(EVERY_KIND))
    offer = read_order(OrderWords(parse(said), vocabulary_of(SITE), able)).plan
    async with home(tmp_path, offer, by_grammar=False) as made:
        asked = await made.say(f"{said} every day at noon", GoalState.NEEDS_CLARIFICATION)
        await made.together.missions.answer(asked.id, "yes")
        kept = await made.together.reach(asked.id, *ENDED)
        assert told(kept).startswith("Every day at 12:00 I will stand before the sofa")
        await made.pass_s(86_401.0)
        [goal] = made.fired()
        assert goal.plan is not None
        assert [step.kind for step in goal.plan.steps] == ["stand_at"]


async def test_a_model_that_drives_elsewhere_at_its_time_is_asked_about(tmp_path: Path) -> None:
    async with home(tmp_path, KITCHEN, SOFA) as made:
        await made.say("every day at 12:10 go to the kitchen")
        await made.pass_s(601.0)
        [goal] = made.fired()
        waits = await made.together.reach(goal.id, GoalState.AWAITING_CONFIRMATION)
        assert waits.reason == "unasked_motion"
        assert made.together.bridge.waypoints == []


async def test_motion_that_nobody_said_is_no_standing_order(tmp_path: Path) -> None:
    async with home(tmp_path, KITCHEN, by_grammar=False) as made:
        refused = await made.say("every day at 12:10 say hello")
        assert refused.outcome is not None
        assert refused.outcome.code is Code.ORDER_NOT_KEPT
        assert made.orders.keeper.book.orders == {}


async def test_an_order_that_comes_back_to_nowhere_is_refused(tmp_path: Path) -> None:
    async with home(tmp_path, StepPlan(steps=(ComeBack(),))) as made:
        refused = await made.say("every day at 12:10 come back")
        assert "name the place" in told(refused)
        assert made.orders.keeper.book.orders == {}


async def test_a_question_about_the_order_is_answered_with_its_time(tmp_path: Path) -> None:
    which = Clarify(
        code=Code.AMBIGUOUS,
        question=Bilingual(en="The kitchen?", zh="厨房？"),
        options=(Option(label=Bilingual(en="Yes", zh="是"), text="go to the kitchen"),),
    )
    async with home(tmp_path, which, KITCHEN) as made:
        asking = await made.say("every day at 12:10 go to the room", GoalState.NEEDS_CLARIFICATION)
        assert asking.plan is not None
        [option] = asking.plan.options
        assert option.text == "every day at 12:10 go to the kitchen"
        await made.together.missions.answer(asking.id, "yes")
        ended = await made.together.reach(asking.id, GoalState.SUCCEEDED)
        assert "go to the kitchen" in told(ended)
        assert made.together.bridge.waypoints == []
        [kept] = made.orders.keeper.book.orders.values()
        assert kept.order == "go to the kitchen"


PROPOSED = Clarify(
    code=Code.AMBIGUOUS,
    question=Bilingual(en="Shall I look after it?", zh="要我照看吗？"),
    options=(
        Option(label=Bilingual(en="Yes", zh="好"), text="every day at 12:10 go to the kitchen"),
    ),
)


@pytest.mark.parametrize("answer", ["yes", "no", "perhaps"])
async def test_a_model_proposes_a_standing_order_and_a_persons_yes_alone_keeps_it(
    tmp_path: Path, answer: str
) -> None:
    talk = AnswerPlan(text=Bilingual(en="As you like.", zh="随你。"))
    async with home(tmp_path, PROPOSED, KITCHEN if answer == "yes" else talk,
                    by_grammar=False) as made:  # fmt: skip
        asking = await made.say("the kitchen is always such a mess", GoalState.NEEDS_CLARIFICATION)
        assert told(asking).endswith(
            "Yes means, from now on (every day at 12:10): “go to the kitchen”."
        ), "what a yes keeps is told, whatever the model asks"
        assert made.orders.keeper.book.orders == {}
        await made.together.missions.answer(asking.id, answer)
        await made.together.reach(asking.id, *ENDED)
        kept = [order.order for order in made.orders.keeper.book.orders.values()]
        assert kept == (["go to the kitchen"] if answer == "yes" else [])
        assert made.together.bridge.waypoints == []


@pytest.mark.parametrize(
    ("offer", "why"),
    [
        ("today at eight in the morning go to the kitchen", "over already"),
        ("every minute go to the kitchen", "too often"),
        ("on 31 June at noon go to the kitchen", "no such date"),
        ("every day at noon stop", "stops me"),
    ],
)  # fmt: skip
async def test_an_offer_that_a_yes_could_not_keep_is_never_made(
    tmp_path: Path, offer: str, why: str
) -> None:
    alone = PROPOSED.model_copy(
        update={"options": (Option(label=Bilingual(en="Yes", zh="好"), text=offer),)}
    )
    beside = PROPOSED.model_copy(update={"options": (*alone.options, *PROPOSED.options)})
    async with home(tmp_path, alone, beside, by_grammar=False) as made:
        refused = await made.say("the kitchen is always such a mess", GoalState.REFUSED)
        assert refused.outcome is not None
        assert refused.outcome.code is Code.ORDER_NOT_KEPT
        assert why in told(refused)
        asking = await made.say("such a mess in there", GoalState.NEEDS_CLARIFICATION)
        assert why in told(asking)
        assert asking.plan is not None
        assert [each.text for each in asking.plan.options] == [PROPOSED.options[0].text]
        assert made.orders.keeper.book.orders == {}


async def test_which_one_is_answered_by_its_place_in_the_list(tmp_path: Path) -> None:
    async with home(tmp_path, HELLO) as made:
        await made.say("remind me at eight in the evening to call Tom")
        await made.say("every day at nine in the evening say hello")
        await made.pass_s(1200.0)
        asking = await made.say("make it ten", GoalState.NEEDS_CLARIFICATION)
        assert "o1" in told(asking)
        await made.together.missions.answer(asking.id, "the second one")
        changed = await made.together.reach(asking.id, GoalState.SUCCEEDED)
        assert "Every day at 22:00" in told(changed)
        await made.pass_s(1200.0)
        asking = await made.say("make it tomorrow at nine", GoalState.NEEDS_CLARIFICATION)
        await made.together.missions.answer(asking.id, "yes")
        changed = await made.together.reach(asking.id, GoalState.SUCCEEDED)
        assert "Tomorrow 21:00 I will remind you" in told(changed)
        assert made.together.bridge.waypoints == []


async def test_a_free_answer_never_drives_at_once(tmp_path: Path) -> None:
    which = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))
    async with home(tmp_path, which, KITCHEN) as made:
        asking = await made.say("every day at 12:10 go to the room", GoalState.NEEDS_CLARIFICATION)
        await made.together.missions.answer(asking.id, "go to the kitchen")
        ended = await made.together.reach(asking.id, GoalState.SUCCEEDED)
        assert "Every day at 12:10 I will" in told(ended)
        assert made.together.bridge.waypoints == []


async def test_stop_words_stop_first_and_then_mean_what_they_say(tmp_path: Path) -> None:
    async with home(tmp_path, KITCHEN) as made:
        await made.say("every day at 12:10 go to the kitchen")
        drive = await made.together.missions.submit("go to the kitchen")
        await made.together.reach(drive.id, GoalState.RUNNING)
        await made.together.until(lambda: made.together.bridge.horizon is not None)
        stopped = await made.say("stop going to the kitchen every day")
        assert stopped.outcome is not None
        assert stopped.outcome.code is Code.STOPPED
        assert "Removed: o1" in told(stopped)
        assert made.together.missions.goal(drive.id).state is GoalState.PAUSED
        assert made.orders.keeper.book.orders == {}


async def test_a_word_that_may_mean_stop_stops_and_removes(tmp_path: Path) -> None:
    async with home(tmp_path, KITCHEN) as made:
        await made.say("remind me in 20 minutes to call Tom")
        drive = await made.together.missions.submit("go to the kitchen")
        await made.together.reach(drive.id, GoalState.RUNNING)
        stopped = await made.say("stop reminding me")
        assert "Removed: o1" in told(stopped)
        assert made.together.missions.goal(drive.id).state is GoalState.PAUSED
        assert made.orders.keeper.book.orders == {}


async def test_nothing_fires_after_a_stop_until_a_person_acts(tmp_path: Path) -> None:
    async with home(tmp_path, KITCHEN) as made:
        await made.say("every day at 12:10 go to the kitchen")
        await made.say("stop")
        await made.pass_s(601.0)
        assert made.fired() == []
        [kept] = made.orders.keeper.book.orders.values()
        assert kept.missed == 1


async def test_a_killed_planner_gives_no_goal_twice(tmp_path: Path) -> None:
    async with home(tmp_path, KITCHEN) as made:
        await made.say("every day at 12:10 go to the kitchen")
        await made.pass_s(601.0)
        [goal] = made.fired()
        [order] = made.orders.keeper.book.orders.values()
        key = key_of(order, 1)
        assert made.together.missions.standing.find(key) == goal.id
    async with home(tmp_path, KITCHEN, prefix="h") as again:
        again.unix_s = NOON_UNIX_S + 610.0
        assert again.together.missions.standing.find(key) == goal.id
        await again.pass_s(1.0)
        assert [g.id for g in again.fired()] == [goal.id]
        await asyncio.sleep(0)


AS_SAID = AnswerPlan(text=Bilingual(en="Good to know.", zh="知道了。"))


@pytest.mark.parametrize("text", [
    "Tom comes home at six", "pizza tonight", "dinner at seven", "good game tonight", "六点开饭",
    "nice weather today", "you did well today", "happy birthday tomorrow", "周末愉快", "今晚有客人",
])  # fmt: skip
async def test_a_remark_that_holds_a_time_is_no_order_and_is_answered_as_said(
    tmp_path: Path, text: str
) -> None:
    async with home(tmp_path, AS_SAID, by_grammar=False) as made:
        goal = await made.say(text)
        assert told(goal) == "Good to know."
        assert made.orders.keeper.book.orders == {}
        assert made.together.brain.asked[-1].text == text


@pytest.mark.parametrize(
    ("text", "within"),
    [
        ("晚上八点那个改成九点吧", offer_order("改成九点")),
        ("你今天都干了些啥", StepPlan(steps=(Recall(deeds=True),))),
    ],
)
async def test_a_time_within_a_change_or_a_question_to_memory_is_no_time_of_an_order(
    tmp_path: Path, text: str, within: Clarify | StepPlan
) -> None:
    async with home(tmp_path, within, AS_SAID, by_grammar=False) as made:
        assert told(await made.say(text)) == "Good to know."
        assert made.together.brain.asked[-1].text == text
        assert made.orders.keeper.book.orders == {}


async def test_an_order_that_a_brain_only_answers_is_refused_by_the_api(tmp_path: Path) -> None:
    async with home(tmp_path, AS_SAID, by_grammar=False) as made:
        new = order_of_text("every day at eight philosophise", None, "api")
        with pytest.raises(OrderRefusal) as refused:
            await made.orders.intake.give(new, "g")
        assert refused.value.code == "order_no_deed"
