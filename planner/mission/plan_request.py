"""Have a brain understand a sentence, judge what it says, and return an event. Trusts no brain.

A model's plan is also held to the person's own words (``planner.language.motion_guard``): the steps
that move the robot and that nobody asked for are named in the event, and wait for a person's yes.

What a brain writes meanwhile is told to those who listen: often enough to read along, and no
oftener. It is for showing and for routing ahead, moves nothing and is written down nowhere.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Awaitable, Callable
from datetime import datetime
from typing import Any

from planner.brain.errors import BadPlan, BrainDown, OutOfBudget
from planner.brain.interface import Brain, ThinkRequest, ThinkResult
from planner.brain.model_error_codes import reason, tell_failure
from planner.brain.offline_brain import read_untouched
from planner.brain.situation import RememberedItem, Situation
from planner.brain.streamed_draft import Draft, Hear
from planner.brain.tainted_text import think_warily
from planner.language.catalogue import join, message, say
from planner.language.changes.antecedents import ORDERS_BACK
from planner.language.motion_guard import PersonWords, find_unasked, said_words
from planner.language.object_names import known_words
from planner.language.place_lists import rejection_outcome
from planner.language.sentence import parse
from planner.language.yes_no import consents
from planner.mission.effects import AskBrain
from planner.mission.events import Planned
from planner.mission.follow_up import LEANS_S
from planner.mission.tasks import Think
from planner.plan import (
    BARE,
    GIVEN,
    Bilingual,
    Code,
    Means,
    Outcome,
    Plan,
    Step,
    StepPlan,
    Vocabulary,
    check_plan,
    holds_call,
    list_nodes,
)
from planner.skill_files.calls import SkillFailure, SkillScene, unfold

CHECKS = frozenset({"look", "find", "count", "ask", "recall"})
"""Steps after which what an order puts on a condition may be done."""
_FOUND = frozenset({Code.ARRIVED, Code.FOUND, Code.COUNTED, Code.SEEN, Code.RECALLED})
"""Outcomes in the robot's own words; an answer is a model's, and names nothing to be ordered."""
Remember = Callable[[AskBrain, Vocabulary], Awaitable[tuple[RememberedItem, ...]]]
"""Choose what a brain is shown of memory."""
RefusesOffer = Callable[[str], Bilingual | None]
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
        """Set the listener.

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
                written = [s.model_dump(mode="json", exclude_none=True) for s in draft.steps]
                told = {"type": "thinking", "goal": goal, "text": draft.text, "steps": written}
                self._publish(told)

        return hear


log = logging.getLogger(__name__)


def read_clock() -> datetime:
    """Return people's own time."""
    return datetime.now().astimezone()


async def remember_nothing(ask: AskBrain, vocabulary: Vocabulary) -> tuple[RememberedItem, ...]:
    """Return what a robot without memory remembers."""
    del ask, vocabulary
    return ()


def _situation(
    ask: AskBrain, clock: Callable[[], datetime], remembered: tuple[RememberedItem, ...]
) -> Situation | None:
    if ask.situation is None:
        return None
    time_told = clock().strftime("%a %Y-%m-%d %H:%M")
    return ask.situation.model_copy(update={"time": time_told, "remembered": remembered})


def thinker(
    brain: Brain,
    vocabulary: Vocabulary,
    hearing: Hearing | None = None,
    means: Means = BARE,
    classes: tuple[str, ...] = (),
    clock: Callable[[], datetime] = read_clock,
    remember: Remember = remember_nothing,
    refuse_offer: RefusesOffer | None = None,
) -> Think:
    """Return how a brain thinks about goals here; ``refuse_offer``: of orders not to be kept."""

    async def think(ask: AskBrain) -> Planned:
        remembered = await remember(ask, vocabulary)
        request = ThinkRequest(
            text=ask.text,
            changed=ask.changed,
            vocabulary=vocabulary,
            room=ask.room,
            language=ask.language,
            runnable=means.plannable | vocabulary.calls,
            blind=means.blind,
            things=known_words(classes) if means.detector else frozenset(),
            kinds=classes if means.detector else (),
            goal=ask.id,
            observed=ask.observed,
            replan=ask.replan,
            order=ask.order if ask.exchanges else "",
            standing=ask.standing,
            departed=ask.departed,
            newest=ask.newest,
            exchanges=ask.exchanges,
            situation=_situation(ask, clock, remembered),
            refuse_offer=refuse_offer,
        )
        try:
            hear = hearing.of(ask.id) if hearing else None
            thought = await think_warily(brain, request, hear)
        except (BadPlan, BrainDown) as error:
            log.warning("goal %s: no plan came: %s", ask.id, error)
            return Planned(ask.id, None, _tell_failure(error), error.brain or brain.tag)
        return await _judge_thought(ask, thought, request, means, clock)

    return think


async def _judge_thought(
    ask: AskBrain,
    thought: ThinkResult,
    request: ThinkRequest,
    means: Means,
    clock: Callable[[], datetime],
) -> Planned:
    """Return a thought with the steps of its skills, held to a person's words and the robot."""
    names = request.vocabulary
    unasked, sure = await _hold_to_words(thought, request)
    try:
        unfolded = await unfold(thought.plan, _scene(request, clock))
    except SkillFailure as failed:
        log.warning("goal %s: %s", ask.id, failed)
        return Planned(ask.id, None, failed.outcome, thought.brain)
    made = unfolded.plan
    runnable = means.runnable - (GIVEN if _points_beyond(made, ask) else frozenset())
    rejection = check_plan(made, names, runnable, means.blind)
    if rejection is not None:
        return Planned(ask.id, None, rejection_outcome(rejection, names), thought.brain)
    unasked = unfolded.find_unasked(unasked, by_grammar=thought.by_grammar)
    return Planned(ask.id, made, None, thought.brain, unasked, sure)


def _scene(request: ThinkRequest, clock: Callable[[], datetime]) -> SkillScene:
    """Return what a skill is told of where things stand."""
    language = request.language or parse(request.text).language
    battery = None if request.situation is None else request.situation.battery
    return SkillScene(request.vocabulary, language, request.room, battery, clock())


def _points_beyond(plan: Plan, ask: AskBrain) -> bool:
    """Tell whether a brain's plan drives to a point of the map that no person gave.

    "Again" keeps the points of the order before: a person gave those.
    """
    if not isinstance(plan, StepPlan):
        return False
    kept = ask.changed.steps if ask.changed is not None else ()
    given = {node.step for node in list_nodes(kept) if node.step.kind in GIVEN}
    return any(
        node.step.kind in GIVEN and node.step not in given for node in list_nodes(plan.steps)
    )


def _tell_failure(error: BadPlan | BrainDown) -> Outcome:
    """Return what a goal comes to for which no plan came."""
    if isinstance(error, BadPlan):
        why = say("model_error.no_plan") if error.code == "bad_plan" else reason(error.code)
        return Outcome(code=Code.BAD_PLAN, message=why)
    if isinstance(error, OutOfBudget):
        return Outcome(code=Code.OUT_OF_BUDGET, message=error.said)
    told = message(Code.MODEL_UNAVAILABLE)
    if error.server:
        told = join((told, tell_failure(error.why, error.server)))
    return Outcome(code=Code.MODEL_UNAVAILABLE, message=told)


async def _hold_to_words(
    thought: ThinkResult, request: ThinkRequest
) -> tuple[tuple[int, ...], StepPlan | None]:
    """Return the steps that nobody asked for, and the built-in brain's plan where there are any.

    "Again" names nothing: what it makes of the order before is asked for, step for step.
    """
    unasked, plan = unasked_of(thought, request), thought.plan
    sure = await _read_surely(request) if unasked else None
    if request.changed is not None and sure is not None and isinstance(plan, StepPlan):
        unasked = tuple(index for index in unasked if plan.steps[index] not in sure.steps)
    return unasked, sure


async def _read_surely(request: ThinkRequest) -> StepPlan | None:
    """Return the built-in brain's plan of an order of which nothing was done; None: it has none."""
    plan = await read_untouched(request)
    if not isinstance(plan, StepPlan):
        return None
    rejection = check_plan(plan, request.vocabulary, request.runnable, request.blind)
    return plan if rejection is None and not holds_call(plan.steps) else None


def unasked_of(thought: ThinkResult, request: ThinkRequest) -> tuple[int, ...]:
    """Return the steps of a plan that move the robot though nobody asked for it.

    One guard for all brains: a model names the words for each step, the grammar has read them all.
    What people answered to an ``ask`` on the way, what was seen and what a model wrote is nobody's
    order.
    """
    plan = thought.plan
    if not isinstance(plan, StepPlan):
        return ()
    pairs = tuple((each.asked, each.answer) for each in request.exchanges)
    order = request.order if pairs else request.text
    checked = any(seen.step in CHECKS or seen.result == "failed" for seen in request.observed)
    agreed = tuple(asked for asked, answer in pairs if consents(answer) is True)
    before = _spoken_before(request.situation)
    person = PersonWords(said_words(order, pairs), request.room, agreed, checked, before)
    found = find_unasked(plan, person, request.vocabulary, by_all_words=thought.by_grammar)
    for each in found:
        log.info("goal %s: step %d was not asked for: %s", request.goal, each.index + 1, each.why)
    return tuple(each.index for each in found)


def _spoken_before(situation: Situation | None) -> tuple[str, ...]:
    """Return the latest orders, newest first, each before what the robot itself found by it."""
    recent = situation.recent[:ORDERS_BACK] if situation is not None else ()
    fresh = [goal for goal in recent if goal.minutes * 60.0 <= LEANS_S]
    told = ((goal.order, goal.told if goal.outcome in _FOUND else "") for goal in fresh)
    return tuple(words for each in told for words in each if words)
