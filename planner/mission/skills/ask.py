"""Ask a person a question and wait for the answer, standing.

Law: the robot is free for others meanwhile, and who waits behind this goal is kept waiting. The
answer is an observation for a later ``decide``; it never becomes a step by itself. Budget: the time
set for answers, after which the goal ends and the robot stays where it is.
"""

from __future__ import annotations

from planner.mission.skills.act import Act, Done, Question, Scene
from planner.plan import same


def ask(scene: Scene) -> Act:
    """Return the question, until it is answered."""
    return Question(same(scene.step.text or "")) if scene.step.answer is None else Done()
