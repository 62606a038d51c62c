"""Be the last gate before a plan is carried out: first plans, new ones under way, resumed by a yes.

It trusts no brain and no validation before it, and knows what those do not: the detector's classes
as they are now, and whether a model can point. Eyes that fail later end their own step
(``planner.mission.skills.act_of``).
"""

from __future__ import annotations

from planner.language.catalogue import message, say
from planner.mission.skills import SKILLS
from planner.mission.skills.object_matching import meant, picks_out
from planner.mission.skills.object_query import unknown_kind
from planner.mission.skills.result_text import unknown_name, unknown_words
from planner.mission.state import Mission, MissionState, SiteView
from planner.plan import (
    NEEDS_DETECTOR,
    Bilingual,
    Code,
    Language,
    Outcome,
    StepRecord,
    same,
)

NO_STEPS = say("plan.no_steps")
UP_TO = frozenset({"go_to_object", "follow"})
"""The robot goes up to what these name: any other of its kind is the wrong one."""


def unwalkable(
    book: MissionState, mission: Mission, steps: tuple[StepRecord, ...]
) -> Outcome | None:
    """Return why these steps can't all be carried out, or None. Nothing has moved yet."""
    if not steps:
        return Outcome(code=Code.BAD_PLAN, message=message(Code.BAD_PLAN, why=NO_STEPS))
    for step in steps:
        code = book.means.lacks(step.kind) if step.kind in SKILLS else Code.NO_CAPABILITY
        if code is not None:
            return Outcome(code=code, message=message(code, part=same(step.kind)))
    return _unknown_place(book.facts, steps) or _unknown_thing(book, mission.language, steps)


def _unknown_place(facts: SiteView, steps: tuple[StepRecord, ...]) -> Outcome | None:
    named = (p for s in steps for p in ((s.place,) if s.place else s.places))
    unknown = next((p for p in named if p not in facts.targets), None)
    if unknown is None:
        return None
    known = same(", ".join(sorted(facts.targets)))
    said = message(Code.UNKNOWN_PLACE, name=unknown, near="", known=known)
    return Outcome(code=Code.UNKNOWN_PLACE, message=said)


def _unknown_thing(
    book: MissionState, language: Language, steps: tuple[StepRecord, ...]
) -> Outcome | None:
    """Return why a thing can't be looked for: the detector does not know it, nor can a model tell.

    A vision model can point at anything, but only at what is in the picture: enough to go there. It
    answers any question about a picture.
    """
    for step in steps:
        said = _unknown_in(book, language, step)
        if said is not None:
            return Outcome(code=Code.OBJECT_UNKNOWN, message=said)
    return None


def _unknown_in(book: MissionState, language: Language, step: StepRecord) -> Bilingual | None:
    eyes = book.eyes
    if eyes.model and step.kind in ("go_to_object", "look"):
        return None
    if step.kind == "look":
        kind = unknown_kind(step.text or "", book.facts, language, eyes.classes)
        return unknown_name(kind, eyes.classes) if kind is not None else None
    if step.kind not in NEEDS_DETECTOR:
        return None
    name = step.object or ""
    which = step.kind in UP_TO and picks_out(name, step.kind, language, eyes.classes)
    unknown = which or meant(name, language, eyes.classes) is None
    return unknown_words(name, eyes.classes, step.kind) if unknown else None
