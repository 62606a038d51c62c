"""Stand for a while.

Law: nothing moves. After a pause or a crash the whole time is waited again: standing longer harms
nobody. Budget: the seconds asked for, 600 at most by the plan's own bounds.
"""

from __future__ import annotations

from planner.skills.actions import Scene, SkillAction, Stand


def wait(scene: Scene[None]) -> SkillAction:
    """Return the time to stand."""
    return Stand(scene.step.seconds or 0.0)
