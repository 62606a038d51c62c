"""Do the steps whose skill has nothing to work out: ``say``, ``wait``, ``decide``, ``recall``.

Laws. Words are said at most once, even across a crash: words whose beginning is on disk were
perhaps said, and are left out. A wait that was paused is waited again whole: standing longer harms
nobody. While the brain thinks again the robot stands; its new steps take the place of the rest, are
validated like any others, and the same again are refused. What is not remembered is a result, too.
Budgets: the plan's own bounds, as many thoughts a goal as the rules allow, and a few seconds for
memory's disk; no motion.
"""

from __future__ import annotations

from planner.plan import StepState
from planner.skills.actions import LookUp, Scene, SkillAction, Skip, Speak, Stand, Think


def say(scene: Scene[None]) -> SkillAction:
    """Return the words, or leave them out where they were perhaps said."""
    if scene.step.state is StepState.RUNNING:
        return Skip("perhaps_said")
    return Speak(scene.step.text or "")


def wait(scene: Scene[None]) -> SkillAction:
    """Return the time to stand."""
    return Stand(scene.step.seconds or 0.0)


def decide(_: Scene[None]) -> SkillAction:
    """Return the wish to think with the sights and answers so far."""
    return Think()


def recall(_: Scene[None]) -> SkillAction:
    """Return the wish to look up things, people, words that were told, or what the robot did."""
    return LookUp()
