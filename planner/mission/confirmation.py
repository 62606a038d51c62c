"""Say when a plan needs a person's yes though nobody asked to see it first. One rule a line."""

from __future__ import annotations

from planner.language.catalogue import message, say
from planner.language.questions import looks_round
from planner.mission.motion_on_yes import first_deed
from planner.mission.state import Mission, SiteView
from planner.plan import Bilingual, Code, Outcome, StepRecord, same

BACK = ""
"""Where a goal was given: no place has this id."""
ROAMS = frozenset({"find", "count", "follow", "go_to_object", "go_to_point", "look"})
"""Steps that lead where the eyes say, and not to a place."""


def needs_yes(facts: SiteView, mission: Mission, steps: tuple[StepRecord, ...]) -> Outcome | None:
    """Return what a person is asked before these new steps are walked, or None.

    ``new_place``: the person named where to go, or what to; a brain that found that shut must not
    choose another destination by itself, nor roam for what was not asked for. After an answer that
    was neither yes nor no, whatever moves needs a yes of its own.
    """
    if mission.now is not None and mission.now.kind == "ask":
        deed = first_deed(facts, steps)
        why = None if deed is None else say("confirmation.would", deed=deed)
        return None if why is None else _confirm(why)
    if mission.failure is None:
        return None
    instead = _elsewhere(facts, mission.steps, steps) or _roaming(mission.steps, steps)
    if instead is None:
        return None
    return _confirm(instead)


def _confirm(why: Bilingual) -> Outcome:
    return Outcome(code=Code.CONFIRM, message=message(Code.CONFIRM, why=why))


def _elsewhere(
    facts: SiteView, before: tuple[StepRecord, ...], steps: tuple[StepRecord, ...]
) -> Bilingual | None:
    """Say which place is new, if one is."""
    known = {place for step in before for place in _places(facts, step)}
    fresh = [p for step in steps for p in _places(facts, step) if p not in known]
    if not fresh:
        return None
    name = _name(facts, fresh[0])
    return say("confirmation.elsewhere", name=name)


def _roaming(before: tuple[StepRecord, ...], steps: tuple[StepRecord, ...]) -> Bilingual | None:
    """Say which step leads where the eyes say and was not in the plan before, if one does."""
    known = {_sought(step) for step in before}
    fresh = next((s for s in steps if _roams(s) and _sought(s) not in known), None)
    if fresh is None:
        return None
    return say(f"confirmation.{fresh.kind}", what=fresh.object or "")


def _roams(step: StepRecord) -> bool:
    if step.kind == "look":
        return step.place is None and looks_round(step.text or "")
    return step.kind in ROAMS


def _sought(step: StepRecord) -> tuple[str, str, str | None, int | None, int | None]:
    """Return what a step is after; a look round is the same whatever it is to answer."""
    what = (step.object or "").strip().casefold()
    if step.kind == "look":
        what = "round" if _roams(step) else "ahead"
    return step.kind, what, step.place, step.x, step.y


def _places(facts: SiteView, step: StepRecord) -> tuple[str, ...]:
    if step.kind == "return_home":
        return (facts.home,)
    if step.kind == "come_back":
        return (BACK,)
    return (step.place,) if step.place else step.places


def _name(facts: SiteView, place: str) -> Bilingual:
    if place == BACK:
        return say("confirmation.start")
    target = facts.targets.get(place)
    return target.name if target is not None else same(place)
