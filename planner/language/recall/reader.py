"""Read a whole sentence as a question about before, or as nothing of the kind. Pure.

Law: what is read here drives nothing. A question about now ("where is the cat?") is told apart: it
is one of memory only where memory knows something. A sentence that goes on, or orders anything
besides, is left to the grammar.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from planner.language.folding import has_chinese
from planner.language.grammar.lexicon import MARK, MarkedText, lexicon_of
from planner.language.grammar.sentence_text import normalise
from planner.language.recall import chinese, english
from planner.plan import Recall

if TYPE_CHECKING:
    from types import ModuleType

    from planner.plan import Span, Vocabulary

MAX_READ = 160
"""Characters; a longer sentence is no such question."""
_ENDS = " .,!?;:。~…"


@dataclass(frozen=True, slots=True)
class RecallReading:
    """Hold the step that a question means."""

    step: Recall
    present: bool = False
    """It asks where a thing is now: where memory knows nothing, looking is offered instead."""


@dataclass(frozen=True, slots=True)
class _Question:
    """Hold a sentence without courtesy, time and place, and these."""

    text: str
    marked: MarkedText
    when: Span | None
    place: str | None
    remembers: bool
    """It asks for what is remembered in so many words."""


def read_recall(text: str, vocabulary: Vocabulary, room: str | None = None) -> RecallReading | None:
    """Return the question about before that a sentence is, or None.

    Args:
        text: what a person said.
        vocabulary: the names of places.
        room: where the robot is, for "here".
    """
    if not text.strip() or len(text) > MAX_READ:
        return None
    lexicon = lexicon_of(vocabulary)
    marked = lexicon.mark(normalise(text))
    words = chinese if has_chinese(text) else english
    asked = _take_apart(marked, words, room)
    if asked is None:
        return None
    return (_read_chinese if words is chinese else _read_english)(asked, room)


def read_span(words: str) -> Span | None:
    """Return the time before that words alone mean, as "this week"; None: they mean none."""
    said = normalise(words).strip(_ENDS)
    spans = chinese.SPANS if has_chinese(words) else english.SPANS
    found = (span for span, pattern in spans if re.fullmatch(pattern, said))
    return cast("Span | None", next(found, None))


def _take_apart(marked: MarkedText, words: ModuleType, room: str | None) -> _Question | None:
    """Take courtesy, time and, in English, the place off a sentence."""
    said = marked.text.strip(_ENDS)
    asks_memory = words is chinese and chinese.REMEMBERED.search(said) is not None
    said = words.TAIL.sub("", said)
    found = words.LEAD.match(said)
    said = said[found.end() :] if found else said
    remembers = words.REMEMBERS.match(said)
    if words is english and remembers is not None:
        said = said[remembers.end() :]
    when, place = None, None
    for _ in range(2):  # "in the kitchen this morning", and the other way round
        if when is None:
            said, when = _take_time(said, words)
            said = words.TAIL.sub("", said)
        if words is english and place is None and (at := english.PLACE.search(said)) is not None:
            place = _place(at["at"], marked) if at["at"] else room
            if place is None:
                return None
            said = said[: at.start()]
    return _Question(said.strip(_ENDS), marked, when, place, asks_memory or remembers is not None)


def _take_time(said: str, words: ModuleType) -> tuple[str, Span | None]:
    for span, pattern in words.SPANS:
        if words is english:
            found = re.search(rf"(?:^|[ ,]+)(?:{pattern})[ ,]*$", said) or re.match(
                rf"(?:{pattern})[ ,]+", said
            )
        else:
            found = re.search(pattern, said)
        if found is not None:
            rest = said[: found.start()] + (" " if words is english else "") + said[found.end() :]
            return rest.strip(), cast("Span", span)
    return said, None


def _place(mark: str | None, marked: MarkedText) -> str | None:
    ids = marked.mention(mark).ids if mark else ()
    return ids[0] if len(ids) == 1 else None


def _read_english(asked: _Question, room: str | None) -> RecallReading | None:
    text = asked.text
    if asked.place is None and english.DEEDS.fullmatch(text):
        return _reading(asked, deeds=True)
    if (been := english.VISITS.fullmatch(text)) is not None:
        place = _spot(been, asked, room)
        if place is not None:
            return _reading(asked, None, place, deeds=True)
    if (entered := english.ENTERS.fullmatch(text)) is not None:
        place = _place(entered["at"] or entered["at2"], asked.marked) or asked.place
        return _reading(asked, "person", place)
    if english.PERSON.fullmatch(text):
        return _reading(asked, "person")
    if english.ANYTHING.fullmatch(text):
        return (
            _reading(asked) if asked.place or asked.when or re.search("you|happen", text) else None
        )
    if (told := english.TOLD.fullmatch(text)) is not None:
        what = _first(told)
        return _name_thing(asked, what, english) if what else _reading(asked)
    if (seen := english.THING.fullmatch(text)) is not None:
        return _name_thing(asked, _first(seen), english)
    if (now := english.NOW.fullmatch(text)) is not None:
        past = asked.when is not None or asked.remembers
        place = _spot(now, asked, room)
        return _name_thing(asked, _first(now), english, place=place, present=not past)
    return None


def _read_chinese(asked: _Question, room: str | None) -> RecallReading | None:
    text = asked.text
    for pattern in (chinese.TOLD, chinese.KEPT):
        if (told := pattern.fullmatch(text)) is not None:
            what = _first(told)
            return _name_thing(asked, what, chinese) if what else _reading(asked)
    if chinese.DEEDS.fullmatch(text):
        past = asked.when is not None or re.search(r"[了过]", text)
        return _reading(asked, deeds=True) if past else None
    if (been := chinese.VISITS.fullmatch(text)) is not None:
        return _reading(asked, None, _spot(been, asked, room), deeds=True)
    if (who := chinese.PERSON.fullmatch(text)) is not None:
        if asked.when is None and not chinese.PAST.search(text):
            return None
        return _reading(asked, "person", _spot(who, asked, room))
    if (some := chinese.ANYTHING.fullmatch(text)) is not None:
        place = _spot(some, asked, room)
        past = asked.when is not None or some["asks"] is not None or re.search(r"[了过]", text)
        return _reading(asked, None, place) if past else None
    for pattern in (chinese.THING, chinese.SEEN):
        if (seen := pattern.fullmatch(text)) is not None:
            return _name_thing(asked, _first(seen), chinese, place=_spot(seen, asked, room))
    if (now := chinese.NOW.fullmatch(text)) is not None:
        place = _spot(now, asked, room)
        is_now = asked.when is None and not asked.remembers
        return _name_thing(asked, _first(now), chinese, place=place, present=is_now)
    return None


def _spot(found: re.Match[str], asked: _Question, room: str | None) -> str | None:
    groups = found.groupdict()
    mark = next((m for name, m in groups.items() if name.startswith("at") and m), None)
    here = any(name.startswith("here") and m for name, m in groups.items())
    return _place(mark, asked.marked) or (room if here else None) or asked.place


def _first(found: re.Match[str]) -> str:
    groups = {n: t for n, t in found.groupdict().items() if not n.startswith(("at", "here"))}
    return next((text for text in groups.values() if text is not None), "")


def _name_thing(
    asked: _Question,
    what: str,
    words: ModuleType,
    *,
    place: str | None = None,
    present: bool = False,
) -> RecallReading | None:
    """Return the question about a thing; None where no thing is named."""
    bare = words.ARTICLE.sub("", what.strip(_ENDS)).strip()
    if not bare or words.NOTHING.fullmatch(bare) or re.fullmatch(MARK, bare):
        return None
    if words.SOMEBODY.fullmatch(bare):
        return _reading(asked, "person", place, present=present)
    return _reading(asked, asked.marked.restore(bare), place, present=present)


def _reading(
    asked: _Question,
    label: str | None = None,
    place: str | None = None,
    *,
    deeds: bool = False,
    present: bool = False,
) -> RecallReading | None:
    if label is not None and not 0 < len(label) <= 80:
        return None
    step = Recall(object=label, place=place or asked.place, span=asked.when, deeds=deeds)
    return RecallReading(step, present)
