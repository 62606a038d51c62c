"""Read the scripts of conversations: what a person says, turn by turn, and what it should come to.

``sentence // other words | reaction: plan``; ``> `` before a sentence: typed as an answer; ``~ ``
before a reaction: still under way at the next turn. Blanks are filled with places and things.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

from pons.evals.matchers import BadMatcher, Expectation, read_expectation
from pons.evals.suites import HELD_OUT, TUNED

if TYPE_CHECKING:
    from collections.abc import Iterator

SCRIPTS = Path(__file__).parent / "persons"
FEWEST, MOST = 3, 8
"""Turns of a conversation."""
VARIANTS = 3
"""Times that a script with blanks is held, each with other places and things."""
_BLANKS = {
    "en": {
        "ABC": (("the kitchen", "kitchen"), ("the study", "study"), ("the bedroom", "bedroom"),
                ("the bathroom", "bathroom"), ("the living room", "living_room"),
                ("the hallway", "hallway")),
        "T": (("cup", "cup"), ("bottle", "bottle"), ("chair", "chair"), ("ball", "ball")),
    },
    "zh": {
        "ABC": (("厨房", "kitchen"), ("书房", "study"), ("卧室", "bedroom"), ("卫生间", "bathroom"),
                ("客厅", "living_room"), ("走廊", "hallway")),
        "T": (("杯子", "杯子"), ("瓶子", "瓶子"), ("椅子", "椅子"), ("球", "球")),
    },
}  # fmt: skip


_NOTE = "\t"
"""Comes before each note of a turn."""


class ScriptSet(StrEnum):
    """Name conversations that were written together, as their files' names begin."""

    OWN = ""
    TRIAL = "trials_"
    """Those that a strong model was once tried with."""
    THIRD = "talks_3_"
    """Written before the grammar was read; their first run is in docs/eval.md."""
    FOURTH = "talks_4_"
    """Written once the third were mended; their first run is in docs/eval.md."""


class Reaction(StrEnum):
    """Say what a sentence came to."""

    NEW = "new"
    INSTEAD = "instead"
    AFTER = "after"
    ASKS = "asks"
    CONFIRMS = "confirms"
    NO = "no"
    ANSWER = "answer"
    CANCEL = "cancel"
    STOP = "stop"
    DROPS = "drops"
    """A question or a plan was given up, upon a no."""


PLANS = frozenset({Reaction.NEW, Reaction.INSTEAD, Reaction.AFTER})


@dataclass(frozen=True, slots=True)
class TrialNotes:
    """Hold what stands below a trial's turn: ``NAME: words``, parts behind semicolons."""

    model: tuple[Expectation, ...] = ()
    """What a model once replied, thought by thought, where that is not simply the plan."""
    sees: str = ""
    """What a vision model says of each picture, behind yes or no."""
    hears: tuple[str, ...] = ()
    """What the person answers on the way."""
    told: tuple[str, ...] = ()
    """A code of the goal's end, then words of which each stands in what was told."""


@dataclass(frozen=True, slots=True)
class ScriptTurn:
    """Hold one turn of a script."""

    says: tuple[str, ...]
    """The sentence, and other words for it."""
    wanted: frozenset[Reaction]
    plan: Expectation | None = None
    typed: bool = False
    """It is written into the answer box of the question that waits."""
    stays: bool = False
    """What it set going is still under way when the person goes on."""
    goal: str = ""
    """The number of the trial's goal that it belongs to."""
    notes: TrialNotes = TrialNotes()


@dataclass(frozen=True, slots=True)
class Script:
    """Hold one conversation."""

    split: str
    name: str
    language: str
    turns: tuple[ScriptTurn, ...]


def read_scripts(language: str, script_set: ScriptSet = ScriptSet.OWN) -> tuple[Script, ...]:
    """Return a language's conversations of a set, each as often as its blanks are filled.

    Args:
        language: ``en`` or ``zh``.
        script_set: which of them.

    Raises:
        BadMatcher: a script can't be read.
    """
    text = (SCRIPTS / f"{script_set}{language}.txt").read_text("utf-8")
    blocks = (block for block in text.split("\n## ")[1:] if block.strip())
    return tuple(script for block in blocks for script in _read_block(block, language))


def _read_block(block: str, language: str) -> Iterator[Script]:
    head, *lines = block.strip().splitlines()
    split, _, name = head.partition(" ")
    if split not in ("tuned", "held"):
        raise BadMatcher(f"{head!r}: expected tuned or held, and a name")
    kept = [line for line in lines if line.strip() and not line.startswith("#")]
    kept = "\n".join(kept).replace("\n  ", _NOTE).split("\n")
    if not FEWEST <= len(kept) <= MOST:
        raise BadMatcher(f"{name!r}: {len(kept)} turns; expected {FEWEST} to {MOST}")
    blanks = "{" in block
    for variant in range(VARIANTS if blanks else 1):
        turns = tuple(_read_turn(_fill(line, language, variant)) for line in kept)
        tag = f"{name}-{variant + 1}" if blanks else name
        yield Script(TUNED if split == "tuned" else HELD_OUT, tag, language, turns)


def _fill(line: str, language: str, variant: int) -> str:
    """Fill blanks: names in what is said, ids in what is expected."""
    said, bar, wanted = line.partition(" | ")
    places, things = _BLANKS[language]["ABC"], _BLANKS[language]["T"]
    for number, blank in enumerate("ABC"):
        name, id_ = places[(variant * 2 + number) % len(places)]
        said, wanted = said.replace(f"{{{blank}}}", name), wanted.replace(f"{{{blank}}}", id_)
    name, id_ = things[variant % len(things)]
    return f"{said.replace('{T}', name)}{bar}{wanted.replace('{T}', id_)}"


def _read_turn(line: str) -> ScriptTurn:
    line, *notes = line.split(_NOTE)
    said, bar, wanted = line.partition(" | ")
    stays, wanted = wanted.startswith("~ "), wanted.removeprefix("~ ")
    typed, said = said.startswith("> "), said.removeprefix("> ")
    goal, said = said[1:].split("] ", 1) if said.startswith("[") else ("", said)
    reactions, plans = set[Reaction](), list[str]()
    for way in wanted.split(" | "):
        names, _, plan = way.removeprefix("~ ").partition(":")
        try:
            reactions |= {Reaction(name) for name in names.strip().split("/")}
        except ValueError as wrong:
            raise BadMatcher(f"{line!r}: {wrong}") from wrong
        plans += [plan.strip()] if plan.strip() else []
    if not bar or (reactions & PLANS and not plans):
        raise BadMatcher(f"{line!r}: expected a sentence, a bar, and what it comes to")
    expected = read_expectation(" | ".join(plans)) if plans else None
    says, wants = tuple(said.split(" // ")), frozenset(reactions)
    return ScriptTurn(says, wants, expected, typed, stays, goal, _read_notes(notes))


def _read_notes(lines: list[str]) -> TrialNotes:
    notes = {name: words for name, _, words in (line.partition(": ") for line in lines)}
    if not notes.keys() <= {"model", "sees", "hears", "told"}:
        raise BadMatcher(f"{lines}: expected model, sees, hears or told, and words")
    parts = {
        name: tuple(part.strip() for part in notes.get(name, "").split(";") if part.strip())
        for name in ("model", "hears", "told")
    }
    model = tuple(read_expectation(part) for part in parts["model"])
    return TrialNotes(model, notes.get("sees", ""), parts["hears"], parts["told"])
