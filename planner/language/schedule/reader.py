"""Read a whole sentence as a standing order, a word about the standing orders, or neither.

A time stands at the beginning of an order or at its end; what is left is the order, as it was
written. A question is none, nor a condition that is no event ("if somebody is in the kitchen").
Pure: no clock, no state.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.schedule import chinese, english
from planner.language.schedule.command import (
    CorrectOrder,
    LeaveOutDays,
    OrderCommand,
    RemindAgain,
    ScheduleCommand,
)
from planner.language.schedule.corrections import read_correction
from planner.language.schedule.folded_sentence import ENDS, FoldedSentence, fold_sentence
from planner.language.schedule.kept_orders import read_asked, read_change
from planner.language.schedule.parts import (
    DayPart,
    MonthDay,
    OnceDay,
    Part,
    Problem,
    TimeOfDay,
    Timing,
    WeekDays,
    combine,
    is_once,
    lacks_time,
    leave_days_out,
)
from planner.language.schedule.statements import (
    begins_with_statement,
    ends_in_statement,
    ends_in_told_words,
    is_limited,
)
from planner.language.schedule.time_finder import (
    FoundTime,
    first_parts,
    last_parts,
)
from planner.plan.timing import CronRule, DayTime, EventRule, EveryRule, InRule, WorldEvent

if TYPE_CHECKING:
    from types import ModuleType

NEWS = {
    WorldEvent.PERSON_SEEN: "somebody is here",
    WorldEvent.MOVEMENT: "something is moving",
    WorldEvent.BATTERY_LOW: "my battery is low",
    WorldEvent.GOAL_DONE: "an order is done",
    WorldEvent.GOAL_FAILED: "an order has failed",
    WorldEvent.ARRIVED_HOME: "I am back home",
}
"""What is said to a person who wants to be told of an event."""
_TELL_ME = re.compile(
    r"(?:please |then |just )*(?:let (?:me|us) know|(?:tell|warn|alert|notify) (?:me|us))"
)
MAX_READ = 300
"""Characters; a longer sentence is no standing order."""
_TO_EACH = re.compile(
    r".*\b(?:every(?:body|one)|each \w+|anybody who|anyone who|people who)(?: who| that)? (?:comes?|arrives?|enters?)\b.*"
)
"""Waits for what is read as no event: done now it would be another order."""
_NOT_NOW = re.compile(r"not (?:now|yet)[, ]+(?:but )?")
_OVER = re.compile(
    r"(?:yesterday|last (?:night|week|\w+day))\b.*|.*\b(?:yesterday|last (?:night|week|\w+day))|(?:昨天|昨晚|前天).*"
)
_WAKES = range(4, 12)
_QUOTED = re.compile(r'[“"].*?[”"]')
_DOES = re.compile(
    r"(?:please )?(?:go|drive|come|look|check|patrol|visit|search|find|count|turn|do|have|take|make)\b"
)
_THEN = re.compile(r"(?:and|then)\b")
_UNTIL = re.compile(r"\b(?:until|till)$")
_CLAUSE = re.compile(r"[,;.]+ *(?:but |and )?")
_TELLS = re.compile(r"(?: and|,|;) (?:then )?(?:tell|let|call|warn|say|ask|shout|remind|alert)\b")
"""Of two orders the one that waits for the event behind them."""


@lru_cache(maxsize=64)
def read_order_command(text: str) -> OrderCommand | None:
    """Return what a sentence says about standing orders; None where it is none of these."""
    if not 0 < len(text.strip()) <= MAX_READ:
        return None
    said = fold_sentence(text)
    asks = said.folded.rstrip(ENDS).endswith("?")
    courteous = asks and said.folded.startswith(("can", "could", "will", "would"))
    chinese_said = has_chinese(said.folded)
    grammar = chinese if chinese_said else english
    said = FoldedSentence(said.folded.replace("?", " "), said.written)
    said = said.bare().strip(grammar.POLITE).strip_end(grammar.POLITE_END).bare()
    if not asks and (excepted := _read_excepting(said, grammar)) is not None:
        return excepted
    about = read_asked(said.folded, chinese=chinese_said) or read_change(
        said.folded, chinese=chinese_said
    )
    if about is not None:
        return about
    if (asks and not courteous) or grammar.ASKS.match(said.folded) is not None:
        return None
    corrects = read_correction(said.folded, chinese=chinese_said)
    if isinstance(corrects, CorrectOrder) and isinstance(corrects.change, RemindAgain):
        otherwise = _read(said.strip(_NOT_NOW), grammar)  # "… again in five"
        return replace(corrects, otherwise=otherwise)
    order = corrects or _read(said, grammar)
    if order is not None or asks or chinese_said:
        return order
    problem = _problem_of(_QUOTED.sub(lambda found: " " * len(found[0]), said.folded))
    return None if problem is None else ScheduleCommand(None, said.written, "", problem=problem)


def asks_about_day(text: str) -> bool:
    """Return whether a sentence is a question that names a day: "what is in my calendar today"."""
    said = fold_sentence(text)
    grammar = chinese if has_chinese(said.folded) else english
    words = said.bare().strip(grammar.POLITE).bare().folded.replace("?", " ")
    before, after = first_parts(words, grammar), last_parts(words, grammar)
    asked = words[before.at :].lstrip(ENDS)
    asks = any(form.match(asked) for form in (grammar.ASKS, grammar.QUESTION, grammar.TELL))
    return asks and any(isinstance(part, OnceDay) for part in (*before.parts, *after.parts))


def _problem_of(said: str) -> Problem | None:
    """Return why an English sentence is no order of now either; None: it may be one.

    A time that comes again and stands in the middle is passed over by nobody: "look round at ten
    every night, and tell me who is in" is not done at once.
    """
    if _TO_EACH.fullmatch(said) is not None:
        return "order_no_event"
    cuts = re.finditer(r"(?<=[ ,])(?=every |each |daily)", said) if _DOES.match(said) else ()
    again = (first_parts(said[cut.start() :], english).parts for cut in cuts)
    found = any(isinstance(part, WeekDays) for parts in again for part in parts)
    return "order_time_within" if found else None


def _read_excepting(said: FoldedSentence, grammar: ModuleType) -> ScheduleCommand | None:
    """Read "every day at seven wake us up, but not at weekends", 每天七点…，周末就不要了."""
    for cut in reversed(list(_CLAUSE.finditer(said.folded))):
        days = read_correction(said.folded[cut.end() :], chinese=grammar is chinese)
        if not isinstance(days, CorrectOrder) or not isinstance(days.change, LeaveOutDays):
            return None
        order = _read(said.part(0, cut.start()).bare(), grammar)
        if order is None or not isinstance(order.when, CronRule) or order.problem is not None:
            return None
        when = leave_days_out(order.when, days.change.days, keeps=days.change.keeps)
        words = f"{order.words} {said.written[cut.end() :]}"
        return None if when is None else replace(order, when=when, words=words)
    return None


def _read(said: FoldedSentence, grammar: ModuleType) -> ScheduleCommand | None:
    """Read a time, an order, and whether it is to be reminded of."""
    before = first_parts(said.folded, grammar)
    rest = said.part(before.at).strip(grammar.LEAD)
    remind = grammar.REMIND.match(rest.folded)
    woken = remind is not None and bool(remind["wake"])
    if remind is not None:
        inner = rest.part(remind.end())
        middle = first_parts(inner.folded.lstrip(" ,"), grammar)
        if middle.parts:
            inner = inner.part(len(inner.folded) - len(inner.folded.lstrip(" ,")) + middle.at)
        rest, before = inner, FoundTime((*before.parts, *middle.parts), before.at)
    elif before.parts:
        rest = rest.strip(grammar.POLITE)
    after = _time_behind(rest, before, grammar, reminds=remind is not None)
    order = (rest.part(0, after.at) if after.parts else rest).bare()
    parts = (*before.parts, *after.parts)
    timing = combine(_by_morning(parts) if woken else parts)
    if timing is None:
        lacks = remind is not None and not parts and not woken
        return _read_timeless(order, remind[0], grammar) if lacks and remind is not None else None
    words = _words(said, rest, before, after)
    if remind is not None:
        return _reminder(order, timing, words, grammar, woken=woken)
    if all(isinstance(part, OnceDay | DayPart | MonthDay) for part in parts):  # and no hour
        asked = said.part(before.at, len(said.folded) - len(rest.folded) + after.at).bare().folded
        if grammar.QUESTION.match(asked) or (not before.parts and grammar.TELL.match(asked)):
            return None  # "will it rain tonight", 今天几点开会: it asks about the day
    once = isinstance(timing.when, DayTime | InRule) and before.parts
    states = once and begins_with_statement(order.folded, chinese=grammar is chinese)
    tells = after.parts and isinstance(timing.when, EventRule) and _TELLS.search(order.folded)
    cuts = (found.end() for found in _CLAUSE.finditer(order.folded))
    others = (part for cut in cuts for part in first_parts(order.folded[cut:], grammar).parts)
    if any(isinstance(part, WeekDays) for part in others):
        return None  # 晚上十点，那个，每晚十点，…: all of it, or none
    if tells or states or grammar.REMARK.match(order.folded) is not None:
        return None  # "it's cold tonight", "at nine the doctor comes, …": a time, and no order
    return _order(order, timing, words)


def _time_behind(
    rest: FoldedSentence, before: FoundTime, grammar: ModuleType, *, reminds: bool
) -> FoundTime:
    """Return the time that an order ends with, where it is the order's."""
    none = FoundTime((), len(rest.folded))
    after = last_parts(rest.folded, grammar)
    if before.parts and after.parts and not reminds and combine(before.parts) is not None:
        joined = combine((*before.parts, *after.parts))
        if joined is None or (joined.problem == "order_nested" and combine(after.parts) is None):
            return none  # "every day at eight say good night at ten"
    if after.parts and grammar is english and not lacks_time(before.parts):
        words = rest.folded[: after.at].rstrip(" ")
        told = not reminds and is_once(after.parts) and ends_in_told_words(words)
        if told or ends_in_statement(words, reminds=reminds) or _UNTIL.search(words):
            return none  # "…, I'm on in two minutes"; "wait until 18:30"
    return after


def _by_morning(parts: tuple[Part, ...]) -> tuple[Part, ...]:
    """Return the parts of a time at which somebody is to be woken: a bare seven is of the morning."""
    if any(isinstance(part, DayPart) for part in parts):
        return parts
    return tuple(
        replace(part, sure=True) if isinstance(part, TimeOfDay) and part.hour in _WAKES else part
        for part in parts
    )


def _order(order: FoldedSentence, timing: Timing, words: str) -> ScheduleCommand | None:
    problem: Problem | None = timing.problem
    if problem is not None and not order.folded:
        return None  # "every day": nothing is understood
    recurs = isinstance(timing.when, CronRule | EveryRule | EventRule)
    if _OVER.fullmatch(order.folded) is not None:
        problem = "order_in_past"
    elif (recurs or problem == "order_time_missing") and is_limited(
        order.folded, is_interval=isinstance(timing.when, EveryRule)
    ):
        problem = "order_no_end"
    news = None
    if isinstance(timing.when, EventRule) and _TELL_ME.fullmatch(order.folded):
        news = NEWS[timing.when.event]
    when = timing.when if problem is None else None
    return ScheduleCommand(when, order.written.strip(), words, reminder=news, problem=problem)


def _read_timeless(order: FoldedSentence, verb: str, grammar: ModuleType) -> ScheduleCommand | None:
    """Read a reminder without its time, which is then asked for: "remind me to ring the doctor"."""
    if not grammar.TIMELESS.match(f"{verb} {order.folded}"):
        return None
    what = order.strip(grammar.OF).bare().written.strip()
    missing: Problem = "order_time_missing"
    return ScheduleCommand(None, what, "", reminder=what, problem=missing) if what else None


def _reminder(
    order: FoldedSentence, timing: Timing, words: str, grammar: ModuleType, *, woken: bool
) -> ScheduleCommand | None:
    if _THEN.match(order.folded) is not None:
        return None  # "remind me at six, and then go to the kitchen"
    what = order.strip(grammar.OF).bare().written.strip()
    if woken and grammar is english and what and what == order.written:
        whole = f"wake me up {what}"  # "wake me at nine, like actually come in"
        return ScheduleCommand(timing.when, whole, words, problem=timing.problem)
    if not what and woken:
        what = grammar.WAKE_UP
    elif not what and isinstance(timing.when, EventRule):
        what = NEWS[timing.when.event]
    return ScheduleCommand(timing.when, what, words, reminder=what, problem=timing.problem)


def _words(said: FoldedSentence, rest: FoldedSentence, before: FoundTime, after: FoundTime) -> str:
    """Return what was said of the time: the beginning and the end together."""
    ends = rest.written[after.at :] if after.parts else ""
    return " ".join(each.strip(ENDS) for each in (said.written[: before.at], ends) if each.strip())
