"""Report the brain in charge: its name, whether a model is asked or rests, its last failure.

What a monitor and the page show; no brain decides by it.
"""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

from planner.brain.fallback import FallbackBrain
from planner.brain.model_error_codes import reason
from planner.plan import Bilingual, Frozen

if TYPE_CHECKING:
    from planner.brain.interface import Brain


class BreakerState(StrEnum):
    """Where the breaker in front of a model stands."""

    CLOSED = "closed"
    """The model is asked."""
    OPEN = "open"
    """The model rests; the offline brain plans."""
    ON_TRIAL = "on_trial"
    """The rest is over; the next answers tell whether the model is believed again."""


class LastError(Frozen):
    """Say why a model was last not believed."""

    code: str
    message: Bilingual


class Mind(Frozen):
    """Show the brain in charge."""

    name: str
    breaker: BreakerState | None = None  # none: no model is set, the offline brain plans alone
    rests_s: float = 0.0  # how much longer the model rests
    loads: bool = False  # an order waits for a model that may still be loading
    last_error: LastError | None = None  # none once the model has answered well


def mind_of(brain: Brain) -> Mind:
    """Return the brain in charge now."""
    if not isinstance(brain, FallbackBrain):
        return Mind(name=brain.tag.name)
    why, rests_s = brain.last_failure, brain.rests_s()
    return Mind(
        name=brain.tag.name,
        breaker=_state(closed=brain.breaker.is_closed, rests_s=rests_s),
        rests_s=round(rests_s, 1),
        loads=brain.loads,
        last_error=None if why is None else LastError(code=why, message=reason(why)),
    )


def _state(*, closed: bool, rests_s: float) -> BreakerState:
    if closed:
        return BreakerState.CLOSED
    return BreakerState.OPEN if rests_s > 0.0 else BreakerState.ON_TRIAL
