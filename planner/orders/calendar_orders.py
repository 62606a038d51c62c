"""Write standing orders as an iCalendar file, and read one into orders that may be kept. Pure.

What the clock tells is an event with its zone, its repeats and its days left out (EXDATE); what no
calendar tells (an order upon an event, a cron line of another form) is a to-do with words of ours.
Laws: what is written is read as the same orders; what an order can't keep is refused and never
changed silently.
"""

from __future__ import annotations

import re
from datetime import UTC, date, datetime
from typing import TYPE_CHECKING
from zoneinfo import ZoneInfo

from pydantic import ValidationError

from planner.language.schedule.parts import EVERY_DAY
from planner.language.sentence import language_of
from planner.orders.calendar_text import Component, escape, read_components, write_lines
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder
from planner.orders.order import MAX_ORDERS
from planner.orders.retiming import WeeklyTime, read_weekly
from planner.orders.rule import day_at, next_due, upcoming
from planner.orders.telling import say_goal_of_reminder
from planner.orders.zone import name_of
from planner.plan import Language
from planner.plan.timing import AtRule, CronRule, EventRule, EveryRule

if TYPE_CHECKING:
    from collections.abc import Iterable
    from datetime import tzinfo

    from planner.orders.calendar_text import CalendarLine
    from planner.orders.order import StandingOrder

_DAYS = ("SU", "MO", "TU", "WE", "TH", "FR", "SA")
_LOCAL, _UTC = "%Y%m%dT%H%M%S", "%Y%m%dT%H%M%SZ"
_SPANS_S = {"SECONDLY": 1, "MINUTELY": 60, "HOURLY": 3600}
_UNREAD = ("RDATE", "EXRULE", "RECURRENCE-ID")
_MOST_RUNS = 300
"""Of one day: every five minutes."""


def write_orders(orders: Iterable[StandingOrder], zone: tzinfo, now_unix_s: float) -> str:
    """Return the orders that have not ended as a file."""
    lines = ["BEGIN:VCALENDAR", "VERSION:2.0", "PRODID:-//Pons//Standing orders//EN"]
    for order in orders:
        if not order.ended:
            lines += _write(order, zone, now_unix_s)
    return write_lines([*lines, "END:VCALENDAR"])


def _write(order: StandingOrder, zone: tzinfo, now_unix_s: float) -> list[str]:
    timed = _write_time(order, zone, now_unix_s)
    kind = "VTODO" if timed is None else "VEVENT"
    deed, words = ("ORDER", order.order)
    if order.reminder is not None:
        deed, words = "REMINDER", order.reminder
    lines = [
        f"BEGIN:{kind}",
        f"UID:{order.id}@pons",
        f"DTSTAMP:{_utc(order.created_unix_s)}",
        f"SUMMARY:{escape(order.text)}",
        f"X-PONS-LANGUAGE:{order.language.value}",
        f"X-PONS-{deed}:{escape(words)}",
    ]
    if order.paused:
        lines += ["STATUS:TENTATIVE", "X-PONS-PAUSED:TRUE"] if timed else ["X-PONS-PAUSED:TRUE"]
    return [*lines, *(timed if timed is not None else _write_untimed(order)), f"END:{kind}"]


def _write_time(order: StandingOrder, zone: tzinfo, now_unix_s: float) -> list[str] | None:
    rule, after_s = order.rule, max(now_unix_s, order.handled_unix_s)
    if isinstance(rule, AtRule):
        return [
            f"DTSTART:{_utc(rule.unix_s)}",
            *(["X-PONS-RELATIVE:TRUE"] if rule.relative else []),
        ]
    first_s = next_due(rule, after_s, zone)
    if first_s is None:
        return None
    if isinstance(rule, EveryRule) and rule.seconds.is_integer():
        unit = next(name for name in ("HOURLY", "MINUTELY", "SECONDLY")
                    if rule.seconds % _SPANS_S[name] == 0.0)  # fmt: skip
        every = f"RRULE:FREQ={unit};INTERVAL={rule.seconds / _SPANS_S[unit]:.0f}"
        gone = [f"EXDATE:{_utc(s)}" for s in _runs_left_out(order, zone, now_unix_s)]
        return [f"DTSTART:{_utc(first_s)}", every, *gone]
    weekly = read_weekly(rule)
    if weekly is None or getattr(zone, "key", None) is None:
        return None
    freq = "HOURLY" if weekly.hour is None else "DAILY" if weekly.days == EVERY_DAY else "WEEKLY"
    days = (
        ""
        if weekly.days == EVERY_DAY
        else f";BYDAY={','.join(_DAYS[d] for d in sorted(weekly.days))}"
    )
    tzid = f"TZID={name_of(zone)}"
    gone = [f"EXDATE;{tzid}:{_local(s, zone)}" for s in _runs_left_out(order, zone, now_unix_s)]
    return [f"DTSTART;{tzid}:{_local(first_s, zone)}", f"RRULE:FREQ={freq}{days}", *gone]


def _write_untimed(order: StandingOrder) -> list[str]:
    lines = [f"X-PONS-RULE:{escape(order.rule.model_dump_json(exclude_none=True))}"]
    return [*lines, *(f"X-PONS-SKIPPED:{day.isoformat()}" for day in order.skipped)]


def _runs_left_out(order: StandingOrder, zone: tzinfo, now_unix_s: float) -> list[float]:
    today = day_at(now_unix_s, zone)
    return [s for day in order.skipped if day >= today for s in _runs_of(order.rule, day, zone)]


def _runs_of(
    rule: CronRule | EveryRule | AtRule | EventRule, day: date, zone: tzinfo
) -> list[float]:
    begin_s = datetime(day.year, day.month, day.day, tzinfo=zone).timestamp() - 1e-3
    return [s for s in upcoming(rule, begin_s, zone, _MOST_RUNS) if day_at(s, zone) == day]


def _utc(unix_s: float) -> str:
    return datetime.fromtimestamp(round(unix_s), UTC).strftime(_UTC)


def _local(unix_s: float, zone: tzinfo) -> str:
    return datetime.fromtimestamp(unix_s, zone).strftime(_LOCAL)


def read_orders(
    text: str, zone: tzinfo, now_unix_s: float, source: str
) -> tuple[tuple[str, NewOrder | OrderRefusal], ...]:
    """Return what a file wants kept: each entry's name with its order, or why it is none.

    Raises:
        OrderRefusal: ``calendar_malformed``, ``calendar_empty``, ``orders_full``.
    """
    components = read_components(text)
    if not components:
        raise OrderRefusal("calendar_empty", "no VEVENT and no VTODO")
    if len(components) > MAX_ORDERS:
        raise OrderRefusal("orders_full", f"{len(components)} entries", most=MAX_ORDERS)
    found: list[tuple[str, NewOrder | OrderRefusal]] = []
    for number, each in enumerate(components, 1):
        try:
            name = (each.text("SUMMARY") or "").strip()[:120] or f"#{number}"
            found.append((name, _read(each, zone, now_unix_s, source)))
        except OrderRefusal as refused:
            found.append((f"#{number}", refused))
    return tuple(found)


def _read(entry: Component, zone: tzinfo, now_unix_s: float, source: str) -> NewOrder:
    reminder, order = entry.text("X-PONS-REMINDER"), entry.text("X-PONS-ORDER")
    summary = entry.text("SUMMARY") or order or reminder or ""
    spoken = entry.text("X-PONS-LANGUAGE")
    own = next((each for each in Language if each.value == spoken), None)
    language = own or language_of(order or reminder or summary)
    if reminder is not None:
        order = say_goal_of_reminder(language.value, reminder)
    rule, skipped = (
        _read_untimed(entry) if entry.kind == "VTODO" else _read_time(entry, zone, now_unix_s)
    )
    return NewOrder(
        rule, order or summary, language, summary, reminder=reminder, source=source,
        skipped=skipped, paused=entry.text("X-PONS-PAUSED") == "TRUE",
    )  # fmt: skip


def _read_untimed(entry: Component) -> tuple[EventRule | CronRule | EveryRule, tuple[date, ...]]:
    written = entry.text("X-PONS-RULE") or ""
    for kind in (EventRule, CronRule, EveryRule):
        try:
            rule: EventRule | CronRule | EveryRule = kind.model_validate_json(written)
            days = [date.fromisoformat(e.text) for e in entry.lines.get("X-PONS-SKIPPED", [])]
        except (ValidationError, ValueError):
            continue
        return rule, tuple(sorted(set(days)))
    raise OrderRefusal("calendar_todo", "a to-do that is none of ours")


def _read_time(
    entry: Component, zone: tzinfo, now_unix_s: float
) -> tuple[AtRule | CronRule | EveryRule, tuple[date, ...]]:
    if unread := [name for name in _UNREAD if name in entry.lines]:
        raise OrderRefusal("calendar_repeats", unread[0], what=unread[0])
    start, repeats = entry.one("DTSTART"), entry.one("RRULE")
    if start is None or re.fullmatch(r"\d{8}T\d{6}Z?", start.value) is None:
        raise OrderRefusal("order_time_missing", "DTSTART has no time of day")
    begin = _instant(start, start.value, zone)
    if repeats is None:
        if "EXDATE" in entry.lines:
            raise OrderRefusal("calendar_repeats", "EXDATE of a single event", what="EXDATE")
        relative = entry.text("X-PONS-RELATIVE") == "TRUE"
        return AtRule(unix_s=begin.timestamp(), relative=relative), ()
    rule = _read_repeats(repeats.value, start, begin, zone)
    first_s = next_due(rule, now_unix_s, zone)
    if first_s is not None and first_s < begin.timestamp() > now_unix_s:
        raise OrderRefusal("calendar_begins_later", start.value)
    exact_s = next_due(rule, begin.timestamp() - 1.0, zone)
    if exact_s != begin.timestamp():
        raise OrderRefusal("calendar_repeats", "DTSTART is no run of its RRULE", what="DTSTART")
    return rule, _read_days(entry, rule, zone, now_unix_s)


def _read_repeats(
    value: str, start: CalendarLine, begin: datetime, zone: tzinfo
) -> CronRule | EveryRule:
    try:
        parts = dict(each.upper().split("=") for each in value.rstrip(";").split(";"))
    except ValueError:
        raise OrderRefusal("calendar_malformed", value[:60], what=value[:60]) from None
    frequency, count = parts.pop("FREQ", ""), parts.pop("INTERVAL", "1")
    days = [_DAYS.index(d) if d in _DAYS else -1 for d in parts.pop("BYDAY", "").split(",") if d]
    parts.pop("WKST", None)
    if "UNTIL" in parts or "COUNT" in parts:
        raise OrderRefusal("order_no_end", value[:60])
    known = frequency in (*_SPANS_S, "DAILY", "WEEKLY") and not parts and -1 not in days
    if not known or not re.fullmatch(r"[1-9]\d{0,7}", count):
        raise OrderRefusal("calendar_repeats", value[:60], what=value[:60])
    if frequency in _SPANS_S and not days and (start.value.endswith("Z") or count != "1"):
        seconds = float(int(count) * _SPANS_S[frequency])
        return EveryRule(seconds=seconds, anchor_unix_s=begin.timestamp() - seconds)
    if count != "1" or frequency in ("SECONDLY", "MINUTELY") or begin.second:
        raise OrderRefusal("calendar_repeats", value[:60], what=value[:60])
    if start.value.endswith("Z") or start.parameters.get("TZID") != name_of(zone):
        raise OrderRefusal("calendar_zone", start.value, zone=name_of(zone))
    if frequency == "WEEKLY" and not days:
        days = [(begin.weekday() + 1) % 7]
    hour = None if frequency == "HOURLY" else begin.hour
    return WeeklyTime(begin.minute, hour, frozenset(days) or EVERY_DAY).rule


def _read_days(
    entry: Component, rule: CronRule | EveryRule, zone: tzinfo, now_unix_s: float
) -> tuple[date, ...]:
    """Return the days that are left out whole; a part of a day's runs can't be."""
    lines = entry.lines.get("EXDATE", [])
    gone_s = {_instant(e, v, zone).timestamp() for e in lines for v in e.value.split(",")}
    days = sorted({day_at(s, zone) for s in gone_s})
    for day in days:
        if not {s for s in _runs_of(rule, day, zone) if s > now_unix_s} <= gone_s:
            raise OrderRefusal("calendar_exdate", day.isoformat())
    return tuple(day for day in days if day >= day_at(now_unix_s, zone))


def _instant(line: CalendarLine, value: str, zone: tzinfo) -> datetime:
    """Return an instant with its zone.

    Raises:
        OrderRefusal: ``calendar_zone`` (none is named, or none is known by that name),
            ``calendar_malformed``.
    """
    named = line.parameters.get("TZID", "")
    try:
        own = UTC if value.endswith("Z") else zone if named == name_of(zone) else ZoneInfo(named)
    except (KeyError, ValueError, OSError):
        raise OrderRefusal("calendar_zone", named[:40], zone=name_of(zone)) from None
    try:
        found = datetime.strptime(value.removesuffix("Z"), _LOCAL).replace(tzinfo=own)
    except ValueError:
        raise OrderRefusal("calendar_malformed", value[:40], what=value[:40]) from None
    if found.astimezone(UTC).astimezone(own).replace(tzinfo=None) != found.replace(tzinfo=None):
        clock = found.strftime("%H:%M")
        raise OrderRefusal("order_time_unknown", value, time=clock)
    return found
