"""Own what one clause can mean: steps, a question about the robot, or a problem with its code."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import Enum, auto
from re import Match, Pattern

from planner.brain.offline.lexicon import Lexicon, Marked
from planner.plan import Code, Step, Vocabulary


class Topic(Enum):
    """Name what a person may ask the robot about itself."""

    WHERE = auto()
    PLACES = auto()


@dataclass(frozen=True, slots=True)
class Steps:
    """Hold the steps that a clause orders."""

    steps: tuple[Step, ...]


@dataclass(frozen=True, slots=True)
class About:
    """Hold a question about the robot."""

    topic: Topic


@dataclass(frozen=True, slots=True)
class Problem:
    """Say why a clause can't be done: the part of the sentence, and what may be offered."""

    code: Code
    part: str
    places: tuple[str, ...] = ()  # places the clause names: offered, never driven to unasked
    before: tuple[Step, ...] = ()  # what the clause orders ahead of the part that can't be done
    name: str = ""  # the unknown name


Meaning = Steps | About | Problem


@dataclass(frozen=True, slots=True)
class Clause:
    """Hold one clause, and whether it opens or closes the sentence or follows a go-to."""

    text: str
    first: bool
    last: bool


@dataclass(frozen=True, slots=True)
class Reading:
    """Carry what the rules of a grammar need besides the clause."""

    marked: Marked
    lexicon: Lexicon
    vocabulary: Vocabulary
    quotes: tuple[str, ...] = ()
    going: bool = False  # the clause before was a go-to: "…, then the bedroom"

    opens: bool = False  # the clause opens the sentence, and others follow

    def at(self, clause: Clause, going: bool) -> Reading:
        """Return the reading of one clause after another."""
        return replace(self, going=going, opens=clause.first and not clause.last)

    def problem(self, code: Code, part: str, before: tuple[Step, ...] = ()) -> Problem:
        """Name the part of the sentence that makes trouble, with the places it mentions."""
        ids = [self.marked.mention(char).ids for char in part if "\ue000" <= char < "\ue800"]
        sure = tuple(dict.fromkeys(found[0] for found in ids if len(found) == 1))
        return Problem(code, self.marked.restore(part), sure, before)


@dataclass(frozen=True, slots=True)
class Rule:
    """Read a clause that matches the pattern whole; what the pattern leaves out is unread."""

    pattern: Pattern[str]
    build: Callable[[Match[str], Reading], Meaning | None]


def read_by(rules: Sequence[Rule], clause: str, reading: Reading) -> Meaning:
    """Return what the first fitting rule reads; a clause that no rule reads whole is a problem."""
    for rule in rules:
        found = rule.pattern.fullmatch(clause)
        meaning = rule.build(found, reading) if found else None
        if meaning is not None:
            return meaning
    return reading.problem(Code.NOT_UNDERSTOOD, clause)
