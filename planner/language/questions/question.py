"""Hold what a question says in its own words, before anybody knows what the eyes can tell."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from planner.language.folding import fold_words

PlaceNames = Mapping[str, bool]
"""What a site's rooms and places are called, folded; and whether that is a room."""


def fold_names(places: Iterable[tuple[bool, Iterable[str]]]) -> PlaceNames:
    """Return the names of places as questions are compared with them.

    Args:
        places: of each whether it is a room, and what it is called.
    """
    return {fold_words(name): is_room for is_room, names in places for name in names}


class Relation(StrEnum):
    """How a thing stands to its neighbour."""

    ON = "on"
    UNDER = "under"
    NEAR = "near"


class Whereabouts(NamedTuple):
    """Hold a thing's relation to its neighbour, in words."""

    relation: Relation | None
    """None: in, behind or before it, which no position tells."""
    by: str
    """The neighbour's words."""
    said: str
    """All of it, as said."""


class ObjectQuestion(NamedTuple):
    """Say what a question asks for, yes or no, in its words."""

    what: str
    certain: bool = False
    """It is a kind of thing though no table names it."""
    where: str = ""
    """Where it is to be: ``on the table``, ``桌子上``; empty: nowhere in particular."""
    may_refuse: bool = True
    """Eyes that don't know the kind refuse it; else they tell what they see."""


@dataclass(frozen=True, slots=True)
class QuestionReading:
    """Hold what a question asks for, and where."""

    asked: tuple[ObjectQuestion, ...]
    """What it may ask for, yes or no, the likeliest first; none where that is open."""
    what: str
    """The words of what it is about; empty: all that is there."""
    where: Whereabouts | None
    is_sure: bool
    """Its form was read; else it is about something that its words merely name somewhere."""
