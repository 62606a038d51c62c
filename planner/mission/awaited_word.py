"""Say what a goal waits for from a person. Pure."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

from planner.brain.interface import OFFLINE
from planner.language.folding import fold_words
from planner.language.stop import is_stop
from planner.plan import GoalState, StepState

if TYPE_CHECKING:
    from planner.mission.state import Mission, MissionState

WAITS = frozenset({GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION})
_MARKS = " .,!?;~…。，！？；"


class AwaitedWord(StrEnum):
    """Name what a goal waits for from a person."""

    STEP = "the answer to a question of one of its own steps"
    PLAN = "a yes to its plan"
    OFFER = "a yes to the one order that a brain's question offers"
    CHOICE = "one of several orders that a brain's question offers"
    ORDER = "a brain's question about the order, which offers none"
    FREELY = "whatever is answered: a model asks about the order, offers none and reads it"


ABOUT_ORDER = frozenset(
    {AwaitedWord.OFFER, AwaitedWord.CHOICE, AwaitedWord.ORDER, AwaitedWord.FREELY}
)
TAKES_YES = frozenset({AwaitedWord.STEP, AwaitedWord.PLAN, AwaitedWord.OFFER})
"""A plain yes or no answers these."""


def wait_of(mission: Mission) -> AwaitedWord | None:
    """Return what a goal waits for from a person; None: for nothing.

    An order to stop is no offer: it is taken from a person's own words alone.
    """
    step, plan, brain = mission.current_step, mission.plan, mission.brain
    if mission.state not in WAITS:
        return None
    if mission.state is GoalState.AWAITING_CONFIRMATION:
        return AwaitedWord.PLAN
    if step is not None and step.state is StepState.RUNNING:
        return AwaitedWord.STEP
    options = () if plan is None else plan.options
    if len(options) > 1:
        return AwaitedWord.CHOICE
    if options:
        return AwaitedWord.ORDER if is_stop(options[0].text) else AwaitedWord.OFFER
    model = plan is not None and brain is not None and brain.name != OFFLINE
    return AwaitedWord.FREELY if model else AwaitedWord.ORDER


def find_offer(mission: Mission) -> str | None:
    """Return the one order that a brain's question offers; None where it offers none or several."""
    plan = mission.plan if wait_of(mission) is AwaitedWord.OFFER else None
    return None if plan is None else plan.options[0].text


def list_waiting(book: MissionState, besides: str = "") -> tuple[Mission, ...]:
    """Return the goals that wait for a person's word, besides one."""
    return tuple(book.goals_in(*WAITS, besides=besides))


def awaits(mission: Mission, text: str) -> bool:
    """Tell whether a sentence is the very word that a goal's step waits for."""
    step = mission.current_step if wait_of(mission) is AwaitedWord.STEP else None
    word = None if step is None else step.word
    return word is not None and fold_words(text).strip(_MARKS) == fold_words(word).strip(_MARKS)
