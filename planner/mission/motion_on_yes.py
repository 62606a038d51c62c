"""Find what moves upon a person's yes, and put it in words. Pure.

An ``ask`` is a question upon whose yes something moves where a step that may move the robot comes
after it, before the next ``ask`` or ``decide``: a later question asks anew, and a thought reads the
answer before it plans.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.brain.interface import OFFLINE
from planner.language.catalogue import CATALOGUE, say
from planner.mission.outcomes import moves
from planner.plan import Bilingual, StepRecord, same

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.mission.state import Mission, Rules, SiteView

DO_THAT = say("deed.do_that")
_UNTIL = frozenset({"ask", "decide"})


def upon_yes(facts: SiteView, mission: Mission) -> Bilingual | None:
    """Return what the robot does next upon a yes to the question of the current step.

    None where nothing moves before the next question or thought.
    """
    if mission.now is None or mission.now.kind != "ask":
        return None
    gated: list[StepRecord] = []
    for step in mission.steps[mission.step + 1 :]:
        if step.kind in _UNTIL:
            break
        gated.append(step)
    return first_deed(facts, gated)


def first_deed(facts: SiteView, steps: Iterable[StepRecord]) -> Bilingual | None:
    """Say what the first of these steps that may move the robot does; None where none moves."""
    step = next(filter(moves, steps), None)
    if step is None:
        return None
    place = facts.home if step.kind == "return_home" else step.place
    if place:
        name = facts.targets[place].name if place in facts.targets else same(place)
        return say("deed.drive_to", name=name)
    code = f"deed.{step.kind}"
    return say(code if CATALOGUE.has(code) else "deed.go_on", what=step.object or "")


def can_think(rules: Rules, mission: Mission) -> bool:
    """Tell whether the brain that planned a goal may read an answer: the offline one has no way."""
    brain = mission.brain
    return brain is not None and brain.name != OFFLINE and mission.decides < rules.decides
