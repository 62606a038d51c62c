"""A brain that answers within a tick fits lockstep; one that waits is told so."""

from __future__ import annotations

from collections.abc import Generator

import pytest

from lockstep.thinking import NotAtOnce, at_once, planned
from planner.brain import BrainDown, ScriptedBrain
from planner.mission.effects import AskBrain
from planner.plan import Bilingual, Code, Entry, GoTo, Language, StepPlan, Vocabulary

WORLD = Vocabulary(
    entries=(Entry(id="kitchen", kind="room", name=Bilingual(en="kitchen", zh="厨房")),)
)
ASK = AskBrain("g1", "go to the kitchen", Language.EN)


def test_a_script_is_played_without_an_event_loop() -> None:
    plan = StepPlan(steps=(GoTo(place="kitchen"),))
    answer = planned(ScriptedBrain([plan]), WORLD, ASK)
    assert answer.plan == plan
    assert answer.brain is not None
    assert answer.brain.name == "scripted"


@pytest.mark.parametrize(
    ("reply", "code"),
    [
        ("not json", Code.BAD_PLAN),
        (BrainDown("no answer"), Code.MODEL_UNAVAILABLE),
        (StepPlan(steps=(GoTo(place="moon"),)), Code.UNKNOWN_PLACE),
    ],
)
def test_what_is_no_usable_plan_becomes_a_typed_failure(
    reply: StepPlan | str | Exception, code: Code
) -> None:
    answer = planned(ScriptedBrain([reply]), WORLD, ASK)
    assert answer.plan is None
    assert answer.failure is not None
    assert answer.failure.code is code


def test_a_brain_that_waits_is_refused_and_not_waited_for() -> None:
    async def waits() -> None:
        while True:
            await _Never()

    with pytest.raises(NotAtOnce):
        at_once(waits())


class _Never:
    def __await__(self) -> Generator[str, None, None]:
        yield "something outside"
