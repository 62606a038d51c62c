"""Put the offline grammar behind the brain's door: always there, never slow, costs nothing."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from planner.brain.interface import OFFLINE, ThinkRequest, ThinkResult
from planner.brain.offline_replan import rest_of
from planner.brain.streamed_draft import Hear
from planner.language.grammar.parser import Context, plan
from planner.plan import BrainTag

VERSION = "2"
TAG = BrainTag(name=OFFLINE, version=VERSION)


def _read_clock() -> datetime:
    return datetime.now().astimezone()


class OfflineBrain:
    """Plan by grammar, in this process and without a model. `clock` tells the time of day."""

    def __init__(self, clock: Callable[[], datetime] = _read_clock) -> None:
        self._clock = clock

    @property
    def tag(self) -> BrainTag:
        """Return the brain's name and version."""
        return TAG

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the plan of a sentence. Pure beneath, and bounded by the length of the text."""
        context = Context(
            room=request.room,
            language=request.language,
            now=self._clock(),
            runnable=request.runnable,
            blind=request.blind,
            things=request.things,
        )
        made = plan(request.text, request.vocabulary, context)
        return ThinkResult(plan=rest_of(made, request.observed), brain=TAG)
