"""Read which sort of room a name means; the words stand in the catalogue, under ``room``.

A name counts by what it ends in: a "kitchen balcony" is no kitchen, 主卧卫生间 no bedroom.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING

from planner.language.catalogue import CATALOGUE
from planner.language.folding import fold
from planner.plan import Language

if TYPE_CHECKING:
    from collections.abc import Iterable

_PARTS = re.compile(r"[/&+,，、和与]| and ")
_NUMBER = re.compile(r" ?(?:\d+|\b[a-z]|[一二三四五六])号?$")


def sorts_of_room(names: Iterable[str]) -> frozenset[str]:
    """Return the sorts of room that any of these names means: ``kitchen``; none of most names."""
    parts = [part for name in names for part in _parts(name)]
    return frozenset(
        sort for sort, ends in _ends().items() if any(part.endswith(ends) for part in parts)
    )


@cache
def _ends() -> dict[str, tuple[str, ...]]:
    """Return what names of each sort of room end in; words in Latin letters are whole words."""
    words = {
        sort: [w for each in Language for w in CATALOGUE.synonyms(f"room.{sort}", each)]
        for sort in CATALOGUE.keys("room")
    }
    return {
        sort: tuple(f" {word}" if word.isascii() else word for word in own)
        for sort, own in words.items()
    }


def _parts(name: str) -> list[str]:
    """Return the rooms that one name is made of, each after a space, without their numbers."""
    plain = " ".join(re.split(r"[\s_-]+", fold(name)))
    return [" " + _NUMBER.sub("", part.strip()) for part in _PARTS.split(plain)]
