"""Decide what a person's words about kept orders change. Pure: told the orders and the time.

Law: the order that was spoken of last is meant where none is named; after a while, or where words
fit several, a person is asked, and each offer names its order. A refusal changes nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from typing import TYPE_CHECKING, Any

from planner.language.folding import has_chinese
from planner.language.schedule import ChangeOrders, CorrectOrder, Delay, RemindAgain, Retime
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder, judge_quiet
from planner.orders.retiming import can_take, correct_rule, fits_time
from planner.orders.rule import days_left_out, find_day, next_due, runs_on, settle
from planner.orders.selection import is_all, pick, select
from planner.plan.timing import AtRule, InRule

if TYPE_CHECKING:
    from planner.language.schedule import OrderChange
    from planner.orders.order import StandingOrder
    from planner.orders.scheduler import OrderBook

    Orders = tuple[StandingOrder, ...]

SPOKEN_S = 600.0
"""An order that was given, changed or told so long ago is still "it"."""
FIRED_S = 1800.0
"""A reminder that came so long ago may be asked for again."""
AGAIN_S = 600.0
"""What "snooze" means without a time; the answer tells it."""
MOST_SKIPPED = 100
"""Days of one order that may be left out at a time."""
_BEFORE = float("-inf")


@dataclass(frozen=True, slots=True)
class KeptOrders:
    """Hold what a decision rests on: the orders, the time, and what was said of them lately."""

    book: OrderBook
    now_s: float
    spoken_s: Mapping[str, float] = field(default_factory=dict)
    """When each was last changed."""
    reminded_s: Mapping[str, float] = field(default_factory=dict)
    """When each reminder's words were last told."""
    listed: tuple[str, ...] = ()
    """Those of the list that was told lately, in its order: "the second one"."""
    is_busy: bool = False
    """A goal is under way, which "five more minutes" may be about."""

    @property
    def live(self) -> Orders:
        """Return the orders that have not ended."""
        return tuple(order for order in self.book.orders.values() if not order.ended)

    def is_recent(self, order: StandingOrder) -> bool:
        """Return whether an order was spoken of a moment ago."""
        return self.now_s - self._when_spoken(order)[0] <= SPOKEN_S

    def spoken_of(self, orders: Orders) -> Orders:
        """Return the one of these that was spoken of last; all where that is too long ago."""
        recent = sorted((o for o in orders if self.is_recent(o)), key=self._when_spoken)
        return tuple(recent[-1:]) or orders

    def _when_spoken(self, order: StandingOrder) -> tuple[float, int]:
        return max(order.created_unix_s, self.spoken_s.get(order.id, 0.0)), order.number


@dataclass(frozen=True, slots=True)
class OrderEdit:
    """Hold what becomes of one order: its new fields, or None where it is removed."""

    order: str
    fields: Mapping[str, Any] | None
    told: str
    """What a person hears of it: removed, paused, resumed, skipped or changed."""


@dataclass(frozen=True, slots=True)
class OrderEdits:
    """Hold edits of orders that are kept, and orders that are given again."""

    edits: tuple[OrderEdit, ...] = ()
    given: tuple[NewOrder, ...] = ()


@dataclass(frozen=True, slots=True)
class WhichOrder:
    """Ask which of several is meant."""

    orders: Orders
    form: str
    """The sentence that an offer is, with a place for its order's number."""


@dataclass(frozen=True, slots=True)
class NoneSuch:
    """Say that no order is called so."""

    which: str


Decision = OrderEdits | WhichOrder | NoneSuch | OrderRefusal


def decide(
    command: ChangeOrders | CorrectOrder, kept: KeptOrders, answer: str | None = None
) -> Decision | None:
    """Return what words about kept orders change; None where they are about no order.

    Args:
        command: what was said.
        kept: the orders, and the time.
        answer: which of several was said to be meant, after a question.
    """
    try:
        if isinstance(command, ChangeOrders):
            return _change(command, kept, answer)
        if isinstance(command.change, RemindAgain):
            return _remind_again(command.change, kept)
        return _correct(command, kept, answer)
    except OrderRefusal as refused:
        return refused


def pause(
    order: StandingOrder, now_s: float, *, paused: bool, until_s: float | None = None
) -> OrderEdit:
    """Return an order paused (until then, where that is said), or resumed.

    What was due meanwhile is not told. One that is on already gets its skipped days back.

    Raises:
        OrderRefusal: ``order_ended``.
    """
    _judge_live(order)
    handled_s = order.handled_unix_s
    if order.paused and not paused:
        handled_s = max(handled_s, now_s)
    fields = {
        "paused": paused, "resume_unix_s": until_s if paused else None, "handled_unix_s": handled_s,
        "skipped": order.skipped if order.paused or paused else (),
    }  # fmt: skip
    return OrderEdit(order.id, fields, "paused" if paused else "resumed")


def skip(order: StandingOrder, day: date, kept: KeptOrders) -> OrderEdit:
    """Return an order with a day left out; one that is due on that day alone is removed.

    Raises:
        OrderRefusal: ``order_ended``, ``order_change_none`` (it has no run on that day),
            ``order_skips_full``.
    """
    _judge_live(order)
    now_s, zone = kept.now_s, kept.book.zone
    if not runs_on(order, day, now_s, zone):
        raise OrderRefusal("order_change_none", f"no run on {day}")
    skipped = days_left_out(order, day, now_s, zone)
    if len(skipped) > MOST_SKIPPED:
        raise OrderRefusal("order_skips_full", order.id, most=MOST_SKIPPED)
    if order.is_once:
        return OrderEdit(order.id, None, "removed")
    return OrderEdit(order.id, {"skipped": tuple(skipped)}, "skipped")


def _move(order: StandingOrder, change: OrderChange, kept: KeptOrders) -> OrderEdits:
    """Return an order with another rule, made of the one that it has. Raises OrderRefusal."""
    _judge_live(order)
    rule = correct_rule(order.rule, change, kept.now_s, kept.book.zone)
    judge_quiet(rule, kept.book, kept.now_s)
    fields = {
        "rule": rule, "handled_unix_s": max(order.handled_unix_s, kept.now_s),
        "text": order.reminder or order.order,  # the sentence would tell the old time
    }  # fmt: skip
    return OrderEdits((OrderEdit(order.id, fields, "changed"),))


def _judge_live(order: StandingOrder) -> None:
    if order.ended:
        raise OrderRefusal("order_ended", order.id)


def _select(which: str, kept: KeptOrders, *, reminders: bool = False) -> Orders:
    """Return the orders that words name: by their place in a list that was told, or else."""
    listed = tuple(kept.book.orders[name] for name in kept.listed)
    placed = (pick(listed, f"the {which} one") or pick(listed, which)) if which else ()
    return placed or select(
        kept.live, which, kept.book.zone, reminders=reminders, now_unix_s=kept.now_s
    )


def _pick_answer(found: Orders, answer: str | None, kept: KeptOrders) -> Orders:
    if answer is None:
        return found
    return pick(found, answer) or select(
        found, answer, kept.book.zone, reminders=False, now_unix_s=kept.now_s
    )


def _change(
    command: ChangeOrders, kept: KeptOrders, answer: str | None
) -> OrderEdits | WhichOrder | NoneSuch | None:
    now_s, zone = kept.now_s, kept.book.zone
    found = _select(command.which, kept, reminders=command.reminders)
    day = None if command.day is None else find_day(command.day, now_s, zone)
    due = tuple(o for o in found if day is not None and runs_on(o, day, now_s, zone))
    if day is not None and len(found) > 1:
        found = due or found
    if command.is_spoken:
        found = kept.spoken_of(found)
    found = _pick_answer(found, answer, kept)
    if not found:
        return NoneSuch(command.which) if command.is_sure else None
    is_one = bool(command.which) or command.is_single or command.is_spoken
    if len(found) > 1 and is_one and not (command.is_every or is_all(answer)):
        return WhichOrder(found, _form_of(command))
    if day is not None:
        meant = tuple(order for order in found if order in due)
        if not meant:
            raise OrderRefusal("order_change_none", f"no run on {day}")
        return OrderEdits(tuple(skip(order, day, kept) for order in meant))
    if command.act == "remove":
        return OrderEdits(tuple(OrderEdit(order.id, None, "removed") for order in found))
    until = settle(command.until, now_s, zone) if command.until is not None else None
    until_s = until.unix_s if isinstance(until, AtRule) else None
    paused = command.act == "pause"
    return OrderEdits(tuple(pause(o, now_s, paused=paused, until_s=until_s) for o in found))


def _form_of(command: ChangeOrders) -> str:
    until = command.until_words
    if command.day is not None:
        return f"{until}的{{id}}跳过" if has_chinese(until) else f"skip order {{id}} {until}"
    return (
        f"把任务{{id}}暂停{until}" if has_chinese(until) else f"{command.act} order {{id}} {until}"
    )


def _correct(
    command: CorrectOrder, kept: KeptOrders, answer: str | None
) -> OrderEdits | WhichOrder | NoneSuch | None:
    zone, change = kept.book.zone, command.change
    found = _select(command.which, kept) if command.which else kept.live
    if not command.which and isinstance(change, Retime) and change.instead_of:
        due = {o.id: next_due(o.rule, o.handled_unix_s, zone) for o in found}
        found = tuple(o for o in found if fits_time(o.rule, change.instead_of, due[o.id], zone))
    able = tuple(o for o in found if can_take(o.rule, change, kept.now_s, zone))
    if command.which:
        found = able or found
    else:  # one that can't be changed so says why
        recent = tuple(o for o in found if kept.is_recent(o))
        found = kept.spoken_of(tuple(o for o in recent if o in able) or recent or able)
    found = _pick_answer(found, answer, kept)
    if not found:
        return NoneSuch(command.which) if command.is_sure else None
    is_meant = bool(command.which) or answer is not None or kept.is_recent(found[0])
    if len(found) > 1 or not is_meant:
        return WhichOrder(found, f"change order {{id}}: {command.words}")
    return _move(found[0], change, kept)


def _remind_again(change: RemindAgain, kept: KeptOrders) -> OrderEdits | None:
    """Remind again of what was told last; else move the one reminder that is waited for."""
    later = Delay(change.seconds if change.seconds is not None else AGAIN_S)
    reminders = [o for o in kept.book.orders.values() if o.reminder is not None]
    told_s = {o.id: kept.reminded_s.get(o.id, _BEFORE) for o in reminders}
    last_s = max(told_s.values(), default=_BEFORE)
    if not 0.0 <= kept.now_s - last_s <= FIRED_S:
        waiting = tuple(o for o in reminders if not o.ended and o.is_once)
        meant = kept.spoken_of(waiting)
        return _move(meant[0], later, kept) if len(meant) == 1 and not kept.is_busy else None
    edits: tuple[OrderEdit, ...] = ()
    given: tuple[NewOrder, ...] = ()
    for order in reminders:
        if last_s - told_s[order.id] >= 1.0:
            continue
        again = next((o for o in kept.live if _is_again(o, order, last_s)), None)
        if again is not None:  # asked for already, since these words were told
            edits += _move(again, later, kept).edits
            continue
        new = NewOrder(InRule(seconds=later.seconds), order.order, order.language, order.text,
                       reminder=order.reminder, source=order.source)  # fmt: skip
        given = (*given, new)
    return OrderEdits(edits, given)


def _is_again(order: StandingOrder, told: StandingOrder, told_s: float) -> bool:
    same = order.is_once and order.reminder == told.reminder
    return same and order.created_unix_s >= told_s
