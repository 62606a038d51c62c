"""Tell people words: on the page, in events, in the goal's outcome.

Law: at most once, even across a crash: words whose beginning is on disk were perhaps said, and are
left out. Budget: 500 characters by the plan's own bounds; no motion.
"""

from __future__ import annotations

from planner.plan import StepState
from planner.skills.actions import Scene, SkillAction, Skip, Speak


def say(scene: Scene[None]) -> SkillAction:
    """Return the words, or leave them out where they were perhaps said."""
    if scene.step.state is StepState.RUNNING:
        return Skip("perhaps_said")
    return Speak(scene.step.text or "")
