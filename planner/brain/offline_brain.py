"""Put the offline grammar behind the brain's door: always there, never slow, costs nothing."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from datetime import datetime

from planner.brain.interface import OFFLINE, Observation, ThinkRequest, ThinkResult
from planner.brain.streamed_draft import Hear
from planner.language.catalogue import join, message, say
from planner.language.grammar.context import Context
from planner.language.readers import OrderWords, read_order
from planner.language.schedule import asks_about_day
from planner.language.sentence import parse
from planner.plan import (
    AnswerPlan,
    Bilingual,
    BrainTag,
    Clarify,
    Code,
    Plan,
    Refuse,
    StepPlan,
    say_same,
)

VERSION = "2"
TAG = BrainTag(name=OFFLINE, version=VERSION)


def _read_clock() -> datetime:
    return datetime.now().astimezone()


class OfflineBrain:
    """Plan by grammar, in this process and without a model. `clock` tells the time of day.

    `servers` are the owner's tool servers, where no model is there to ask them: it is then told.
    """

    def __init__(
        self, clock: Callable[[], datetime] = _read_clock, servers: Sequence[str] = ()
    ) -> None:
        self._clock, self._servers = clock, tuple(servers)

    @property
    def tag(self) -> BrainTag:
        """Return the brain's name and version."""
        return TAG

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the plan of a sentence. Pure beneath, and bounded by the length of the text."""
        changed = request.changed
        if changed is not None and changed.steps:
            made: Plan = StepPlan(steps=changed.steps)
        else:
            made = self._or_tools(request.text, read_order(self._words_of(request)).plan)
        rest = rest_of(made, request.observed)
        return ThinkResult(plan=rest, brain=TAG, by_grammar=True)

    def _or_tools(self, text: str, made: Plan) -> Plan:
        """Return a plan, or that tools need a model where only they could answer.

        That is a question about a day, or one with a server's name, which the grammar can't answer.
        """
        if not self._servers or isinstance(made, StepPlan | AnswerPlan):
            return made
        named = any(re.search(rf"\b{name}\b", text.lower(), re.ASCII) for name in self._servers)
        if not (named or asks_about_day(text)):
            return made
        told = message(Code.TOOLS_NEED_MODEL, servers=say_same(", ".join(self._servers)))
        return Refuse(code=Code.TOOLS_NEED_MODEL, reason=told)

    def _words_of(self, request: ThinkRequest) -> OrderWords:
        words = request.text if request.changed is None else request.changed.words
        context = Context(
            room=request.room,
            language=request.language,
            now=self._clock(),
            runnable=request.runnable,
            blind=request.blind,
            things=request.things,
            departed=request.departed,
            newest=request.newest,
            remembers=request.situation is not None
            and any(item.fits for item in request.situation.remembered),
        )
        return OrderWords(parse(words), request.vocabulary, context, bool(request.exchanges))


_READS_NO_ANSWER = say("replan.reads_no_answer")
_NO_OTHER_WAY = say("replan.no_other_way")


def _whole(seen: Observation) -> Bilingual:
    """Return the facts known of a step, and beside them a model's reading."""
    if seen.read is None:
        return seen.detail
    return join(text for text in (seen.detail, seen.read) if text.en)


def rest_of(
    plan: StepPlan | AnswerPlan | Clarify | Refuse, observed: Sequence[Observation]
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Return the rest of a sentence's plan after these observations, and nothing twice.

    A grammar has no second idea. It never orders a step again that is over, and says so where the
    rest is not its own plan's. What a person answered it does not read: that is no reason to go on.
    """
    if not observed or not isinstance(plan, StepPlan):
        return plan
    if observed[-1].step == "ask":  # neither yes nor no: a person is asked again, nothing goes on
        return Refuse(code=Code.BAD_PLAN, reason=message(Code.BAD_PLAN, why=_READS_NO_ANSWER))
    kinds = [step.kind for step in plan.steps]
    walked = [seen.step for seen in observed]
    if kinds[: len(walked)] != walked:  # another brain's plan was walked
        return Refuse(code=Code.BAD_PLAN, reason=message(Code.BAD_PLAN, why=_NO_OTHER_WAY))
    failed = observed[-1].result == "failed"
    left = plan.steps[len(walked) - int(failed) :]
    if left:
        return StepPlan(steps=left)
    told = [_whole(seen) for seen in observed if seen.step != "decide"]
    told = told or [_NO_OTHER_WAY]
    return AnswerPlan(text=told[-1])


async def read_untouched(
    request: ThinkRequest,
) -> StepPlan | AnswerPlan | Clarify | Refuse | None:
    """Return the built-in brain's reading of an order; None where something of it was done."""
    if request.observed or request.exchanges:
        return None
    return (await OfflineBrain().think(request)).plan
