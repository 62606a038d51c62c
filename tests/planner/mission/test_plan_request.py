"""Check that what a brain says, or fails to say, becomes the right event, with the right brain."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain import BrainDown, FallbackBrain, OfflineBrain, OutOfBudget, ScriptedBrain
from planner.brain.scripted import Reply
from planner.brain.situation import RecentGoal, Situation
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


@pytest.mark.parametrize(
    ("outcome", "told", "minutes", "waits"),
    [
        ("recalled", "I saw a red cup in the kitchen.", 1, False),
        ("answered", "There is one in the kitchen.", 1, True),
        ("recalled", "I saw a red cup in the kitchen.", 31, True),
    ],
)
def test_it_is_what_the_robot_itself_found_a_short_while_ago(
    outcome: str, told: str, minutes: int, waits: bool
) -> None:
    """A model's own answer names no place that "it" may then lead to."""
    recent = RecentGoal(order="where is it?", outcome=outcome, told=told, minutes=minutes)
    ask = AskBrain("g1", "go to it", Language.EN, situation=Situation(recent=(recent,)))
    made = StepPlan(steps=(GoTo(place="kitchen"),), asked_by=("go to it",))
    event = asyncio.run(_think(ScriptedBrain([made], by_grammar=False), ask))
    assert event.unasked == ((0,) if waits else ())
