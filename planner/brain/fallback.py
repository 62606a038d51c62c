"""Ask the model; where it fails, answer by the offline brain, visibly.

The thought then carries the offline brain's tag with the model's name and the reason. What the
offline brain can't do alone ends typed: the model is unavailable, or wrote no usable plan.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from planner.brain.circuit_breaker import FIRST_REST_S, Breaker
from planner.brain.errors import BadPlan, BrainDown, OutOfBudget, StillLoading
from planner.brain.interface import Brain, ThinkRequest, ThinkResult
from planner.brain.model_error_codes import tell_failure
from planner.brain.streamed_draft import Draft, Hear
from planner.language.grammar.sentence_text import refuse_bad_text
from planner.plan import AnswerPlan, BrainTag, Clarify, Code, Refuse, StepPlan, holds_call

log = logging.getLogger(__name__)

HOPELESS = frozenset({"bad_key", "unknown_model", "redirect", "refused_address"})
"""Only the owner can mend these."""


class FallbackBrain:
    """Think with a model, and without it where it fails."""

    def __init__(
        self,
        model: Brain,
        offline: Brain,
        clock: Callable[[], float] = time.monotonic,
        rest_s: float = FIRST_REST_S,
    ) -> None:
        self._model, self._offline, self._clock = model, offline, clock
        self.breaker = Breaker(first_rest_s=rest_s)
        self.last_failure: str | None = None
        """Why the model was last not believed; None once it answered."""
        self.loads = False
        """A thought waits for the first word of a server that may be loading its model."""

    @property
    def tag(self) -> BrainTag:
        """Return the model's name."""
        return self._model.tag

    def rests_s(self) -> float:
        """Return how much longer the model rests [s]; 0 where it may be asked."""
        return self.breaker.rests_s(self._clock())

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the model's thought, else the offline brain's.

        Raises:
            BrainDown: the model is down and the offline brain does not understand the sentence.
            OutOfBudget: the same, but the model was not asked.
            BadPlan: the model wrote no plan and neither does the offline brain.
        """
        if refuse_bad_text(request.text) is not None:  # no model is paid to read what is no text
            return await self._offline.think(request)
        if request.vocabulary.skills and not (request.observed or request.exchanges):
            own = await self._offline.think(request)  # by its own words: no model is asked
            if isinstance(own.plan, StepPlan) and holds_call(own.plan.steps):
                return own
        if not self.breaker.lets(self._clock()):
            rests_s = self.breaker.rests_s(self._clock())
            return await self._instead(request, BrainDown(f"{rests_s:.0f} s more", why="resting"))
        try:
            thought = await self._ask_model(request, hear)
        except OutOfBudget as spent:  # no call went out: no word about the model
            self.last_failure = spent.why
            self.breaker.note_cancel()
            return await self._instead(request, spent)
        except StillLoading as cold:  # no word about the model, either
            self.last_failure = cold.why
            self.breaker.note_cancel()
            return await self._instead(request, cold)
        except BrainDown as down:
            self.last_failure = down.why
            self.breaker.note_failure(self._clock(), hopeless=down.why in HOPELESS)
            return await self._instead(request, down)
        except BadPlan as rejected:
            # It answers: what it writes is judged anew each time.
            self.last_failure = rejected.code
            self.breaker.note_success()
            return await self._instead(request, rejected)
        except BaseException:  # cancelled, or a fault of ours: no word about the model
            self.breaker.note_cancel()
            raise
        self.last_failure = None
        self.breaker.note_success()
        return thought

    async def _ask_model(self, request: ThinkRequest, hear: Hear | None) -> ThinkResult:
        """Return the model's thought; one that loads is waited for where the grammar is not sure.

        Raises:
            StillLoading: it loads, and the offline brain has read the sentence surely.
        """
        try:
            return await self._model.think(request, hear and self._note_load(hear))
        except StillLoading as cold:
            known = (await self._offline.think(request)).plan
            if isinstance(known, StepPlan | AnswerPlan | Refuse):
                cold.drop()
                raise
            thought: ThinkResult = await cold.later()
            return thought
        finally:
            self.loads = False

    def _note_load(self, hear: Hear) -> Hear:
        def note(draft: Draft, /) -> None:
            self.loads = draft.loads
            hear(draft)

        return note

    async def _instead(self, request: ThinkRequest, failure: BrainDown | BadPlan) -> ThinkResult:
        why = failure.why if isinstance(failure, BrainDown) else failure.code
        server = failure.server if isinstance(failure, BrainDown) else ""
        log.warning("%s: %s (%s); the offline brain answers", self.tag.name, why, failure)
        thought = await self._offline.think(request)
        tag = thought.brain.model_copy(
            update={
                "fallback_from": self.tag.name,
                "fallback_reason": why,
                "fallback_message": failure.said
                if isinstance(failure, OutOfBudget)
                else tell_failure(why, server),
            }
        )
        if _is_lost(thought) and isinstance(failure, OutOfBudget):
            raise OutOfBudget(str(failure), failure.said, tag) from failure
        if _is_lost(thought) and isinstance(failure, BrainDown):
            raise BrainDown(str(failure), tag, why=why, server=server) from failure
        if _is_lost(thought):
            raise BadPlan(str(failure), tag, code=failure.code) from failure
        return thought.model_copy(update={"brain": tag})


def _is_lost(thought: ThinkResult) -> bool:
    """Tell whether the offline brain understood nothing, and has nothing to offer."""
    plan = thought.plan
    unread = isinstance(plan, Clarify | Refuse) and plan.code is Code.NOT_UNDERSTOOD
    return unread and not getattr(plan, "options", ())
