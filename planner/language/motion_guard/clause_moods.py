"""Tell what a clause does by how it opens: order, question, or a statement. Pure.

An order opens with its verb once courtesy is set aside; a verb that is not known counts where it
leads to a place. Who stands before the verb, the past and what is supposed order nothing.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

from planner.language.motion_guard.clause_cuts import FINITE, strip_openers
from planner.language.motion_guard.clause_words import CHINESE, ENGLISH, ClauseWords
from planner.language.motion_guard.mentioned_names import find_places, first_place
from planner.language.numbers import EN_OFTEN
from planner.language.person_names import is_given_name

if TYPE_CHECKING:
    from planner.plan import Vocabulary


_STATIC = re.compile(r"(?:in|at|by|with|near|beside|behind|before|on)\b")
MY_ASK = re.compile(r"(?:tell|let|inform|show) (?:me|us)\b")
_TO_PLACE = re.compile(
    r"(?!(?:the|a|an|my|our|your|which|what|\w+(?:ed|s|ing|n't)) )(?:[a-z']+ ){1,5}?"
    r"(?:to|into|towards?|over to|up to)(?: the| my| our)? $"
)
_FILLS = re.compile(
    rf"\b(?:once|twice|thrice|(?:a )?(?:{EN_OFTEN}) times|the|a|my|our|and|too|also|next|by|of|to"
    r"|in|at|on|up|there|instead|side|i think|it's|(?:one|room|place) (?:with|that has))\b"
    r"|我说的?|有(?=\s*的)|的那?(?:一?[间个]|房间|屋)|[就里间边上儿那和跟与、了吧呀啊哦呢旁面]|[^\w]+"
)
_AFTER_ZH = re.compile(r"(?:那?[里边儿上个面]|之间|中间|[的和跟与、]|房间)*")


class ClauseMood(Enum):
    """Tell what a clause does."""

    ORDER = auto()
    QUESTION = auto()
    CONDITION = auto()
    FACT = auto()
    DENIED = auto()
    CALL = auto()
    """Calls somebody who is not the robot: what follows is theirs."""
    NOTHING = auto()


@dataclass(frozen=True, slots=True)
class Before:
    """Hold what the clauses before one do, in their order."""

    moods: tuple[ClauseMood, ...]

    @property
    def last(self) -> ClauseMood:
        """Return what the clause right before does."""
        return self.moods[-1] if self.moods else ClauseMood.NOTHING

    @property
    def states(self) -> bool:
        """Tell whether anything was stated, asked or supposed."""
        return not {ClauseMood.FACT, ClauseMood.QUESTION, ClauseMood.CONDITION}.isdisjoint(
            self.moods
        )


def read_english(
    words: str, rest: str, asks: bool, vocabulary: Vocabulary, before: Before
) -> ClauseMood:
    """Return what an English clause does; ``rest``: without courtesy, ``asks``: by its mark."""
    table = ENGLISH
    if table.supposes.search(words) or table.past.match(rest):
        return ClauseMood.FACT
    if _is_call(rest, table, vocabulary, before):
        return ClauseMood.CALL
    if _is_theirs(rest, vocabulary):
        return ClauseMood.FACT
    asked = table.to_you.match(rest)
    verb = (
        strip_openers(strip_openers(rest, table.to_you), table.opens) if asked is not None else rest
    )
    if (mine := MY_ASK.match(verb)) is not None and verb[mine.end() :].strip():
        return ClauseMood.QUESTION
    if is_bare(verb, vocabulary):
        else_way = before.last is ClauseMood.CONDITION and table.ways.match(verb)
        stated = asked is None and before.states and not else_way
        return ClauseMood.FACT if stated else ClauseMood.QUESTION if asks else ClauseMood.ORDER
    if asked is None and table.others.match(rest):
        return ClauseMood.QUESTION if asks else ClauseMood.FACT
    if _STATIC.match(verb):
        return (
            before.last
            if before.last is ClauseMood.ORDER and not FINITE.search(verb)
            else ClauseMood.FACT
        )
    if table.orders.match(verb) or (table.ways.match(verb) and not FINITE.search(verb)):
        return ClauseMood.ORDER
    if table.asks.match(rest) or asks:
        return ClauseMood.QUESTION
    place = first_place(verb, vocabulary)
    led = place is not None and _TO_PLACE.fullmatch(verb[: place.start]) is not None
    first = verb.split(" ", maxsplit=1)[0]
    led = led and not is_given_name(first) and not FINITE.search(verb)
    return ClauseMood.ORDER if led else ClauseMood.FACT


def read_chinese(
    words: str, rest: str, asks: bool, vocabulary: Vocabulary, before: Before
) -> ClauseMood:
    """Return what a Chinese clause does; ``rest``: without courtesy, ``asks``: by its mark."""
    table = CHINESE
    rest = strip_openers(rest, ENGLISH.to_you)
    if table.supposes.search(words):
        return ClauseMood.FACT
    if _is_call(rest, table, vocabulary, before):
        return ClauseMood.CALL
    if table.others.match(rest) and not table.to_you.match(rest):
        return (
            ClauseMood.QUESTION
            if table.asks.match(words) and "去" not in words
            else ClauseMood.FACT
        )
    if table.past.match(words) and not table.to_you.match(rest):
        return ClauseMood.FACT
    if is_bare(rest, vocabulary):
        return ClauseMood.FACT if asks or before.states else ClauseMood.ORDER
    rest = strip_openers(rest, table.to_you)
    while True:
        shorter = strip_openers(rest, table.opens)
        place = first_place(shorter, vocabulary)
        if place is not None and place.start == 0:
            follows = _AFTER_ZH.match(shorter, place.end)
            shorter = shorter[follows.end() if follows else place.end :]
        if shorter == rest:
            break
        rest = shorter
    if not rest:
        return ClauseMood.ORDER
    if (table.orders.match(rest) or ENGLISH.orders.match(rest)) and not table.others.match(rest):
        return ClauseMood.ORDER
    return ClauseMood.QUESTION if asks or table.asks.match(words) else ClauseMood.FACT


def _is_call(rest: str, table: ClauseWords, vocabulary: Vocabulary, before: Before) -> bool:
    """Tell whether somebody else is called: a name, or a lone word that opens and is not known."""
    if is_given_name(rest) or (table.others.fullmatch(rest) and rest not in ("我", "it", "that")):
        return True
    opens = all(each is ClauseMood.NOTHING for each in before.moods)
    lone = len(rest) <= 4 if table is CHINESE else rest.count(" ") == 0
    rows = (table.orders, table.to_you)
    known = any(each.match(rest) for each in rows) or first_place(rest, vocabulary) is not None
    if table is CHINESE:
        known = known or re.search(r"[了啦吧吗呢没好]$|[你您]", rest) is not None
    return opens and lone and not known and rest.isalpha()


def _is_theirs(rest: str, vocabulary: Vocabulary) -> bool:
    """Tell whether a place is somebody's: only its home is the robot's own."""
    mine = (p for p in find_places(rest, vocabulary) if vocabulary.by_id[p.id].is_home)
    own = {p.start for p in mine}
    return any(
        p.start not in own and rest[: p.start].endswith("your ")
        for p in find_places(rest, vocabulary)
    )


def is_bare(text: str, vocabulary: Vocabulary) -> bool:
    """Tell whether a text names places and says nothing else."""
    places = find_places(text, vocabulary)
    for place in reversed(places):
        text = f"{text[: place.start]} {text[place.end :]}"
    for table in (ENGLISH, CHINESE):
        words = (
            w if table.orders.match(w) else strip_openers(w, table.opens) for w in text.split()
        )
        text = " ".join(words)
    return bool(places) and not _FILLS.sub("", text)
