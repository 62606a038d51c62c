"""A model reads what was said; the built-in brain plans the change, also where the model fails."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain import FallbackBrain, OfflineBrain
from planner.brain.interface import Brain, ThinkRequest
from planner.brain.scripted import ScriptedBrain
from planner.language.sentence import parse
from planner.mission.effects import AskBrain
from planner.mission.events import Planned, Submitted
from planner.mission.plan_request import thinker
from planner.mission.reception import receive
from planner.mission.reducer import advance
from planner.plan import GoTo, Language, Means, StepPlan
from planner.site.site_view import vocabulary_of
from tests.planner.mission.leaning import NOW_S, SITE, order_done

BEDROOM = order_done("go to the bedroom")
GO = '{"kind":"plan","steps":[{"kind":"go_to","place":"bedroom"}]}'
ELSEWHERE = '{"kind":"plan","steps":[{"kind":"go_to","place":"kitchen"}]}'


def think_of(said: str, brain: Brain) -> Planned:
    """Return what comes of a sentence behind a drive to the bedroom."""
    given = receive(BEDROOM, parse(said), Submitted("new", said, Language.EN), NOW_S).given
    _, effects = advance(BEDROOM, given, NOW_S)
    [ask] = [each for each in effects if isinstance(each, AskBrain)]
    think = thinker(brain, vocabulary_of(SITE), None, Means(camera=True, detector=True))

    async def story() -> Planned:
        return await think(ask)

    return asyncio.run(story())


@pytest.mark.parametrize("said", ["again", "再来一次"])
def test_a_model_gets_the_words_as_they_were_said_and_again_needs_no_yes(said: str) -> None:
    model = ScriptedBrain([GO], by_grammar=False)
    planned = think_of(said, model)
    heard: list[ThinkRequest] = model.asked
    assert [each.text for each in heard] == [said]
    assert planned.plan == StepPlan(steps=(GoTo(place="bedroom"),), asked_by=(said,))
    assert planned.unasked == ()


def test_a_step_beside_the_change_waits_for_a_yes() -> None:
    assert think_of("again", ScriptedBrain([ELSEWHERE], by_grammar=False)).unasked == (0,)


@pytest.mark.parametrize("said", ["no, the study", "不对，书房"])
def test_where_a_model_fails_the_built_in_brain_plans_the_change(said: str) -> None:
    brain = FallbackBrain(ScriptedBrain(["no plan", "no plan"]), OfflineBrain())
    planned = think_of(said, brain)
    assert planned.plan == StepPlan(steps=(GoTo(place="study"),))
    assert planned.brain is not None
    assert planned.brain.fallback_reason is not None
