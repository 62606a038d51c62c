"""Tell what is remembered: of things, people, words that were told, or of what the robot did.

Law: it drives nothing and looks at nothing; what is not remembered is a result, too. Budget: a few
seconds for the disk. The same again after a crash or a pause.
"""

from __future__ import annotations

from planner.skills.actions import LookUp, Scene, SkillAction


def recall(_: Scene[None]) -> SkillAction:
    """Return the wish to look it up."""
    return LookUp()
