"""What a brain says, or fails to say, becomes the right event, with the right brain."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.brain import BrainDown, FallbackBrain, OfflineBrain, OutOfBudget, ScriptedBrain
from planner.brain.interface import Brain
from planner.brain.scripted import Reply
from planner.brain.situation import RecentGoal, Situation
from planner.mission.effects import AskBrain
from planner.mission.events import Planned, Submitted
from planner.mission.plan_request import thinker
from planner.mission.reducer import advance
from planner.plan import (
    Clarify,
    Code,
    ComeBack,
    GoalState,
    GoTo,
    Language,
    Means,
    StepPlan,
    say_same,
)
from planner.site.site_view import vocabulary_of
from tests.planner.brain.conftest import HOME
from tests.planner.mission.leaning import NOW_S, SITE, heard, order_done
from tests.planner.mission.lockstep import Together, go
from wire import Pose2

NOWHERE = StepPlan(steps=(GoTo(place="wine_cellar"),))
DOWN = BrainDown("gone", why="timeout")
BEDROOM = order_done("go to the bedroom")
GO = '{"kind":"plan","steps":[{"kind":"go_to","place":"bedroom"}]}'
ELSEWHERE = '{"kind":"plan","steps":[{"kind":"go_to","place":"kitchen"}]}'


async def planned(brain: Brain, text: str) -> Planned:
    return await thinker(brain, HOME)(AskBrain("g1", text, Language.EN))


async def think_of(said: str, brain: Brain) -> Planned:
    """Return what comes of a sentence behind a drive to the bedroom."""
    _, effects = advance(BEDROOM, heard(BEDROOM, said).given, NOW_S)
    [ask] = [each for each in effects if isinstance(each, AskBrain)]
    return await thinker(brain, vocabulary_of(SITE), None, Means(camera=True, detector=True))(ask)


@pytest.mark.parametrize(
    ("reply", "code"),
    [
        (NOWHERE, Code.UNKNOWN_PLACE),
        ("no json", Code.BAD_PLAN),
        (DOWN, Code.MODEL_UNAVAILABLE),
        (OutOfBudget("spent", say_same("8 of 8 calls")), Code.OUT_OF_BUDGET),
    ],
)
async def test_a_brain_that_fails_gives_an_outcome_and_no_plan(reply: Reply, code: Code) -> None:
    event = await planned(ScriptedBrain([reply]), "go to the kitchen")
    assert event.plan is None
    assert event.failure is not None
    assert (event.failure.code, event.brain and event.brain.name) == (code, "scripted")


async def test_the_event_names_the_brain_that_thought_last() -> None:
    both = FallbackBrain(ScriptedBrain([DOWN]), OfflineBrain())
    event = await planned(both, "go to the kitchen")
    assert event.plan == StepPlan(steps=(GoTo(place="kitchen"),))
    assert event.brain is not None
    assert (event.brain.name, event.brain.fallback_reason) == ("offline", "timeout")
    lost = await planned(both, "colourless green ideas")
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
async def test_it_is_what_the_robot_itself_found_a_short_while_ago(
    outcome: str, told: str, minutes: int, waits: bool
) -> None:
    """A model's own answer names no place that "it" may then lead to."""
    recent = RecentGoal(order="where is it?", outcome=outcome, told=told, minutes=minutes)
    ask = AskBrain("g1", "go to it", Language.EN, situation=Situation(recent=(recent,)))
    made = StepPlan(steps=(GoTo(place="kitchen"),), asked_by=("go to it",))
    event = await thinker(ScriptedBrain([made], by_grammar=False), HOME)(ask)
    assert event.unasked == ((0,) if waits else ())


@pytest.mark.parametrize("said", ["again", "再来一次"])
async def test_a_model_gets_the_words_as_they_were_said_and_again_needs_no_yes(said: str) -> None:
    model = ScriptedBrain([GO], by_grammar=False)
    event = await think_of(said, model)
    assert [each.text for each in model.asked] == [said]
    assert event.plan == StepPlan(steps=(GoTo(place="bedroom"),), asked_by=(said,))
    assert event.unasked == ()


async def test_a_step_beside_the_change_waits_for_a_yes() -> None:
    event = await think_of("again", ScriptedBrain([ELSEWHERE], by_grammar=False))
    assert event.unasked == (0,)


@pytest.mark.parametrize("said", ["no, the study", "不对，书房"])
async def test_where_a_model_fails_the_built_in_brain_plans_the_change(said: str) -> None:
    brain = FallbackBrain(ScriptedBrain(["no plan", "no plan"]), OfflineBrain())
    event = await think_of(said, brain)
    assert event.plan == StepPlan(steps=(GoTo(place="study"),))
    assert event.brain is not None
    assert event.brain.fallback_reason is not None


@pytest.mark.parametrize("text", ["come back", "ok, now come back", "回来", "好，回来吧"])
async def test_the_grammar_comes_back_where_an_order_led_away_and_asks_where_none_did(
    text: str,
) -> None:
    world = Together()
    world.bridge.pose = Pose2(0.4, -0.3, 0.5)
    world.run(0.2)
    world.run_until(world.give(go("kitchen")), GoalState.SUCCEEDED)
    plans = []
    for book in (world.book, replace(world.book, missions={})):
        _, effects = advance(book, Submitted("new", text, Language.EN), world.now_s)
        ask = next(each for each in effects if isinstance(each, AskBrain))
        plans.append((await thinker(OfflineBrain(), HOME)(ask)).plan)
    assert plans[0] == StepPlan(steps=(ComeBack(),))
    assert isinstance(plans[1], Clarify)
