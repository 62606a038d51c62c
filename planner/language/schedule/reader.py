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
from planner.language.schedule.command import OrderCommand, RemindAgain, ScheduleCommand
from planner.language.schedule.corrections import read_correction
from planner.language.schedule.parts import EventPart, Part, Timing, combine
from planner.language.schedule.statements import begins_with_statement, ends_in_statement
from planner.plan.timing import DayTime, InRule

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
    about = read_about(said.folded, _reads_timing, _whole_parts, chinese=grammar is chinese)
    if about is not None:
        return about
    courteous = asks and grammar is english and _fold(text).folded.startswith(("can", "could", "w"))
    if (asks and not courteous) or grammar.ASKS.match(said.folded) is not None:
        return None
    if grammar.PAST.fullmatch(said.folded) is not None:
        return ScheduleCommand(None, said.written, "", problem="order_in_past")
    corrects = read_correction(said.folded, _whole_parts, chinese=grammar is chinese)
    if corrects is None:
        return _read(said, grammar)
    if isinstance(corrects.change, RemindAgain):  # "remind me again in five minutes"
        return replace(corrects, otherwise=_read(said.strip(_NOT_NOW), grammar))
    return corrects


def _fold(text: str) -> _FoldedSentence:
    spaced = _SPACES.sub(" ", fold_width(text).translate(_MARKS)).strip()
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
        if joined is None or (joined.problem == "order_nested" and not _repeats(after.parts)):
            after = _Found((), len(rest.folded))  # "every day at eight say good night at ten"
    if after.parts and grammar is english and not _lacks_time(before.parts):
        words = rest.folded[: after.at].rstrip(" ")
        if ends_in_statement(words, reminds=remind is not None) or _UNTIL.search(words):
            after = _Found((), len(rest.folded))  # "…, I'm on in two minutes"; "wait until 18:30"
    order = rest.part(0, after.at) if after.parts else rest
    timing = combine((*before.parts, *after.parts))
    if timing is None:
        return None
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


def _repeats(parts: tuple[Part, ...]) -> bool:
    timing = combine(parts)
    return timing is not None


def _order(order: _FoldedSentence, timing: Timing, words: str) -> ScheduleCommand | None:
    if timing.problem is not None and not order.folded:
        return None  # "every day": nothing that is understood
    return ScheduleCommand(timing.when, order.written.strip(), words, problem=timing.problem)


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
