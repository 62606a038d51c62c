"""Cut a sentence into units: words, Chinese characters, marks; a place's name or an amount is one.

A unit knows where it stands in the sentence as it was said, so that what is pointed at is told in
the person's own words. Places are looked up among the site's names, the longest first.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from planner.language.folding import CHINESE, fold
from planner.language.semantic_parser.amounts import find_amounts

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from planner.language.semantic_parser.plan_grammar import SlotKind

MAX_UNITS = 96
"""A longer sentence is a story, and is not read."""
_CLITICS = "s|t|m|d|re|ve|ll|em|clock"
_WORD = rf"[^\W\d_{CHINESE}]+"
_PIECE = re.compile(
    rf"[{CHINESE}]|{_WORD}|\d+|['’‘](?:{_CLITICS})(?![^\W_])|[^\s\w'’‘]", re.IGNORECASE
)
"""An apostrophe belongs to a piece where it begins a word's own end: "it's", not "t'hall"."""
_APOSTROPHES = str.maketrans("’‘", "''")


@dataclass(frozen=True, slots=True)
class Unit:
    """Hold one unit, and its place in the sentence."""

    key: str
    """Its folded text."""
    start: int
    end: int
    place: str | None = None
    """What the site calls the place that it names."""
    amount: tuple[SlotKind, float] | None = None


@dataclass(frozen=True, slots=True)
class SentenceUnits:
    """Hold a sentence and its units."""

    text: str
    units: tuple[Unit, ...]

    def words_between(self, first: int, last: int) -> str:
        """Return the words from one unit to another as they were said."""
        return self.text[self.units[first].start : self.units[last].end]


class Gazetteer:
    """Find a site's names in sentences.

    Args:
        names: what each spelling names; a spelling that names two places names none.
    """

    def __init__(self, names: Mapping[str, str]) -> None:
        self._places = {keys_of(spelling): place for spelling, place in names.items()}
        self._places.pop((), None)
        self._longest = max(map(len, self._places), default=0)

    def at(self, keys: tuple[str, ...], first: int) -> tuple[int, str] | None:
        """Return where a name that begins at a position ends, and the place; None: none begins."""
        for length in range(min(self._longest, len(keys) - first), 0, -1):
            place = self._places.get(keys[first : first + length])
            if place is not None:
                return first + length, place
        return None


@lru_cache(maxsize=4096)
def keys_of(text: str) -> tuple[str, ...]:
    """Return the folded pieces of a text, hyphens and marks left out."""
    return tuple(key for key, _, _ in _pieces(text) if key[-1].isalnum())


def _pieces(text: str) -> Iterable[tuple[str, int, int]]:
    for found in _PIECE.finditer(text):
        key = fold(found[0]).translate(_APOSTROPHES)
        if key:
            yield key, found.start(), found.end()


def cut_units(text: str, names: Gazetteer) -> SentenceUnits:
    """Return a sentence's units."""
    pieces = [Unit(key, start, end) for key, start, end in _pieces(text)]
    units = _join_amounts(text, pieces)
    keys = tuple(unit.key for unit in units)
    joined: list[Unit] = []
    at = 0
    while at < len(units):
        found = None if units[at].amount else names.at(keys, at)
        if found is None:
            joined.append(units[at])
            at += 1
            continue
        after, place = found
        last = units[after - 1]
        key = " ".join(keys[at:after])
        joined.append(Unit(key, units[at].start, last.end, place=place))
        at = after
    return SentenceUnits(text, tuple(joined))


def _join_amounts(text: str, pieces: list[Unit]) -> list[Unit]:
    """Return the pieces, those of an amount joined."""
    folded, borders = "", {}
    for number, piece in enumerate(pieces):
        gap = number > 0 and text[pieces[number - 1].end : piece.start].isspace()
        folded += " " if gap else ""
        borders[len(folded)] = number
        folded += piece.key
    ends = {start + len(pieces[number].key): number + 1 for start, number in borders.items()}
    spans = {}
    for found in find_amounts(folded):
        if found.start in borders and found.end in ends:
            spans[borders[found.start]] = (ends[found.end], (found.kind, found.value))
    joined: list[Unit] = []
    at = 0
    while at < len(pieces):
        after, amount = spans.get(at, (at + 1, None))
        key = " ".join(piece.key for piece in pieces[at:after])
        joined.append(Unit(key, pieces[at].start, pieces[after - 1].end, amount=amount))
        at = after
    return joined
