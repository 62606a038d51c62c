"""Write a model's replies: the offline brain's plan in the shape that the prompt asks for. Pure."""

from __future__ import annotations

from typing import Any

from planner.brain.schema import CLARIFY_CODES, EVIDENCE, REFUSE_CODES
from planner.plan import AnswerPlan, Clarify, Code, Refuse, StepPlan

GARBAGE = (
    "Sure! I would love to drive there for you. Let me think about the best way…",
    '{"kind": "plan", "steps": [{"kind": "go_to", "place": ',
    "<html><body><h1>It works!</h1></body></html>",
    '{"kind": "dance", "moves": 3}',
)


def reply_of(plan: StepPlan | AnswerPlan | Clarify | Refuse, order: str = "") -> dict[str, Any]:
    """Return a plan in the flat shape that the prompt asks for; each step quotes the order."""
    match plan:
        case StepPlan():
            dumped = [step.model_dump(mode="json", exclude_none=True) for step in plan.steps]
            steps = _quote(dumped, order) if order else dumped
            return {"kind": "plan", "steps": steps} | ({"pace": plan.pace} if plan.pace else {})
        case AnswerPlan():
            return {"kind": "answer", **plan.text.model_dump()}
        case Clarify():
            options = [option.text for option in plan.options]
            code = _one_of(plan.code, CLARIFY_CODES)
            return {"kind": "clarify", "code": code, **plan.question.model_dump(),
                    "options": options}  # fmt: skip
        case Refuse():
            code = _one_of(plan.code, REFUSE_CODES)
            return {"kind": "refuse", "code": code, **plan.reason.model_dump()}


def _quote(value: Any, order: str) -> Any:
    """Return steps, and those that they hold, each with the whole order as its evidence."""
    if isinstance(value, list):
        return [_quote(each, order) for each in value]
    if not isinstance(value, dict):
        return value
    return {k: _quote(v, order) for k, v in value.items()} | {EVIDENCE: order}


def _one_of(code: Code, codes: tuple[Code, ...]) -> str:
    return (code if code in codes else Code.NOT_UNDERSTOOD).value
