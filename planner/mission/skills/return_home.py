"""Drive to the site's home.

Precondition: the site still has its home. Verdict: as for any place. Budget: one leg; metres and
seconds are the bridge's grant.
"""

from __future__ import annotations

from planner.mission.skills.actions import Finish, Scene, SkillAction
from planner.mission.skills.drive_to_place import drive_to


def return_home(scene: Scene) -> SkillAction:
    """Return the leg home, or that it was reached."""
    return Finish() if scene.part > 0 else drive_to(scene, scene.facts.home)
