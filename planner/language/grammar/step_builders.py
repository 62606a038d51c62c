"""Make steps of a rule's finds: meet, follow, guide, find, count, look. One way for all tongues.

A person known only by name has to be somewhere that the sentence names; what is missing is asked
for, never guessed.
"""

from __future__ import annotations

import re
from dataclasses import replace

from pydantic import ValidationError

from planner.language.catalogue import build, noun, raw, say
from planner.language.grammar.lexicon import MARK, NAME
from planner.language.grammar.noun_phrases import ONE_AT_A_TIME, go_to, several
from planner.language.grammar.parse_result import ClauseProblem, Meaning, Reading, Steps
from planner.language.person_names import is_given_name
from planner.plan import (
    MAX_STEPS,
    Bilingual,
    Code,
    Count,
    Find,
    Follow,
    GoTo,
    Look,
    Say,
    Step,
)

WHERE_IS = build(lambda language: raw("grammar.where_is", language))
"""Its name is put in where it is known."""
WHERE_TO = say("grammar.where_to")
HOW_LONG = say("grammar.how_long")
WHO = say("grammar.who")
WHERE_LOOK = say("grammar.where_look")
SEARCH = say("grammar.search")
WHERE_ARE_YOU = say("grammar.where_are_you")
WHICH_WORDS = say("grammar.which_words")

_SELF = frozenset({"me", "us", "我", "我们"})
_THEY = frozenset(
    {"him", "her", "them", "they", "他", "她", "他们", "她们", "ta", "人家", "那位", "这位"}
)
_IT = frozenset({"it", "them", "one", "它", "它们"})
_WHO_IS_THERE = re.compile(r"\b(?:any|some)(?:one|body)\b|\bwho\b|\bpeople\b|有(?:没有)?人|谁|有人")
"""A question about people: "tell them …" means whoever is found."""
_ANYBODY = re.compile(r"(?:any|some)(?:one|body)")
_THERE = frozenset({"there", "over there", "那里", "那儿", "那边"})
_HERE = frozenset({"here", "over here", "这里", "这儿", "这边"})
_ARTICLE = re.compile(
    r"^(?:(?:the|a|an|my|our|your|some|any|that|this|all|of|every|each|me)\s+)+"
    r"|^(?:这个|那个|一个|一下|一只|一位|一些|所有的?|我的|咱们?的)"
)
_AT_HAND = re.compile(
    r" (?:in (?:all (?:of )?(?:the )?|every |each )rooms?"
    r"|(?:right |just )?in front of (?:you|me)|ahead(?: of you)?|before you|"
    r"(?:that |which |who )?you (?:see|saw|found|have seen)|"
    r"(?:somewhere |anywhere )?in (?:the|this) (?:whole |entire )?(?:house|home|flat))$"
    r"|^(?:你|您)?(?:前面|面前|眼前|前方)的?(?=.)|^(?:家里|家中|屋里)(?:所有)?的?(?=.)"
    r"|^(?:所有|全部|每个|各个)的?房间(?:里面?)?的(?=.)"
)
"""What says no more of a thing than that the robot is to see it, in the home that it is in."""
_IN_A_ROOM = re.compile(
    r".+ (?:in|inside) (?P<room>(?:the|my|our|your)"
    r" (?!(?:whole |entire )?(?:house|home|flat|apartment|place|building|rooms?)\b)[a-z][a-z ]*)"
)
_TITLE = 80
_DONE = re.compile(
    r"了|完$|[过吗]$|没有?$|\b(?:is|are|am|was|were|hurts?|since|because|had)\b"
    r"|^(?:it|em|them|him|they)\b|^它(?!的)"
)
"""What no thing's name holds: "找到杯子了吗", "数完了" and "my legs are tired" tell or ask, and "it
for me" names none."""
ASIDE = re.compile(
    r"\b(?:behind (?:you|me|us)|(?:on|to|at|by) (?:your|my|the) (?:left|right)"
    r"|(?:left|right) of (?:you|me))\b|^[你您我]?的?(?:[身背]后|后[面边方]|[左右]手?[边侧面])的"
)
"""A side of the robot: eyes look ahead, and a map has no sides."""


def place_of(phrase: str | None, reading: Reading) -> str | ClauseProblem | None:
    """Return the id of a place phrase; None where no place is named and none was before."""
    if phrase is None or phrase in _THERE:
        return reading.scene.place
    if phrase in _HERE:
        return None
    meaning = go_to(phrase, reading)
    if isinstance(meaning, Steps) and isinstance(meaning.steps[0], GoTo):
        return meaning.steps[0].place
    return meaning if isinstance(meaning, ClauseProblem) else None


def arrive(place: str | None, reading: Reading) -> tuple[Step, ...]:
    """Return the way to a place, where the clauses before have not led there."""
    there = place is None or (place == reading.scene.place and reading.scene.kind != "follow")
    return () if there or place is None else (GoTo(place=place),)


def label_of(words: str, reading: Reading) -> str:
    """Return the thing to look for, in the sentence's own words."""
    said = _AT_HAND.sub("", reading.marked.restore(words).strip(" ,的"))
    return _ARTICLE.sub("", said).strip()[:_TITLE]


def person_of(words: str, reading: Reading) -> str | ClauseProblem:
    """Return whom a phrase means."""
    if words in _SELF:
        return "person"
    if words in _THEY or words in _IT:
        known = reading.scene.person
        return known or reading.problem(Code.INCOMPLETE, words, what=WHO)
    return label_of(words, reading) or reading.problem(Code.INCOMPLETE, words, what=WHO)


_ALL = re.compile(
    r"every(?:one|body)|all|you all|them all|all of (?:us|you|them)"
    r"|(?:(?:the|our|my|your|these|all (?:the|our)) )?(?:visitors|guests|people|children|kids)\b.*"
    r"|大家|所有人|各位|大伙儿?|(?:小朋友|孩子|同学|客人|来宾|访客)们?"
)
"""Who hears it where the robot stands: told without a place, nobody is looked for."""


_WHOEVER = re.compile(
    r"every(?:one|body)|any(?:one|body)|some(?:one|body)|whoever(?: is|'s)?"
    r"|(?:(?:the|our|my) )?little ones?|大家|所有人"
)


def meet(
    words: str, where: str | None, reading: Reading, saying: str = "", *, sought: bool = False
) -> Meaning:
    """Go to where somebody is, and look for them.

    Who is to be told something, or is `sought`, is looked for through the rooms where no place is
    named; whom the robot is to follow or lead is asked for.
    """
    person, place = person_of(words, reading), place_of(where, reading)
    if isinstance(person, ClauseProblem) and saying and isinstance(place, str) and words in _THEY:
        person = noun("noun.person").of(reading.language)  # "go there and tell them"
    if isinstance(person, ClauseProblem):
        return person
    if isinstance(place, ClauseProblem):
        return place
    if saying and place is None and reading.scene.place is None and _ALL.fullmatch(words):
        return Steps((Say(text=saying),))
    if place is None and re.search(NAME, words) and not (saying or sought):
        return missing(WHERE_IS, words, reading, person)
    # Who was met is still there; who was only asked about may be nowhere.
    again = words in _THEY and where is None and reading.scene.kind != "look"
    if place is not None and _WHOEVER.fullmatch(words):
        person = noun("noun.person").of(reading.language)  # "everybody" is whoever is there
    if saying and _is_named(words) and not is_given_name(person):
        person = noun("noun.person").of(reading.language)  # eyes know no more of it than of a thing
    steps: tuple[Step, ...] = () if again else (Find(object=person, place=place),)
    said = (Say(text=call(words, saying, reading)),) if saying else ()
    return Steps((*arrive(place, reading), *steps, *said), person=person, seen=True)


def _is_named(words: str) -> bool:
    return re.fullmatch(NAME, words) is not None


def call(words: str, saying: str, reading: Reading) -> str:
    """Return what is said to somebody, behind their name: no eye tells who is who."""
    sought = reading.scene.person if reading.scene.kind == "find" and words in _THEY else None
    named = sought is not None and is_given_name(sought)  # "find Dad and tell him …"
    name = sought if named and sought else label_of(words, reading)
    if not (named or _is_named(words)) or name.lower() in saying.lower():
        return saying
    if not name.isascii():
        name = _OF_MINE.sub("", name)  # nobody is called 我老公
    return f"{name}{', ' if name.isascii() else ','}{saying}"[:500]


_OF_MINE = re.compile(r"^[我你您咱]们?(?:家|的)?(?=.{2}|[妈爸哥姐弟妹])")


def follow(words: str, start: str | None, end: str | None, reading: Reading) -> Meaning:
    """Find somebody, follow them, and end at a place where one is named."""
    found = meet(words, start, reading)
    to = place_of(end, reading) if end else None
    if not isinstance(found, Steps) or found.person is None:
        return found
    if isinstance(to, ClauseProblem):
        return to
    last = (GoTo(place=to),) if to else ()
    return Steps((*found.steps, Follow(object=found.person), *last), person=found.person)


def guide(words: str, start: str | None, end: str | None, reading: Reading) -> Meaning:
    """Find somebody and drive ahead of them to a place."""
    found = meet(words, start, reading)
    if not isinstance(found, Steps):
        return found
    if end is None:
        return missing(WHERE_TO, words, reading)
    back = end in ("back", "回去", "回来")
    to = reading.scene.met if back else place_of(end, reading)
    if isinstance(to, ClauseProblem):
        return to
    if to is None:
        return missing(WHERE_TO, words, reading)
    come = told_in("spoken.come", reading)
    return Steps((*found.steps, Say(text=come), GoTo(place=to)), person=found.person)


_ANYTHING = re.compile(
    r"(?:(?:the|my|our|that|this) )?"
    r"(?:things?|thing(?:y|ie|ies)|thingumm?[a-z]*|stuff|whatsit|doodah)|[那这]?个?东西"
)
"""Whoever says no more of a thing has to be asked which."""


def find(words: str, where: str | None, reading: Reading) -> Meaning:
    """Go to a place and look for a thing there; for a place, go there."""
    if re.fullmatch(rf"(?:(?:the|my|our) )?{MARK}", words) and where is None:
        return go_to(words, reading)
    place = place_of(where, reading)
    if isinstance(place, ClauseProblem):
        return place
    if words in _IT or words in _THEY:
        thing = reading.scene.thing or reading.scene.person
    else:
        thing = label_of(words, reading)
    if not thing or _ANYTHING.fullmatch(thing):
        return missing(WHO, words, reading)
    if _DONE.search(thing) or ASIDE.search(thing):
        return replace(reading.problem(Code.NOT_UNDERSTOOD, words), places=())
    if several(words) is not None:
        return one_at_a_time(words, place, reading)
    return Steps((*arrive(place, reading), Find(object=thing, place=place)), thing=thing, seen=True)


def one_at_a_time(words: str, place: str | None, reading: Reading) -> Meaning:
    """Offer to count what can't be found, or driven up to, all at once."""
    label = label_of(several(words) or words, reading)
    if not label:
        return missing(WHO, words, reading)
    counted = (*arrive(place, reading), Count(object=label, place=place))
    return replace(missing(ONE_AT_A_TIME, words, reading), places=(), instead=counted)


def count(words: str, where: str | None, reading: Reading) -> Meaning:
    """Go to a place and count things or people there."""
    place, label = place_of(where, reading), label_of(words, reading)
    if isinstance(place, ClauseProblem):
        return place
    if not label:
        return missing(WHO, words, reading)
    if _DONE.search(label):
        return replace(reading.problem(Code.NOT_UNDERSTOOD, words), places=())
    elsewhere = _IN_A_ROOM.fullmatch(words) if place is None else None
    if elsewhere is not None:  # counted all over the home it would be another order
        return go_to(elsewhere["room"], reading)
    steps = (*arrive(place, reading), Count(object=label, place=place))
    return Steps(steps, thing=label, seen=True)


def look(question: str, where: str | None, reading: Reading) -> Meaning:
    """Go to a place and answer a question by looking."""
    place = place_of(where, reading)
    if isinstance(place, ClauseProblem):
        return place
    asked = reading.marked.restore(question)[:500]
    somebody = noun("noun.person").of(reading.language) if _WHO_IS_THERE.search(question) else None
    steps = (*arrive(place, reading), Look(question=asked, place=place))
    return Steps(steps, person=somebody, seen=True)


def look_everywhere(question: str, reading: Reading) -> Meaning:
    """Go to every room and answer a question by looking round in it."""
    rooms = [entry.id for entry in reading.vocabulary.entries if entry.kind == "room"]
    asked = reading.marked.restore(question)[:500]
    looks = ((GoTo(place=room), Look(question=asked, place=room)) for room in rooms)
    steps = tuple(step for look_there in looks for step in look_there)
    if not 0 < len(steps) <= MAX_STEPS:
        return missing(WHERE_LOOK, question, reading)
    return Steps(steps, seen=True)


def offer_search(words: str, part: str, reading: Reading) -> Meaning:
    """Offer to search for the thing a question asks about: no word of it orders a drive.

    Where a clause before it drove somewhere, it is looked for there.
    """
    if reading.scene.place is not None:
        return find(words, "there", reading)
    label = "person" if _ANYBODY.fullmatch(words) else label_of(words, reading)
    asked = missing(SEARCH, part, reading)
    sought = label and not re.search(NAME, words)  # who is who, no eye tells
    return replace(asked, instead=(Find(object=label),)) if sought else asked


def missing(what: Bilingual, part: str, reading: Reading, name: str = "") -> ClauseProblem:
    """Name the part that the sentence leaves open."""
    filled = build(lambda language: what.of(language).format(name=name))
    return reading.problem(Code.INCOMPLETE, part, what=filled)


def told_in(code: str, reading: Reading, **facts: str) -> str:
    """Return a message of the catalogue that is to be said, in the language of the goal."""
    return say(code, **facts).of(reading.language)


def saying(words: str, reading: Reading) -> Meaning:
    """Say words of the sentence."""
    said = reading.marked.restore(words).strip(" \"'")
    try:
        return Steps((Say(text=said),))
    except ValidationError:
        return reading.problem(Code.NOT_UNDERSTOOD, words)
