"""Cut a marked sentence into units, and tell what the intent model looks at: hashes of their runs.

A unit is a place's mark, an English word, a Chinese character or a mark of punctuation. Words are
looked at by their beginnings and ends as well, so that a form that was never seen shares something
with one that was. Training and reading share this file.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from zlib import crc32

from planner.language.folding import CHINESE as HAN

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

BUCKETS = 1 << 16
MOST_UNITS = 48
"""A longer sentence is a story, and is not guessed at."""
_UNIT = re.compile(rf"[\ue000-\ue7ff]|[a-z0-9']+|[{HAN}]|[,.?!;:]")


def units_of(marked: str) -> list[str]:
    """Return the units of a normalised sentence whose places are private characters.

    Places come out as ``<0>``, ``<1>`` in their order: which place it is says nothing of what is
    wanted there.
    """
    numbers: dict[str, int] = {}
    units = []
    for unit in _UNIT.findall(marked):
        is_place = "\ue000" <= unit <= "\ue7ff"
        units.append(f"<{numbers.setdefault(unit, len(numbers))}>" if is_place else unit)
    return units


def sentence_features(units: Sequence[str]) -> list[int]:
    """Return the buckets of a sentence: units, runs of two and three of them, and pieces."""
    return [_bucket(feature) for feature in _of_sentence(("^", *units, "$"))]


def unit_features(units: Sequence[str], at: int, intent: str) -> list[int]:
    """Return the buckets that tell what the unit at a position belongs to, by its neighbours."""
    around = ("^", "^", *units, "$", "$")
    before2, before, unit, after, after2 = around[at : at + 5]
    return [
        _bucket(f"t {feature}")
        for feature in (
            f"0 {unit}",
            f"-1 {before}",
            f"+1 {after}",
            f"-2 {before2}",
            f"+2 {after2}",
            f"-2-1 {before2} {before}",
            f"+1+2 {after} {after2}",
            f"-1 0 {before} {unit}",
            f"0 +1 {unit} {after}",
            f"-1 0 +1 {before} {unit} {after}",
            f"end {unit[-3:]}",
            f"begin {unit[:3]}",
            f"{intent}",
            f"{intent} 0 {unit}",
            f"{intent} -1 {before}",
            f"{intent} +1 {after}",
        )
    ]


def _of_sentence(units: Sequence[str]) -> Iterator[str]:
    for at, unit in enumerate(units):
        after, later = units[at + 1 : at + 2], units[at + 2 : at + 3]
        yield unit
        if after:
            yield f"{unit} {after[0]}"
        if later:
            yield f"{unit} {after[0]} {later[0]}"
            yield f"{unit} * {later[0]}"
        if len(unit) > 3 and unit[0].isascii() and unit[0].isalpha():
            yield f"^{unit[:4]}"
            yield f"{unit[-3:]}$"


def _bucket(feature: str) -> int:
    return crc32(feature.encode()) % BUCKETS
