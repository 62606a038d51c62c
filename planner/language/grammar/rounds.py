"""Tell what of a plan goes round: "twice" is an order's own word, and a patrol's too. Pure."""

from __future__ import annotations

from planner.plan import Patrol, Repeat, StepPlan


def has_rounds_alone(plan: StepPlan) -> bool:
    """Tell whether a plan does nothing but rounds, repeated or not."""
    inner = [
        s for step in plan.steps for s in (step.steps if isinstance(step, Repeat) else (step,))
    ]
    return all(isinstance(step, Patrol) for step in inner)


def is_round(plan: StepPlan) -> bool:
    """Tell whether a plan begins with steps that are done so many times."""
    return isinstance(plan.steps[0], Repeat)


def has_patrol(plan: StepPlan) -> bool:
    """Tell whether a plan drives round by itself."""
    return any(isinstance(step, Patrol) for step in plan.steps)
