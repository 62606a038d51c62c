"""Take standing orders from a calendar file: told first, kept by a yes to just what was told.

Law: nothing of a file is kept until a person has said yes to it; the yes carries the digest of what
was told, so that a file, a clock or a thought that has changed since is told anew.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.orders.calendar_orders import read_orders
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder, OrderQuestion, tell_question
from planner.orders.rule import settle, upcoming
from planner.plan.timing import EventRule, Rule

if TYPE_CHECKING:
    from datetime import tzinfo

    from planner.orders.intake import OrderIntake
    from planner.orders.keeper import OrderKeeper
    from planner.orders.order import StandingOrder
    from planner.plan import StepRecord


@dataclass(frozen=True, slots=True)
class ImportedEntry:
    """Hold one entry of a file: the order that it would be, or why it is none."""

    name: str
    new: NewOrder | None = None
    rule: Rule | None = None
    allowed: tuple[StepRecord, ...] = ()
    refused: OrderRefusal | None = None


@dataclass(frozen=True, slots=True)
class ImportedCalendar:
    """Hold what a file would have kept, and what a yes to it must name."""

    proposals: tuple[ImportedEntry, ...]
    digest: str


async def propose(
    text: str, keeper: OrderKeeper, desk: OrderIntake, source: str, goal_id: str
) -> ImportedCalendar:
    """Return what a file wants kept; nothing is.

    Raises:
        OrderRefusal: the file can't be read at all.
    """
    now_s, zone = keeper.clocks.unix(), keeper.book.zone
    proposals = []
    for name, read in read_orders(text, zone, now_s, source):
        if isinstance(read, OrderRefusal):
            proposals.append(ImportedEntry(name, refused=read))
            continue
        try:
            rule = settle(read.when, now_s, zone)
            kept = keeper.book.orders.values()
            if any(_is_same(order, read, rule, zone, now_s) for order in kept):
                raise OrderRefusal("calendar_kept", name)
            proposals.append(ImportedEntry(name, read, rule, await desk.weigh(read, goal_id)))
        except OrderRefusal as refused:
            proposals.append(ImportedEntry(name, refused=refused))
        except OrderQuestion as question:
            said = tell_question(question.asked)
            words = read.order[:120]
            unclear = OrderRefusal("order_not_understood", said.en, order=words, why=said)
            proposals.append(ImportedEntry(name, refused=unclear))
    shown = [(p.new, p.rule, p.allowed) for p in proposals if p.new is not None]
    return ImportedCalendar(tuple(proposals), hashlib.sha256(repr(shown).encode()).hexdigest()[:32])


def _is_same(order: StandingOrder, new: NewOrder, rule: Rule, zone: tzinfo, now_s: float) -> bool:
    """Tell whether an order does the same at the same times, to the second."""
    if order.ended or (order.order, order.reminder) != (new.order, new.reminder):
        return False
    if order.is_event or isinstance(rule, EventRule):
        return order.rule == rule
    runs = [list(map(round, upcoming(each, now_s, zone, 3))) for each in (order.rule, rule)]
    return runs[0] == runs[1]


async def keep_proposed(
    imported: ImportedCalendar, digest: str, desk: OrderIntake, goal_id: str
) -> tuple[StandingOrder, ...]:
    """Keep what was told and agreed to; what is kept already stays as it is.

    Raises:
        OrderRefusal: ``calendar_changed``: the yes is to something else; or as a new order's.
    """
    if digest != imported.digest:
        raise OrderRefusal("calendar_changed", "the yes is to something else")
    return tuple(
        [
            await desk.give(each.new, goal_id, allowed=each.allowed)
            for each in imported.proposals
            if each.new is not None
        ]
    )
