"""Think again after steps have run: the rest of the same plan, and nothing twice.

A grammar has no second idea. It never orders a step again that is over, and says so where the rest
is not its own plan's. What a person answered it does not read: that is no reason to go on.
"""

from __future__ import annotations

from collections.abc import Sequence

from planner.brain.interface import Observation
from planner.language.catalogue import join, message, say
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, Refuse, StepPlan

_READS_NO_ANSWER = say("replan.reads_no_answer")
_NO_OTHER_WAY = say("replan.no_other_way")


def _whole(seen: Observation) -> Bilingual:
    """Return the facts known of a step, and beside them a model's reading."""
    if seen.read is None:
        return seen.detail
    return join(text for text in (seen.detail, seen.read) if text.en)


def rest_of(
    plan: StepPlan | AnswerPlan | Clarify | Refuse, observed: Sequence[Observation]
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Return the rest of a sentence's plan after these observations."""
    if not observed or not isinstance(plan, StepPlan):
        return plan
    if observed[-1].step == "ask":  # neither yes nor no: a person is asked again, nothing goes on
        return Refuse(code=Code.BAD_PLAN, reason=message(Code.BAD_PLAN, why=_READS_NO_ANSWER))
    kinds = [step.kind for step in plan.steps]
    walked = [seen.step for seen in observed]
    if kinds[: len(walked)] != walked:  # another brain's plan was walked
        return Refuse(code=Code.BAD_PLAN, reason=message(Code.BAD_PLAN, why=_NO_OTHER_WAY))
    failed = observed[-1].result == "failed"
    left = plan.steps[len(walked) - int(failed) :]
    if left:
        return StepPlan(steps=left)
    told = [_whole(seen) for seen in observed if seen.step != "decide"]
    told = told or [_NO_OTHER_WAY]
    return AnswerPlan(text=told[-1])
