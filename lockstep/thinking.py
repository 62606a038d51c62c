"""Have a brain think within one tick. A brain that waits for anything outside does not fit here."""

from __future__ import annotations

from collections.abc import Coroutine
from typing import TYPE_CHECKING, Any, TypeVar

from planner.brain import BrainDown, PlanRejected, ThinkRequest
from planner.mission.events import Planned
from planner.plan import Code, Outcome, Rejection, message, validate_plan

if TYPE_CHECKING:
    from planner.brain import Brain
    from planner.mission.effects import AskBrain
    from planner.plan import Vocabulary

T = TypeVar("T")

MAX_YIELDS = 100


class NotAtOnce(Exception):
    """A coroutine waited for something that does not exist on a simulated clock."""


def at_once(coroutine: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine to its end without an event loop; bare yields are allowed.

    Raises:
        NotAtOnce: it waits for a timer, a socket or a task.
    """
    try:
        for _ in range(MAX_YIELDS):
            waited_for = coroutine.send(None)
            if waited_for is not None:
                break
    except StopIteration as done:
        result: T = done.value
        return result
    coroutine.close()
    raise NotAtOnce("the brain waits; in lockstep give its delay as Pace(brain=…) instead")


def planned(brain: Brain, vocabulary: Vocabulary, ask: AskBrain) -> Planned:
    """Ask the brain and judge its plan, as the planner's runner does."""
    request = ThinkRequest(
        text=ask.text,
        vocabulary=vocabulary,
        room=ask.room,
        language=ask.language,
    )
    try:
        thought = at_once(brain.think(request))
    except PlanRejected as error:
        return Planned(ask.id, None, _outcome(Code.BAD_PLAN, why=str(error)))
    except BrainDown:
        return Planned(ask.id, None, _outcome(Code.MODEL_UNAVAILABLE))
    judged = validate_plan(thought.plan, vocabulary)
    if isinstance(judged, Rejection):
        return Planned(ask.id, None, judged.outcome, thought.brain)
    return Planned(ask.id, judged, brain=thought.brain)


def _outcome(code: Code, **facts: str) -> Outcome:
    return Outcome(code=code, message=message(code, **facts))
