"""Change the standing orders that a person means: remove, pause, resume, skip a day, move, snooze.

Law: the order that was spoken of last is meant where none is named; after a while, or where words
fit several, a person is asked, and each offer names its order. A refusal changes nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from planner.language.catalogue import join, message, say
from planner.language.folding import has_chinese
from planner.language.schedule import ChangeOrders, CorrectOrder, Delay, RemindAgain, Retime
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder
from planner.orders.retiming import can_take, correct_rule, fits_time
from planner.orders.rule import next_due, settle
from planner.orders.selection import is_all, pick, select
from planner.orders.skipping import find_day, runs_on
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, Language, Option, Refuse
from planner.plan.timing import AtRule, InRule

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import date

    from planner.language.schedule import OrderChange
    from planner.language.schedule.parts import OnceDay
    from planner.orders.keeper import OrderKeeper
    from planner.orders.order import StandingOrder
    from planner.plan.timing import Rule

    Orders = tuple[StandingOrder, ...]

SPOKEN_S = 600.0
"""An order that was given, changed or told so long ago is still "it"."""
FIRED_S = 1800.0
"""A reminder that came so long ago may be asked for again."""
AGAIN_S = 600.0
"""What "snooze" means without a time; the answer tells it."""
MOST_OFFERED = 8


class ChangeDesk(Protocol):
    """Take, change and tell orders, as ``OrderIntake`` does."""

    async def give(self, new: NewOrder, goal_id: str) -> StandingOrder: ...

    async def pause(
        self, order_id: str, *, paused: bool = True, until_s: float | None = None
    ) -> StandingOrder: ...

    async def skip(self, order_id: str, day: date) -> StandingOrder: ...

    async def move(self, order_id: str, rule: Callable[[Rule], Rule]) -> StandingOrder: ...

    async def remove(self, order_id: str) -> StandingOrder: ...

    def line(self, order: StandingOrder) -> Bilingual: ...

    def tell(self) -> Bilingual: ...

    def tell_one(self, order: StandingOrder) -> Bilingual: ...


class OrderChanger:
    """Carry out what a person said about orders that are kept; remember which were spoken of."""

    def __init__(
        self, keeper: OrderKeeper, desk: ChangeDesk, listed: Callable[[], Orders] = lambda: ()
    ) -> None:
        """Take the keeper, who changes orders on disk and tells them, and what was listed last."""
        self._keeper, self._desk, self._listed = keeper, desk, listed
        self._spoken: dict[str, float] = {}

    def note(self, order_id: str) -> None:
        """Remember that an order is spoken of now."""
        live = self._keeper.book.orders
        self._spoken = {name: s for name, s in self._spoken.items() if name in live}
        self._spoken[order_id] = self._now_s

    async def take(
        self,
        command: ChangeOrders | CorrectOrder,
        language: Language,
        answer: str | None,
        goal_id: str = "",
        *,
        is_busy: bool = False,
    ) -> AnswerPlan | Clarify | Refuse | None:
        """Change what is meant and say so; None where the sentence is about no order.

        Args:
            command: what was said.
            language: of the person.
            answer: which of several was said to be meant, after a question.
            goal_id: to whose account a thought goes.
            is_busy: a goal is under way, which "five more minutes" may be about.
        """
        try:
            if isinstance(command, CorrectOrder):
                if isinstance(command.change, RemindAgain):
                    return await self._remind_again(command.change, goal_id, is_busy=is_busy)
                return await self._correct(command, language, answer)
            return await self._change(command, language, answer)
        except OrderRefusal as refused:
            why = message(Code.ORDER_NOT_KEPT, why=refused.message)
            return Refuse(code=Code.ORDER_NOT_KEPT, reason=why)

    @property
    def _now_s(self) -> float:
        return self._keeper.clocks.unix()

    @property
    def _live(self) -> Orders:
        return tuple(o for o in self._keeper.book.orders.values() if not o.ended)

    # Which --------------------------------------------------------------------------------------

    def _select(self, which: str, *, reminders: bool = False) -> Orders:
        """Return the orders that words name: by their place in a list that was told, or else."""
        listed = self._listed()
        placed = (pick(listed, f"the {which} one") or pick(listed, which)) if which else ()
        zone = self._keeper.book.zone
        return placed or select(
            self._live, which, zone, reminders=reminders, now_unix_s=self._now_s
        )

    def _find_answered(self, found: Orders, answer: str) -> Orders:
        zone = self._keeper.book.zone
        return pick(found, answer) or select(
            found, answer, zone, reminders=False, now_unix_s=self._now_s
        )

    def _spoken_of(self, orders: Orders) -> Orders:
        """Return the one of these that was spoken of last; all where that is too long ago."""
        recent = sorted((o for o in orders if self._is_recent(o)), key=self._spoken_s)
        return tuple(recent[-1:]) or orders

    def _spoken_s(self, order: StandingOrder) -> tuple[float, int]:
        return max(order.created_unix_s, self._spoken.get(order.id, 0.0)), order.number

    def _is_recent(self, order: StandingOrder) -> bool:
        return self._now_s - self._spoken_s(order)[0] <= SPOKEN_S

    def _no_such(self, which: str, language: Language) -> AnswerPlan:
        which = which or ("reminder" if language is Language.EN else "提醒")
        known = self._desk.tell()
        return AnswerPlan(text=say("standing.no_such", which=which[:80], known=known))

    def _ask_which(self, found: Orders, form: str) -> Clarify:
        options = tuple(
            Option(label=self._desk.line(order), text=form.format(id=order.id).strip())
            for order in found[:MOST_OFFERED]
        )
        lines = join((option.label for option in options), "joint.name")
        question = say("standing.which", lines=lines)
        return Clarify(code=Code.AMBIGUOUS, question=question, options=options)

    # Remove, pause, resume, skip ----------------------------------------------------------------

    async def _change(
        self, command: ChangeOrders, language: Language, answer: str | None
    ) -> AnswerPlan | Clarify | None:
        found = self._select(command.which, reminders=command.reminders)
        day = None if command.day is None else self._day(command.day)
        if day is not None and len(found) > 1:
            now_s, zone = self._now_s, self._keeper.book.zone
            found = tuple(o for o in found if runs_on(o, day, now_s, zone)) or found
        if command.is_spoken:
            found = self._spoken_of(found)
        if answer is not None:
            found = self._find_answered(found, answer)
        if not found:
            return self._no_such(command.which, language) if command.is_sure else None
        is_one = bool(command.which) or command.is_single or command.is_spoken
        if len(found) > 1 and is_one and not (command.is_every or is_all(answer)):
            return self._ask_which(found, _form_of(command))
        if day is not None:
            return await self._skip(day, found)
        until_s = self._read_until(command)
        for order in found:
            if command.act == "remove":
                await self._desk.remove(order.id)
            else:
                await self._desk.pause(order.id, paused=command.act == "pause", until_s=until_s)
        done = {"remove": "removed", "pause": "paused", "resume": "resumed"}[command.act]
        return AnswerPlan(text=self._tell_done(done, found))

    def _day(self, said: OnceDay) -> date:
        return find_day(said, self._now_s, self._keeper.book.zone)

    async def _skip(self, day: date, found: Orders) -> AnswerPlan:
        """Leave out a day's runs. Raises OrderRefusal: there are none."""
        now_s, zone = self._now_s, self._keeper.book.zone
        meant = tuple(order for order in found if runs_on(order, day, now_s, zone))
        if not meant:
            raise OrderRefusal("order_change_none", f"no run on {day}")
        for order in meant:
            await self._desk.skip(order.id, day)
        gone = tuple(order for order in meant if order.id not in self._keeper.book.orders)
        left = tuple(order for order in meant if order not in gone)
        told = [self._tell_done(done, orders)
                for done, orders in (("removed", gone), ("skipped", left)) if orders]  # fmt: skip
        return AnswerPlan(text=join(told))

    def _tell_done(self, done: str, orders: Orders) -> Bilingual:
        now = self._keeper.book.orders
        lines = join((self._desk.line(now.get(o.id, o)) for o in orders), "joint.name")
        return say(f"standing.{done}", lines=lines)

    def _read_until(self, command: ChangeOrders) -> float | None:
        """Return when a pause ends. Raises OrderRefusal: it is over, or there is no such time."""
        if command.until is None:
            return None
        rule = settle(command.until, self._now_s, self._keeper.book.zone)
        return rule.unix_s if isinstance(rule, AtRule) else None

    # Move ---------------------------------------------------------------------------------------

    async def _correct(
        self, command: CorrectOrder, language: Language, answer: str | None
    ) -> AnswerPlan | Clarify | None:
        found = self._select(command.which) if command.which else self._live
        if not command.which and isinstance(command.change, Retime) and command.change.instead_of:
            found = tuple(o for o in found if self._is_at(o, command.change))
        able = tuple(o for o in found if self._can_take(o, command.change))
        if command.which:
            found = able or found
        else:  # one that can't be changed so says why
            recent = tuple(o for o in found if self._is_recent(o))
            found = self._spoken_of(tuple(o for o in recent if o in able) or recent or able)
        if answer is not None:
            found = self._find_answered(found, answer)
        if not found:
            return self._no_such(command.which, language) if command.is_sure else None
        is_meant = bool(command.which) or answer is not None or self._is_recent(found[0])
        if len(found) > 1 or not is_meant:
            return self._ask_which(found, f"change order {{id}}: {command.words}")
        return await self._move(found[0], command.change)

    async def _move(self, order: StandingOrder, change: OrderChange) -> AnswerPlan:
        zone = self._keeper.book.zone
        now_s = self._now_s
        changed = await self._desk.move(order.id, lambda r: correct_rule(r, change, now_s, zone))
        said = self._desk.line(changed) if changed.paused else self._desk.tell_one(changed)
        return AnswerPlan(text=say("standing.changed", line=said))

    def _is_at(self, order: StandingOrder, change: Retime) -> bool:
        zone = self._keeper.book.zone
        due_s = next_due(order.rule, order.handled_unix_s, zone)
        return fits_time(order.rule, change.instead_of, due_s, zone)

    def _can_take(self, order: StandingOrder, change: OrderChange) -> bool:
        return can_take(order.rule, change, self._now_s, self._keeper.book.zone)

    # Again --------------------------------------------------------------------------------------

    async def _remind_again(
        self, change: RemindAgain, goal_id: str, *, is_busy: bool
    ) -> AnswerPlan | None:
        """Remind again of what was told last; else move the one reminder that is waited for."""
        seconds = change.seconds if change.seconds is not None else AGAIN_S
        reminders = [o for o in self._keeper.book.orders.values() if o.reminder is not None]
        told_s = {o.id: self._keeper.reminded_unix_s(o.id) for o in reminders}
        last_s = max(told_s.values(), default=float("-inf"))
        if 0.0 <= self._now_s - last_s <= FIRED_S:
            together = [o for o in reminders if last_s - told_s[o.id] < 1.0]
            return AnswerPlan(
                text=join([await self._tell_again(o, last_s, seconds, goal_id) for o in together])
            )
        waiting = tuple(o for o in reminders if not o.ended and isinstance(o.rule, AtRule))
        meant = self._spoken_of(waiting)
        if len(meant) != 1 or is_busy:
            return None
        return await self._move(meant[0], Delay(seconds))

    async def _tell_again(
        self, order: StandingOrder, told_s: float, seconds: float, goal_id: str
    ) -> Bilingual:
        for other in self._live:  # asked for again already, since these words were told
            same = isinstance(other.rule, AtRule) and other.reminder == order.reminder
            if same and other.created_unix_s >= told_s:
                return (await self._move(other, Delay(seconds))).text
        again = NewOrder(
            InRule(seconds=seconds), order.order, order.language, order.text,
            reminder=order.reminder, source=order.source,
        )  # fmt: skip
        return self._desk.tell_one(await self._desk.give(again, goal_id))


def _form_of(command: ChangeOrders) -> str:
    """Return the sentence that an offer is, with a place for its order's number."""
    until = command.until_words
    if command.day is not None:
        return f"{until}的{{id}}跳过" if has_chinese(until) else f"skip order {{id}} {until}"
    return (
        f"把任务{{id}}暂停{until}" if has_chinese(until) else f"{command.act} order {{id}} {until}"
    )
