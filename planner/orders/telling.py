"""Say what a standing order is, when it comes next, what became of it, and which are kept. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime, time, timedelta, tzinfo
from typing import TYPE_CHECKING

from planner.language.catalogue import build, join, list_names, raw, say, say_or_quote
from planner.language.plan_words import tell_steps
from planner.orders.rule import coming_runs, find_day, next_run
from planner.orders.selection import select
from planner.plan import CONTROL, Bilingual, Clarify, Code, Option, StepRecord, say_same
from planner.plan.slots import steps_of
from planner.plan.timing import AtRule, CronRule, EventRule, EveryRule, Rule

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.language.schedule import ListOrders
    from planner.language.schedule.parts import OnceDay
    from planner.orders.order import Firing, StandingOrder
    from planner.orders.scheduler import OrderBook
    from planner.site.site_view import SiteView

MOST_TOLD = 8
"""Orders that are listed in words; the page shows all."""
MOST_A_DAY = 3
"""Runs of one order that are told one by one; of more the rule is told."""
_FEW = 2
_WORKDAYS, _WEEKEND = "1-5", ("0,6", "6,0")


def tell_rule(rule: Rule, zone: tzinfo, now_unix_s: float) -> Bilingual:
    """Return when a rule is due, in words."""
    match rule:
        case CronRule():
            return _tell_cron(rule.cron)
        case EveryRule():
            minutes = rule.seconds / 60.0
            if minutes % 60.0 == 0.0:
                return say("standing.every_hours", hours=f"{minutes / 60.0:g}")
            return say("standing.every_minutes", minutes=f"{minutes:g}")
        case AtRule():
            return tell_time(rule.unix_s, zone, now_unix_s)
        case EventRule():
            upon = say(f"standing.upon_{rule.event.value}")
            if rule.hours is None:
                return upon
            first, last = rule.hours.split("-")
            return say("standing.upon_within", upon=upon, first=first, last=last)


def tell_when(order: StandingOrder, zone: tzinfo, now_unix_s: float) -> Bilingual:
    """Return when an order is due, in words, with the days that are left out."""
    when = tell_rule(order.rule, zone, now_unix_s)
    today = datetime.fromtimestamp(now_unix_s, zone).date()
    days = [_tell_day(day) for day in order.skipped if day >= today]
    return say("standing.but_not", when=when, days=list_names(days, "joint.and")) if days else when


def _tell_day(day: date) -> Bilingual:
    weekday = say(f"standing.day_{day.isoweekday() % 7}")
    return say("standing.day_date", weekday=weekday, date=day.isoformat())


def _tell_cron(cron: str) -> Bilingual:
    minute, hour, day, month, week = cron.split()
    plain = minute.isdigit() and day == month == "*"
    if plain and hour == "*":
        return _tell_hourly(f"{int(minute):02}", week, cron)
    if not (plain and hour.isdigit()):
        return say("standing.cron", cron=cron)
    time = f"{int(hour):02}:{int(minute):02}"
    if week == "*":
        return say("standing.daily", time=time)
    if week == _WORKDAYS:
        return say("standing.workdays", time=time)
    if week in _WEEKEND:
        return say("standing.weekend", time=time)
    if not all(each.isdigit() for each in week.split(",")):
        return say("standing.cron", cron=cron)
    left_out = sorted(set("0123456") - set(week.split(",")))
    if len(left_out) <= _FEW:
        return say("standing.daily_but", days=_name_days(",".join(left_out)), time=time)
    return say("standing.weekly", days=_name_days(week), time=time)


def _name_days(week: str) -> Bilingual:
    if week == _WORKDAYS or week in _WEEKEND:
        return say("standing.weekdays" if week == _WORKDAYS else "standing.weekends")
    names = [say(f"standing.day_{int(each) % 7}") for each in week.split(",")]
    return list_names(names, "joint.and")


def _tell_hourly(minute: str, week: str, cron: str) -> Bilingual:
    if week == "*":
        return say("standing.hourly", minute=minute)
    known = week == _WORKDAYS or all(each.isdigit() for each in week.split(","))
    if not known:
        return say("standing.cron", cron=cron)
    return say("standing.hourly_on", minute=minute, days=_name_days(week))


def tell_time(unix_s: float, zone: tzinfo, now_unix_s: float) -> Bilingual:
    """Return an instant as people name it: "tomorrow 09:00"."""
    then, now = datetime.fromtimestamp(unix_s, zone), datetime.fromtimestamp(now_unix_s, zone)
    time = f"{then.hour:02}:{then.minute:02}"
    days = (then.date() - now.date()).days
    if days in (0, 1):
        return say("standing.today" if days == 0 else "standing.tomorrow", time=time)
    return say("standing.on_date", date=then.date().isoformat(), time=time)


def tell_record(facts: SiteView, records: Sequence[StepRecord]) -> Bilingual:
    """Return what these steps do: "go to the kitchen, then look around"."""
    return tell_steps(steps_of(records), lambda place: _name(facts, place))


def _name(facts: SiteView, place: str) -> Bilingual:
    return facts.targets[place].name if place in facts.targets else say_same(place)


def tell_deed(facts: SiteView, order: StandingOrder) -> Bilingual:
    """Return what an order does each time."""
    if order.reminder is not None:
        return say("standing.reminds", words=order.reminder) if order.reminder else say(
            "standing.reminds_of_time"
        )  # fmt: skip
    if not order.allowed:
        return say("standing.answers", order=order.order)
    if any(step.kind in CONTROL for step in order.allowed):  # the person's words are shorter
        return say("standing.as_said", order=order.order)
    return tell_record(facts, order.allowed)


def tell_missed(order: StandingOrder, firing: Firing, zone: tzinfo, now_unix_s: float) -> Bilingual:
    """Return that a run was missed, and why; a reminder's words are in it."""
    why = say_or_quote("order_reason", firing.reason or "late")
    time = tell_time(firing.due_unix_s, zone, now_unix_s)
    order_text = order.reminder or order.text
    if firing.count > 1:
        return say(
            "standing.missed_several", count=firing.count, text=order_text, time=time, why=why
        )
    return say("standing.missed", text=order_text, time=time, why=why)


def tell_reminder(order: StandingOrder) -> Bilingual:
    """Return a reminder's words."""
    return (
        say("standing.reminder", words=order.reminder)
        if order.reminder
        else say("standing.reminder_of_time")
    )


def say_goal_of_reminder(order_language: str, words: str) -> str:
    """Return the order that a reminder is as a goal, in its own language."""
    spoken = words or raw("standing.time_is_over", order_language)
    return raw("standing.say_words", order_language).format(words=spoken)


def tell_left(seconds: float) -> Bilingual:
    """Return how long it is until then, in words."""
    minutes = round(seconds / 60.0)
    if seconds < 60.0:
        return say("standing.left_seconds", seconds=max(0, round(seconds)))
    if minutes < 60:
        return say("standing.left_minutes", minutes=minutes)
    hours, rest = divmod(minutes, 60)
    if hours >= 48:
        return say("standing.left_days", days=round(hours / 24.0))
    if not rest:
        return say("standing.left_whole_hours", hours=hours)
    return say("standing.left_hours", hours=hours, minutes=rest)


@dataclass(frozen=True, slots=True)
class OrderTelling:
    """Tell the orders of a book, as they are at an instant."""

    facts: SiteView
    book: OrderBook
    now_s: float

    @property
    def live(self) -> tuple[StandingOrder, ...]:
        """Return the orders that have not ended."""
        return tuple(order for order in self.book.orders.values() if not order.ended)

    def line(self, order: StandingOrder) -> Bilingual:
        """Return an order in one line: "o3: every day at 20:00: look. (paused)"."""
        when = tell_when(order, self.book.zone, self.now_s)
        deed = tell_deed(self.facts, order)
        if order.paused and order.resume_unix_s is not None:
            until = tell_time(order.resume_unix_s, self.book.zone, self.now_s)
            return say("standing.line_paused_until", id=order.id, until=until, when=when, deed=deed)
        code = "standing.line_paused" if order.paused else "standing.line"
        return say(code, id=order.id, when=when, deed=deed)

    def tell_one(self, order: StandingOrder) -> Bilingual:
        """Return what a person hears when an order is taken or has changed."""
        zone = self.book.zone
        when = tell_when(order, zone, self.now_s)
        when = build(lambda language: when.of(language)[:1].upper() + when.of(language)[1:])
        said = say("standing.kept", when=when, deed=tell_deed(self.facts, order))
        due_s = self.book.due.get(order.id, next_run(order, self.now_s, zone))
        if due_s is None or order.is_once:
            return said
        return join((said, say("standing.next", time=tell_time(due_s, zone, self.now_s))))

    def tell_all(self, orders: tuple[StandingOrder, ...] | None = None) -> Bilingual:
        """Return orders in words; of many the first."""
        lines = [self.line(order) for order in (self.live if orders is None else orders)]
        if not lines:
            return say("standing.none")
        shown = lines[:MOST_TOLD]
        if len(lines) > MOST_TOLD:
            shown.append(say("standing.more", count=len(lines) - MOST_TOLD))
        return say("standing.list", lines=join(shown, "joint.line"))

    def answer(
        self, asked: ListOrders
    ) -> tuple[Bilingual | None, tuple[StandingOrder, ...] | None]:
        """Return the answer to a question, and the orders that it lists, where it is a list.

        None where it may be about something else, and no order fits.
        """
        if asked.day is not None:
            return self._tell_day(asked.day, is_sure=asked.is_sure), None
        named = bool(asked.which or asked.reminders)
        zone, found = self.book.zone, self.live
        if named:
            found = select(found, asked.which, zone, reminders=asked.reminders)
        if asked.next_runs:
            return self._tell_next(found, asked), None
        if not found and asked.which and self.live:
            return self.tell_no_such(asked.which), None
        return self.tell_all(found), found

    def _tell_next(self, found: tuple[StandingOrder, ...], asked: ListOrders) -> Bilingual | None:
        """Return when these are due next, the soonest first."""
        due = self.book.due
        waiting = sorted((o for o in found if o.id in due), key=lambda o: (due[o.id], o.number))
        if not (asked.is_sure or asked.which):  # "how long is left?": of what was asked for once
            waiting = [order for order in waiting if order.is_once]
        if waiting:
            lines = [self._line_left(order, due[order.id]) for order in waiting[:MOST_TOLD]]
            return say("standing.next_runs", lines=join(lines, "joint.line"))
        if not asked.is_sure:
            return None
        if found:  # paused, or upon an event
            return self.tell_all(found)
        return say("standing.no_reminders") if asked.reminders else self.tell_all()

    def _line_left(self, order: StandingOrder, due_s: float) -> Bilingual:
        when = tell_time(due_s, self.book.zone, self.now_s)
        left, deed = tell_left(due_s - self.now_s), tell_deed(self.facts, order)
        return say("standing.line_left", id=order.id, when=when, left=left, deed=deed)

    def _tell_day(self, said: OnceDay, *, is_sure: bool) -> Bilingual | None:
        """Return what is due on one day, in its order."""
        zone, now_s = self.book.zone, self.now_s
        day, today = find_day(said, now_s, zone), datetime.fromtimestamp(now_s, zone).date()
        begin_s = max(now_s, datetime.combine(day, time(), zone).timestamp() - 1e-3)
        end_s = datetime.combine(day + timedelta(days=1), time(), zone).timestamp()
        told: list[tuple[float, Bilingual]] = []
        for order in self.live:
            resume_s = order.resume_unix_s or 0.0
            if order.paused and not 0.0 < resume_s < end_s:
                continue
            since_s = max(begin_s, order.handled_unix_s, resume_s)
            runs = [s for s in coming_runs(order, since_s, zone, MOST_A_DAY + 1) if s < end_s]
            told += self._lines_of_day(order, runs)
        ahead = (day - today).days
        codes = {0: "standing.day_today", 1: "standing.day_tomorrow"}
        name = say(codes[ahead]) if ahead in codes else _tell_day(day)
        if not told:
            return say("standing.day_free", day=name) if is_sure or self.live else None
        lines = [line for _, line in sorted(told, key=lambda each: each[0])]
        return say("standing.day_list", day=name, lines=join(lines, "joint.line"))

    def _lines_of_day(
        self, order: StandingOrder, runs: list[float]
    ) -> list[tuple[float, Bilingual]]:
        zone, deed = self.book.zone, tell_deed(self.facts, order)
        if len(runs) > MOST_A_DAY:
            rule = tell_rule(order.rule, zone, self.now_s)
            return [(runs[0], say("standing.line", id=order.id, when=rule, deed=deed))]
        clock = [f"{datetime.fromtimestamp(run_s, zone):%H:%M}" for run_s in runs]
        return [
            (run_s, say("standing.line", id=order.id, when=at, deed=deed))
            for run_s, at in zip(runs, clock, strict=True)
        ]

    def ask_which(self, orders: Sequence[StandingOrder], form: str) -> Clarify:
        """Return the question which of several is meant; each offer names its order."""
        options = tuple(
            Option(label=self.line(order), text=form.format(id=order.id).strip())
            for order in orders[:MOST_TOLD]
        )
        lines = join((option.label for option in options), "joint.line")
        question = say("standing.which", lines=lines)
        return Clarify(code=Code.AMBIGUOUS, question=question, options=options)

    def tell_no_such(self, which: str) -> Bilingual:
        """Return that no order is called so, with those that are kept."""
        return say("standing.no_such", which=which[:80], known=self.tell_all())
