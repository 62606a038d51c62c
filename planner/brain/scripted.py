"""Answer from a script: the double for tests and demonstrations of brains that misbehave.

Replies are used in order, the last one again and again. A text is judged like a model's: what is
no plan is rejected.
"""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass, field

from pydantic import ValidationError

from planner.brain.errors import BadPlan, BrainConfigError
from planner.brain.interface import ThinkRequest, ThinkResult
from planner.brain.streamed_draft import Draft, Hear
from planner.plan import PLAN, AnswerPlan, BrainTag, Clarify, Refuse, StepPlan, list_nodes

Reply = StepPlan | AnswerPlan | Clarify | Refuse | str | Exception


@dataclass
class ScriptedBrain:
    """Give the next reply of a script: a plan, a model's text, or an error to raise.

    `delay_s` passes before each reply; `hangs` never replies at all. `drafts` are told to who
    listens, before anything else. With `by_grammar` False its plans are held to the order's words,
    as a model's are; a plan without evidence quotes the whole of them, as a fair model may.
    """

    replies: Sequence[Reply]
    delay_s: float = 0.0
    hangs: bool = False
    drafts: Sequence[Draft] = ()
    by_grammar: bool = True
    asked: list[ThinkRequest] = field(default_factory=list)

    def __post_init__(self) -> None:
        if not self.replies and not self.hangs:
            raise BrainConfigError("a scripted brain needs at least one reply; got none")

    @property
    def tag(self) -> BrainTag:
        """Return the double's name."""
        return BrainTag(name="scripted", version="1")

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the next reply of the script.

        Raises:
            BadPlan: the reply is a text that is no plan.
            BrainDown: the script says so.
        """
        self.asked.append(request)
        if hear is not None:
            for draft in self.drafts:
                hear(draft)
        if self.hangs:
            await asyncio.Event().wait()
        await asyncio.sleep(self.delay_s)
        reply = self.replies[min(len(self.asked), len(self.replies)) - 1]
        if isinstance(reply, Exception):
            raise reply
        plan = _parse_reply(reply) if isinstance(reply, str) else reply
        if isinstance(plan, StepPlan) and not plan.asked_by and not self.by_grammar:
            row = list_nodes(plan.steps)
            plan = plan.model_copy(update={"asked_by": (request.text,) * len(row)})
        return ThinkResult(plan=plan, brain=self.tag, calls=1, by_grammar=self.by_grammar)


def _parse_reply(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    try:
        return PLAN.validate_json(text)
    except ValidationError as error:
        first = error.errors()[0]["msg"]
        raise BadPlan(f"the reply is no plan ({first}): {text[:200]!r}") from None
