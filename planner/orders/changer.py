"""Remove, pause, resume and skip the standing orders that a person means, or ask which.

Law: words that fit several are asked about; a skip leaves out that day's runs and no other, so
where another run lies between, the person says whether that one may go too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from planner.language.catalogue import join, message, raw, say
from planner.language.folding import has_chinese
from planner.orders.errors import OrderRefusal
from planner.orders.rule import settle
from planner.orders.selection import is_all, pick, select
from planner.orders.skipping import DaySkip, SkipAct, skip_day
from planner.orders.telling import tell_time
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, Language, Option, Refuse
from planner.plan.timing import AtRule

if TYPE_CHECKING:
    from collections.abc import Callable

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
                return await self._skip(command, command.day, found, language)
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
            skips = {o.id: skip_day(o, command.day, now_s, zone) for o in found}
            found = tuple(o for o in found if skips[o.id].act is not SkipAct.NOTHING) or found
        if answer is None:
            return found
        picked = pick(found, answer)
        return picked or select(found, answer, zone, reminders=command.reminders, now_unix_s=now_s)

    async def _skip(
        self,
        command: ChangeOrders,
        day: OnceDay,
        found: tuple[StandingOrder, ...],
        language: Language,
    ) -> AnswerPlan | Clarify:
        """Leave out a day's runs. Raises OrderRefusal: there are none, or they are no clock's."""
        now_s, zone = self._keeper.clocks.unix(), self._keeper.book.zone
        skips = [(order, skip_day(order, day, now_s, zone)) for order in found]
        meant = [(order, skip) for order, skip in skips if skip.act is not SkipAct.NOTHING]
        if not meant:
            deaf = all(order.is_event for order in found)  # to pause it now is another thing
            raise OrderRefusal("order_change_unfit" if deaf else "order_change_none", "no such run")
        if any(skip.act is SkipAct.BETWEEN for _, skip in meant):
            if len(meant) > 1:
                return self._ask_which(command, tuple(order for order, _ in meant))
            return self._ask_pause(*meant[0], language)
        gone, paused = [], []
        for order, skip in meant:
            if skip.act is SkipAct.REMOVE:
                await self._desk.remove(order.id)
                gone.append(order)
            else:
                await self._desk.pause(order.id, until_s=skip.ends_s)
                paused.append(order)
        told = [self._tell_done(done, tuple(orders)).text
                for done, orders in (("removed", gone), ("paused", paused)) if orders]  # fmt: skip
        return AnswerPlan(text=join(told))

    def _ask_pause(self, order: StandingOrder, skip: DaySkip, language: Language) -> Clarify:
        """Ask about "not tomorrow" where a run of today would be left out as well."""
        now_s, zone = self._keeper.clocks.unix(), self._keeper.book.zone
        day = (skip.weekday + 1) % 7
        code, ends_code = f"standing.day_{day}", f"standing.day_{(day + 1) % 7}"
        name, ends = say(code), say(ends_code)
        pause = raw("standing.pause_until", language.value).format(
            id=order.id, day=raw(ends_code, language.value)
        )
        each = raw("standing.leave_out_each", language.value).format(day=raw(code, language.value))
        options = (
            Option(label=say("standing.option_pause", day=ends), text=pause),
            Option(
                label=say("standing.option_each", day=name),
                text=f"change order {order.id}: {each}",
            ),
        )
        asked = say("standing.skip_pauses", time=tell_time(skip.due_s, zone, now_s), day=name)
        return Clarify(code=Code.AMBIGUOUS, question=asked, options=options)

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
            form = f"skip order {{id}} {until}"
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
