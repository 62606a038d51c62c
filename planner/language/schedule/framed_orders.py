"""Read English orders whose time stands in their middle, and those that begin on a later day.

"Go to the fridge at six and say hello", "from Monday on, every night at eleven …". Pure. Law: the
time in the middle is of the first deed, which drives or looks and speaks no words, so that no time
of what is to be said is taken for the order's.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.language.schedule import english
from planner.language.schedule.folded_sentence import FoldedSentence
from planner.language.schedule.parts import OnceDay, TimeOfDay, combine
from planner.language.schedule.statements import ends_in_statement
from planner.language.schedule.time_finder import first_parts, last_parts, whole_parts
from planner.plan.timing import CronRule, DayTime, EveryRule, InRule

if TYPE_CHECKING:
    from planner.language.schedule.parts import Part

_DOES = re.compile(
    r"(?:please |just )*(?:go|drive|come|head|roll|look|check|patrol|visit|inspect|search|see|find|count|turn|do"
    r"|have (?:a|another) look|take a look|make (?:a|your) round|set off)\b"
)
_SAYS = re.compile(
    r"[\"“”]|\b(?:say|tell|ask|announce|remind|shout|call|greet|wish|until|till|for|before|after|when|whenever|if"
    r"|unless|while|once|by|and|then|or|since|because)\b"
)
"""With these before it, a time may be another's."""
_GOES_ON = re.compile(
    r",? (?:and|then)\b|, (?:starting|beginning|ending|finishing) (?:at|in|from|with|by) "
)
_BESIDE = re.compile(
    r"(?: (?:before|after) (?:(?:i|we) (?:go to (?:bed|sleep)|get up|leave|eat)|breakfast|lunch|dinner|supper|tea|school|work))?"
    r",? (?:let's say |say |perhaps |around |so )?"
)
"""What explains a time whose hour follows: "every night before I go to bed, say at ten"."""
_LEAD = re.compile(
    r"(?:(?:please|just) )*(?:set yourself (?:up )?to|(?:plan|arrange) to|see to it that you) "
)
_BEGINS = re.compile(
    r"(?:from|starting(?: from)?|beginning(?: on)?|as of|as from) (?P<day>[a-z ]+?)(?: on(?:wards?)?)?,? (?=(?:every|each|at|on|in|daily|remind|wake|go|say|tell|patrol|check|drive|look|please|when)\b)"
)
_ENDS_SO = re.compile(
    r",? (?:from|starting(?: from)?|beginning(?: on)?|as of|as from) (?P<day>[a-z ]+?)(?: on(?:wards?)?)?$"
)
_NOW = re.compile(r"(?:now|today|tonight|this (?:morning|evening|afternoon))")
_NO_HOUR = (
    r"(?:(?:every day |each day |daily )?at (?:sunset|sunrise|sundown|dusk|dawn|bed ?time|(?:dinner|lunch|tea|supper|breakfast|meal) ?time"
    r"|(?:dinner|lunch|tea|supper|breakfast))|when it gets (?:dark|light)|after dark)"
)
_HOURLESS = re.compile(
    rf"(?P<a>{_NO_HOUR}),? (?P<b>(?:please )?[a-z].+)|(?P<c>[a-z].+?),? (?P<d>{_NO_HOUR})"
)
_LIMIT = re.compile(
    r"for (?:the (?:next|rest)|this|an?|one|two|three|four|five|six|seven|ten|\d+)\b[a-z ]{0,20}?(?:minutes?|hours?|days?|weeks?|months?|morning|afternoon|evening|night|day|week)\b"
    r"|(?:until|till|up to)\b|this (?:week|month)\b"
)
_LIMIT_BEHIND = re.compile(r".+ for the (?:next|rest of the|rest of this) [a-z0-9 ]{2,20}")


@dataclass(frozen=True, slots=True)
class MiddleTime:
    """Hold a time, the words that said it, and the order without them."""

    parts: tuple[Part, ...]
    words: str
    order: FoldedSentence


def take_lead(said: FoldedSentence) -> FoldedSentence:
    """Return a sentence without "set yourself to"."""
    return said.strip(_LEAD)


def read_middle(said: FoldedSentence) -> MiddleTime | None:
    """Return a time that stands in the middle of a sentence, and the order about it."""
    folded = said.folded
    if _DOES.match(folded) is None:
        return None
    for cut in re.finditer(r"(?<=[ ,])(?=\S)", folded):
        head = folded[: cut.start()].rstrip(" ,")
        if _SAYS.search(head) is not None:
            return None
        parts, at = _parts_at(folded, cut.start())
        timing = combine(parts) if parts else None
        if timing is None or timing.when is None:
            continue
        behind = folded[at:]
        rules = isinstance(timing.when, (CronRule, DayTime, EveryRule, InRule))
        if not (rules and _GOES_ON.match(behind)) or ends_in_statement(head):
            return None
        if last_parts(behind, english).parts:
            return None  # two times
        head = head.removesuffix(" at")  # "at noon"
        order = FoldedSentence(head + behind, said.written[: len(head)] + said.written[at:])
        return MiddleTime(parts, said.written[cut.start() : at], order)
    return None


def _parts_at(folded: str, start: int) -> tuple[tuple[Part, ...], int]:
    """Return the parts of a time that begins here, with what explains it, and where they end."""
    found = first_parts(folded[start:], english)
    parts, at = found.parts, start + found.at
    if parts and not any(isinstance(part, TimeOfDay) for part in parts):
        gap = _BESIDE.match(folded, at)
        more = first_parts(folded[gap.end() :], english) if gap is not None else None
        if gap is not None and more is not None and more.parts:
            return (*parts, *more.parts), gap.end() + more.at
    return parts, at


def read_beginning(said: FoldedSentence) -> tuple[OnceDay | None, str, FoldedSentence] | None:
    """Return the day that an order begins on (None: now), its words, and the sentence without."""
    found = _BEGINS.match(said.folded)
    rest = said.part(found.end()) if found is not None else said
    if found is None:
        found = _ENDS_SO.search(said.folded)
        rest = said.part(0, found.start()) if found is not None else said
    if found is None:
        return None
    if _NOW.fullmatch(found["day"]) is not None:
        return None, "", rest
    for lead in ("", "on "):
        parts = whole_parts(lead + found["day"], in_chinese=False)
        if len(parts) == 1 and isinstance(parts[0], OnceDay):
            return parts[0], said.written[slice(*found.span())].strip(" ,"), rest
    return None


def is_limited(order: str) -> bool:
    """Tell whether an order says how long it is to be kept: no standing order ends by itself."""
    return _LIMIT.match(order) is not None or _LIMIT_BEHIND.fullmatch(order) is not None


_HAS_END = re.compile(r"\b(?:until|till)\b|直到|等到|为止")


def has_end(order: str) -> bool:
    """Tell whether an order says itself when it ends: kept "every five minutes" it never would."""
    return _HAS_END.search(order) is not None


def read_hourless(said: FoldedSentence) -> FoldedSentence | None:
    """Return an order at a time that no clock tells: "at sunset go to the dock"."""
    found = _HOURLESS.fullmatch(said.folded)
    if found is None:
        return None
    span = found.span("b" if found["b"] else "c")
    order = said.part(*span)
    plain = _DOES.match(order.folded) and not _SAYS.search(order.folded)
    return order if plain and " " in order.folded.strip() else None  # "look at dinner"
