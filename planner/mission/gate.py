"""Be the last gate before a plan is walked: it trusts no brain and no validation before it."""

from __future__ import annotations

from planner.mission.records import Book, Facts, Mission
from planner.mission.skills import SKILLS, Eyesight
from planner.mission.skills.seen import meant
from planner.mission.skills.tell import unknown_words
from planner.plan import NEEDS_DETECTOR, Code, Language, Outcome, StepRecord, message, same
from planner.vision.labels import singles_out

UP_TO = frozenset({"go_to_object", "follow"})
"""The robot goes up to what these name: any other of its kind is the wrong one."""


def unwalkable(book: Book, mission: Mission, steps: tuple[StepRecord, ...]) -> Outcome | None:
    """Return why these steps can't all be walked, or None. Nothing has moved yet."""
    if not steps:
        return Outcome(code=Code.BAD_PLAN, message=message(Code.BAD_PLAN, why="no steps"))
    for step in steps:
        code = book.means.lacks(step.kind) if step.kind in SKILLS else Code.NO_CAPABILITY
        if code is not None:
            return Outcome(code=code, message=message(code, part=same(step.kind)))
    return _unknown_place(book.facts, steps) or _unknown_thing(book.eyes, mission.language, steps)


def _unknown_place(facts: Facts, steps: tuple[StepRecord, ...]) -> Outcome | None:
    named = (p for s in steps for p in ((s.place,) if s.place else s.places))
    unknown = next((p for p in named if p not in facts.targets), None)
    if unknown is None:
        return None
    known = same(", ".join(sorted(facts.targets)))
    said = message(Code.UNKNOWN_PLACE, name=unknown, near="", known=known)
    return Outcome(code=Code.UNKNOWN_PLACE, message=said)


def _unknown_thing(
    eyes: Eyesight, language: Language, steps: tuple[StepRecord, ...]
) -> Outcome | None:
    """Return why a thing can't be looked for: the detector does not know it, nor can a model tell.

    A vision model can point at anything, but only at what is in the picture: enough to go there.
    """
    for step in steps:
        pointed = eyes.model and step.kind == "go_to_object"
        if step.kind not in NEEDS_DETECTOR or pointed:
            continue
        name = step.object or ""
        which = step.kind in UP_TO and singles_out(name, eyes.classes)
        if which or meant(name, language, eyes.classes) is None:
            said = unknown_words(name, eyes.classes)
            return Outcome(code=Code.OBJECT_UNKNOWN, message=said)
    return None
