"""Score what a brain makes of questions about before, and of what it is told to keep or forget.

The planner's own reading first, as at run time: what is to be kept or forgotten asks no brain. A
question is right where it becomes a `recall` of what is asked; an order must stay what it was.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.brain import ThinkRequest
from planner.brain.situation import RememberedItem, Situation
from planner.language.commands import Forget, ForgetFacts, Remember, TeachFact, read_statement
from planner.language.motion_guard.step_words import moves
from planner.language.sentence import parse
from planner.plan import EVERY_KIND, Recall, StepPlan
from pons.evals.cases import HELD_OUT, TUNED
from pons.evals.matchers import BadMatcher, read_expectation
from pons.evals.world import new_goal

if TYPE_CHECKING:
    from planner.brain import Brain
    from pons.evals.matchers import Made
    from pons.evals.world import EvalWorld

QUESTIONS = Path(__file__).parent / "memory"
_KNOWN = Situation(remembered=(RememberedItem(what="what is asked for", fits=True),))
"""Memory knows what a sentence names: a question about now may then be answered from it."""


@dataclass(frozen=True, slots=True)
class MemoryCase:
    """Hold one sentence, and what is to come of it."""

    split: str
    group: str
    text: str
    wanted: str


@dataclass(frozen=True, slots=True)
class MemoryVerdict:
    """Hold what came of one sentence."""

    case: MemoryCase
    done: str
    right: bool
    moves_wrongly: bool


def read_memory_cases(name: str) -> tuple[MemoryCase, ...]:
    """Return the cases of a language.

    Raises:
        BadMatcher: a line can't be read.
    """
    lines = (QUESTIONS / f"{name}.tsv").read_text("utf-8").splitlines()
    return tuple(_read(line) for line in lines if line.strip() and not line.startswith("#"))


def _read(line: str) -> MemoryCase:
    split, group, text, wanted = line.split("\t")
    if not (split in ("tuned", "held") and wanted):
        raise BadMatcher(f"{line!r}: expected split, group, sentence and expectation")
    return MemoryCase(TUNED if split == "tuned" else HELD_OUT, group, text, wanted)


async def score_memory(
    cases: tuple[MemoryCase, ...], brain: Brain, world: EvalWorld
) -> tuple[MemoryVerdict, ...]:
    """Return the verdicts in order."""
    return tuple([await _score(case, brain, world) for case in cases])


async def _score(case: MemoryCase, brain: Brain, world: EvalWorld) -> MemoryVerdict:
    done, made = _read_locally(case.text), None
    if done is None:
        asked = ThinkRequest(
            text=case.text,
            vocabulary=world.vocabulary,
            room=world.room,
            runnable=EVERY_KIND,
            situation=_KNOWN,
            goal=new_goal("memory"),
        )
        made = (await brain.think(asked)).plan
        done = _name(made)
    ways = [way.strip() for way in case.wanted.split("|")]
    right = any(_fits(way, done, made) for way in ways)
    moved = isinstance(made, StepPlan) and any(map(moves, made.steps))
    still = all(way.split()[0] in _STILL for way in ways)
    return MemoryVerdict(case, done, right, moved and still)


_STILL = frozenset(
    {"recall", "deeds", "teach", "forget", "place", "command", "answer", "clarify", "still"}
)


def _read_locally(text: str) -> str | None:
    """Return what the planner itself does with a sentence; None: it asks a brain."""
    intent = parse(text).intent or read_statement(text)
    match intent:
        case None:
            return None
        case TeachFact():
            return "teach"
        case ForgetFacts(about):
            return f"forget {about or 'all'}"
        case Remember() | Forget():
            return "place"
    return "command"


def _name(made: Made) -> str:
    """Return a plan in the words of an expectation."""
    if not isinstance(made, StepPlan):
        return made.kind
    step = made.steps[0] if len(made.steps) == 1 else None
    if not isinstance(step, Recall):
        return " > ".join(each.kind for each in made.steps)
    place = f" @{step.place}" if step.place else ""
    when = f" %{step.span}" if step.span else ""
    what = "deeds" if step.deeds else f"recall {step.object or ''}".strip()
    return f"{what}{place}{when}"


def _fits(way: str, done: str, made: Made | None) -> bool:
    kind = way.split(maxsplit=1)[0]
    if kind in ("teach", "place", "command", "deeds"):
        return done == way
    if kind in ("recall", "forget"):
        return done.split(maxsplit=1)[0] == kind and _is_same(way, done)
    return made is not None and read_expectation(way).fits(made)


def _is_same(way: str, done: str) -> bool:
    """Compare words; articles and the 的 of Chinese do not matter."""
    wanted, said = (
        [part for part in text.casefold().split() if part not in ("the", "my", "a", "an")]
        for text in (way, done)
    )
    bare = (re.sub("我的|的", "", "".join(parts)) for parts in (wanted, said))
    return next(bare) == next(bare)


def show_memory(name: str, verdicts: tuple[MemoryVerdict, ...]) -> str:
    """Return the figures, and every sentence that came to something else."""
    lines = []
    for split in (TUNED, HELD_OUT):
        mine = [each for each in verdicts if each.case.split == split]
        wrong = sum(v.moves_wrongly for v in mine)
        lines.append(
            f"memory {name} {split}: {sum(v.right for v in mine)} of {len(mine)} right, "
            f"{wrong} wrong motions"
        )
    lines += [
        f"  {v.case.text!r} -> {v.done}; expected {v.case.wanted}" for v in verdicts if not v.right
    ]
    return "\n".join(lines)
