"""Tell what the network looks at in a unit: a bucket of its word, and buckets of its pieces.

Training and reading share this file. Which place, which amount it is says nothing of what is wanted
there, so that one home's words serve another. A Chinese character is known by its neighbours too:
with one of them it is a word.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING
from zlib import crc32

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from planner.language.semantic_parser.units import Unit

BUCKETS = 12_288
UNKNOWN = "<unknown>"
"""Stands for a word that was never met; training puts it in the place of some."""
_MOST_PLACES = 4
_PIECE = 3
_SHORT = 3


@dataclass(frozen=True, slots=True)
class UnitFeatures:
    """Hold the buckets of one unit, in the table of words and in that of pieces."""

    word: int
    pieces: tuple[int, ...]


def bucket_of(text: str) -> int:
    """Return the bucket of a word or a piece."""
    return crc32(text.encode()) % BUCKETS


def sentence_features(units: Sequence[Unit]) -> list[UnitFeatures]:
    """Return the buckets of each unit."""
    places: dict[str, int] = {}
    names = []
    for unit in units:
        name = unit.key
        if unit.place is not None:
            number = places.setdefault(unit.place, len(places))
            name = f"<place{min(number, _MOST_PLACES)}>"
        elif unit.amount is not None:
            name = f"<{unit.amount[0]}>"
        names.append(name)
    around = ["<begin>", *names, "<end>"]
    return [
        UnitFeatures(bucket_of(name), tuple(map(bucket_of, _pieces(*around[at : at + 3]))))
        for at, name in enumerate(names)
    ]


def _pieces(before: str, name: str, after: str) -> Iterator[str]:
    if len(name) == 1 and not name.isascii():
        yield f"{before} {name}"
        yield f"{name} {after}"
    elif name.startswith("<place"):
        yield "<place>"
    elif name.isdigit():
        yield f"<{len(name)} digits>"
    elif len(name) > _SHORT and name.isalpha():
        marked = f"^{name}$"
        yield f"^{name[:4]}"
        yield f"${name[-3:]}"
        for at in range(len(marked) - _PIECE + 1):
            yield f"~{marked[at : at + _PIECE]}"
