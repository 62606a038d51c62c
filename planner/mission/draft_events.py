"""Tell who listens what a brain writes about a goal: often enough to read along, and no oftener.

For showing and for routing ahead; what is told here moves nothing and is written down nowhere.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from planner.brain.streamed_draft import Draft, Hear
from planner.plan import Step

TELL_S = 0.1
"""Between two tellings of one goal; the first comes at once."""


class Hearing:
    """Hand drafts on as events ``{"type": "thinking", "goal", "text", "steps"}``."""

    def __init__(
        self,
        publish: Callable[[dict[str, Any]], None],
        expect: Callable[[tuple[Step, ...]], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Say who is told.

        Args:
            publish: tells the listeners.
            expect: takes the steps as soon as there are new ones, to search ahead.
            clock: monotonic [s].
        """
        self._publish, self._expect, self._clock = publish, expect, clock

    def of(self, goal: str) -> Hear:
        """Return the listener of one thought about a goal."""
        told_s, steps = float("-inf"), 0

        def hear(draft: Draft, /) -> None:
            nonlocal told_s, steps
            if len(draft.steps) != steps:
                steps = len(draft.steps)
                self._expect(draft.steps)
            if self._clock() - told_s >= TELL_S:
                told_s = self._clock()
                self._publish(_event(goal, draft))

        return hear


def _event(goal: str, draft: Draft) -> dict[str, Any]:
    steps = [step.model_dump(mode="json", exclude_none=True) for step in draft.steps]
    return {"type": "thinking", "goal": goal, "text": draft.text, "steps": steps}
