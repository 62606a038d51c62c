"""Name the reply that a model is to fill in: the schema's name, the forced tool's, a hint."""

from __future__ import annotations

from dataclasses import dataclass

from planner.brain.schema import NAME


@dataclass(frozen=True, slots=True)
class ReplyForm:
    """Name one kind of reply."""

    name: str
    told: str
    """What the forced tool is for."""
    prompt_has_schema: bool = True
    """Else the schema's text is added where nothing but the prompt tells it."""


PLAN_FORM = ReplyForm(
    NAME, "Reply to the order with one plan, answer, question or refusal.", prompt_has_schema=False
)
LOOK_FORM = ReplyForm("look", "Answer the question about the picture.")
POINT_FORM = ReplyForm("point", "Point at one thing in the picture, or say that it is not there.")
SEEK_FORM = ReplyForm("seek", "Say whether one kind of thing is in the picture, and how many.")
