"""Drive to places of the site: ``go_to``, ``return_home`` and ``come_back`` share this.

Law: a place that is gone is not driven to, however recently it was there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import message
from planner.mission.skills.actions import Drive, Fail, Scene
from planner.plan import Code, same

if TYPE_CHECKING:
    from planner.mission.state import SiteView


def drive_to(scene: Scene, place: str) -> Drive | Fail:
    """Return the leg to a place: into a room at any heading, to anything else at its own."""
    target = scene.facts.targets.get(place)
    if target is None:
        return place_gone(scene.facts, place)
    return Drive(target.pose, heading=not target.room, target=target.id)


def place_gone(facts: SiteView, place: str) -> Fail:
    """Say that a place was forgotten since the plan was made, and what there is."""
    known = same(", ".join(sorted(facts.targets)))
    said = message(Code.UNKNOWN_PLACE, name=place, near="", known=known)
    return Fail(Code.UNKNOWN_PLACE, "place_gone", said)
