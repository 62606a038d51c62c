"""Have the other model think about each recorded sentence, and say how its decision differs.

One goal of the home's budget: the day's limits hold, and what it cost is counted with the rest.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from planner.brain import Brain, BrainDown, OutOfBudget, PlanRejected, ThinkRequest
from planner.brain.endpoint import EndpointBrain
from planner.budget import Ledger, Purse
from planner.mission.site_view import vocabulary_of
from planner.plan import Rejection, StepPlan, plan_record, validate_plan
from planner.settings import BudgetSettings, GoalLimits, ModelSettings, Settings
from planner.site import Site
from pons.evals.journal.compare import Difference, difference, told
from pons.evals.journal.drive import MOTION, Driven
from pons.evals.journal.recorded import Decision

CALLS_EACH = 2
"""A call and its repair."""
PROBES = 8
"""Calls more, in which a server that is met for the first time may refuse a way of asking."""
MOST_TOKENS = 100_000_000
GOAL = "replay"


@dataclass(frozen=True, slots=True)
class Again:
    """Hold one sentence thought about twice."""

    decision: Decision
    relation: str
    """``same``, ``words``, ``differs``, or ``none``: the model gave no plan."""
    made: str
    """What the model decided, in a line, or why it decided nothing."""
    refused: str = ""
    """Code of the validation that would have refused the plan, so that nothing had moved."""
    plan: StepPlan | None = None
    """A valid plan of motion that differs: what could be driven."""
    driven: Driven | None = None


@dataclass(frozen=True, slots=True)
class Spending:
    """Say what the thinking cost."""

    calls: int
    prompt_tokens: int
    reply_tokens: int
    money: float
    left: int
    """Sentences not thought about: the budget was up."""


def most_calls(sentences: int) -> int:
    """Return the calls that so many sentences may cost: what is promised is what is allowed."""
    return CALLS_EACH * sentences + PROBES


async def think_again(
    decisions: Sequence[Decision],
    site: Site,
    settings: Settings,
    model: ModelSettings,
    home: Path,
    tell: Callable[[int], None] = lambda _: None,
) -> tuple[list[Again], Spending]:
    """Return each sentence's second decision, and the bill.

    Raises:
        Misconfigured: the model may not be asked, or the budget can't be read.
    """
    budget = BudgetSettings(
        goal=GoalLimits(
            calls=most_calls(len(decisions)),
            prompt_tokens=MOST_TOKENS,
            reply_tokens=MOST_TOKENS,
            seconds=1e6,
        ),
        day=settings.budget.day,
        price=settings.budget.price,
    )
    goal, found = f"{GOAL}-{time.time_ns()}", list[Again]()
    purse = Purse(budget, Ledger(home), model=model.name, most_reply=model.max_tokens)
    try:
        with TemporaryDirectory(prefix="pons-replay-") as folder:
            brain = EndpointBrain(model, Path(folder), meter=purse)
            try:
                for number, decision in enumerate(decisions):
                    tell(number)
                    found.append(await _again(brain, decision, site, goal))
            except OutOfBudget:
                pass
            finally:
                await brain.close()
        spent = purse.usage(goal).goal
    finally:
        purse.close()
    left = len(decisions) - len(found)
    if spent is None:
        return found, Spending(0, 0, 0, 0.0, left)
    return found, Spending(spent.calls, spent.prompt_tokens, spent.reply_tokens, spent.money, left)


async def _again(brain: Brain, decision: Decision, site: Site, goal: str) -> Again:
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
        return Again(decision, "none", f"no answer: {down.why}")
    except PlanRejected as rejected:
        return Again(decision, "none", f"no plan: {rejected}"[:200])
    record = plan_record(plan)
    relation = difference(decision.plan, record)
    again = Again(decision, relation.value, told(record))
    judged = validate_plan(plan, vocabulary)
    if isinstance(judged, Rejection):
        return replace(again, refused=judged.first.code.value)
    moves = isinstance(plan, StepPlan) and any(step.kind in MOTION for step in plan.steps)
    if relation is Difference.DIFFERS and isinstance(plan, StepPlan) and moves:
        return replace(again, plan=plan)
    return again
