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
    goes_on_until,
    has_end,
    is_filler,
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
_SEES = re.compile(
    r"(?:if|when(?:ever)?|any ?time|each time|every time) (?:you )?(?:ever )?(?:see|spot|notice|detect) .+"
    r" (?:at night|after dark|while (?:i'm|i am|we're|we are) .+?), (?:please )?(?:let|tell|call|warn) me\b.*"
)
_TO_EACH = re.compile(
    r".+ (?:every(?:body|one)|any(?:body|one)|whoever|(?:each|any|all) (?:person|guests?|visitors?)|people)"
    r"(?: who| that)? (?:comes?|coming|arriv(?:es?|ing)|enters?|walks?|walking) ?(?:in|by|home|past)?\b.*"
)
_ZH_COMES = re.compile(
    r"(?:当|等|等到|只要|一旦|每次|每当)[^,]{1,8}?(?:回来|回家|到家|进门|进屋|进来)(?:了|的时候|之后|以后|时|后)*,?"
    r"(?:就|你|请)*(?:说|告诉|提醒|通知|[跟和给对].{1,3}(?:说|讲)).+"
)
"""With ``_SEES``: waits for what is read as no event: done now it would be another order."""
_NOT_NOW = re.compile(r"not (?:now|yet)[, ]+(?:but )?")
_WAKES = range(4, 12)
_QUOTED = re.compile(r'[“"].*?[”"]')
_DOES = re.compile(
    r"(?:please |just )*(?:go|drive|come|head|look|check|patrol|visit|search|find|count|turn|do|have|take|make)\b"
)
_THEN = re.compile(r"(?:and|then)\b")
_UNTIL = re.compile(r"\b(?:until|till)$")
_CLAUSE = re.compile(r"[,;.]+ *(?:but |and |although )?")
_TELLS = re.compile(r"(?: and|,|;) (?:then )?(?:tell|let|call|warn|say|ask|shout|remind|alert)\b")
"""Of two orders the one that waits for the event behind them."""


@lru_cache(maxsize=64)
def read_order_command(text: str) -> OrderCommand | None:
    """Return what a sentence says about standing orders; None where it is none of these."""
    if not 0 < len(text.strip()) <= MAX_READ:
        return None
    said = fold_sentence(text)
    asks = said.folded.rstrip(ENDS).endswith("?")
    grammar = chinese if has_chinese(said.folded) else english
    said = FoldedSentence(said.folded.replace("?", " "), said.written)
    said = said.bare().strip(grammar.POLITE).strip_end(grammar.POLITE_END).bare()
    return _read_command(said, grammar, text, asks=asks)


def _read_command(
    said: FoldedSentence, grammar: ModuleType, text: str, *, asks: bool
) -> OrderCommand | None:
    is_chinese = grammar is chinese
    excepted = None if asks else _read_excepting(said, grammar)
    if excepted is not None:
        return excepted
    about = read_asked(said.folded, chinese=is_chinese) or read_change(
        said.folded, chinese=is_chinese
    )
    if about is not None:
        return about
    if not asks and _SEES.fullmatch(said.folded) is not None:
        return ScheduleCommand(None, said.written, "", problem="order_no_event")
    courteous = (
        asks and grammar is english and fold_sentence(text).folded.startswith(("can", "could", "w"))
    )
    if (asks and not courteous) or grammar.ASKS.match(said.folded) is not None:
        return None
    if grammar.PAST.fullmatch(said.folded) is not None:
        return ScheduleCommand(None, said.written, "", problem="order_in_past")
    corrects = read_correction(said.folded, chinese=is_chinese)
    if isinstance(corrects, CorrectOrder) and isinstance(corrects.change, RemindAgain):
        return replace(
            corrects, otherwise=_read(said.strip(_NOT_NOW), grammar)
        )  # "… again in five"
    order = corrects or _read(said, grammar)
    if order is None and not asks and (problem := _problem_of(said, grammar)) is not None:
        return ScheduleCommand(None, said.written, "", problem=problem)
    return order


def _problem_of(said: FoldedSentence, grammar: ModuleType) -> Problem | None:
    """Return why a sentence is no order of now either; None: it may be one.

    A time that comes again and stands in the middle is passed over by nobody: "look round at ten
    every night, and tell me who is in" is not done at once.
    """
    if grammar is chinese:
        return "order_no_event" if _ZH_COMES.fullmatch(said.folded) is not None else None
    if _TO_EACH.fullmatch(said.folded) is not None:
        return "order_no_event"
    plain = _QUOTED.sub(lambda found: " " * len(found[0]), said.folded)
    if _DOES.match(plain) is None:
        return None
    for cut in re.finditer(r"(?<=[ ,])(?=every |each |daily)", plain):
        parts = first_parts(plain[cut.start() :], grammar).parts
        if any(isinstance(part, WeekDays) for part in parts):
            return "order_time_within"
    return None


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
    if remind is not None:
        inner = rest.part(remind.end())
        middle = first_parts(inner.folded.lstrip(" ,"), grammar)
        if middle.parts:
            shift = len(inner.folded) - len(inner.folded.lstrip(" ,"))
            inner = inner.part(shift + middle.at)
        parts = (*before.parts, *middle.parts)
        rest, before = inner, FoundTime(_by_morning(parts) if remind["wake"] else parts, before.at)
    elif before.parts:
        rest = rest.strip(grammar.POLITE)
    after = _time_behind(rest, before, grammar, reminds=remind is not None)
    order = rest.part(0, after.at) if after.parts else rest
    if (
        after.parts and english.TWO_HOURS.search(order.folded.rstrip()) is not None
    ):  # "at eight and at six"
        return ScheduleCommand(None, said.written, "", problem="order_nested")
    woken = remind is not None and bool(remind["wake"])
    parts = (*before.parts, *after.parts)
    timing = combine(_by_morning(parts) if woken else parts)
    if (
        after.parts
        and timing
        and isinstance(timing.when, EventRule)
        and _TELLS.search(order.folded)
    ):
        return None  # "go to the kitchen and tell me when somebody comes": the telling waits
    if timing is None:
        lacks = remind is not None and not (before.parts or after.parts or remind["wake"])
        return _read_timeless(order, remind[0], grammar) if lacks and remind is not None else None
    words = _words(said, rest, before, after)
    if remind is not None:
        return _reminder(order, timing, words, grammar, woken=woken)
    said_first = order.bare().folded
    remark = grammar.REMARK.match(said_first) is not None
    once = isinstance(timing.when, DayTime | InRule) and before.parts
    if remark or (once and begins_with_statement(said_first, chinese=grammar is chinese)):
        return None  # "it's cold tonight", "at nine the doctor comes, …": a time, and no order
    return _order(order.bare(), timing, words)


def _time_behind(
    rest: FoldedSentence, before: FoundTime, grammar: ModuleType, *, reminds: bool
) -> FoundTime:
    """Return the time that an order ends with, where it is the order's."""
    after = last_parts(rest.folded, grammar)
    if before.parts and after.parts and not reminds and combine(before.parts) is not None:
        joined = combine((*before.parts, *after.parts))
        if joined is None or (joined.problem == "order_nested" and combine(after.parts) is None):
            after = FoundTime((), len(rest.folded))  # "every day at eight say good night at ten"
    if after.parts and grammar is english and not lacks_time(before.parts):
        words = rest.folded[: after.at].rstrip(" ")
        told = not reminds and is_once(after.parts) and ends_in_told_words(words)
        if told or ends_in_statement(words, reminds=reminds) or _UNTIL.search(words):
            after = FoundTime(
                (), len(rest.folded)
            )  # "…, I'm on in two minutes"; "wait until 18:30"
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
    empty = timing.problem is not None and not order.folded  # "every day": nothing is understood
    ends = isinstance(timing.when, EveryRule) and has_end(order.folded)
    if empty or ends or is_filler(order.folded):
        return None
    if goes_on_until(order.folded):
        return ScheduleCommand(None, order.written, "", problem="order_nested")
    recurs = isinstance(timing.when, CronRule | EveryRule | EventRule)
    if (recurs or timing.problem == "order_time_missing") and is_limited(order.folded):
        return ScheduleCommand(None, order.written, "", problem="order_no_end")
    if isinstance(timing.when, EventRule) and timing.problem is None:
        news = NEWS[timing.when.event] if _TELL_ME.fullmatch(order.folded) else None
        return ScheduleCommand(timing.when, order.written.strip(), words, reminder=news)
    return ScheduleCommand(timing.when, order.written.strip(), words, problem=timing.problem)


def _read_timeless(order: FoldedSentence, verb: str, grammar: ModuleType) -> ScheduleCommand | None:
    """Read a reminder without its time, which is then asked for: "remind me to ring the doctor"."""
    if grammar.OPEN.search(order.folded) or not grammar.TIMELESS.match(f"{verb}{order.folded}"):
        return None
    what = order.bare().strip(grammar.OF).bare().written.strip()
    missing: Problem = "order_time_missing"
    return ScheduleCommand(None, what, "", reminder=what, problem=missing) if what else None


def _reminder(
    order: FoldedSentence, timing: Timing, words: str, grammar: ModuleType, *, woken: bool
) -> ScheduleCommand | None:
    bare = order.bare()
    if _THEN.match(bare.folded) is not None:
        return None  # "remind me at six, and then go to the kitchen"
    what = bare.strip(grammar.OF).bare().written.strip()
    if woken and grammar is english and what and what == bare.written:
        whole = f"wake me up {bare.written}"  # "wake me at nine, like actually come in"
        return ScheduleCommand(timing.when, whole, words, problem=timing.problem)
    if woken and not what:
        what = grammar.WAKE_UP
    if isinstance(timing.when, EventRule) and not what:
        what = NEWS[timing.when.event]
    return ScheduleCommand(timing.when, what, words, reminder=what, problem=timing.problem)


def _words(said: FoldedSentence, rest: FoldedSentence, before: FoundTime, after: FoundTime) -> str:
    """Return what was said of the time: the beginning and the end together."""
    ends = rest.written[after.at :] if after.parts else ""
    return " ".join(each.strip(ENDS) for each in (said.written[: before.at], ends) if each.strip())
