"""Drive to a room or place.

Precondition: the place exists now. Verdict: the bridge reached the leg, the robot stands, and for a
room its pose lies inside the outline. Budget: one leg; metres and seconds are the bridge's grant.
"""

from __future__ import annotations

from planner.mission.skills.actions import Finish, Scene, SkillAction
from planner.mission.skills.drive_to_place import drive_to


def go_to(scene: Scene) -> SkillAction:
    """Return the leg to the place, or that it was reached."""
    return Finish() if scene.part > 0 else drive_to(scene, scene.step.place or "")
