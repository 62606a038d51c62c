"""Ask a brain every sentence of a suite and judge each answer. Plans only: nothing runs.

A sentence is right where its outcome is allowed, its plan is valid in the closed world with every
kind of step, and no step moves to what the sentence does not name.
"""

from __future__ import annotations

import time
from collections.abc import AsyncGenerator, Callable
from dataclasses import dataclass, replace

from planner.brain import BadPlan, Brain, BrainDown, OutOfBudget, ThinkRequest, ThinkResult
from planner.brain.tainted_text import think_warily
from planner.language.catalogue import message
from planner.language.motion_guard.unasked_motion import can_move
from planner.language.place_lists import rejection_outcome
from planner.language.stop import is_stop
from planner.mission.plan_request import unasked_of
from planner.plan import EVERY_KIND, Clarify, Code, Refuse, StepPlan, check_plan, list_nodes
from pons.evals.matchers import Made
from pons.evals.suites import Case, Suite
from pons.evals.world import EvalWorld


@dataclass(frozen=True, slots=True)
class SentenceVerdict:
    """Hold a brain's decision on one sentence, and its faults."""

    case: Case
    made: Made
    fault: str  # empty: allowed
    wrong: tuple[str, ...]  # wrong motions
    seconds: float
    calls: int = 0
    tokens: int = 0
    after_yes: bool | None = None
    """Whether one of the plans offered would have been right; None: nothing was offered, or a model
    would have to be asked."""
    needs_yes: bool | None = None
    """Whether the guard would have a person asked before a model's plan is walked; None: it holds
    no motion, is not valid, or is the grammar's own, which is not held to the guard."""
    no_decision: str = ""
    """``bad_plan``, or why the model did not answer (``timeout`` and the like)."""

    @property
    def right(self) -> bool:
        """Tell whether the outcome is allowed and nothing moves wrongly."""
        return not self.fault and not self.wrong

    @property
    def walked_unasked(self) -> bool:
        """Tell whether a wrong motion would be walked without a person's yes."""
        return bool(self.wrong) and self.needs_yes is not True

    @property
    def explanation(self) -> str:
        """Give the faults, in one line."""
        return "; ".join((*([self.fault] if self.fault else []), *self.wrong))

    @property
    def kind_and_code(self) -> str:
        """Return the decision in a word or two, or the steps of a plan."""
        if isinstance(self.made, StepPlan):
            return " > ".join(_short(step.model_dump()) for step in self.made.steps)
        return f"{self.made.kind} {getattr(self.made, 'code', '')}".strip()


async def score(
    suite: Suite, brain: Brain, clock: Callable[[], float] = time.perf_counter
) -> tuple[SentenceVerdict, ...]:
    """Return a verdict for every sentence, in order.

    Raises:
        OutOfBudget: a model may not be asked any more.
    """
    return tuple([verdict async for verdict in score_each(suite, brain, clock)])


async def score_each(
    suite: Suite, brain: Brain, clock: Callable[[], float] = time.perf_counter
) -> AsyncGenerator[SentenceVerdict]:
    """Yield the verdicts one by one; each sentence of each run is a goal of its own to a budget.

    Raises:
        OutOfBudget: a model may not be asked any more.
    """
    run = time.time_ns()
    for number, case in enumerate(suite.cases):
        goal = f"eval-{run}-{number}-{suite.name}"  # long ids are cut, so a suite's name is last
        yield await _one(case, suite.world, brain, clock, goal)


async def _one(
    case: Case, world: EvalWorld, brain: Brain, clock: Callable[[], float], goal: str
) -> SentenceVerdict:
    asked = request_of(case, world, goal)
    began = clock()
    if is_stop(case.text):  # as at run time: a stop asks no brain
        return judge(case, _no(Code.STOPPED), world, clock() - began)
    try:
        thought = await think_warily(brain, asked)
    except OutOfBudget:
        raise
    except BadPlan as rejected:
        made = _no(Code.BAD_PLAN, why=str(rejected)[:200])
        none = _nothing(case, made, f"no plan: {rejected}", clock() - began, rejected.code)
        return replace(none, calls=rejected.calls, tokens=rejected.tokens)
    except BrainDown as down:
        return _nothing(
            case, _no(Code.MODEL_UNAVAILABLE), f"no answer: {down.why}", clock() - began, down.why
        )
    verdict = judge(case, thought.plan, world, clock() - began, thought.calls, thought.tokens)
    verdict = replace(verdict, needs_yes=_needs_yes(thought, asked))
    options = thought.plan.options if isinstance(thought.plan, Clarify) else ()
    if verdict.right or not options or not thought.by_grammar:
        return verdict
    taken = [
        each.plan or (await brain.think(asked.model_copy(update={"text": each.text}))).plan
        for each in options
    ]
    return replace(verdict, after_yes=any(judge(case, each, world).right for each in taken))


def request_of(case: Case, world: EvalWorld, goal: str) -> ThinkRequest:
    """Return what a brain is asked: the sentence, and what came before it."""
    given = {"text": case.text, "room": world.room, **case.asked}
    return ThinkRequest(vocabulary=world.vocabulary, runnable=EVERY_KIND, goal=goal, **given)


def _needs_yes(thought: ThinkResult, asked: ThinkRequest) -> bool | None:
    """Return the guard's word on a model's valid plan that moves the robot."""
    made = thought.plan
    if thought.by_grammar or not isinstance(made, StepPlan):
        return None
    if check_plan(made, asked.vocabulary, asked.runnable) is not None:
        return None
    if not any(can_move(node.step) for node in list_nodes(made.steps)):
        return None
    return bool(unasked_of(thought, asked))


def _nothing(case: Case, made: Refuse, fault: str, seconds: float, why: str) -> SentenceVerdict:
    """Return the verdict over no decision: a fault under any expectation."""
    return SentenceVerdict(case, made, fault[:200], (), seconds, no_decision=why)


def judge(
    case: Case, made: Made, world: EvalWorld, seconds: float = 0.0, calls: int = 0, tokens: int = 0
) -> SentenceVerdict:
    """Return the verdict over one outcome."""
    rejection = check_plan(made, world.vocabulary, EVERY_KIND)
    if rejection is not None:  # what is rejected never moves
        fault = f"no valid plan: {rejection_outcome(rejection, world.vocabulary).message.en}"
        return SentenceVerdict(case, made, fault, (), seconds, calls, tokens)
    fault = case.wanted.fault(made, case.text, world.vocabulary)
    wrong = (
        case.wanted.wrong(made, case.text, world.vocabulary) if isinstance(made, StepPlan) else ()
    )
    return SentenceVerdict(case, made, fault, wrong, seconds, calls, tokens)


def _short(step: dict[str, object]) -> str:
    return " ".join(str(value) for value in step.values() if value is not None)


def _no(code: Code, **facts: str) -> Refuse:
    return Refuse(code=code, reason=message(code, **facts))
