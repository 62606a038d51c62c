"""Say when a plan needs a person's yes though nobody asked to see it first. One rule a line."""

from __future__ import annotations

from planner.mission.records import Facts, Mission
from planner.plan import Bilingual, Code, Outcome, StepRecord, message, same

BACK = ""
"""Where a goal was given: no place has this id."""


def needs_yes(facts: Facts, mission: Mission, steps: tuple[StepRecord, ...]) -> Outcome | None:
    """Return what a person is asked before these new steps are walked, or None.

    ``new_place``: the person named where to go; a brain that found that way shut must not choose
    another destination by itself.
    """
    if mission.failure is None:
        return None
    known = {place for step in mission.steps for place in _places(facts, step)}
    fresh = [p for step in steps for p in _places(facts, step) if p not in known]
    if not fresh:
        return None
    name = _name(facts, fresh[0])
    why = Bilingual(en=f"it goes to “{name.en}” instead", zh=f"改去“{name.zh}”")
    return Outcome(code=Code.CONFIRM, message=message(Code.CONFIRM, why=why))


def _places(facts: Facts, step: StepRecord) -> tuple[str, ...]:
    if step.kind == "return_home":
        return (facts.home,)
    if step.kind == "come_back":
        return (BACK,)
    return (step.place,) if step.place else step.places


def _name(facts: Facts, place: str) -> Bilingual:
    if place == BACK:
        return Bilingual(en="where the goal was given", zh="下达任务的地方")
    target = facts.targets.get(place)
    return target.name if target is not None else same(place)
