"""Own the four things a brain may answer: a plan, an answer, a question, or an honest no.

Only `StepPlan` can lead to motion, and only after `check_plan`.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from planner.plan.base import Bilingual, Frozen
from planner.plan.outcome import Code
from planner.plan.steps import Step

MAX_STEPS = 20


class PlanRole(StrEnum):
    """Say how a plan acts on the goal that runs, or on the question that waits."""

    NEW = "new"
    INSTEAD = "instead"
    AFTER = "after"
    CANCEL = "cancel"
    ANSWER_TO = "answer_to"


STEPLESS = frozenset({PlanRole.CANCEL, PlanRole.ANSWER_TO})
"""Roles of plans that hold no steps: they move nothing."""


class StepPlan(Frozen):
    """Do these steps in this order. Emptiness and the cap are judged by `check_plan`."""

    kind: Literal["plan"] = "plan"
    steps: tuple[Step, ...]
    does: PlanRole = PlanRole.NEW
    pace: Literal["slow"] | None = None  # half the planned speeds; never faster than planned
    asked_by: tuple[str, ...] = ()
    """The person's words that ask for each step, in the row of ``list_nodes``; empty: none."""


class AnswerPlan(Frozen):
    """Answer a question; nothing moves."""

    kind: Literal["answer"] = "answer"
    text: Bilingual


class Option(Frozen):
    """Offer one reply to a question: the button's text, and the sentence it stands for."""

    label: Bilingual
    text: str = Field(min_length=1, max_length=2000)
    plan: StepPlan | None = None
    """What is done upon this reply as it stands; None: the sentence is read. No model writes it."""
    is_standing: bool = False
    """The sentence is a standing order, and the plan what it does each time."""


class Clarify(Frozen):
    """Ask the person; nothing moves until a reply is itself understood as a goal."""

    kind: Literal["clarify"] = "clarify"
    code: Code
    question: Bilingual
    options: tuple[Option, ...] = ()


class Refuse(Frozen):
    """Say no, with a code and the reason; nothing moves."""

    kind: Literal["refuse"] = "refuse"
    code: Code
    reason: Bilingual


Plan = Annotated[StepPlan | AnswerPlan | Clarify | Refuse, Field(discriminator="kind")]
PLAN: TypeAdapter[StepPlan | AnswerPlan | Clarify | Refuse] = TypeAdapter(Plan)


def words_of(plan: StepPlan | AnswerPlan | Clarify | Refuse | None) -> Bilingual | None:
    """Return what a plan says to a person; None where it says nothing."""
    match plan:
        case AnswerPlan():
            return plan.text
        case Clarify():
            return plan.question
        case Refuse():
            return plan.reason
        case _:
            return None
