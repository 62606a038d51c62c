"""Visit places in the order they were named.

Precondition: each place exists when its turn comes. Verdict: every place was reached as ``go_to``
reaches it; a pause or a crash goes on with the place that was next. Budget: one leg a place; metres
and seconds are the bridge's grant.
"""

from __future__ import annotations

from planner.mission.skills.actions import Finish, Scene, SkillAction
from planner.mission.skills.drive_to_place import drive_to


def patrol(scene: Scene) -> SkillAction:
    """Return the leg to the next place, or that all were visited."""
    places = scene.step.places
    if scene.part >= len(places):
        return Finish({"visited": scene.part})
    return drive_to(scene, places[scene.part])
