"""Take standing orders in: read, judged, thought about once as they are given, then kept and told.

The one door for sentences, page, command line and API. What the order does each time is found out
by the very brain and checks that will do it, so that a person hears at once what can't be done, or
what will be. Decisions are pure functions (``decision``, ``new_order``); here they are asked for
under the lock, written, and told. Nothing moves here.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from typing import TYPE_CHECKING, Protocol

from planner.language.catalogue import join, say
from planner.language.schedule import ChangeOrders, ListOrders, OrderCommand, ScheduleCommand
from planner.language.sentence import parse
from planner.mission.events import Planned
from planner.mission.state import ORDER_SOURCE, GivenOrder
from planner.orders import new_order, world
from planner.orders.decision import (
    KeptOrders,
    NoneSuch,
    OrderEdit,
    OrderEdits,
    WhichOrder,
    decide,
    pause,
    skip,
)
from planner.orders.errors import OrderRefusal
from planner.orders.order import MAX_ORDER_CHARACTERS, StandingOrder, new_nonce
from planner.orders.telling import OrderTelling
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Language,
    Refuse,
    Say,
    StepPlan,
    StepRecord,
    plan_record,
    words_of,
)
from planner.plan.timing import EventRule
from planner.state_database import StateUnavailable

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import date

    from planner.language.schedule import CorrectOrder
    from planner.mission.effects import AskBrain
    from planner.mission.state import Mission, MissionState
    from planner.navigation import ObstacleReport
    from planner.orders.keeper import OrderKeeper
    from planner.plan.timing import Rule
    from planner.site.site_view import SiteView

LISTED_S = 600.0
"""For so long after a list "the second one" is of it."""


class Considers(Protocol):
    """Think about an order ahead, as ``StandingGoals`` does."""

    @property
    def book(self) -> MissionState: ...

    async def consider(
        self, text: str, language: Language, goal_id: str, standing: str = "",
        deed: StepPlan | None = None,
    ) -> Planned: ...  # fmt: skip


class OrderIntake:
    """Be the missions' desk for standing orders, and the API's."""

    def __init__(
        self,
        keeper: OrderKeeper,
        goals: Considers,
        report: Callable[[], ObstacleReport | None] = lambda: None,
    ) -> None:
        """Take the keeper, and who thinks about orders."""
        self._keeper, self._goals, self._report = keeper, goals, report
        self._spoken: dict[str, float] = {}
        self._listed: tuple[str, ...] = ()
        self._listed_s = float("-inf")

    # The missions' desk -------------------------------------------------------------------------

    async def take(self, command: OrderCommand, ask: AskBrain, given: Mission) -> Planned | None:
        """Carry out what a person said about standing orders, and say what came of it.

        None where the sentence may be about something else, and no order is kept that it fits.
        """
        answered = bool(given.replies) and not isinstance(parse(ask.text).intent, OrderCommand)
        if isinstance(command, ListOrders):
            told = self._answer(command)
            return None if told is None else Planned(ask.id, AnswerPlan(text=told))
        if not isinstance(command, ScheduleCommand):
            answer = ask.text if answered else None
            plan = await self._change(command, ask.language, answer, given.id)
            if plan is not None or isinstance(command, ChangeOrders) or command.otherwise is None:
                return None if plan is None else Planned(ask.id, plan)
            command = command.otherwise
        planned = None if answered else await self._consider_deed(command, ask)
        if planned is not None and new_order.is_remark(planned, command.problem):
            return None  # "Tom comes home at six": the whole sentence is a brain's
        command = replace(command, order=ask.text) if answered else command  # of the order within
        return Planned(ask.id, await self._keep(command, ask, given, planned))

    async def change(self, command: ChangeOrders, language: Language) -> Bilingual | None:
        """Remove, pause or resume the orders that are meant, and say which; None: none is meant."""
        changed = await self._change(command, language)
        return None if changed is None else words_of(changed) or say("standing.none")

    def allowed_steps(self, source: str) -> tuple[StepRecord, ...] | None:
        """Return what the standing order of a goal may do; None where it is gone."""
        return None if (order := self._of(source)) is None else order.allowed

    def sentence_of(self, source: str) -> tuple[str, str | None]:
        """Return the sentence of a goal's standing order, and a reminder's fixed words."""
        return ("", None) if (order := self._of(source)) is None else (order.text, order.reminder)

    def _of(self, source: str) -> StandingOrder | None:
        return self._keeper.book.orders.get(source.removeprefix(ORDER_SOURCE))

    def refuse_offer(self, text: str) -> Bilingual | None:
        """Return why a standing order could not be kept if a person said it now; None: it could."""
        try:
            if isinstance(parse(text).intent, ScheduleCommand):
                self._judge(new_order.order_of_text(text, None, "offer"))
        except OrderRefusal as refused:
            return refused.message
        return None

    # Giving -------------------------------------------------------------------------------------

    async def _consider_deed(self, command: ScheduleCommand, ask: AskBrain) -> Planned | None:
        """Have thought about what is to be done each time; None: that is known without a brain."""
        said = parse(command.order)
        known = said.intent is not None or said.consent is not None or said.orders_stop
        if command.reminder is not None or not command.order.strip() or known:
            return None
        return await self._goals.consider(command.order, ask.language, ask.id, ask.text, ask.deed)

    async def _keep(
        self, command: ScheduleCommand, ask: AskBrain, given: GivenOrder, planned: Planned | None
    ) -> AnswerPlan | Clarify | Refuse:
        """Keep a new order and tell it, or say why not."""
        try:
            new = new_order.read_new_order(
                command, ask.language, given.text, given.source, ask.deed
            )
            order = await self.give(new, ask.id, planned)
        except OrderRefusal as refused:
            return refused.plan
        except new_order.OrderQuestion as question:
            asked = question.asked
            return asked if question.is_whole else new_order.put_time_before(asked, command.words)
        return AnswerPlan(text=self.tell_one(order))

    async def give(
        self,
        new: new_order.NewOrder,
        goal_id: str,
        planned: Planned | None = None,
        allowed: tuple[StepRecord, ...] | None = None,
    ) -> StandingOrder:
        """Keep an order, on disk as this returns; the same one again is the one that is kept.

        ``goal_id`` pays for the thought, where neither the thought nor what it may do is known.

        Raises:
            OrderRefusal: see ``[order_refusal]`` of the catalogue.
            OrderQuestion: the brain asks about it, or its day may be either of two.
        """
        keeper, now_s = self._keeper, self._keeper.clocks.unix()
        if (asked := new_order.ask_which_day(new, now_s, keeper.book.zone)) is not None:
            raise new_order.OrderQuestion(asked, is_whole=True)
        rule = self._judge(new)
        if allowed is None:
            allowed = (
                new_order.judge_deed(new, planned) if planned else await self.weigh(new, goal_id)
            )
        async with keeper.lock:
            if (order := new_order.find_same(new, rule, keeper.book)) is None:
                self._judge(new)  # of the room that is left by now
                number = keeper.last_number + 1
                order = StandingOrder(
                    id=f"o{number}", number=number, nonce=new_nonce(),
                    text=new.text[:MAX_ORDER_CHARACTERS], order=new.order,
                    language=new.language, rule=rule, reminder=new.reminder, source=new.source,
                    allowed=allowed, created_unix_s=now_s, handled_unix_s=now_s,
                    skipped=new.skipped, paused=new.paused, steps=new.steps,
                )  # fmt: skip
                try:
                    await keeper.keep(order)
                except StateUnavailable as error:
                    raise OrderRefusal("orders_unwritable", str(error)) from None
        self._note(order.id)
        return order

    async def weigh(self, new: new_order.NewOrder, goal_id: str) -> tuple[StepRecord, ...]:
        """Return what an order would do each time. Raises OrderRefusal, OrderQuestion."""
        self._judge(new)
        if new.reminder:  # its words are fixed: no brain is asked
            return plan_record(StepPlan(steps=(Say(text=new.reminder),))).steps
        return new_order.judge_deed(
            new, await self._goals.consider(new.order, new.language, goal_id, new.text)
        )

    def _judge(self, new: new_order.NewOrder) -> Rule:
        """Return the rule of an order that is given now. Raises OrderRefusal."""
        lacking = None
        if isinstance(new.when, EventRule):
            lacking = world.lacks(self._goals.book, new.when.event, self._report())
        return new_order.judge_new(new, self._keeper.book, self._keeper.clocks.unix(), lacking)

    # Changing -----------------------------------------------------------------------------------

    async def _change(
        self, command: ChangeOrders | CorrectOrder, language: Language,
        answer: str | None = None, goal_id: str = "",
    ) -> AnswerPlan | Clarify | Refuse | None:  # fmt: skip
        """Change what is meant and say so; None where the sentence is about no order."""
        running = self._goals.book.running
        is_busy = running is not None and running != goal_id
        try:
            async with self._keeper.lock:
                decided = decide(command, replace(self._view, is_busy=is_busy), answer)
                told = await self._carry_out(decided) if isinstance(decided, OrderEdits) else []
            match decided:
                case OrderEdits(given=given):
                    told += [self.tell_one(await self.give(new, goal_id)) for new in given]
                    return AnswerPlan(text=join(told))
                case WhichOrder(orders, form):
                    return self._telling.ask_which(orders, form)
                case NoneSuch(which):
                    which = which or ("reminder" if language is Language.EN else "提醒")
                    return AnswerPlan(text=self._telling.tell_no_such(which))
                case OrderRefusal():
                    return decided.plan
                case None:
                    return None
        except OrderRefusal as refused:
            return refused.plan

    async def _carry_out(self, change: OrderEdits) -> list[Bilingual]:
        """Write edits, and return what is told of them."""
        lines: defaultdict[str, list[Bilingual]] = defaultdict(list)
        for edit in change.edits:
            order = await self._write(edit)
            is_new = edit.told == "changed" and not order.paused
            lines[edit.told].append(self.tell_one(order) if is_new else self._telling.line(order))
        return [
            say("standing.changed", line=join(told))
            if done == "changed"
            else say(f"standing.{done}", lines=join(told, "joint.line"))
            for done, told in lines.items()
        ]

    async def pause(self, order_id: str, *, paused: bool = True) -> StandingOrder:
        """Pause an order, or resume it. Raises OrderRefusal: as ``decision.pause``."""
        async with self._keeper.lock:
            now_s = self._keeper.clocks.unix()
            return await self._write(pause(self.find(order_id), now_s, paused=paused))

    async def skip(self, order_id: str, day: date) -> StandingOrder:
        """Leave a day out of an order. Raises OrderRefusal: as ``decision.skip``."""
        async with self._keeper.lock:
            return await self._write(skip(self.find(order_id), day, self._view))

    async def remove(self, order_id: str) -> StandingOrder:
        """Forget an order. Raises OrderRefusal."""
        async with self._keeper.lock:
            return await self._write(OrderEdit(order_id, None, "removed"))

    async def _write(self, edit: OrderEdit) -> StandingOrder:
        """Write an edit, on disk as this returns.

        Raises:
            OrderRefusal: ``unknown_order``, ``orders_unwritable``.
        """
        order = self.find(edit.order)
        try:
            if edit.fields is None:
                await self._keeper.remove(order.id)
                return order
            changed = await self._keeper.revise(order.id, **edit.fields)
        except StateUnavailable as error:
            raise OrderRefusal("orders_unwritable", str(error)) from None
        self._note(order.id)
        return changed

    def _note(self, order_id: str) -> None:
        """Remember that an order is spoken of now."""
        live = self._keeper.book.orders
        self._spoken = {name: s for name, s in self._spoken.items() if name in live}
        self._spoken[order_id] = self._keeper.clocks.unix()

    def find(self, order_id: str) -> StandingOrder:
        """Return an order. Raises OrderRefusal: ``unknown_order``."""
        kept = self._keeper.book.orders
        if order_id not in kept:
            known, named = ", ".join(kept) or "none", order_id[:60]
            raise OrderRefusal("unknown_order", f"{named!r}; known: {known}", id=named)
        return kept[order_id]

    @property
    def _view(self) -> KeptOrders:
        """Return what a decision rests on now."""
        book, now_s = self._keeper.book, self._keeper.clocks.unix()
        is_fresh = 0.0 <= now_s - self._listed_s <= LISTED_S
        listed = self._listed if is_fresh and set(self._listed) <= book.orders.keys() else ()
        return KeptOrders(book, now_s, self._spoken, self._keeper.announcer.told_unix_s, listed)

    # Telling ------------------------------------------------------------------------------------

    def _answer(self, asked: ListOrders) -> Bilingual | None:
        told, listed = self._telling.answer(asked)
        if listed is not None:
            self._listed = tuple(order.id for order in listed)
            self._listed_s = self._keeper.clocks.unix()
        return told

    def tell_one(self, order: StandingOrder) -> Bilingual:
        """Return what a person hears when an order is taken."""
        return self._telling.tell_one(order)

    @property
    def _telling(self) -> OrderTelling:
        return OrderTelling(self.facts, self._keeper.book, self._keeper.clocks.unix())

    @property
    def facts(self) -> SiteView:
        """Return the site as it is now."""
        return self._goals.book.facts
