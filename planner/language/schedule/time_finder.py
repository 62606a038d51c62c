"""Find the parts of a time in a sentence: at its beginning, at its end, or all of it. Pure."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.schedule import chinese, english
from planner.language.schedule.folded_sentence import ENDS
from planner.language.schedule.parts import After, EventPart, Part, combine

if TYPE_CHECKING:
    from types import ModuleType

_MOST_PARTS = 6
_QUOTE = re.compile('["“”「」『』]')


@dataclass(frozen=True, slots=True)
class FoundTime:
    """Hold the parts of a time, and where they end (or, at the end of a sentence, begin)."""

    parts: tuple[Part, ...] = ()
    at: int = 0


@lru_cache(maxsize=512)
def first_parts(folded: str, grammar: ModuleType) -> FoundTime:
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
    return FoundTime(parts, at)


def _part_at(folded: str, start: int, grammar: ModuleType) -> FoundTime | None:
    for pattern, make in grammar.PARTS:
        match = pattern.match(folded, start)
        made = make(match) if match is not None and callable(make) else make
        if match is not None and match.end() > start and made:
            return FoundTime(made if isinstance(made, tuple) else (made,), match.end())
    return None


def last_parts(folded: str, grammar: ModuleType) -> FoundTime:
    """Return the longest parts of a time that a text ends with; not within quotes."""
    starts = re.finditer(r"(?<=[ ,])" if grammar is english else r"(?<=,)", folded)
    for each in starts:
        found = first_parts(folded[each.start() :], grammar)
        whole = found.parts and not folded[each.start() + found.at :].strip(ENDS)
        if whole and combine(found.parts) is not None:
            quoted = len(_QUOTE.findall(folded[: each.start()])) % 2
            start = each.start() - (3 if folded[: each.start()].endswith(" at ") else 0)
            return FoundTime() if quoted else FoundTime(found.parts, start)
    return FoundTime((), len(folded))


def reads_timing(folded: str, *, in_chinese: bool) -> bool:
    """Tell whether a text is, or ends with, a time that comes again."""
    grammar = chinese if in_chinese else english
    found = first_parts(folded, grammar)
    event = any(isinstance(part, EventPart) for part in found.parts)
    if found.parts and not event and combine(found.parts) is not None:
        return True
    return bool(last_parts(folded, grammar).parts)


def whole_parts(folded: str, *, in_chinese: bool) -> tuple[Part, ...]:
    """Return the parts of a time that a whole text is; none where it is anything else."""
    found = first_parts(folded, chinese if in_chinese else english)
    whole = found.parts and found.at == len(folded)
    return found.parts if whole else ()


def split_time(words: str) -> tuple[tuple[Part, ...], str]:
    """Return the time that stands at the beginning or the end of folded words, and what is left."""
    grammar = chinese if has_chinese(words) else english
    first = first_parts(words, grammar)
    if first.parts:
        return first.parts, words[first.at :].strip(ENDS)
    for each in re.finditer(r"(?<=[ ,])", words):
        found = first_parts(words[each.start() :], grammar)
        if found.parts and not words[each.start() + found.at :].strip(ENDS):
            return found.parts, words[: each.start()].strip(ENDS)
    return (), words


def form_pair(words: str, words_zh: str) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """Return a form in both languages; ``[is_chinese]`` picks one."""
    return re.compile(words), re.compile(words_zh)


def time_of(words: str, chinese: bool, *forms: str) -> tuple[Part, ...]:
    """Return the parts of the time that words are, which may be said without its "at"."""
    forms = forms or (("{}",) if chinese else ("{}", "at {}", "on {}", "in {}"))
    found = (whole_parts(form.format(words), in_chinese=chinese) for form in forms)
    return next((parts for parts in found if parts), ())


def lasting(words: str, chinese: bool) -> tuple[Part, ...]:
    """Return the time after so long, as "ten minutes" or "hour"."""
    words = re.sub(r"^(?=(?:hour|minute)s?$)", "one ", words)
    return time_of(words, chinese, "{}后" if chinese else "in {}")


def seconds_of(words: str, chinese: bool) -> float | None:
    """Return how long that is [s]; None where words are no length."""
    parts = lasting(words, chinese)
    return parts[0].seconds if len(parts) == 1 and isinstance(parts[0], After) else None
