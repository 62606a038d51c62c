"""Own the shape of a grammar and the builders that both languages share.

A grammar is data: patterns that veto a sentence, a pattern that ends clauses, words that may stand
around an order without changing it, and rules that read a clause whole.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from re import Match, Pattern

from pydantic import ValidationError

from planner.language.grammar.names import go_to
from planner.language.grammar.numbers import seconds
from planner.language.grammar.objects import several_of, up_to
from planner.language.grammar.parse_result import (
    About,
    Clause,
    Meaning,
    Reading,
    Rule,
    Steps,
    read_by,
)
from planner.language.grammar.small_talk import Topic, topic_of
from planner.language.grammar.step_builders import ASIDE, look, one_at_a_time
from planner.plan import Code, ComeBack, GoTo, Patrol, ReturnHome, Say, Wait

FIRST_QUOTE = 0xF800
QUOTE = "[\uf800-\uf8ff]"

Build = Callable[[Match[str], Reading], Meaning | None]


@dataclass(frozen=True, slots=True)
class Grammar:
    """Hold one language's patterns. `opening` may only begin the first clause, `closing` the last.

    The order in which clauses stand is the order in which they are done; a word that says otherwise
    ("first" in a later clause, "before") is read by no rule.
    """

    vetoes: tuple[tuple[Code, Pattern[str]], ...]
    asked: Pattern[str]  # an order in the form of a question; group 1 is the order
    joint: Pattern[str]  # what ends a clause without a word; group 1 stays
    clause_end: Pattern[str]
    courtesy: Pattern[str]  # at the start of a clause
    thanks: Pattern[str]  # at the end of a clause
    opening: Pattern[str]
    closing: Pattern[str]
    rules: tuple[Rule, ...]

    def clauses(self, text: str) -> list[Clause]:
        """Cut a marked sentence into clauses; those of mere courtesy are dropped."""
        order = self.joint.sub(r"\1,", self.asked.sub(r"\1", text))
        parts = [self.plain(part) for part in self.clause_end.split(order)]
        kept = [part for part in parts if part]
        last = len(kept) - 1
        return [Clause(part, at == 0, at == last) for at, part in enumerate(kept)]

    def plain(self, part: str) -> str:
        """Take the courtesies off both ends of a clause."""
        before = None
        while part != before:
            before = part
            part = self.thanks.sub("", self.courtesy.sub("", part.strip())).strip()
        return part

    def read(self, clause: Clause, reading: Reading) -> Meaning:
        """Read one clause whole, after the words of order that its position allows."""
        text = clause.text
        if clause.first:
            text = self.plain(self.opening.sub("", text))
        if clause.last:
            text = self.plain(self.closing.sub("", text))
        return read_by(self.rules, text, reading)


def rule(pattern: str, build: Build) -> Rule:
    """Return a rule of a pattern."""
    return Rule(re.compile(pattern), build)


def where(found: Match[str], group: str) -> str | None:
    """Return the place phrase of a group, or "there"."""
    groups = found.groupdict()
    return groups.get(group) or groups.get(f"{group}_there")


def ahead(reading: Reading, meaning: Steps) -> Reading:
    """Return the reading of what a clause says after its first part."""
    return replace(reading, scene=reading.scene.after(meaning))


def drive_to(found: Match[str], reading: Reading) -> Meaning:
    """Read the group `place` as a place to drive to, or as a thing to drive up to."""
    meaning = go_to(found["place"], reading)
    if isinstance(meaning, Steps):
        return meaning
    if ASIDE.search(found["place"]):
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    many = several_of(found["place"], reading)
    if many is not None:
        return one_at_a_time(many[0], many[1], reading)
    return up_to(found["place"], reading) or meaning


def set_out(found: Match[str], reading: Reading) -> Meaning | None:
    """Read "from the kitchen" as the first place, where it opens an order and more follows.

    Alone, "leave from the kitchen" orders no drive to the kitchen.
    """
    return go_to(found["place"], reading) if reading.opens else None


def drive_into(found: Match[str], reading: Reading) -> Meaning:
    """Read the group `place` as a room: nothing drives into a sofa."""
    meaning = go_to(found["place"], reading)
    goals = meaning.steps if isinstance(meaning, Steps) else ()
    rooms = all(
        isinstance(goal, GoTo) and reading.vocabulary.by_id[goal.place].kind == "room"
        for goal in goals
    )
    return meaning if rooms else reading.problem(Code.NOT_UNDERSTOOD, found[0])


def route(found: Match[str], reading: Reading) -> Meaning:
    """Read the groups `start` and `place` as two places, one after the other."""
    start, place = go_to(found["start"], reading), go_to(found["place"], reading)
    if isinstance(start, Steps) and isinstance(place, Steps):
        return Steps((*start.steps, *place.steps))
    return place if isinstance(start, Steps) else start


def next_place(found: Match[str], reading: Reading) -> Meaning | None:
    """Read a bare place after a go-to clause as the next place; elsewhere offer it."""
    phrase = found["place"]
    meaning = go_to(phrase, reading)
    again = re.match(r"(?:back )?(?:to|into) ", phrase)
    if again and reading.going:
        return go_to(phrase[again.end() :], reading)
    if reading.scene.kind == "look" and isinstance(meaning, Steps):
        return look(phrase, phrase, reading)
    if reading.going and isinstance(meaning, Steps):
        goals = tuple(step.place for step in meaning.steps if isinstance(step, GoTo))
        patrols = reading.scene.kind == "patrol" and goals
        return Steps((Patrol(places=goals),)) if patrols else meaning
    named = reading.going and phrase.startswith(("the ", "my ", "our "))
    return meaning if named else None


def come_back(_found: Match[str], _reading: Reading) -> Meaning:
    """Read the way back to where the goal was accepted."""
    return Steps((ComeBack(),))


def home(_found: Match[str], _reading: Reading) -> Meaning:
    """Read the way to the site's home."""
    return Steps((ReturnHome(),))


def stand(_found: Match[str], reading: Reading) -> Meaning | None:
    """Read "and stay there" after a go-to: arriving does that."""
    return Steps(()) if reading.going else None


def wait(found: Match[str], reading: Reading) -> Meaning:
    """Read the groups `number` and `unit` as a time to stand still."""
    span_s = seconds(found["number"], found["unit"])
    if not span_s:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    try:
        return Steps((Wait(seconds=span_s),))
    except ValidationError:
        return reading.problem(Code.BAD_PLAN, found[0])


def say(found: Match[str], reading: Reading) -> Meaning:
    """Read the group `quote` or `words` as words to say."""
    groups = found.groupdict()
    if groups.get("quote"):
        words = reading.quotes[ord(found["quote"]) - FIRST_QUOTE].strip()
    else:
        words = found["words"]
    if not 1 <= len(words) <= 500:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return Steps((Say(text=words),))


def on_topic(found: Match[str], _reading: Reading) -> Meaning | None:
    """Read a clause that is a question the robot can answer by itself."""
    topic = topic_of(found["topic"])
    return None if topic in (None, Topic.SELF) else About(topic)


def about(topic: Topic) -> Build:
    """Return a builder for a question about the robot."""
    return lambda _found, _reading: About(topic)


def unread(found: Match[str], reading: Reading) -> Meaning:
    """Understand nothing of a clause, and offer no place that it names."""
    return replace(reading.problem(Code.NOT_UNDERSTOOD, found[0]), places=())


def lacks(code: Code) -> Build:
    """Return a builder for an order that is understood and can't be done."""
    return lambda found, reading: reading.problem(code, found[0])
