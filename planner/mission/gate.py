"""Be the last gate before a plan is walked: it trusts no brain and no validation before it."""

from __future__ import annotations

from planner.mission.records import Facts
from planner.mission.skills import SKILLS
from planner.plan import NEEDS_CAMERA, Code, Outcome, StepRecord, message, same


def unwalkable(facts: Facts, steps: tuple[StepRecord, ...]) -> Outcome | None:
    """Return why these steps can't all be walked, or None. Nothing has moved yet."""
    if not steps:
        return Outcome(code=Code.BAD_PLAN, message=message(Code.BAD_PLAN, why="no steps"))
    lacking = next((s.kind for s in steps if s.kind not in SKILLS), None)
    if lacking is not None:
        code = Code.NO_CAMERA if lacking in NEEDS_CAMERA else Code.NO_CAPABILITY
        return Outcome(code=code, message=message(code, part=same(lacking)))
    named = (p for s in steps for p in ((s.place,) if s.place else s.places))
    unknown = next((p for p in named if p not in facts.targets), None)
    if unknown is None:
        return None
    known = same(", ".join(sorted(facts.targets)))
    said = message(Code.UNKNOWN_PLACE, name=unknown, near="", known=known)
    return Outcome(code=Code.UNKNOWN_PLACE, message=said)
