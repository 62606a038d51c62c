"""A brain that answers within a tick fits lockstep; one that waits is told so."""

from __future__ import annotations

from collections.abc import Generator

import pytest

from planner.brain import BrainDown, ScriptedBrain, ThinkRequest
from planner.plan import GoTo, StepPlan, Vocabulary
from tools.lockstep.run_coroutine import NotAtOnce, at_once

ASK = ThinkRequest(text="go to the kitchen", vocabulary=Vocabulary())


def test_a_script_is_played_without_an_event_loop() -> None:
    plan = StepPlan(steps=(GoTo(place="kitchen"),))
    assert at_once(ScriptedBrain([plan]).think(ASK)).plan == plan


def test_what_a_brain_raises_comes_through() -> None:
    with pytest.raises(BrainDown):
        at_once(ScriptedBrain([BrainDown("no answer")]).think(ASK))


def test_a_brain_that_waits_is_refused_and_not_waited_for() -> None:
    async def waits() -> None:
        while True:
            await _Never()

    with pytest.raises(NotAtOnce):
        at_once(waits())


class _Never:
    def __await__(self) -> Generator[str, None, None]:
        yield "something outside"
