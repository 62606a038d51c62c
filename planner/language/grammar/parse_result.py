"""Own what one clause can mean: steps, a question to the robot, or a problem with its code.

And the rules that read it: a pattern, and what builds the meaning of what it found.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from re import Match, Pattern
from typing import Protocol

from planner.language.grammar.lexicon import MARK, Lexicon, MarkedText
from planner.language.grammar.small_talk import CLAUSES, Topic, topic_of
from planner.plan import Bilingual, Code, Find, Language, Patrol, Step, Vocabulary


@dataclass(frozen=True, slots=True)
class Steps:
    """Hold the steps that a clause orders, and the persons and things it spoke of."""

    steps: tuple[Step, ...]
    person: str | None = None
    thing: str | None = None
    part: str = ""  # the clause, as said
    seen: bool = False  # something is looked at, which a later clause may ask to be told


@dataclass(frozen=True, slots=True)
class TopicQuestion:
    """Hold a question to the robot."""

    topic: Topic


@dataclass(frozen=True, slots=True)
class ClauseProblem:
    """Hold why a clause can't be done: the part of the sentence, and the offers instead."""

    code: Code
    part: str
    places: tuple[str, ...] = ()  # places the clause names: offered, never driven to unasked
    before: tuple[Step, ...] = ()  # what could be done of the clause, or ahead of it
    name: str = ""  # the unknown name
    what: Bilingual | None = None  # what is missing
    instead: tuple[Step, ...] = ()  # offered in its stead: it was asked about, not ordered
    choices: tuple[tuple[Step, ...], ...] = ()  # offered in its stead, one of them


Meaning = Steps | TopicQuestion | ClauseProblem


@dataclass(frozen=True, slots=True)
class Clause:
    """Hold one clause, and whether it opens or closes the sentence or follows a go-to."""

    text: str
    first: bool
    last: bool


@dataclass(frozen=True, slots=True)
class ClauseContext:
    """Remember what the clauses before spoke of, for "there", "her" and "it"."""

    place: str | None = None
    person: str | None = None
    thing: str | None = None
    seen: bool = False
    toured: bool = False  # a round that looks at every stop was ordered
    kind: str = ""  # of the last step
    met: str | None = None  # where somebody was met: "take them back"

    def after(self, meaning: Meaning) -> ClauseContext:
        """Return the scene behind one more clause."""
        if not isinstance(meaning, Steps):
            return replace(self, kind="")
        place = self.place
        for step in meaning.steps:
            if step.kind in ("go_to", "patrol", "find", "count", "look"):
                named = (
                    getattr(step, "place", None) or (getattr(step, "places", None) or (None,))[-1]
                )
                place = named or place
            elif step.kind in ("come_back", "return_home", "move", "follow"):
                place = None
        finds = [step for step in meaning.steps if isinstance(step, Find)]
        met = (finds[0].place if meaning.person and finds else None) or self.met
        return ClauseContext(
            met=met,
            place=place,
            person=meaning.person or self.person,
            thing=meaning.thing or self.thing,
            seen=self.seen or meaning.seen,
            toured=self.toured or any(isinstance(s, Patrol) and s.look for s in meaning.steps),
            kind=meaning.steps[-1].kind if meaning.steps else self.kind,
        )


@dataclass(frozen=True, slots=True)
class Reading:
    """Carry what the rules of a grammar need besides the clause."""

    marked: MarkedText
    lexicon: Lexicon
    vocabulary: Vocabulary
    language: Language
    quotes: tuple[str, ...] = ()
    now: datetime | None = None
    things: frozenset[str] = frozenset()  # what can be driven up to though it is no place
    scene: ClauseContext = field(default_factory=ClauseContext)
    maps: bool = False  # a map is being made by driving
    opens: bool = False  # the clause opens the sentence, and others follow

    @property
    def going(self) -> bool:
        """Tell whether the clause before drove somewhere: "…, then the bedroom"."""
        return self.scene.kind in ("go_to", "patrol")

    def at(self, clause: Clause, scene: ClauseContext) -> Reading:
        """Return the reading of one clause after another."""
        return replace(self, scene=scene, opens=clause.first and not clause.last)

    def problem(
        self,
        code: Code,
        part: str,
        before: tuple[Step, ...] = (),
        what: Bilingual | None = None,
    ) -> ClauseProblem:
        """Name the part of the sentence that makes trouble, with the places it mentions."""
        ids = [self.marked.mention(char).ids for char in part if MARK[1] <= char <= MARK[3]]
        sure = tuple(dict.fromkeys(found[0] for found in ids if len(found) == 1))
        return ClauseProblem(code, self.marked.restore(part), sure, before, what=what)


Build = Callable[[Match[str], Reading], Meaning | None]


class ClauseReader(Protocol):
    """Read a clause whole, or not at all."""

    def read(self, clause: str, reading: Reading) -> Meaning | None:
        """Return the meaning of a clause; None where it is not read."""


@dataclass(frozen=True, slots=True, eq=False)
class Rule:
    """Read a clause that matches the pattern whole; words beyond the pattern are unread."""

    pattern: Pattern[str]
    build: Build

    def read(self, clause: str, reading: Reading) -> Meaning | None:
        """Return the meaning of a clause; None where it is not read."""
        found = self.pattern.fullmatch(clause)
        return self.build(found, reading) if found else None


def read_by(rules: Sequence[ClauseReader], clause: str, reading: Reading) -> Meaning:
    """Return the first fitting rule's reading; a clause that no rule reads whole is a problem."""
    for each in rules:
        meaning = each.read(clause, reading)
        if isinstance(meaning, Steps):
            return replace(meaning, part=reading.marked.restore(clause))
        if meaning is not None:
            return meaning
    return reading.problem(Code.NOT_UNDERSTOOD, clause)


def rule(pattern: str, build: Build) -> Rule:
    """Return a rule of a pattern."""
    return Rule(re.compile(pattern), build)


def read_place(found: Match[str], group: str) -> str | None:
    """Return the place phrase of a group, or "there"."""
    groups = found.groupdict()
    return groups.get(group) or groups.get(f"{group}_there")


def ahead(reading: Reading, meaning: Steps) -> Reading:
    """Return the reading of a clause after its first part."""
    return replace(reading, scene=reading.scene.after(meaning))


def _on_topic(found: Match[str], _reading: Reading) -> Meaning | None:
    """Read a clause that is a question the robot can answer by itself."""
    topic = Topic(found.lastgroup) if found.lastgroup else topic_of(found[0])
    return (
        None
        if topic is None or (topic is Topic.SELF and not found.lastgroup)
        else TopicQuestion(topic)
    )


TALK = tuple(Rule(each, _on_topic) for each in (*CLAUSES, re.compile(".+")))
"""Read questions to the robot, greetings and thanks of both languages."""


def about(topic: Topic) -> Build:
    """Return a builder for a question about the robot."""
    return lambda _found, _reading: TopicQuestion(topic)


def unread(found: Match[str], reading: Reading) -> Meaning:
    """Understand nothing of a clause, and offer no place that it names."""
    return replace(reading.problem(Code.NOT_UNDERSTOOD, found[0]), places=())


def lacks(code: Code) -> Build:
    """Return a builder for an order that is understood and can't be done."""
    return lambda found, reading: reading.problem(code, found[0])
