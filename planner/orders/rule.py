"""Work out when a rule is due next, and refuse rules that never are, or all the time.

The only place that knows cronsim and time zones. Pure: told the instant and the zone. Daylight
saving as Debian's cron: a time of day that a spring night leaves out is due when it ends (02:30 at
03:00), one that an autumn night has twice is due once, the first time; "every hour" is due each
hour that passes.
"""

from __future__ import annotations

from datetime import UTC, datetime
from itertools import pairwise
from math import ceil, isfinite
from typing import TYPE_CHECKING

from cronsim import CronSim, CronSimError

from planner.orders.calendar_day import day_of
from planner.orders.errors import OrderRefusal
from planner.plan.timing import (
    MAX_AHEAD_S,
    AtRule,
    CronRule,
    DayTime,
    EventRule,
    EveryRule,
    InRule,
    Rule,
    SpokenRule,
)

if TYPE_CHECKING:
    from collections.abc import Iterator
    from datetime import tzinfo

    from planner.plan import QuietHours

MIN_APART_S = 300.0
"""Between two runs of one order: what comes oftener is no errand but a state."""
RUNS_JUDGED = 50
"""So many runs of a new rule are looked at: over two days of an hourly one."""
_CRON_FIELDS = 5


def settle(said: SpokenRule | AtRule, now_unix_s: float, zone: tzinfo) -> Rule:
    """Return the rule that a sentence or a request means, said now.

    Raises:
        OrderRefusal: ``order_in_past``, ``order_too_far``, ``order_time_unknown`` (no such time on
            that day), ``order_no_such_date``, ``order_too_often``, ``order_never``,
            ``order_malformed``.
    """
    match said:
        case InRule():
            rule: Rule = AtRule(unix_s=now_unix_s + said.seconds, relative=True)
        case DayTime():
            rule = AtRule(unix_s=_instant(said, now_unix_s, zone))
        case EveryRule() if not said.anchor_unix_s:  # said now; a calendar names its instant
            rule = EveryRule(seconds=said.seconds, anchor_unix_s=now_unix_s)
        case _:
            rule = said
    judge(rule, now_unix_s, zone)
    return rule


def judge(rule: Rule, now_unix_s: float, zone: tzinfo) -> None:
    """Refuse a rule that can't be kept.

    Raises:
        OrderRefusal: see ``settle``.
    """
    if isinstance(rule, EventRule):
        return
    if isinstance(rule, EveryRule) and not rule.seconds >= MIN_APART_S:
        raise OrderRefusal("order_too_often", f"every {rule.seconds:g} s", most=MIN_APART_S / 60.0)
    first = next_due(rule, now_unix_s, zone)
    if isinstance(rule, AtRule) and first is None:
        told = datetime.fromtimestamp(rule.unix_s, zone).isoformat(timespec="minutes")
        raise OrderRefusal("order_in_past", f"{told} is over")
    if first is None:
        raise OrderRefusal("order_never", f"{rule.model_dump()} is never due")
    if not first - now_unix_s <= MAX_AHEAD_S:
        raise OrderRefusal("order_too_far", "the first run is more than a year away")
    if isinstance(rule, CronRule):
        apart_s = min((b - a for a, b in pairwise(upcoming(rule, now_unix_s, zone, RUNS_JUDGED))),
                      default=MIN_APART_S)  # fmt: skip
        if not apart_s >= MIN_APART_S:
            raise OrderRefusal(
                "order_too_often", f"{rule.cron!r}: {apart_s:g} s apart", most=MIN_APART_S / 60.0
            )


def next_due(rule: Rule, after_unix_s: float, zone: tzinfo) -> float | None:
    """Return the first instant after this one at which a rule is due; None where there is none."""
    match rule:
        case AtRule():
            return rule.unix_s if rule.unix_s > after_unix_s else None
        case EveryRule():
            passed = (after_unix_s - rule.anchor_unix_s) / rule.seconds
            count = max(1, ceil(passed))
            due_s = rule.anchor_unix_s + count * rule.seconds
            return due_s if due_s > after_unix_s else due_s + rule.seconds
        case CronRule():
            return _next_cron(rule.cron, after_unix_s, zone)
        case EventRule():
            return None


def upcoming(rule: Rule, after_unix_s: float, zone: tzinfo, count: int) -> Iterator[float]:
    """Yield the next runs of a rule, ``count`` at most."""
    due_s: float | None = after_unix_s
    for _ in range(count):
        due_s = next_due(rule, due_s if due_s is not None else after_unix_s, zone)
        if due_s is None:
            return
        yield due_s


def _next_cron(cron: str, after_unix_s: float, zone: tzinfo) -> float | None:
    if len(cron.split()) != _CRON_FIELDS:
        raise OrderRefusal("order_malformed", f"{cron!r}: expected five fields, as cron has them")
    after = datetime.fromtimestamp(after_unix_s, zone)
    try:
        for due in CronSim(cron, after):
            # In the second of two equal hours cronsim counts from the first one.
            if (due_s := due.timestamp()) > after_unix_s:
                return due_s
    except CronSimError as error:
        raise OrderRefusal("order_malformed", f"{cron!r}: {error}") from None
    except (RuntimeError, OverflowError, ValueError):  # out of years
        return None
    return None


def _instant(said: DayTime, now_unix_s: float, zone: tzinfo) -> float:
    """Return the instant of a time of day; of two such times in one night the first."""
    now = datetime.fromtimestamp(now_unix_s, zone)
    hours = (said.hour, (said.hour + 12) % 24) if said.either_half else (said.hour,)
    found = []
    for hour in hours:
        day = day_of(said, now, hour)
        wanted = datetime(day.year, day.month, day.day, hour, said.minute, tzinfo=zone)
        if _exists(wanted):
            found.append(wanted.timestamp())
    if not found:
        clock = f"{said.hour:02}:{said.minute:02}"
        raise OrderRefusal("order_time_unknown", f"the clock skips {clock} on that day", time=clock)
    return min((s for s in found if s > now_unix_s), default=found[0])


def _exists(wanted: datetime) -> bool:
    there_and_back = wanted.astimezone(UTC).astimezone(wanted.tzinfo)
    return there_and_back.replace(tzinfo=None) == wanted.replace(tzinfo=None)


def is_quiet(quiet: QuietHours, unix_s: float, zone: tzinfo) -> bool:
    """Return whether an instant lies within hours of the day there; one that is none does."""
    if not isfinite(unix_s):
        return True
    now = datetime.fromtimestamp(unix_s, zone)
    return quiet.holds(now.hour * 60 + now.minute)
