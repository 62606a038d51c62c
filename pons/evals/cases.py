"""Own an eval suite: sentences, each with its expectation, in one world."""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from pathlib import Path

from pons.evals.category_rules import Law
from pons.evals.course import OrderCourse, read_course
from pons.evals.matchers import BadMatcher, Expectation, read_expectation
from pons.evals.world import EvalWorld

HOLD_OUT_SEED = 5
TUNED, HELD_OUT = "tuned", "held out"
FORM = "tuned or held, group, sentence, expectation (a turn: its course before that)"
COLUMNS, COLUMNS_OF_TURN = 4, 5


class MissingSuite(Exception):
    """Nobody's fault here: the suite, or its data, is not on this machine."""


@dataclass(frozen=True, slots=True)
class Case:
    """Hold one sentence and its expectation: a law by category, or a matcher.

    With a course the brain is asked again in the middle of the order, and not at its beginning.
    """

    text: str
    group: str
    law: Law | None = None
    wanted: Expectation | None = None
    split: str = TUNED
    course: OrderCourse | None = None

    @property
    def full_text(self) -> str:
        """Return the sentence with its course, for people."""
        return self.text if self.course is None else f"{self.text} | {self.course.told}"


@dataclass(frozen=True, slots=True)
class Suite:
    """Hold cases and the world they are planned in."""

    name: str
    world: EvalWorld
    cases: tuple[Case, ...]

    def split_in_half(self, seed: int = HOLD_OUT_SEED) -> Suite:
        """Return the suite with a random half held out, the same for one seed."""
        rng = random.Random(seed)
        order = list(range(len(self.cases)))
        rng.shuffle(order)
        held = frozenset(order[: len(order) // 2])
        cases = [
            replace(case, split=HELD_OUT if at in held else TUNED)
            for at, case in enumerate(self.cases)
        ]
        return replace(self, cases=tuple(cases))


def read_tsv(path: Path, world: EvalWorld) -> Suite:
    """Read a suite of our own: split, group, sentence and expectation in four columns.

    A turn has a fifth before the last: what came of the sentence's steps so far.

    Raises:
        MissingSuite: there is no such file.
        BadMatcher: a line can't be read.
    """
    if not path.is_file():
        raise MissingSuite(f"no suite at {path}")
    cases = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        columns = line.split("\t")
        try:
            if len(columns) not in (COLUMNS, COLUMNS_OF_TURN):
                raise BadMatcher(f"{len(columns)} columns between tabs; expected {COLUMNS}: {FORM}")
            split, group, text, *told, expected = columns
            course = read_course(told[0], world) if told else None
            wanted = read_expectation(expected)
            if unknown := sorted(wanted.places - world.vocabulary.by_id.keys()):
                known = ", ".join(world.vocabulary.by_id)
                raise BadMatcher(f"unknown place {', '.join(unknown)}; known: {known}")
            kept = _split(split)
            cases.append(Case(text, group, wanted=wanted, split=kept, course=course))
        except ValueError as wrong:
            raise BadMatcher(f"{path.name}:{number}: {wrong}") from wrong
    return Suite(path.stem, world, tuple(cases))


def _split(word: str) -> str:
    known = {"tuned": TUNED, "held": HELD_OUT}
    if word not in known:
        raise BadMatcher(f"unknown split {word!r}; known: {', '.join(known)}")
    return known[word]
