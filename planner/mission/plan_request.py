"""Have a brain understand a sentence, judge what it says, and return an event. Trusts no brain."""

from __future__ import annotations

import logging
from functools import lru_cache

from planner.brain.errors import BrainDown, OutOfBudget, PlanRejected
from planner.brain.interface import Brain, ThinkRequest
from planner.brain.tainted_text import think_warily
from planner.language.catalogue import message
from planner.language.object_classes import kind_of
from planner.language.place_lists import rejection_outcome
from planner.mission.draft_events import Hearing
from planner.mission.effects import AskBrain
from planner.mission.events import Planned
from planner.mission.tasks import Think
from planner.plan import BARE, Code, Means, Outcome, Vocabulary, check_plan

log = logging.getLogger(__name__)


def thinker(
    brain: Brain,
    vocabulary: Vocabulary,
    hearing: Hearing | None = None,
    means: Means = BARE,
    classes: tuple[str, ...] = (),
) -> Think:
    """Return how this brain thinks about goals in this closed world; ``hearing`` listens."""

    async def think(ask: AskBrain) -> Planned:
        request = ThinkRequest(
            text=ask.text,
            vocabulary=vocabulary,
            room=ask.room,
            language=ask.language,
            runnable=means.offered,
            blind=means.blind,
            things=things_of(classes) if means.detector else frozenset(),
            goal=ask.id,
            observed=ask.observed,
            replan=ask.replan,
            order=ask.order if ask.exchanges else "",
            exchanges=ask.exchanges,
        )
        try:
            hear = hearing.of(ask.id) if hearing else None
            thought = await think_warily(brain, request, hear)
        except PlanRejected as error:
            log.warning("goal %s: the brain wrote no plan: %s", ask.id, error)
            said = _outcome(Code.BAD_PLAN, why=str(error)[:200])
            return Planned(ask.id, None, said, error.brain or brain.tag)
        except OutOfBudget as error:
            log.warning("goal %s: no call went out: %s", ask.id, error)
            said = Outcome(code=Code.OUT_OF_BUDGET, message=error.said)
            return Planned(ask.id, None, said, error.brain or brain.tag)
        except BrainDown as error:
            log.warning("goal %s: the brain is down: %s", ask.id, error)
            said = _outcome(Code.MODEL_UNAVAILABLE)
            return Planned(ask.id, None, said, error.brain or brain.tag)
        rejection = check_plan(thought.plan, vocabulary, means.runnable, means.blind)
        if rejection is not None:
            return Planned(ask.id, None, rejection_outcome(rejection, vocabulary), thought.brain)
        return Planned(ask.id, thought.plan, None, thought.brain)

    return think


@lru_cache(maxsize=8)
def things_of(classes: tuple[str, ...]) -> frozenset[str]:
    """Return what people call the things that a detector knows, in both languages.

    None while it has not said what it knows: an unknown place is then told as one.
    """
    kinds = [kind_of(label) for label in classes]
    return frozenset(
        name for kind in kinds for name in (kind.en, kind.zh, *kind.also_en, *kind.also_zh)
    )


def _outcome(code: Code, **facts: str) -> Outcome:
    return Outcome(code=code, message=message(code, **facts))
