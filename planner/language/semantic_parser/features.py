"""Tell what the network looks at in a unit: buckets of its word, its pieces and its neighbours.

Training and reading share this file. Which place, which amount it is says nothing of what is wanted
there, so that one home's words serve another.
"""

from __future__ import annotations

from typing import TYPE_CHECKING
from zlib import crc32

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from planner.language.semantic_parser.units import Unit

BUCKETS = 1 << 14
_MOST_PLACES = 4
_PIECE = 3
_SHORT = 3


def sentence_features(units: Sequence[Unit]) -> list[list[int]]:
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
        [crc32(feature.encode()) % BUCKETS for feature in _of_unit(*around[at : at + 3])]
        for at in range(len(names))
    ]


def _of_unit(before: str, name: str, after: str) -> Iterator[str]:
    yield name
    yield f"{before} {name}"
    yield f"{name} {after}"
    if name.startswith("<place"):
        yield "<place>"
    elif name.isdigit():
        yield f"<{len(name)} digits>"
    elif len(name) > _SHORT and name.isalpha():
        marked = f"^{name}$"
        yield f"^{name[:4]}"
        for at in range(len(marked) - _PIECE + 1):
            yield f"~{marked[at : at + _PIECE]}"
