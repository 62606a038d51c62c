"""Part a person's words into clauses and tell what each does: order, ask, state, deny, suppose.

Only an order sends the robot anywhere, and it opens with its verb once courtesy is set aside; who
stands before the verb, what is past, imagined, denied or said to somebody else orders nothing. The
words for that are closed rows of `clause_words`. In doubt a clause states: a person is then asked,
and nothing else. Pure, never raises, linear up to ``MAX_READ`` characters.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

from planner.language.motion_guard.clause_cuts import (
    HARD,
    ClausePart,
    cut,
    find_denial,
    mask_quotes,
    strip_openers,
    table_of,
)
from planner.language.motion_guard.clause_moods import (
    MY_ASK,
    Before,
    ClauseMood,
    is_bare,
    read_chinese,
    read_english,
)
from planner.language.motion_guard.clause_words import CHINESE, ENGLISH, ClauseWords
from planner.language.motion_guard.mentioned_names import (
    NamedPlace,
    find_places,
    first_place,
    plain,
)
from planner.plan import Vocabulary

MAX_READ = 400
"""Characters; what stands behind them asks for nothing."""

_ASKED = frozenset({ClauseMood.ORDER, ClauseMood.QUESTION})
_SAID = re.compile(
    r"\b(?:that|whether|if|i|we|he|she|it|they|you|is|are|was|were|will|can|has|have|needs?|go"
    r"|come|drive|follow|move|turn|run|stop)\b|'(?:s|re|m|ll)\b"
)
_THERE = re.compile(r"\b(?:there|in)\b|那[里儿边]|[过进]去")
"""What leans on the place that was named last."""
_ASKS_HOW_IT_IS = re.compile(r"(?:is|are)\b")
_AT = re.compile(r"\b(?:in|at|on|by|to|near)(?: (?:the|my|our))? $")


@dataclass(frozen=True, slots=True)
class SaidClause:
    """Hold one clause, from ``start`` to ``end`` of the plain text."""

    start: int
    end: int
    text: str
    """Without what is said to somebody."""
    mood: ClauseMood
    speech: str = ""
    """What is said to somebody."""
    hung: bool = False
    """On a condition, or on a time that is not now."""
    otherwise: bool = False
    """In the other branch of its condition."""
    stays: bool = False
    """Orders something by which nothing moves."""
    beyond: bool = False
    """Orders what no robot here does."""


@lru_cache(maxsize=64)
def read_clauses(text: str, vocabulary: Vocabulary) -> tuple[SaidClause, ...]:
    """Return the clauses of a text, in its order."""
    said = plain(text)[:MAX_READ]
    said = mask_quotes(said)
    found: list[SaidClause] = []
    speaks = called = False
    for part in cut(said, vocabulary):
        words = said[part.start : part.end]
        if part.mark == ":" or (speaks and not HARD.search(part.mark) and not words.strip()):
            speaks = speaks or table_of(words).speaks.search(words) is not None
        clause = _judge(said, part, vocabulary, found)
        if (speaks and part.mark[:1] in (":", "：")) or called:
            clause = replace(clause, mood=ClauseMood.FACT)
        called = called or clause.mood is ClauseMood.CALL
        speaks = (
            clause.mood is ClauseMood.ORDER and table_of(words).speaks.search(words) is not None
        )
        found.append(clause)
    found = _spare_lists(_take_back(found, vocabulary), vocabulary)
    return _hang(said, found)


def denied_places(text: str, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the places that a text names where it denies, and nowhere else.

    "Mum is in the bath, don't go there" denies the bath, though it is a fact that names it.
    """
    denied: set[str] = set()
    meant: set[str] = set()
    before: set[str] = set()
    for clause in read_clauses(text, vocabulary):
        named = {found.id for found in find_places(clause.text, vocabulary)}
        if clause.mood is not ClauseMood.DENIED:
            meant |= named
            is_order = clause.mood is ClauseMood.ORDER and not is_bare(clause.text, vocabulary)
            if named or is_order:
                before = named if not is_order else set()
        elif named or not _THERE.search(clause.text):
            denied |= named
        else:
            denied |= before
            meant -= before
    return frozenset(denied - meant)


def _judge(
    said: str, part: ClausePart, vocabulary: Vocabulary, before: list[SaidClause]
) -> SaidClause:
    whole = said[part.start : part.end]
    words = whole.strip(" '\"“”")
    table = table_of(words)
    words, speech = _cut_speech(words, table, vocabulary)
    last = before[-1].mood if before else ClauseMood.NOTHING
    rest = strip_openers(words, table.opens)
    asks = said[part.end : part.end + 1] in ("?", "？")
    denial = find_denial(words, table)
    if part.upon:
        mood = ClauseMood.CONDITION
    elif denial is not None:
        mood = ClauseMood.DENIED
    elif last is ClauseMood.FACT and part.mark.strip() == "and":
        mood = ClauseMood.FACT  # the same who stands before its verb
    elif last is ClauseMood.DENIED and _goes_on(part, rest, before[-1], table, vocabulary):
        mood = ClauseMood.DENIED
    elif not rest:
        mood = ClauseMood.NOTHING
    elif (
        (other := table.otherwise.match(rest)) is not None and not rest[other.end() :].strip()
    ) or (other is None and table.hangs.match(rest) and not table.polite.match(rest)):
        mood = ClauseMood.CONDITION
    else:
        rest = strip_openers(rest, table.otherwise).strip()
        read = read_chinese if table is CHINESE else read_english
        mood = read(words, rest, asks, vocabulary, Before(tuple(each.mood for each in before)))
    if mood is ClauseMood.ORDER and _is_choice(words, table, vocabulary):
        mood = ClauseMood.QUESTION
    return SaidClause(
        part.start,
        part.end,
        words,
        mood,
        speech,
        hung=table.later.search(words) is not None,
        otherwise=table.otherwise.match(words) is not None,
        beyond=mood in (ClauseMood.ORDER, ClauseMood.FACT, ClauseMood.QUESTION)
        and _is_beyond(words, rest, table, vocabulary),
        stays=table.stays.match(strip_openers(rest, table.to_you)) is not None,
    )


def _is_beyond(words: str, rest: str, table: ClauseWords, vocabulary: Vocabulary) -> bool:
    """Tell whether a clause orders an arm's work, harm or haste, anywhere behind a place."""
    verb = strip_openers(strip_openers(rest, table.to_you), table.opens)
    places = find_places(words, vocabulary)
    blotted = _blot(words, places)
    # Behind "is the fridge" stands how it is ("open"), and no work.
    held = () if _ASKS_HOW_IT_IS.match(rest) else places
    tails = (blotted[p.end :].lstrip(" 里上并和后再") for p in held)
    parts = (blotted, _blot(verb, find_places(verb, vocabulary)), *tails)
    return any(table.beyond.match(re.sub(r"[\s·]+", " ", each)) for each in parts)


def _blot(words: str, places: Sequence[NamedPlace]) -> str:
    """Blot out the names of places, in which letters of other words stand."""
    for place in places:
        words = f"{words[: place.start]}{'·' * (place.end - place.start)}{words[place.end :]}"
    return words


def _cut_speech(words: str, table: ClauseWords, vocabulary: Vocabulary) -> tuple[str, str]:
    """Part a clause before what is said to somebody; who stands where is spoken to may name it."""
    spoken = table.speaks.search(words)
    if spoken is None or (table is ENGLISH and MY_ASK.match(words, spoken.start())):
        return words, ""
    at = spoken.end()
    if table is ENGLISH:
        content = _SAID.search(words, at)
        end = content.start() if content is not None else len(words)
        where = [p.end for p in find_places(words, vocabulary) if at <= p.start < end]
        heard = [p.end for p in find_places(words, vocabulary) if _AT.search(words[: p.start])]
        at = max([at, *(each for each in where if each in heard)])
    else:
        near = re.compile(r"(?:一下|一声|在)?").match(words, at)
        here = (p.end for p in find_places(words, vocabulary) if near and p.start == near.end())
        at = next((end for end in here if words[end : end + 2].lstrip("里")[:1] == "的"), at)
    return words[:at], words[at:]


def _goes_on(
    part: ClausePart, rest: str, denied: SaidClause, table: ClauseWords, vocabulary: Vocabulary
) -> bool:
    """Tell whether a denial goes on: "don't go to the kitchen and look", "…, the study"."""
    excepted = table.excepts.search(denied.text) is not None
    bare = is_bare(rest, vocabulary)
    if excepted:
        return part.mark.strip() == "and" and bare
    return bare if "," in part.mark or "，" in part.mark else part.mark.strip() == "and"


def _is_choice(words: str, table: ClauseWords, vocabulary: Vocabulary) -> bool:
    places = find_places(words, vocabulary)
    between = (words[a.end : b.start] for a, b in pairwise(places))
    return len({p.id for p in places}) > 1 and any(map(table.chooses.search, between))


def _spare_lists(clauses: list[SaidClause], vocabulary: Vocabulary) -> list[SaidClause]:
    """Let bare names be no order beside what is merely stated: "desk, dock, so many words"."""
    orders = [each for each in clauses if each.mood is ClauseMood.ORDER]
    bare = all(is_bare(each.text, vocabulary) for each in orders)
    if not bare or not any(each.mood is ClauseMood.FACT for each in clauses):
        return clauses
    return [replace(each, mood=ClauseMood.FACT) if each in orders else each for each in clauses]


def _take_back(clauses: list[SaidClause], vocabulary: Vocabulary) -> list[SaidClause]:
    """Deny what stands before a correction that names a place."""
    named = False
    for index in range(len(clauses) - 1, 0, -1):
        words = clauses[index].text
        named = named or first_place(words, vocabulary) is not None
        if named and table_of(words).corrects.match(words):
            denied = [replace(each, mood=ClauseMood.DENIED) for each in clauses[:index]]
            return [*denied, *clauses[index:]]
    return clauses


def _hang(said: str, clauses: list[SaidClause]) -> tuple[SaidClause, ...]:
    """Hang orders on their conditions: those behind one, or before one that nothing follows."""
    found = list(clauses)
    edges = [0, *(each.end() for each in HARD.finditer(said)), len(said) + 1]
    for start, end in pairwise(edges):
        row = [i for i, each in enumerate(found) if start <= each.start < end]
        if any(found[i].hung for i in row):  # a time that is not now
            found[row[0] : row[-1] + 1] = [replace(found[i], hung=True) for i in row]
        for at in row:
            here = found[at]
            behind = [i for i in row if i > at and found[i].mood is not ClauseMood.NOTHING]
            if here.mood is ClauseMood.CONDITION:
                hung = list(behind)
                if all(found[i].otherwise for i in behind):  # "go if …, otherwise come back"
                    hung += [i for i in row if i < at and found[i].mood in _ASKED]
            elif here.otherwise:
                hung = [at, *behind]
            else:
                awaits = here.mood is ClauseMood.ORDER and table_of(here.text).awaits.match(
                    here.text
                )
                hung = behind if awaits else []
            unreal = table_of(here.text).supposes.search(here.text) is not None
            for i in hung:
                mood = ClauseMood.FACT if unreal else found[i].mood
                other = here.otherwise or found[i].otherwise
                found[i] = replace(found[i], hung=True, otherwise=other, mood=mood)
    return tuple(found)
