"""Remove, pause, resume and skip the standing orders that a person means, or ask which.

Law: words that fit several are asked about; a skip leaves out that day's runs and no other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from planner.language.catalogue import join, message, say
from planner.language.folding import has_chinese
from planner.orders.errors import OrderRefusal
from planner.orders.rule import settle
from planner.orders.selection import is_all, pick, select
from planner.orders.skipping import find_day, runs_on
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, Language, Option, Refuse
from planner.plan.timing import AtRule

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import date

    from planner.language.schedule import ChangeOrders
    from planner.language.schedule.parts import OnceDay
    from planner.orders.keeper import OrderKeeper
    from planner.orders.order import StandingOrder

MOST_OFFERED = 8


class ChangeDesk(Protocol):
    """Change and tell orders, as ``OrderIntake`` does."""

    async def pause(
        self, order_id: str, *, paused: bool = True, until_s: float | None = None
    ) -> StandingOrder: ...

    async def skip(self, order_id: str, day: date) -> StandingOrder: ...

    async def remove(self, order_id: str) -> StandingOrder: ...

    def line(self, order: StandingOrder) -> Bilingual: ...

    def tell(self) -> Bilingual: ...


class OrderChanger:
    """Carry out what a person said about orders that are kept."""

    def __init__(
        self,
        keeper: OrderKeeper,
        desk: ChangeDesk,
        listed: Callable[[], tuple[StandingOrder, ...]] = lambda: (),
    ) -> None:
        """Take the keeper, who changes orders on disk and tells them, and what was listed last."""
        self._keeper, self._desk, self._listed = keeper, desk, listed

    async def take(
        self, command: ChangeOrders, language: Language, answer: str | None
    ) -> AnswerPlan | Clarify | Refuse | None:
        """Change what is meant and say so; None where the sentence is about no order.

        Args:
            command: what was said.
            language: of the person.
            answer: which of several was said to be meant, after a question.
        """
        found = self._find(command, answer)
        if not found:
            if not command.is_sure:
                return None
            which = command.which or ("reminder" if language is Language.EN else "提醒")
            none = say("standing.no_such", which=which[:80], known=self._desk.tell())
            return AnswerPlan(text=none)
        is_one = (bool(command.which) or command.is_single) and not command.is_every
        if len(found) > 1 and is_one and not is_all(answer):
            return self._ask_which(command, found)
        try:
            if command.day is not None:
                return await self._skip(command.day, found)
            until_s = self._read_until(command)
            for order in found:
                if command.act == "remove":
                    await self._desk.remove(order.id)
                else:
                    await self._desk.pause(order.id, paused=command.act == "pause", until_s=until_s)
        except OrderRefusal as refused:
            why = message(Code.ORDER_NOT_KEPT, why=refused.message)
            return Refuse(code=Code.ORDER_NOT_KEPT, reason=why)
        done = {"remove": "removed", "pause": "paused", "resume": "resumed"}[command.act]
        return self._tell_done(done, found)

    def _find(self, command: ChangeOrders, answer: str | None) -> tuple[StandingOrder, ...]:
        orders, zone = self._keeper.book.orders.values(), self._keeper.book.zone
        now_s = self._keeper.clocks.unix()
        placed = pick(self._listed(), f"the {command.which} one") or pick(
            self._listed(), command.which
        )
        if placed and answer is None and command.which:
            return placed
        found = select(orders, command.which, zone, reminders=command.reminders, now_unix_s=now_s)
        if command.day is not None and len(found) > 1:  # those that have a run on that day
            day = find_day(command.day, now_s, zone)
            found = tuple(o for o in found if runs_on(o, day, now_s, zone)) or found
        if answer is None:
            return found
        picked = pick(found, answer)
        return picked or select(found, answer, zone, reminders=command.reminders, now_unix_s=now_s)

    async def _skip(self, day: OnceDay, found: tuple[StandingOrder, ...]) -> AnswerPlan:
        """Leave out a day's runs. Raises OrderRefusal: there are none."""
        now_s, zone = self._keeper.clocks.unix(), self._keeper.book.zone
        named = find_day(day, now_s, zone)
        meant = [order for order in found if runs_on(order, named, now_s, zone)]
        if not meant:
            raise OrderRefusal("order_change_none", f"no run on {named}")
        for order in meant:
            await self._desk.skip(order.id, named)
        gone = tuple(order for order in meant if order.id not in self._keeper.book.orders)
        left = tuple(order for order in meant if order not in gone)
        told = [self._tell_done(done, orders).text
                for done, orders in (("removed", gone), ("skipped", left)) if orders]  # fmt: skip
        return AnswerPlan(text=join(told))

    def _tell_done(self, done: str, orders: tuple[StandingOrder, ...]) -> AnswerPlan:
        now = self._keeper.book.orders
        lines = join((self._desk.line(now.get(o.id, o)) for o in orders), "joint.name")
        return AnswerPlan(text=say(f"standing.{done}", lines=lines))

    def _read_until(self, command: ChangeOrders) -> float | None:
        """Return when a pause ends. Raises OrderRefusal: it is over, or there is no such time."""
        if command.until is None:
            return None
        rule = settle(command.until, self._keeper.clocks.unix(), self._keeper.book.zone)
        return rule.unix_s if isinstance(rule, AtRule) else None

    def _ask_which(self, command: ChangeOrders, found: tuple[StandingOrder, ...]) -> Clarify:
        until = command.until_words
        form = f"{command.act} order {{id}} {until}"
        if command.day is not None:
            form = f"{until}的{{id}}跳过" if has_chinese(until) else f"skip order {{id}} {until}"
        elif has_chinese(until):
            form = f"把任务{{id}}暂停{until}"
        options = tuple(
            Option(label=self._desk.line(order), text=form.format(id=order.id).strip())
            for order in found[:MOST_OFFERED]
        )
        lines = join((option.label for option in options), "joint.name")
        return Clarify(
            code=Code.AMBIGUOUS, question=say("standing.which", lines=lines), options=options
        )
