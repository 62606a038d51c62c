"""Drive back to where the goal was accepted.

Precondition: that pose was known, and is on this map. Verdict: the bridge reached the leg and the
robot stands. Budget: one leg; metres and seconds are the bridge's grant.
"""

from __future__ import annotations

from planner.mission.skills.actions import Drive, Fail, Finish, Scene, SkillAction
from planner.plan import Code


def come_back(scene: Scene) -> SkillAction:
    """Return the leg back, or that it was reached."""
    if scene.part > 0:
        return Finish()
    if scene.accepted is None:
        return Fail(Code.NO_ROUTE, "no_route")
    return Drive(scene.accepted, heading=True)
