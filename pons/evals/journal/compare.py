"""Compare two decisions about one sentence. Pure.

Steps are compared by what they do. The words of an answer, a question or a ``say`` may differ
without the robot doing anything else, so that counts apart.
"""

from __future__ import annotations

from enum import StrEnum

from planner.plan import PlanRecord, StepRecord


class Difference(StrEnum):
    """How two decisions relate."""

    SAME = "same"
    WORDS = "words"
    """The same acts and codes, other words."""
    DIFFERS = "differs"


_NUMBERS = ("seconds", "angle_rad", "distance_m")


def difference(one: PlanRecord, other: PlanRecord) -> Difference:
    """Return how two plans relate."""
    if deed(one) != deed(other):
        return Difference.DIFFERS
    return Difference.SAME if words(one) == words(other) else Difference.WORDS


def deed(plan: PlanRecord) -> tuple[object, ...]:
    """Return a plan's acts, without its words."""
    code = plan.code.value if plan.code is not None else ""
    return (plan.kind, code, *map(_act, plan.steps))


def words(plan: PlanRecord) -> tuple[object, ...]:
    """Return a plan's words."""
    said = (plan.text.en, plan.text.zh) if plan.text is not None else ()
    return (*said, *(step.text for step in plan.steps))


def plan_line(plan: PlanRecord) -> str:
    """Return a plan in a line."""
    if plan.kind != "plan":
        return f"{plan.kind} {plan.code.value if plan.code is not None else ''}".strip()
    return " > ".join(_step(step) for step in plan.steps)


def _act(step: StepRecord) -> tuple[object, ...]:
    numbers = (None if (n := getattr(step, name)) is None else round(n, 2) for name in _NUMBERS)
    return (step.kind, step.place, step.places, step.object, *numbers)


def _step(step: StepRecord) -> str:
    numbers = (f"{n:g}" for name in _NUMBERS if (n := getattr(step, name)) is not None)
    named = (step.place, *step.places, step.object, *numbers)
    return " ".join([step.kind, *(word for word in named if word)])
