"""Judge what a brain wrote against the site's names and the kinds of steps that can be run.

It collects every reason, so that a model can be asked to write the plan better. It sees neither the
detector's classes nor what a person said: ``planner.mission.plan_check`` judges a plan whole before
any of it is carried out, whatever was found here.
"""

from __future__ import annotations

from collections.abc import Iterator

from planner.plan.base import Frozen
from planner.plan.outcome_codes import Code
from planner.plan.responses import MAX_STEPS, Answer, Clarify, Refuse, StepPlan
from planner.plan.steps import NEEDS_CAMERA, RUNNABLE, Step, places_of
from planner.plan.vocabulary import Vocabulary


class Reason(Frozen):
    """Name one fault of a plan; `repairable` where the model could write it better."""

    code: Code
    step: int | None  # index into the plan's steps; None where the plan as a whole is meant
    what: str
    repairable: bool


class Rejection(Frozen):
    """Refuse a plan, with every reason found; ``planner.language.plan_rejections`` tells it."""

    reasons: tuple[Reason, ...]

    @property
    def first(self) -> Reason:
        """Return what a person must hear first: what no repair can mend."""
        return next((reason for reason in self.reasons if not reason.repairable), self.reasons[0])

    @property
    def repairable(self) -> bool:
        """Tell whether handing the reasons back to the model could help."""
        return all(reason.repairable for reason in self.reasons)


def validate_plan(
    plan: StepPlan | Answer | Clarify | Refuse,
    vocabulary: Vocabulary,
    runnable: frozenset[str] = RUNNABLE,
    blind: Code = Code.NO_CAMERA,
) -> StepPlan | Answer | Clarify | Refuse | Rejection:
    """Return the plan itself where no reason speaks against it, else every reason that does.

    ``blind`` is the code of a step that needs eyes and can't be run. Bounds of numbers hold from
    birth (the models refuse them), so they are not looked at again.
    """
    if not isinstance(plan, StepPlan):
        return plan
    reasons = tuple(_faults(plan, vocabulary, runnable, blind))
    return Rejection(reasons=reasons) if reasons else plan


def _faults(
    plan: StepPlan, vocabulary: Vocabulary, runnable: frozenset[str], blind: Code
) -> Iterator[Reason]:
    count = len(plan.steps)
    if not 1 <= count <= MAX_STEPS:
        what = f"{count} steps; expected 1 to {MAX_STEPS}"
        yield Reason(code=Code.BAD_PLAN, step=None, what=what, repairable=True)
    for index, step in enumerate(plan.steps):
        for place in places_of(step):
            if place not in vocabulary:
                yield Reason(code=Code.UNKNOWN_PLACE, step=index, what=place, repairable=True)
        if step.kind not in runnable:
            yield Reason(code=lacking(step, blind), step=index, what=step.kind, repairable=False)


def lacking(step: Step, blind: Code = Code.NO_CAMERA) -> Code:
    """Name what the robot lacks for a step that it can't run; ``blind``: what its eyes lack."""
    return blind if step.kind in NEEDS_CAMERA else Code.NO_CAPABILITY
