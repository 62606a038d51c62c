"""Read a whole sentence as a standing order, a word about the standing orders, or neither.

A time stands at the beginning of an order or at its end; what is left is the order, as it was
written. A question is none, nor a condition that is no event ("if somebody is in the kitchen").
Pure: no clock, no state.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from planner.language.folding import fold_script, fold_width, has_chinese
from planner.language.schedule import chinese, english
from planner.language.schedule.about import read_about
from planner.language.schedule.arrivals import offer_event, read_arrival
from planner.language.schedule.command import (
    LeaveOutDays,
    OrderCommand,
    RemindAgain,
    ScheduleCommand,
)
from planner.language.schedule.corrections import read_correction
from planner.language.schedule.parts import (
    EventPart,
    Part,
    Problem,
    Timing,
    combine,
    leave_days_out,
)
from planner.language.schedule.placed_reminders import settle_deed
from planner.language.schedule.reasons import leave_reasons_out
from planner.language.schedule.statements import begins_with_statement, ends_in_statement
from planner.plan.timing import CronRule, DayTime, EventRule, InRule, WorldEvent

if TYPE_CHECKING:
    from types import ModuleType

MAX_READ = 300
"""Characters; a longer sentence is no standing order."""
_ENDS = " .!,;:。~…，；！、"
_MARKS = str.maketrans({"’": "'", "‘": "'", "，": ",", "；": ";", "：": ":", "！": "!", "？": "?"})
_SPACES = re.compile(r"\s+")
_MOST_PARTS = 6
_NOT_NOW = re.compile(r"not (?:now|yet)[, ]+(?:but )?")
_UNTIL = re.compile(r"\b(?:until|till)$")
_CLAUSE = re.compile(r"[,;.]+ *(?:but |and |although )?")
_DAYS_ER = re.compile(
    r"(?<!说)([今明后])儿个?(?=[早上中下晚夜]|[一二三四五六七八九十两\d]{1,2}[点:])"
)
"""明儿早上 is 明天早上."""
_DENIAL = re.compile(
    r"(?:[就都也])*(?:别|不要|不用|不准|不许)|(?:don't|do not|never|not) ", re.IGNORECASE
)
_QUOTE = re.compile('["“”「」『』]')


@dataclass(frozen=True, slots=True)
class _FoldedSentence:
    """Hold a sentence twice, character for character alike: to match, and as it was written."""

    folded: str
    written: str

    def part(self, start: int, end: int | None = None) -> _FoldedSentence:
        return _FoldedSentence(self.folded[start:end], self.written[start:end])

    def strip(self, pattern: re.Pattern[str]) -> _FoldedSentence:
        """Take off what a pattern matches at the beginning."""
        found = pattern.match(self.folded)
        return self.part(found.end()) if found is not None else self

    def strip_end(self, pattern: re.Pattern[str]) -> _FoldedSentence:
        found = pattern.search(self.folded)
        return self.part(0, found.start()) if found is not None and found.start() > 0 else self

    def bare(self) -> _FoldedSentence:
        start = len(self.folded) - len(self.folded.lstrip(_ENDS))
        return self.part(start, max(start, len(self.folded.rstrip(_ENDS))))


@dataclass(frozen=True, slots=True)
class _Found:
    """Hold the parts of a time, and where they end (or, at the end of a sentence, begin)."""

    parts: tuple[Part, ...] = ()
    at: int = 0


@lru_cache(maxsize=64)
def read_order_command(text: str) -> OrderCommand | None:
    """Return what a sentence says about standing orders; None where it is none of these."""
    if not 0 < len(text.strip()) <= MAX_READ:
        return None
    said = _fold(text)
    asks = said.folded.rstrip(_ENDS).endswith("?")
    grammar = chinese if has_chinese(said.folded) else english
    said = _FoldedSentence(said.folded.replace("?", " "), said.written)
    said = said.bare().strip(grammar.POLITE).strip_end(grammar.POLITE_END).bare()
    command = settle_deed(_read_command(said, grammar, text, asks=asks))
    if asks or not (command is None or _denies(command)):
        return command
    bare = leave_reasons_out(said.folded, chinese=grammar is chinese)
    if bare is None:
        return command
    bare = _FoldedSentence(bare, bare).strip(grammar.POLITE).strip_end(grammar.POLITE_END).folded
    about = _read_about_kept(bare.strip(_ENDS), grammar)
    alone = _FoldedSentence(bare.strip(_ENDS), bare.strip(_ENDS))
    timed = about is None and _whole_parts(alone.folded, in_chinese=grammar is chinese)
    return (settle_deed(_read(alone, grammar)) if timed else about) or command


def _denies(command: OrderCommand) -> bool:
    """Tell whether an order says what is not to be done: a change of one that is kept, perhaps."""
    if not isinstance(command, ScheduleCommand) or command.reminder is not None:
        return False
    return _DENIAL.match(command.order) is not None


def _read_about_kept(folded: str, grammar: ModuleType) -> OrderCommand | None:
    """Return what a sentence says about orders that are kept: a question, a change, a removal."""
    is_chinese = grammar is chinese
    return read_about(folded, _reads_timing, _whole_parts, chinese=is_chinese) or read_correction(
        folded, _whole_parts, chinese=is_chinese
    )


def _read_command(
    said: _FoldedSentence, grammar: ModuleType, text: str, *, asks: bool
) -> OrderCommand | None:
    is_chinese = grammar is chinese
    excepted = None if asks else _read_excepting(said, grammar)
    if excepted is not None:
        return excepted
    about = read_about(said.folded, _reads_timing, _whole_parts, chinese=is_chinese)
    if about is not None:
        return about
    if not asks and (unseen := _read_event(said, grammar)) is not None:
        return unseen
    courteous = asks and grammar is english and _fold(text).folded.startswith(("can", "could", "w"))
    if (asks and not courteous) or grammar.ASKS.match(said.folded) is not None:
        return None
    if grammar.PAST.fullmatch(said.folded) is not None:
        return ScheduleCommand(None, said.written, "", problem="order_in_past")
    corrects = read_correction(said.folded, _whole_parts, chinese=is_chinese)
    if corrects is None:
        return _read(said, grammar)
    if isinstance(corrects.change, RemindAgain):  # "remind me again in five minutes"
        return replace(corrects, otherwise=_read(said.strip(_NOT_NOW), grammar))
    return corrects


def _read_excepting(said: _FoldedSentence, grammar: ModuleType) -> ScheduleCommand | None:
    """Read "every day at seven wake us up, but not at weekends", 每天七点…，周末就不要了."""
    for cut in reversed(list(_CLAUSE.finditer(said.folded))):
        days = read_correction(said.folded[cut.end() :], _whole_parts, chinese=grammar is chinese)
        if days is None or days.which or not isinstance(days.change, LeaveOutDays):
            return None
        order = _read(said.part(0, cut.start()).bare(), grammar)
        if order is None or not isinstance(order.when, CronRule) or order.problem is not None:
            return None
        when = leave_days_out(order.when, days.change.days, keeps=days.change.keeps)
        words = f"{order.words} {said.written[cut.end() :]}"
        return None if when is None else replace(order, when=when, words=words)
    return None


def _read_event(said: _FoldedSentence, grammar: ModuleType) -> ScheduleCommand | None:
    """Read an order upon somebody's coming who is named, or upon what can't be noticed."""
    is_chinese = grammar is chinese
    arrival = read_arrival(said.folded, said.written, chinese=is_chinese)
    if arrival is not None:
        when = EventRule(event=WorldEvent.PERSON_SEEN)
        return ScheduleCommand(when, arrival.order, "", who=arrival.who)
    offer = offer_event(said.folded, chinese=is_chinese)
    if offer is None or (not offer and _first_parts(said.folded, grammar).parts):
        return None
    problem: Problem = "order_event_place" if offer else "order_no_event"
    return ScheduleCommand(None, said.written, "", problem=problem, offer=offer)


def _fold(text: str) -> _FoldedSentence:
    spaced = _SPACES.sub(" ", fold_width(text).translate(_MARKS)).strip()
    spaced = _DAYS_ER.sub(r"\1天", spaced)
    if has_chinese(spaced):  # spaces between characters mean nothing; between Latin words they do
        spaced = re.sub(r"(?<![A-Za-z0-9]) | (?![A-Za-z0-9])", "", spaced)
    folded = spaced.lower()
    if len(folded) != len(spaced):  # a few letters grow in lower case
        spaced = folded
    return _FoldedSentence(fold_script(folded), spaced)


def _read(said: _FoldedSentence, grammar: ModuleType) -> ScheduleCommand | None:
    """Read a time, an order, and whether it is to be reminded of."""
    before = _first_parts(said.folded, grammar)
    rest = said.part(before.at).strip(grammar.LEAD)
    remind = grammar.REMIND.match(rest.folded)
    if remind is not None:
        inner = rest.part(remind.end())
        middle = _first_parts(inner.folded.lstrip(" ,"), grammar)
        if middle.parts:
            shift = len(inner.folded) - len(inner.folded.lstrip(" ,"))
            inner = inner.part(shift + middle.at)
        rest, before = inner, _Found((*before.parts, *middle.parts), before.at)
    elif before.parts:
        rest = rest.strip(grammar.POLITE)
    after = _last_parts(rest.folded, grammar)
    if before.parts and after.parts and remind is None and combine(before.parts) is not None:
        joined = combine((*before.parts, *after.parts))
        if joined is None or (joined.problem == "order_nested" and combine(after.parts) is None):
            after = _Found((), len(rest.folded))  # "every day at eight say good night at ten"
    if after.parts and grammar is english and not _lacks_time(before.parts):
        words = rest.folded[: after.at].rstrip(" ")
        if ends_in_statement(words, reminds=remind is not None) or _UNTIL.search(words):
            after = _Found((), len(rest.folded))  # "…, I'm on in two minutes"; "wait until 18:30"
    order = rest.part(0, after.at) if after.parts else rest
    timing = combine((*before.parts, *after.parts))
    if timing is None:
        lacks = remind is not None and not (before.parts or after.parts or remind["wake"])
        return _read_timeless(order, remind[0], grammar) if lacks and remind is not None else None
    words = _words(said, rest, before, after)
    if remind is not None:
        return _reminder(order, timing, words, grammar, woken=bool(remind["wake"]))
    said_first = order.bare().folded
    remark = grammar.REMARK.match(said_first) is not None
    once = isinstance(timing.when, DayTime | InRule) and before.parts
    if remark or (once and begins_with_statement(said_first, chinese=grammar is chinese)):
        return None  # "it's cold tonight", "at nine the doctor comes, …": a time, and no order
    return _order(order.bare(), timing, words)


def _lacks_time(parts: tuple[Part, ...]) -> bool:
    """Tell whether these name a day, and not when on it: "every day", "tomorrow"."""
    timing = combine(parts)
    return timing is not None and timing.problem == "order_time_missing"


def _order(order: _FoldedSentence, timing: Timing, words: str) -> ScheduleCommand | None:
    if timing.problem is not None and not order.folded:
        return None  # "every day": nothing that is understood
    return ScheduleCommand(timing.when, order.written.strip(), words, problem=timing.problem)


def _read_timeless(
    order: _FoldedSentence, verb: str, grammar: ModuleType
) -> ScheduleCommand | None:
    """Read a reminder without its time, which is then asked for: "remind me to ring the doctor"."""
    if grammar.OPEN.search(order.folded) or not grammar.TIMELESS.match(f"{verb}{order.folded}"):
        return None
    what = order.bare().strip(grammar.OF).bare().written.strip()
    missing: Problem = "order_time_missing"
    return ScheduleCommand(None, what, "", reminder=what, problem=missing) if what else None


def complete_order(command: ScheduleCommand, time: str) -> ScheduleCommand | None:
    """Return an order that lacked its time with the time that was said for it; None: it is none."""
    said = _fold(time)
    grammar = chinese if has_chinese(said.folded) else english
    bare = said.bare().strip(grammar.POLITE).strip_end(grammar.POLITE_END).bare()
    for words in (f"{command.words} {bare.written}".strip(), bare.written):
        folded = _fold(words).folded
        for lead in ("", "at ") if grammar is english else ("",):
            parts = _whole_parts(lead + folded, in_chinese=grammar is chinese)
            timing = combine(parts) if parts else None
            if timing is not None and timing.when is not None:
                return replace(command, when=timing.when, words=words, problem=None)
    return None


def _reminder(
    order: _FoldedSentence, timing: Timing, words: str, grammar: ModuleType, *, woken: bool
) -> ScheduleCommand:
    what = order.bare().strip(grammar.OF).bare().written.strip()
    if woken and not what:
        what = grammar.WAKE_UP
    return ScheduleCommand(timing.when, what, words, reminder=what, problem=timing.problem)


def _words(said: _FoldedSentence, rest: _FoldedSentence, before: _Found, after: _Found) -> str:
    """Return what was said of the time: the beginning and the end together."""
    ends = rest.written[after.at :] if after.parts else ""
    return " ".join(each.strip(_ENDS) for each in (said.written[: before.at], ends) if each.strip())


def _first_parts(folded: str, grammar: ModuleType) -> _Found:
    """Return the parts of a time that a text begins with."""
    parts: tuple[Part, ...] = ()
    at = 0
    for _ in range(_MOST_PARTS):
        gap = grammar.GAP.match(folded, at)
        start = gap.end() if gap is not None and parts else at
        found = _part_at(folded, start, grammar)
        if found is None:
            break
        parts, at = (*parts, *found.parts), found.at
    return _Found(parts, at)


def _part_at(folded: str, start: int, grammar: ModuleType) -> _Found | None:
    for pattern, make in grammar.PARTS:
        match = pattern.match(folded, start)
        if match is not None and match.end() > start and (parts := make(match)):
            return _Found(parts, match.end())
    return None


def _last_parts(folded: str, grammar: ModuleType) -> _Found:
    """Return the longest parts of a time that a text ends with; not within quotes."""
    starts = re.finditer(r"(?<=[ ,])" if grammar is english else r"(?<=,)", folded)
    for each in starts:
        found = _first_parts(folded[each.start() :], grammar)
        whole = found.parts and not folded[each.start() + found.at :].strip(_ENDS)
        if whole and combine(found.parts) is not None:
            quoted = len(_QUOTE.findall(folded[: each.start()])) % 2
            return _Found() if quoted else _Found(found.parts, each.start())
    return _Found((), len(folded))


def _reads_timing(folded: str, *, in_chinese: bool) -> bool:
    """Tell whether a text is, or ends with, a time that comes again."""
    grammar = chinese if in_chinese else english
    found = _first_parts(folded, grammar)
    event = any(isinstance(part, EventPart) for part in found.parts)
    if found.parts and not event and combine(found.parts) is not None:
        return True
    return bool(_last_parts(folded, grammar).parts)


def _whole_parts(folded: str, *, in_chinese: bool) -> tuple[Part, ...]:
    """Return the parts of a time that a whole text is; none where it is anything else."""
    found = _first_parts(folded, chinese if in_chinese else english)
    whole = found.parts and found.at == len(folded)
    return found.parts if whole else ()


def split_time(words: str) -> tuple[tuple[Part, ...], str]:
    """Return the time that stands at the beginning or the end of folded words, and what is left."""
    grammar = chinese if has_chinese(words) else english
    first = _first_parts(words, grammar)
    if first.parts:
        return first.parts, words[first.at :].strip(_ENDS)
    for each in re.finditer(r"(?<=[ ,])", words):
        found = _first_parts(words[each.start() :], grammar)
        if found.parts and not words[each.start() + found.at :].strip(_ENDS):
            return found.parts, words[: each.start()].strip(_ENDS)
    return (), words
