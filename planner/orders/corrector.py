"""Correct standing orders as a person says: find the one that is meant, change it, tell it anew.

Law: the order that was spoken of last is meant, where none is named; after a while, or where
several fit, a person is asked, and each offer names its order. A refusal changes nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from planner.language.catalogue import join, message, raw, say
from planner.language.schedule import (
    CorrectOrder,
    Delay,
    KeepHalf,
    LeaveOutDays,
    RemindAgain,
    Retime,
)
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder
from planner.orders.order import StandingOrder
from planner.orders.retiming import can_take, correct_rule, fits_time, split_days
from planner.orders.rule import next_due
from planner.orders.selection import pick, select
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, Language, Option, Refuse
from planner.plan.timing import AtRule, InRule
from planner.state_database import StateUnavailable

if TYPE_CHECKING:
    from planner.orders.keeper import OrderKeeper
    from planner.plan.timing import CronRule, Rule

SPOKEN_S = 600.0
"""An order that was given, changed or told so long ago is still "it"."""
FIRED_S = 1800.0
"""A reminder that came so long ago may be asked for again."""
AGAIN_S = 600.0
"""What "snooze" means without a time; the answer tells it."""
MOST_OFFERED = 8


class Desk(Protocol):
    """Take and tell orders, as ``OrderIntake`` does."""

    async def give(self, new: NewOrder, goal_id: str) -> StandingOrder: ...

    def judge_quiet(self, rule: Rule, now_s: float) -> None: ...

    def line(self, order: StandingOrder) -> Bilingual: ...

    def tell(self) -> Bilingual: ...

    def tell_one(self, order: StandingOrder) -> Bilingual: ...


class OrderCorrector:
    """Carry out corrections; remember which orders were spoken of."""

    def __init__(self, keeper: OrderKeeper, desk: Desk) -> None:
        """Take the keeper, and who takes new orders and tells them."""
        self._keeper, self._desk = keeper, desk
        self._spoken: dict[str, float] = {}

    def note(self, order_id: str) -> None:
        """Remember that an order is spoken of now."""
        live = self._keeper.book.orders
        self._spoken = {name: s for name, s in self._spoken.items() if name in live}
        self._spoken[order_id] = self._keeper.clocks.unix()

    async def take(
        self, command: CorrectOrder, language: Language, goal_id: str, *, is_busy: bool
    ) -> AnswerPlan | Clarify | Refuse | None:
        """Carry a correction out and say what came of it; None where it is about no order.

        Args:
            command: the correction.
            language: of the person.
            goal_id: to whose account a thought goes.
            is_busy: a goal is under way, which "five more minutes" may be about.
        """
        try:
            if isinstance(command.change, RemindAgain) and not command.which:
                return await self._remind_again(command.change, language, goal_id, is_busy=is_busy)
            return await self._change(command, language, goal_id)
        except OrderRefusal as refused:
            why = message(Code.ORDER_NOT_KEPT, why=refused.message)
            return Refuse(code=Code.ORDER_NOT_KEPT, reason=why)

    def pick(self, command: CorrectOrder, answer: str) -> str | None:
        """Return the id of the order that an answer picks of those that a correction may mean."""
        found = self._find_named(command) if command.which else self._spoken_of(command)
        picked = pick(found, answer)
        return picked[0].id if len(picked) == 1 else None

    # Which one ----------------------------------------------------------------------------------

    async def _change(
        self, command: CorrectOrder, language: Language, goal_id: str
    ) -> AnswerPlan | Clarify | Refuse | None:
        found = self._find_named(command) if command.which else self._spoken_of(command)
        if not found:
            if not command.is_sure:
                return None
            none = say("standing.no_such", which=command.which[:80], known=self._desk.tell())
            return AnswerPlan(text=none)
        [first, *others] = found
        is_meant = bool(command.which) or self._is_recent(first)
        if isinstance(command.change, KeepHalf) and not is_meant:
            return None  # "in the afternoon": of something else
        if others or not is_meant:
            return self._ask_which(command, found)
        if isinstance(command.change, LeaveOutDays) and command.change.is_one:
            return self._ask_each(command.change, first, language)
        if (parted := split_days(first.rule, command.change, self._keeper.book.zone)) is not None:
            return await self._part(first, *parted, goal_id)
        changed = await self._apply(command, first)
        said = self._desk.line(changed) if changed.paused else self._desk.tell_one(changed)
        return AnswerPlan(text=say("standing.changed", line=said))

    def _find_named(self, command: CorrectOrder) -> tuple[StandingOrder, ...]:
        live = self._keeper.book.orders.values()
        now_s, zone = self._keeper.clocks.unix(), self._keeper.book.zone
        found = select(live, command.which, zone, reminders=False, now_unix_s=now_s)
        return self._that_can(command, found) or found

    def _spoken_of(self, command: CorrectOrder) -> tuple[StandingOrder, ...]:
        """Return the one order that was spoken of last, or all that may be meant."""
        live = tuple(o for o in self._keeper.book.orders.values() if not o.ended)
        if isinstance(command.change, Retime) and command.change.instead_of:
            live = tuple(o for o in live if self._is_at(o, command.change))
        able = self._that_can(command, live)
        recent = sorted((o for o in live if self._is_recent(o)), key=self._spoken_s)
        fitting = [order for order in recent if order in able]
        if fitting:
            return (fitting[-1],)
        return (recent[-1],) if recent else able  # one that can't be changed so says why

    def _is_at(self, order: StandingOrder, change: Retime) -> bool:
        zone = self._keeper.book.zone
        due_s = next_due(order.rule, order.handled_unix_s, zone)
        return fits_time(order.rule, change.instead_of, due_s, zone)

    def _that_can(
        self, command: CorrectOrder, orders: tuple[StandingOrder, ...]
    ) -> tuple[StandingOrder, ...]:
        now_s, zone = self._keeper.clocks.unix(), self._keeper.book.zone
        return tuple(o for o in orders if can_take(o.rule, command.change, now_s, zone))

    def _spoken_s(self, order: StandingOrder) -> tuple[float, int]:
        return max(order.created_unix_s, self._spoken.get(order.id, 0.0)), order.number

    def _is_recent(self, order: StandingOrder) -> bool:
        return self._keeper.clocks.unix() - self._spoken_s(order)[0] <= SPOKEN_S

    def _ask_which(self, command: CorrectOrder, found: tuple[StandingOrder, ...]) -> Clarify:
        options = tuple(
            Option(label=self._desk.line(o), text=f"change order {o.id}: {command.words}")
            for o in found[:MOST_OFFERED]
        )
        return self._ask(options)

    def _ask_each(self, change: LeaveOutDays, order: StandingOrder, language: Language) -> Clarify:
        """Ask about "not on Sunday": a single run can't be left out, each Sunday's can."""
        day = next(iter(change.days))
        name = raw(f"standing.day_{day}", language.value)
        words = raw("standing.leave_out_each", language.value).format(day=name)
        option = Option(label=self._desk.line(order), text=f"change order {order.id}: {words}")
        asked = say("standing.each_such_day", day=say(f"standing.day_{day}"))
        return Clarify(code=Code.AMBIGUOUS, question=asked, options=(option,))

    # Changing -----------------------------------------------------------------------------------

    async def _part(
        self, order: StandingOrder, others: CronRule, named: CronRule, goal_id: str
    ) -> AnswerPlan:
        """Give these days an order of their own. Raises OrderRefusal; nothing has changed then."""
        words = order.reminder or order.order
        new = NewOrder(named, order.order, order.language, words, reminder=order.reminder,
                       source=order.source)  # fmt: skip
        given = await self._desk.give(new, goal_id)
        async with self._keeper.lock:
            now_s = self._keeper.clocks.unix()
            try:
                left = await self._keeper.revise(
                    order.id, rule=others, text=words,
                    handled_unix_s=max(order.handled_unix_s, now_s),
                )  # fmt: skip
            except StateUnavailable as error:
                raise OrderRefusal("orders_unwritable", str(error)) from None
        both = join((self._desk.tell_one(left), self._desk.tell_one(given)))
        return AnswerPlan(text=say("standing.changed", line=both))

    async def _apply(self, command: CorrectOrder, order: StandingOrder) -> StandingOrder:
        """Change an order on disk. Raises OrderRefusal; nothing has changed then."""
        async with self._keeper.lock:
            kept = self._keeper.book.orders.get(order.id)
            if kept is None or kept.ended:
                raise OrderRefusal("order_ended", order.id)
            now_s, zone = self._keeper.clocks.unix(), self._keeper.book.zone
            rule = correct_rule(kept.rule, command.change, now_s, zone)
            self._desk.judge_quiet(rule, now_s)
            words = kept.reminder or kept.order  # the sentence would tell the old time
            try:
                changed = await self._keeper.revise(
                    kept.id, rule=rule, text=words, handled_unix_s=max(kept.handled_unix_s, now_s)
                )
            except StateUnavailable as error:
                raise OrderRefusal("orders_unwritable", str(error)) from None
        self.note(order.id)
        return changed

    # Again --------------------------------------------------------------------------------------

    async def _remind_again(
        self, change: RemindAgain, language: Language, goal_id: str, *, is_busy: bool
    ) -> AnswerPlan | Clarify | None:
        now_s = self._keeper.clocks.unix()
        seconds = change.seconds if change.seconds is not None else AGAIN_S
        reminders = [o for o in self._keeper.book.orders.values() if o.reminder is not None]
        told_s = {o.id: self._keeper.reminded_unix_s(o.id) for o in reminders}
        last_s = max(told_s.values(), default=float("-inf"))
        if 0.0 <= now_s - last_s <= FIRED_S:
            together = tuple(o for o in reminders if last_s - told_s[o.id] < 1.0)
            if len(together) > 1:
                return self._ask_again(together, seconds, language)
            if (later := self._asked_again(together[0], last_s)) is not None:
                changed = await self._apply(_delay(seconds), later)
                return AnswerPlan(text=say("standing.changed", line=self._desk.tell_one(changed)))
            again = NewOrder(
                InRule(seconds=seconds), together[0].order, together[0].language,
                together[0].text, reminder=together[0].reminder, source=together[0].source,
            )  # fmt: skip
            order = await self._desk.give(again, goal_id)
            return AnswerPlan(text=self._desk.tell_one(order))
        waiting = tuple(o for o in reminders if not o.ended and isinstance(o.rule, AtRule))
        if not waiting or is_busy:
            return None
        recent = [o for o in waiting if self._is_recent(o)]
        if len(waiting) > 1 and not recent:
            return self._ask_later(waiting, seconds, language)
        order = max(recent or waiting, key=self._spoken_s)
        changed = await self._apply(_delay(seconds), order)
        return AnswerPlan(text=say("standing.changed", line=self._desk.tell_one(changed)))

    def _asked_again(self, reminder: StandingOrder, told_s: float) -> StandingOrder | None:
        """Return the reminder that was asked for again already, since these words were told."""
        live = (o for o in self._keeper.book.orders.values() if not o.ended)
        same = (o for o in live if isinstance(o.rule, AtRule) and o.reminder == reminder.reminder)
        return next((o for o in same if o.created_unix_s >= told_s), None)

    def _ask_again(
        self, orders: tuple[StandingOrder, ...], seconds: float, language: Language
    ) -> Clarify:
        code = "standing.again_in"
        minutes = f"{seconds / 60.0:g}"
        options = tuple(
            Option(
                label=self._desk.line(order),
                text=raw(code, language.value).format(minutes=minutes, words=order.reminder),
            )
            for order in orders[:MOST_OFFERED]
        )
        return self._ask(options)

    def _ask_later(
        self, orders: tuple[StandingOrder, ...], seconds: float, language: Language
    ) -> Clarify:
        words = raw("standing.later_by", language.value).format(minutes=f"{seconds / 60.0:g}")
        options = tuple(
            Option(label=self._desk.line(order), text=f"change order {order.id}: {words}")
            for order in orders[:MOST_OFFERED]
        )
        return self._ask(options)

    def _ask(self, options: tuple[Option, ...]) -> Clarify:
        lines = join((option.label for option in options), "joint.name")
        question = say("standing.which", lines=lines)
        return Clarify(code=Code.AMBIGUOUS, question=question, options=options)


def _delay(seconds: float) -> CorrectOrder:
    return CorrectOrder(Delay(seconds), "")
