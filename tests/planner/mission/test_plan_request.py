"""Check that what a brain says, or fails to say, becomes the right event, with the right brain."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain import BrainDown, FallbackBrain, OfflineBrain, OutOfBudget, ScriptedBrain
from planner.brain.scripted import Reply
from planner.mission import AskBrain, Planned
from planner.mission.plan_request import thinker
from planner.plan import Code, GoTo, Language, StepPlan, say_same
from tests.planner.brain.conftest import HOME

NOWHERE = StepPlan(steps=(GoTo(place="wine_cellar"),))
DOWN = BrainDown("gone", why="timeout")


def planned(brain: ScriptedBrain | FallbackBrain, text: str) -> Planned:
    ask = AskBrain("g1", text, Language.EN)
    return asyncio.run(_think(brain, ask))


async def _think(brain: ScriptedBrain | FallbackBrain, ask: AskBrain) -> Planned:
    return await thinker(brain, HOME)(ask)


@pytest.mark.parametrize(
    ("reply", "code"),
    [
        (NOWHERE, Code.UNKNOWN_PLACE),
        ("no json", Code.BAD_PLAN),
        (DOWN, Code.MODEL_UNAVAILABLE),
        (OutOfBudget("spent", say_same("8 of 8 calls")), Code.OUT_OF_BUDGET),
    ],
)
def test_a_brain_that_fails_gives_an_outcome_and_no_plan(reply: Reply, code: Code) -> None:
    event = planned(ScriptedBrain([reply]), "go to the kitchen")
    assert event.plan is None
    assert event.failure is not None
    assert (event.failure.code, event.brain and event.brain.name) == (code, "scripted")


def test_the_event_names_the_brain_that_thought_last() -> None:
    both = FallbackBrain(ScriptedBrain([DOWN]), OfflineBrain())
    event = planned(both, "go to the kitchen")
    assert event.plan == StepPlan(steps=(GoTo(place="kitchen"),))
    assert event.brain is not None
    assert (event.brain.name, event.brain.fallback_reason) == ("offline", "timeout")
    lost = planned(both, "colourless green ideas")
    assert lost.failure is not None
    assert lost.failure.code is Code.MODEL_UNAVAILABLE
    assert lost.brain is not None
    assert lost.brain.fallback_from == "scripted"
