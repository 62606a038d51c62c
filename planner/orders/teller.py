"""Answer what is asked about standing orders: which there are, when, how long is left, one day's.

Reads the order book and the clock; changes nothing.
"""

from __future__ import annotations

from datetime import date, datetime, time, timedelta
from typing import TYPE_CHECKING

from planner.language.catalogue import list_names, say
from planner.orders.selection import select
from planner.orders.skipping import coming_runs, find_day, next_run
from planner.orders.telling import (
    MOST_TOLD,
    tell_deed,
    tell_kept,
    tell_list,
    tell_order,
    tell_rule,
    tell_time,
)
from planner.plan.timing import AtRule

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.language.schedule import ListOrders
    from planner.orders.keeper import OrderKeeper
    from planner.orders.order import StandingOrder
    from planner.plan import Bilingual
    from planner.site.site_view import SiteView

LISTED_S = 600.0
"""For so long after a list "the second one" is of it."""
MOST_A_DAY = 3
"""Runs of one order that are told one by one; of more the rule is told."""


class OrderTeller:
    """Say in words what is kept."""

    def __init__(self, keeper: OrderKeeper, facts: Callable[[], SiteView]) -> None:
        """Take the keeper, and how the site is read as it is now."""
        self._keeper, self._facts = keeper, facts
        self._listed: tuple[str, ...] = ()
        self._listed_s = float("-inf")

    @property
    def last_list(self) -> tuple[StandingOrder, ...]:
        """Return the orders that were told in a list lately, in its order: "the second one"."""
        if not 0.0 <= self._now_s - self._listed_s <= LISTED_S:
            return ()
        live = self._keeper.book.orders
        gone = any(name not in live for name in self._listed)
        return () if gone else tuple(live[name] for name in self._listed)

    def _list(self, orders: tuple[StandingOrder, ...]) -> Bilingual:
        self._listed, self._listed_s = tuple(order.id for order in orders), self._now_s
        return tell_list(tuple(self.line(order) for order in orders))

    def tell(self, asked: ListOrders) -> Bilingual | None:
        """Answer a question; None where it may be about something else and no order fits."""
        live = tuple(o for o in self._keeper.book.orders.values() if not o.ended)
        zone = self._keeper.book.zone
        if asked.day is not None:
            return self._tell_day(live, asked)
        if asked.which or asked.reminders:
            found = select(live, asked.which, zone, reminders=asked.reminders)
        else:
            found = live
        if asked.next_runs:
            return self._tell_next(found, asked)
        if not found and asked.which and live:
            return say("standing.no_such", which=asked.which[:80], known=self.tell_all())
        return self._list(found)

    def tell_all(self) -> Bilingual:
        """Return all orders in words."""
        live = [o for o in self._keeper.book.orders.values() if not o.ended]
        return tell_list(tuple(self.line(order) for order in live))

    def line(self, order: StandingOrder) -> Bilingual:
        """Return an order in one line."""
        return tell_order(self._facts(), order, self._keeper.book.zone, self._now_s)

    def tell_one(self, order: StandingOrder) -> Bilingual:
        """Return what a person hears when an order is taken."""
        book, now_s = self._keeper.book, self._now_s
        due_s = book.due.get(order.id, next_run(order, now_s, book.zone))
        return tell_kept(self._facts(), order, due_s, book.zone, now_s)

    @property
    def _now_s(self) -> float:
        return self._keeper.clocks.unix()

    def _tell_next(self, found: tuple[StandingOrder, ...], asked: ListOrders) -> Bilingual | None:
        """Return when these are due next, the soonest first."""
        due = self._keeper.book.due
        waiting = sorted((o for o in found if o.id in due), key=lambda o: (due[o.id], o.number))
        if not (asked.is_sure or asked.which):  # "how long is left?": of what was asked for once
            waiting = [o for o in waiting if isinstance(o.rule, AtRule)]
        if waiting:
            lines = [self._line_left(order, due[order.id]) for order in waiting[:MOST_TOLD]]
            return say("standing.next_runs", lines=list_names(lines, "joint.name"))
        if not asked.is_sure:
            return None
        if found:  # paused, or upon an event
            return tell_list(tuple(self.line(order) for order in found))
        return say("standing.no_reminders") if asked.reminders else self.tell_all()

    def _line_left(self, order: StandingOrder, due_s: float) -> Bilingual:
        when = tell_time(due_s, self._keeper.book.zone, self._now_s)
        left = tell_left(due_s - self._now_s)
        deed = tell_deed(self._facts(), order)
        return say("standing.line_left", id=order.id, when=when, left=left, deed=deed)

    def _tell_day(self, live: tuple[StandingOrder, ...], asked: ListOrders) -> Bilingual | None:
        """Return what is due on one day, in its order."""
        zone, now_s = self._keeper.book.zone, self._now_s
        now = datetime.fromtimestamp(now_s, zone)
        if asked.day is None:
            return None
        day = find_day(asked.day, now_s, zone)
        begin_s = max(now_s, datetime.combine(day, time(), zone).timestamp() - 1e-3)
        end_s = datetime.combine(day + timedelta(days=1), time(), zone).timestamp()
        told: list[tuple[float, Bilingual]] = []
        for order in live:
            if order.paused and not (order.resume_unix_s and order.resume_unix_s < end_s):
                continue
            since_s = max(begin_s, order.handled_unix_s, order.resume_unix_s or 0.0)
            runs = [s for s in coming_runs(order, since_s, zone, MOST_A_DAY + 1) if s < end_s]
            told += self._lines_of_day(order, runs)
        name = self._name_of_day(day, now.date())
        if not told:
            return say("standing.day_free", day=name) if asked.is_sure or live else None
        lines = [line for _, line in sorted(told, key=lambda each: each[0])]
        return say("standing.day_list", day=name, lines=list_names(lines, "joint.name"))

    def _lines_of_day(
        self, order: StandingOrder, runs: list[float]
    ) -> list[tuple[float, Bilingual]]:
        zone, deed = self._keeper.book.zone, tell_deed(self._facts(), order)
        if len(runs) > MOST_A_DAY:
            rule = tell_rule(order.rule, zone, self._now_s)
            return [(runs[0], say("standing.line", id=order.id, when=rule, deed=deed))]
        clock = [f"{datetime.fromtimestamp(run_s, zone):%H:%M}" for run_s in runs]
        return [
            (run_s, say("standing.line", id=order.id, when=at, deed=deed))
            for run_s, at in zip(runs, clock, strict=True)
        ]

    def _name_of_day(self, day: date, today: date) -> Bilingual:
        ahead = (day - today).days
        if ahead in (0, 1):
            return say("standing.day_today" if ahead == 0 else "standing.day_tomorrow")
        weekday = say(f"standing.day_{day.isoweekday() % 7}")
        return say("standing.day_date", weekday=weekday, date=day.isoformat())


def tell_left(seconds: float) -> Bilingual:
    """Return how long it is until then, in words."""
    minutes = round(seconds / 60.0)
    if seconds < 60.0:
        return say("standing.left_seconds", seconds=max(0, round(seconds)))
    if minutes < 60:
        return say("standing.left_minutes", minutes=minutes)
    hours, rest = divmod(minutes, 60)
    if hours < 48:
        code = "standing.left_hours" if rest else "standing.left_whole_hours"
        return say(code, hours=hours, minutes=rest) if rest else say(code, hours=hours)
    return say("standing.left_days", days=round(hours / 24.0))
