"""Take standing orders in: read, judged, thought about once as they are given, then kept and told.

The one door for sentences, page, command line and API. What the order does each time is found out
by the very brain and checks that will do it, so that a person hears at once what can't be done, or
what will be. Nothing moves here.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Protocol

from planner.language.catalogue import message, say
from planner.language.schedule import (
    ChangeOrders,
    ListOrders,
    OrderCommand,
    ScheduleCommand,
)
from planner.language.sentence import parse
from planner.mission.events import Planned
from planner.mission.state import ORDER_SOURCE
from planner.orders.changer import OrderChanger
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import (
    NewOrder,
    OrderQuestion,
    ask_which_day,
    put_time_before,
    read_new_order,
)
from planner.orders.new_order_judge import NewOrderJudge, is_remark, judge_deed
from planner.orders.order import MAX_ORDER_CHARACTERS, StandingOrder, new_nonce
from planner.orders.skipping import MOST_SKIPPED, days_left_out, runs_on
from planner.orders.teller import OrderTeller
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Language,
    Refuse,
    Say,
    StepPlan,
    StepRecord,
    plan_record,
    words_of,
)
from planner.state_database import StateUnavailable

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import date

    from planner.mission.effects import AskBrain
    from planner.mission.state import Mission, MissionState
    from planner.navigation import ObstacleReport
    from planner.orders.keeper import OrderKeeper
    from planner.plan.timing import Rule
    from planner.site.site_view import SiteView


class Considers(Protocol):
    """Think about an order ahead, as ``StandingGoals`` does."""

    @property
    def book(self) -> MissionState: ...

    async def consider(
        self, text: str, language: Language, goal_id: str, standing: str = ""
    ) -> Planned: ...


class OrderIntake:
    """Be the missions' desk for standing orders, and the API's."""

    def __init__(
        self,
        keeper: OrderKeeper,
        goals: Considers,
        report: Callable[[], ObstacleReport | None] = lambda: None,
    ) -> None:
        """Take the keeper, and who thinks about orders."""
        self._keeper, self._goals = keeper, goals
        self._judge = NewOrderJudge(keeper, lambda: goals.book, report)
        self._teller = OrderTeller(keeper, lambda: goals.book.facts)
        self._changer = OrderChanger(keeper, self, lambda: self._teller.last_list)

    # The missions' desk -------------------------------------------------------------------------

    async def take(self, command: OrderCommand, ask: AskBrain, given: Mission) -> Planned | None:
        """Carry out what a person said about standing orders, and say what came of it.

        None where the sentence may be about something else, and no order is kept that it fits.
        """
        answered = bool(given.replies) and not isinstance(parse(ask.text).intent, OrderCommand)
        if isinstance(command, ListOrders):
            told = self._teller.tell(command)
            return None if told is None else Planned(ask.id, AnswerPlan(text=told))
        if not isinstance(command, ScheduleCommand):
            answer = ask.text if answered else None
            running = self._goals.book.running
            busy = running is not None and running != given.id
            plan = await self._changer.take(command, ask.language, answer, ask.id, is_busy=busy)
            if plan is not None or isinstance(command, ChangeOrders) or command.otherwise is None:
                return None if plan is None else Planned(ask.id, plan)
            command = command.otherwise
        planned = None if answered else await self._consider_deed(command, ask)
        if planned is not None and is_remark(planned):
            return None  # "Tom comes home at six": the whole sentence is a brain's
        if answered:  # about the order within: its words alone are put in
            command = replace(command, order=ask.text)
        return Planned(ask.id, await self._keep(command, ask, given, planned))

    async def _keep(
        self, command: ScheduleCommand, ask: AskBrain, given: Mission, planned: Planned | None
    ) -> AnswerPlan | Clarify | Refuse:
        """Keep a new order and tell it, or say why not."""
        try:
            order = await self.give(read_new_order(command, ask.language, given), ask.id, planned)
        except OrderRefusal as refused:
            why = message(Code.ORDER_NOT_KEPT, why=refused.message)
            return Refuse(code=Code.ORDER_NOT_KEPT, reason=why)
        except OrderQuestion as question:
            whole = question.is_whole
            return question.asked if whole else put_time_before(question.asked, command)
        return AnswerPlan(text=self.tell_one(order))

    async def change(self, command: ChangeOrders, language: Language) -> Bilingual | None:
        """Remove, pause or resume the orders that are meant, and say which; None: none is meant."""
        changed = await self._changer.take(command, language, None)
        return None if changed is None else words_of(changed) or say("standing.none")

    def allowed_steps(self, source: str) -> tuple[StepRecord, ...] | None:
        """Return what the standing order of a goal may do; None where it is gone."""
        order = self._keeper.book.orders.get(source.removeprefix(ORDER_SOURCE))
        return order.allowed if order is not None else None

    def sentence_of(self, source: str) -> tuple[str, str | None]:
        """Return the sentence of a goal's standing order, and a reminder's fixed words."""
        order = self._keeper.book.orders.get(source.removeprefix(ORDER_SOURCE))
        return ("", None) if order is None else (order.text, order.reminder)

    # Giving -------------------------------------------------------------------------------------

    async def give(
        self,
        new: NewOrder,
        goal_id: str,
        planned: Planned | None = None,
        allowed: tuple[StepRecord, ...] | None = None,
    ) -> StandingOrder:
        """Keep an order, on disk as this returns; the same one again is the one that is kept.

        Args:
            new: what is wanted.
            goal_id: to whose account the thought goes.
            planned: the thought about it, where there was one.
            allowed: what it may do, where that was weighed already.

        Raises:
            OrderRefusal: see ``[order_refusal]`` of the catalogue.
            OrderQuestion: the brain asks about it, or its day may be either of two.
        """
        book = self._keeper.book
        now_s = self._keeper.clocks.unix()
        if (asked := ask_which_day(new, now_s, book.zone)) is not None:
            raise OrderQuestion(asked, is_whole=True)
        rule = self._judge.judge(new, now_s)
        if allowed is None:
            allowed = judge_deed(new, planned) if planned else await self.weigh(new, goal_id)
        async with self._keeper.lock:
            if (same := self._judge.find_same(new, rule)) is not None:
                self._changer.note(same.id)
                return same
            self._judge.judge_room(new, rule)
            number = self._keeper.last_number + 1
            order = StandingOrder(
                id=f"o{number}", number=number, nonce=new_nonce(),
                text=new.text[:MAX_ORDER_CHARACTERS], order=new.order,
                language=new.language, rule=rule, reminder=new.reminder,
                source=new.source, allowed=allowed, created_unix_s=now_s, handled_unix_s=now_s,
                skipped=new.skipped, paused=new.paused,
            )  # fmt: skip
            try:
                await self._keeper.keep(order)
            except StateUnavailable as error:
                raise OrderRefusal("orders_unwritable", str(error)) from None
        self._changer.note(order.id)
        return order

    async def _consider_deed(self, command: ScheduleCommand, ask: AskBrain) -> Planned | None:
        """Have thought about what is to be done each time; None: that is known without a brain."""
        said = parse(command.order)
        known = said.intent is not None or said.consent is not None or said.orders_stop
        if command.reminder is not None or not command.order.strip() or known:
            return None
        return await self._goals.consider(command.order, ask.language, ask.id, ask.text)

    async def weigh(self, new: NewOrder, goal_id: str) -> tuple[StepRecord, ...]:
        """Return what an order would do each time; nothing is kept.

        Raises:
            OrderRefusal: it can't be kept.
            OrderQuestion: the brain asks about it.
        """
        self._judge.judge(new, self._keeper.clocks.unix())
        if new.reminder:  # its words are fixed: no brain is asked
            return plan_record(StepPlan(steps=(Say(text=new.reminder),))).steps
        return judge_deed(
            new, await self._goals.consider(new.order, new.language, goal_id, new.text)
        )

    def refuse_offer(self, text: str) -> Bilingual | None:
        """Return why a standing order that a model offers could not be kept; None: it could."""
        return self._judge.refuse_offer(text)

    # Changing -----------------------------------------------------------------------------------

    async def pause(
        self, order_id: str, *, paused: bool = True, until_s: float | None = None
    ) -> StandingOrder:
        """Pause an order (until then, where that is said), or resume it.

        What was due meanwhile is not told. One that is on already gets its skipped days back.

        Raises:
            OrderRefusal: ``unknown_order``, ``order_ended``, ``orders_unwritable``.
        """
        async with self._keeper.lock:
            order = self.find(order_id)
            if order.ended:
                raise OrderRefusal("order_ended", order_id)
            handled_s = order.handled_unix_s
            if order.paused and not paused:
                handled_s = max(handled_s, self._keeper.clocks.unix())
            try:
                changed = await self._keeper.revise(
                    order_id, paused=paused, resume_unix_s=until_s if paused else None,
                    handled_unix_s=handled_s,
                    skipped=order.skipped if order.paused or paused else (),
                )  # fmt: skip
            except StateUnavailable as error:
                raise OrderRefusal("orders_unwritable", str(error)) from None
        self._changer.note(order_id)
        return changed

    async def skip(self, order_id: str, day: date) -> StandingOrder:
        """Leave a day out of an order; one that is due on that day alone is removed.

        Raises:
            OrderRefusal: ``unknown_order``, ``order_ended``, ``order_change_none`` (it has no run
                on that day), ``order_skips_full``, ``orders_unwritable``.
        """
        async with self._keeper.lock:
            order = self.find(order_id)
            now_s, zone = self._keeper.clocks.unix(), self._keeper.book.zone
            if order.ended:
                raise OrderRefusal("order_ended", order_id)
            if not runs_on(order, day, now_s, zone):
                raise OrderRefusal("order_change_none", f"no run on {day}")
            skipped = days_left_out(order, day, now_s, zone)
            if len(skipped) > MOST_SKIPPED:
                raise OrderRefusal("order_skips_full", order_id, most=MOST_SKIPPED)
            try:
                if order.is_once:
                    await self._keeper.remove(order_id)
                    return order
                changed = await self._keeper.revise(order_id, skipped=tuple(skipped))
            except StateUnavailable as error:
                raise OrderRefusal("orders_unwritable", str(error)) from None
        self._changer.note(order_id)
        return changed

    async def move(self, order_id: str, rule: Callable[[Rule], Rule]) -> StandingOrder:
        """Give an order another rule, made of the one that it has.

        Raises:
            OrderRefusal: ``unknown_order``, ``order_ended``, as the new rule's,
                ``order_always_quiet``, ``orders_unwritable``; nothing has changed then.
        """
        async with self._keeper.lock:
            kept, now_s = self.find(order_id), self._keeper.clocks.unix()
            if kept.ended:
                raise OrderRefusal("order_ended", order_id)
            new = rule(kept.rule)
            self._judge.judge_quiet(new, now_s)
            words = kept.reminder or kept.order  # the sentence would tell the old time
            try:
                changed = await self._keeper.revise(
                    order_id, rule=new, text=words, handled_unix_s=max(kept.handled_unix_s, now_s)
                )
            except StateUnavailable as error:
                raise OrderRefusal("orders_unwritable", str(error)) from None
        self._changer.note(order_id)
        return changed

    async def remove(self, order_id: str) -> StandingOrder:
        """Forget an order. Raises OrderRefusal: ``unknown_order``, ``orders_unwritable``."""
        async with self._keeper.lock:
            order = self.find(order_id)
            try:
                await self._keeper.remove(order_id)
            except StateUnavailable as error:
                raise OrderRefusal("orders_unwritable", str(error)) from None
        return order

    def find(self, order_id: str) -> StandingOrder:
        """Return an order. Raises OrderRefusal: ``unknown_order``."""
        order = self._keeper.book.orders.get(order_id)
        if order is None:
            known = ", ".join(self._keeper.book.orders) or "none"
            raise OrderRefusal("unknown_order", f"{order_id[:60]!r}; known: {known}",
                               id=order_id[:60])  # fmt: skip
        return order

    # Telling ------------------------------------------------------------------------------------

    def tell(self) -> Bilingual:
        """Return all orders in words."""
        return self._teller.tell_all()

    def line(self, order: StandingOrder) -> Bilingual:
        """Return an order in one line."""
        return self._teller.line(order)

    def tell_one(self, order: StandingOrder) -> Bilingual:
        """Return what a person hears when an order is taken."""
        return self._teller.tell_one(order)

    @property
    def facts(self) -> SiteView:
        """Return the site as it is now."""
        return self._goals.book.facts
