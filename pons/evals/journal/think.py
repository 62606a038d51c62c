"""Have the other model think about each recorded sentence, and say how its decision differs.

Steps are compared by what they do. The words of an answer, a question or a ``say`` may differ
without the robot doing anything else, so that counts apart. All of it is one goal of the home's
budget: the day's limits hold, and what it cost is counted with the rest.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from planner.brain import BadPlan, Brain, BrainDown, OutOfBudget, ThinkRequest
from planner.brain.endpoint import EndpointBrain
from planner.plan import PlanRecord, StepRecord, check_plan, plan_record
from planner.settings import GoalLimits, ModelSettings, Settings
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons.evals.journal.recorded import RecordedDecision
from pons.evals.model_access import Spending, open_purse, spending_of

CALLS_EACH = 2
"""A call and its repair."""
PROBES = 8
"""Calls more, in which a server that is met for the first time may refuse a way of asking."""
MOST_TOKENS = 100_000_000
GOAL = "replay"
MOTION = frozenset(
    {"go_to", "stand_at", "patrol", "turn", "move", "come_back", "return_home", "explore"}
)


class Difference(StrEnum):
    """How two decisions relate."""

    SAME = "same"
    WORDS = "words"
    """The same acts and codes, other words."""
    DIFFERS = "differs"


@dataclass(frozen=True, slots=True)
class SecondThought:
    """Hold one sentence thought about twice."""

    decision: RecordedDecision
    relation: str
    """``same``, ``words``, ``differs``, or ``none``: the model gave no plan."""
    made: str
    """What the model decided, in a line, or why it decided nothing."""
    refused: str = ""
    """Code of the validation that would have refused the plan, so that nothing had moved."""
    moves: bool = False
    """It is valid, differs, and moves the robot."""


def most_calls(sentences: int) -> int:
    """Return the calls that so many sentences may cost: the promise is the limit."""
    return CALLS_EACH * sentences + PROBES


async def think_again(
    decisions: Sequence[RecordedDecision],
    site: Site,
    settings: Settings,
    model: ModelSettings,
    home: Path,
) -> tuple[list[SecondThought], Spending]:
    """Return each sentence's second decision, and the bill.

    Raises:
        ConfigError: the model may not be asked, or the budget can't be read.
    """
    limits = GoalLimits(
        calls=most_calls(len(decisions)),
        prompt_tokens=MOST_TOKENS,
        reply_tokens=MOST_TOKENS,
        seconds=1e6,
    )
    goal, found = f"{GOAL}-{time.time_ns()}", list[SecondThought]()
    with open_purse(settings, model, home, limits) as (purse, folder):
        brain = EndpointBrain(model, folder, meter=purse)
        try:
            for decision in decisions:
                found.append(await _think_again(brain, decision, site, goal))
        except OutOfBudget:
            pass
        finally:
            await brain.close()
        return found, spending_of(purse, goal)


async def _think_again(
    brain: Brain, decision: RecordedDecision, site: Site, goal: str
) -> SecondThought:
    vocabulary = vocabulary_of(site)
    room = None if decision.start is None else site.room_at(*decision.start[:2])
    request = ThinkRequest(
        text=decision.text,
        vocabulary=vocabulary,
        room=None if room is None else room.id,
        language=decision.language,
        goal=goal,
        order=decision.order if decision.exchanges else "",
        exchanges=decision.exchanges,
    )
    try:
        plan = (await brain.think(request)).plan
    except OutOfBudget:
        raise
    except BrainDown as down:
        return SecondThought(decision, "none", f"no answer: {down.why}")
    except BadPlan as rejected:
        return SecondThought(decision, "none", f"no plan: {rejected}"[:200])
    record = plan_record(plan)
    relation = difference(decision.plan, record)
    again = SecondThought(decision, relation.value, plan_line(record))
    rejection = check_plan(plan, vocabulary)
    if rejection is not None:
        return replace(again, refused=rejection.first.code.value)
    moves = any(step.kind in MOTION for step in record.steps)
    return replace(again, moves=moves and relation is Difference.DIFFERS)


_NUMBERS = ("seconds", "angle_rad", "distance_m")


def difference(one: PlanRecord, other: PlanRecord) -> Difference:
    """Return how two plans relate."""
    if _deed(one) != _deed(other):
        return Difference.DIFFERS
    return Difference.SAME if _words(one) == _words(other) else Difference.WORDS


def _deed(plan: PlanRecord) -> tuple[object, ...]:
    code = plan.code.value if plan.code is not None else ""
    return (plan.kind, code, *map(_act, plan.steps))


def _words(plan: PlanRecord) -> tuple[object, ...]:
    said = (plan.text.en, plan.text.zh) if plan.text is not None else ()
    return (*said, *(step.text for step in plan.steps))


def plan_line(plan: PlanRecord) -> str:
    """Return a plan in a line."""
    if plan.kind != "plan":
        return f"{plan.kind} {plan.code.value if plan.code is not None else ''}".strip()
    return " > ".join(_step(step) for step in plan.steps)


def _act(step: StepRecord) -> tuple[object, ...]:
    numbers = (None if (n := getattr(step, name)) is None else round(n, 2) for name in _NUMBERS)
    return (step.kind, step.place, step.places, step.object, *numbers)


def _step(step: StepRecord) -> str:
    numbers = (f"{n:g}" for name in _NUMBERS if (n := getattr(step, name)) is not None)
    named = (step.place, *step.places, step.object, *numbers)
    return " ".join([step.kind, *(word for word in named if word)])
