"""Give goals to a model with a fault of the mock's, and see that no bad plan is walked.

The whole way of a thought, in process: endpoint client, judge, fallback, validation, and the
mission's own reducer, which alone can ask for a way. A plan of the model's counts as invalid where
there is none to be had behind the fault; the offline brain's plans, which it may fall back on, are
its own and carry its name. The mock runs in a process of its own, over real sockets.
"""

from __future__ import annotations

import asyncio
from collections import Counter
from functools import cache
from typing import TYPE_CHECKING

from planner.brain import FallbackBrain, OfflineBrain
from planner.brain.endpoint import EndpointBrain
from planner.mission import AskBrain, MissionState, Planned, Submitted, advance
from planner.mission.plan_request import Hearing, thinker
from planner.plan import DRIVES, Language, StepPlan, Vocabulary, check_plan, list_nodes
from planner.settings import ModelSettings
from planner.site import Site
from planner.site.site_view import facts_of, vocabulary_of
from pons.settings import CHECKOUT
from tests.pons.mock_llm.faults import READABLE

if TYPE_CHECKING:
    from pathlib import Path

    from planner.brain import Brain
    from planner.mission import Think
    from planner.plan import Step

PARALLEL = 10
SLOW_S = 0.5
"""The deadline where a fault is to run into it; the least that settings allow."""
ENOUGH_S = 10.0
SLOW = frozenset({"hang", "drip"})
ORDERS = (
    ("go to the kitchen", Language.EN),
    ("first go to the living room, then the kitchen, wait ten seconds and come back", Language.EN),
    ("去客厅，然后去厨房", Language.ZH),
    ("turn around and go to the sofa", Language.EN),
    ("回家", Language.ZH),
)


async def try_fault(url: str, home: Path, fault: str, goals: int) -> Counter[str]:
    """Count what became of goals given to a mock that has this fault."""
    timeout_s = SLOW_S if fault in SLOW else ENOUGH_S
    settings = ModelSettings(url=url, name=fault, timeout_s=timeout_s, parallel=PARALLEL)
    model = EndpointBrain(settings, home)
    site = _home()
    trial = _Trial(fault, vocabulary_of(site), MissionState(facts_of(site)))
    try:
        for brain in (model, FallbackBrain(model, OfflineBrain(), rest_s=0.5)):
            await trial.give(brain, goals)
    finally:
        await model.close()
    return trial.counts


@cache
def _home() -> Site:
    """Read the site once for all faults: it is frozen."""
    return Site.load(CHECKOUT / "sites" / "home")


class _Trial:
    """Count what becomes of goals under one fault."""

    def __init__(self, fault: str, vocabulary: Vocabulary, book: MissionState) -> None:
        self.counts: Counter[str] = Counter()
        self._fault, self._vocabulary, self._book = fault, vocabulary, book
        self._hearing = Hearing(lambda _event: None, self._expect)

    async def give(self, brain: Brain, goals: int) -> None:
        """Give the goals, ten at a time."""
        turns = asyncio.Semaphore(PARALLEL)
        think = thinker(brain, self._vocabulary, self._hearing)
        await asyncio.gather(*(self._one(think, number, turns) for number in range(goals)))

    async def _one(self, think: Think, number: int, turns: asyncio.Semaphore) -> None:
        text, language = ORDERS[number % len(ORDERS)]
        self.counts["goals"] += 1
        try:
            async with turns:
                planned = await think(AskBrain(f"g{number}", text, language))
            self._judge(planned, text, language)
        except Exception as error:  # noqa: BLE001  # a crash of any kind is what is counted
            print(f"{self._fault}: {type(error).__name__}: {error}")
            self.counts["crashed"] += 1

    def _judge(self, planned: Planned, text: str, language: Language) -> None:
        plan, brain = planned.plan, planned.brain
        by_model = brain is not None and brain.name == self._fault
        if not isinstance(plan, StepPlan):
            self.counts["nothing"] += 1
        else:
            self.counts["model" if by_model else "offline"] += 1
            drives = any(node.step.kind in DRIVES for node in list_nodes(plan.steps))
            wrong = check_plan(plan, self._vocabulary) is not None
            if drives and (wrong or (by_model and self._fault not in READABLE)):
                self.counts["invalid"] += 1
        if self._moves(planned, text, language) and not isinstance(plan, StepPlan):
            self.counts["invalid"] += 1

    def _moves(self, planned: Planned, text: str, language: Language) -> bool:
        """Tell whether the mission's reducer makes a goal of this answer that would drive."""
        book, _ = advance(self._book, Submitted(planned.id, text, language), 0.0)
        book, _ = advance(book, planned, 0.0)
        return any(step.kind in DRIVES for step in book.missions[planned.id].steps)

    def _expect(self, steps: tuple[Step, ...]) -> None:
        """Take what would be routed ahead: none of it may be outside of the closed world."""
        if steps and check_plan(StepPlan(steps=steps), self._vocabulary) is not None:
            self.counts["invalid"] += 1
