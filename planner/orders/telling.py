"""Say what a standing order is, when it comes next and what became of it. Pure."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from planner.language.catalogue import build, join, list_names, raw, say, say_or_quote
from planner.language.plan_words import tell_steps
from planner.plan import CONTROL, Bilingual, say_same
from planner.plan.slots import steps_of
from planner.plan.timing import AtRule, CronRule, EventRule, EveryRule

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import date, tzinfo

    from planner.orders.order import Firing, StandingOrder
    from planner.plan import StepRecord
    from planner.plan.timing import Rule
    from planner.site.site_view import SiteView

MOST_TOLD = 8
"""Orders that are listed in words; the page shows all."""
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


def tell_kept(
    facts: SiteView, order: StandingOrder, due_s: float | None, zone: tzinfo, now_unix_s: float
) -> Bilingual:
    """Return what a person hears when an order is taken."""
    when = capitalise(tell_when(order, zone, now_unix_s))
    said = say("standing.kept", when=when, deed=tell_deed(facts, order))
    if due_s is None or order.is_once:
        return said
    following = say("standing.next", time=tell_time(due_s, zone, now_unix_s))
    return join((said, following))


def tell_order(facts: SiteView, order: StandingOrder, zone: tzinfo, now_unix_s: float) -> Bilingual:
    """Return an order in one line: "o3: every day at 20:00: look. (paused)"."""
    code = "standing.line_paused" if order.paused else "standing.line"
    when = tell_when(order, zone, now_unix_s)
    if order.paused and order.resume_unix_s is not None:
        until, deed = tell_time(order.resume_unix_s, zone, now_unix_s), tell_deed(facts, order)
        return say("standing.line_paused_until", id=order.id, until=until, when=when, deed=deed)
    return say(code, id=order.id, when=when, deed=tell_deed(facts, order))


def tell_list(lines: tuple[Bilingual, ...]) -> Bilingual:
    """Return all orders in words; of many the first."""
    if not lines:
        return say("standing.none")
    shown = list(lines[:MOST_TOLD])
    if len(lines) > MOST_TOLD:
        shown.append(say("standing.more", count=len(lines) - MOST_TOLD))
    return say("standing.list", lines=list_names(shown, "joint.name"))


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


def capitalise(said: Bilingual) -> Bilingual:
    """Return a text with a capital at its beginning, where its language has them."""
    return build(lambda language: said.of(language)[:1].upper() + said.of(language)[1:])


def say_goal_of_reminder(order_language: str, words: str) -> str:
    """Return the order that a reminder is as a goal, in its own language."""
    spoken = words or raw("standing.time_is_over", order_language)
    return raw("standing.say_words", order_language).format(words=spoken)
