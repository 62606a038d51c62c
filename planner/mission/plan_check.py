"""Judge steps before any of them is carried out, with all that the missions know at that moment.

Asked for first plans and for new ones under way; trusts no brain and no judgement before it.
``planner.plan.check_plan`` judges; told to it here are the places and the means as they are now,
the detector's classes, and whether a model can point.

A person is asked before steps move the robot in a way that nobody asked for. Which steps those are
is judged beside the brain (``planner.mission.plan_request``). Law: the question names every one of
these deeds, since a yes is a yes to all of them; what was allowed before is not asked again.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from planner.language.catalogue import list_names, message, say, say_or_quote
from planner.language.formatting import angle, metres
from planner.language.questions import find_elsewhere
from planner.language.room_names import sorts_of_room
from planner.mission.account import name_place
from planner.mission.scene import name_deed, name_sought
from planner.mission.state import Mission, MissionState
from planner.plan import (
    CONTROL,
    DRIVES,
    NEEDS_DETECTOR,
    Bilingual,
    Code,
    Language,
    Outcome,
    StepRecord,
    check_plan,
    places_of,
)
from planner.skills import SKILLS
from planner.skills.drive_to_place import tell_unknown_place
from planner.skills.object_matching import anybody_for, picks_out, read_object
from planner.skills.object_query import place_names, unknown_kind
from planner.skills.result_text import unknown_name, unknown_words

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.site.site_view import SiteView


NO_STEPS = say("plan.no_steps")
UP_TO = frozenset({"go_to_object", "follow"})
"""The robot goes up to what these name: any other of its kind is the wrong one."""


def unwalkable(
    book: MissionState, mission: Mission, steps: tuple[StepRecord, ...]
) -> Outcome | None:
    """Return why these steps can't all be carried out, or None. Nothing has moved yet."""
    rejection = check_plan(
        steps,
        book.facts.targets,
        book.means.runnable & (SKILLS.keys() | CONTROL),
        book.means.blind,
        partial(_unknown_object, book, mission.language),
    )
    if rejection is None:
        elsewhere = _find_unknown_place(book, mission, steps)
        said = None if elsewhere is None else tell_unknown_place(book.facts, elsewhere)
        return None if said is None else Outcome(code=Code.UNKNOWN_PLACE, message=said)
    first = rejection.first
    match first.code:
        case Code.BAD_PLAN:
            said = message(first.code, why=say("plan.flaw", what=first.what) if steps else NO_STEPS)
        case Code.UNKNOWN_PLACE:
            said = tell_unknown_place(book.facts, first.what)
        case _:
            said = first.said or message(first.code, part=say_or_quote("step_kind", first.what))
    return Outcome(code=first.code, message=said)


def _find_unknown_place(
    book: MissionState, mission: Mission, steps: tuple[StepRecord, ...]
) -> str | None:
    """Return the unknown place about which a look from here would answer; None: it answers of here.

    A brain may have dropped the place from its question, so the order itself counts where no step
    names any. To a vision model that is asked about a picture only a sort of room is elsewhere.
    """
    here = [step.text or "" for step in steps if step.kind == "look" and step.place is None]
    if here and not any(map(places_of, steps)):
        here.append(mission.words)
    names = place_names(book.facts)
    found = (name for text in here if (name := find_elsewhere(text, names)) is not None)
    return next((n for n in found if not book.eyes.model or sorts_of_room((n,))), None)


def _unknown_object(book: MissionState, language: Language, step: StepRecord) -> Bilingual | None:
    """Return why a thing can't be looked for: the detector does not know it, nor can a model tell.

    A vision model can point at anything, but only at what is in the picture: enough to go there. It
    answers any question about a picture, and looks for anything, one picture a direction.
    """
    eyes = book.eyes
    if eyes.searches and step.kind in ("find", "count"):
        return None
    if eyes.model and step.kind in ("go_to_object", "look"):
        return None
    if step.kind == "look":
        kind = unknown_kind(step.text or "", book.facts, language, eyes.classes)
        return unknown_name(kind, eyes.classes) if kind is not None else None
    if step.kind not in NEEDS_DETECTOR and not (step.kind == "wait_for" and step.object):
        return None
    name = step.object or ""
    if step.kind == "find" and anybody_for(name, eyes.classes) is not None:
        return None
    which = step.kind in UP_TO and picks_out(name, step.kind, language, eyes.classes)
    unknown = which or read_object(name, language, eyes.classes) is None
    return unknown_words(name, eyes.classes, step.kind) if unknown else None


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
        *(step.map_id, step.x_m, step.y_m, step.yaw_rad),
    )


def _tell(facts: SiteView, step: StepRecord) -> Bilingual:
    """Name a step's deed with all that it would move."""
    if step.places:
        names = list_names((name_place(facts, p) for p in step.places), "joint.and")
        return say("deed.drive_to_each", names=names)
    if step.angle_rad is not None:
        return say("deed.turn_by", angle=angle(step.angle_rad))
    if step.kind == "move" and step.distance_m is not None:
        return say("deed.move_by", metres=metres(step.distance_m))
    if step.place and step.kind != "go_to":
        there = say("deed.drive_to", name=name_place(facts, step.place))
        if step.object is None:
            return there
        return say("deed.drive_and_seek", there=there, what=name_sought(step))
    return name_deed(facts, step)
