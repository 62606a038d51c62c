"""Think again with the sights and answers so far; the new steps take the place of the rest.

Law: the robot stands meanwhile; the new plan is validated like any other, and the same steps again
are refused, so that no goal thinks for ever. Budget: as many thoughts a goal as the rules allow.
"""

from __future__ import annotations

from planner.skills.actions import Scene, SkillAction, Think


def decide(_: Scene[None]) -> SkillAction:
    """Return the wish to think."""
    return Think()
