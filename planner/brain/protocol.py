"""Own what a brain is: one question in, one thought out. Knows no model, no network, no grammar.

A brain may be slow, wrong or gone; what it returns is judged by `planner.plan.validate_plan`.
"""

from __future__ import annotations

from typing import Protocol

from pydantic import Field

from planner.plan import BrainTag, Frozen, Language, Plan, Vocabulary


class ThinkRequest(Frozen):
    """Ask for a plan of one sentence in one closed world."""

    text: str
    vocabulary: Vocabulary
    room: str | None = None  # the id of the room the robot is in, where known
    language: Language | None = None  # as the client said; else told from the text
    goal: str = ""  # the id of the goal that is thought about: what it may cost is counted by it


class Thought(Frozen):
    """Return a plan, which brain made it, and what it cost."""

    plan: Plan
    brain: BrainTag
    calls: int = Field(default=0, ge=0)  # to a model
    tokens: int = Field(default=0, ge=0)  # all that was billed
    prompt_tokens: int = Field(default=0, ge=0)  # of these, what was sent
    reply_tokens: int = Field(default=0, ge=0)  # and what was written


class Brain(Protocol):
    """Turn a request into a thought. Cancelling `think` must take effect at once."""

    @property
    def tag(self) -> BrainTag:
        """Return the brain's name and version, for the goal's record."""
        ...

    async def think(self, request: ThinkRequest) -> Thought:
        """Return the plan of a sentence; nothing has moved when it returns.

        Raises:
            PlanRejected: what the model wrote is no plan, and its repairs are used up.
            BrainDown: the model does not answer in time.
        """
        ...
