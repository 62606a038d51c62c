"""Ask a person before a model's plan moves the robot in a way that nobody asked for.

Which steps those are is judged beside the brain, from the person's words alone
(``planner.mission.plan_request``), for a first plan, for one after ``decide``, after an answer and
after a failure alike. Law: the question names every one of these deeds, since a yes is a yes to all
of them; what this goal was allowed before is not asked again. Pure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import list_names, message, say
from planner.language.formatting import angle, metres
from planner.mission.scene import name_deed, name_sought
from planner.plan import DRIVES, Bilingual, Code, Outcome, StepRecord, say_same

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.site.site_view import SiteView

UNASKED = "unasked_motion"
"""The reason of a goal that waits for a yes to motion nobody asked for; never renamed."""


def ask_for_motion(
    facts: SiteView,
    allowed: tuple[StepRecord, ...],
    steps: tuple[StepRecord, ...],
    unasked: Iterable[int],
) -> Outcome | None:
    """Return the question before these steps are walked, or None where every one was asked for.

    Args:
        facts: the site as it is now.
        allowed: this goal's steps until now, accepted as they stood.
        steps: the new ones.
        unasked: which of the new ones nobody asked for.
    """
    known = {key_of_deed(step) for step in allowed}
    found = [steps[i] for i in unasked if i < len(steps) and key_of_deed(steps[i]) not in known]
    if not found:
        return None
    deeds = dict.fromkeys(_tell(facts, step) for step in found)
    drives = [step for step in steps if step.kind in DRIVES or step.place or step.places]
    if len(deeds) == 1 and len(drives) > 1 and drives[0] is found[0]:  # and then elsewhere
        deeds = {say("deed.first", deed=deed): None for deed in deeds}
    why = say("confirmation.unasked", deeds=list_names(deeds, "joint.and"))
    return Outcome(code=Code.CONFIRM, message=message(Code.ASKED, text=why))


def key_of_deed(step: StepRecord) -> tuple[object, ...]:
    """Return what a step would do, so that two of the same are alike."""
    label = (step.object or "").strip().casefold()
    return (
        *(step.kind, step.place, step.places, label),
        *(step.angle_rad, step.distance_m, step.x, step.y, step.side),
    )


def _tell(facts: SiteView, step: StepRecord) -> Bilingual:
    """Name a step's deed with all that it would move."""
    if step.places:
        names = [facts.targets[p].name if p in facts.targets else say_same(p) for p in step.places]
        return say("deed.drive_to_each", names=list_names(names, "joint.and"))
    if step.angle_rad is not None:
        return say("deed.turn_by", angle=angle(step.angle_rad))
    if step.kind == "move" and step.distance_m is not None:
        return say("deed.move_by", metres=metres(step.distance_m))
    if step.place and step.kind != "go_to":
        name = facts.targets[step.place].name if step.place in facts.targets else None
        there = say("deed.drive_to", name=name if name is not None else say_same(step.place))
        if step.object is None:
            return there
        return say("deed.drive_and_seek", there=there, what=name_sought(step))
    return name_deed(facts, step)
