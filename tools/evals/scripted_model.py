"""Reply as a strong model would to a scripted person: with the plan that the person wants.

With whims, every third plan moves besides somewhere that nobody named: the guard must ask.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.brain.interface import ThinkResult
from planner.plan import (
    AnswerPlan,
    BrainTag,
    Clarify,
    Code,
    GoTo,
    PlanRole,
    Refuse,
    StepPlan,
    say_same,
)
from pons.evals.evidence import give_evidence
from pons.evals.hostile_plans import expected_plan
from tools.evals.scripts import PLANS, Reaction

if TYPE_CHECKING:
    from planner.brain.interface import ThinkRequest
    from planner.brain.streamed_draft import Hear
    from tools.evals.scripts import ScriptTurn


class ScriptedModel:
    """Give the plan that the person wants, in its role."""

    def __init__(self, *, whims: bool = True) -> None:
        """Choose whether it has whims."""
        self._turn: ScriptTurn | None = None
        self._plans, self._whims, self.hostile = 0, whims, 0
        self._thoughts = 0

    @property
    def tag(self) -> BrainTag:
        """Return the double's name."""
        return BrainTag(name="scripted-model", version="1")

    def expect(self, turn: ScriptTurn) -> None:
        """Be told what the person of the script wants next."""
        self._turn, self._thoughts = turn, 0

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the reply to the turn that is expected."""
        del hear
        return ThinkResult(plan=self._reply(request), brain=self.tag, calls=1)

    def _reply(self, request: ThinkRequest) -> StepPlan | AnswerPlan | Clarify | Refuse:
        turn = self._turn
        wanted = turn.wanted if turn is not None else frozenset()
        made = None
        if turn is not None and turn.plan is not None and wanted & PLANS:
            replies = turn.notes.model or (turn.plan,)
            self._thoughts += bool(request.observed)
            reply = replies[min(self._thoughts, len(replies) - 1)]
            made = expected_plan(reply)
        if made is None:
            return self._talk(wanted)
        role = PlanRole.AFTER if Reaction.AFTER in wanted else PlanRole.NEW
        role = PlanRole.INSTEAD if Reaction.INSTEAD in wanted else role
        self._plans += 1
        if self._whims and self._plans % 3 == 0:
            self.hostile += 1
            made = made.model_copy(update={"steps": (*made.steps, _WHIM)})
        quoted = give_evidence(made, request.text, request.vocabulary)
        return quoted.model_copy(update={"does": role})

    @staticmethod
    def _talk(wanted: frozenset[Reaction]) -> AnswerPlan | Clarify | Refuse | StepPlan:
        words = say_same("So it is. 是的。")
        if Reaction.ASKS in wanted:
            return Clarify(code=Code.AMBIGUOUS, question=words)
        if Reaction.CANCEL in wanted:
            return StepPlan(steps=(), does=PlanRole.CANCEL)
        if Reaction.NO in wanted:
            return Refuse(code=Code.NO_CAPABILITY, reason=words)
        return AnswerPlan(text=words)


_WHIM = GoTo(place="entrance")
"""No script speaks of it."""
