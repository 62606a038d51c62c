"""Put the questions to a model, one at a time, within hard caps of calls and seconds.

The exam is one goal of the home's budget, so that a day's limits hold for it as well.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from planner.brain import BadPlan, Brain, BrainDown, OutOfBudget, ThinkRequest
from planner.brain.endpoint import EndpointBrain
from planner.brain.endpoint.line import Line
from planner.brain.prompt import Prompt
from planner.brain.prompt_tokens import tokens
from planner.budget import Purse
from planner.outbound import Address
from planner.plan import Language
from planner.settings import GoalLimits, JsonMode, ModelSettings, Settings
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons.evals.matchers import read_expectation
from pons.evals.model_access import open_purse, spending_of
from pons.evals.quick.exam import (
    QUESTIONS,
    WITH_SCHEMA,
    WORLD,
    Exam,
    ExamQuestion,
    MarkedAnswer,
    ModeResult,
    PictureResult,
    Result,
    ServerPace,
)
from pons.evals.quick.eyes import examine_eyes
from pons.evals.quick.server_probe import holds_schema, measure_speed
from pons.evals.score import judge, request_of
from pons.evals.suites import Case
from pons.evals.world import EvalWorld

MOST_CALLS = 40
MOST_S = 60.0
RUNGS_SHARE = 1 / 3
"""Of the exam's time, after which no further rung is begun once one has given a right plan."""
PROMPT_TOKENS = 3500
"""What a call may send, taken over all calls: some 1 700, and in a repair the reply once more."""
GOAL = "exam"
_EXAM_WORLD = EvalWorld(WORLD, "living_room")


@dataclass(frozen=True, slots=True)
class Caps:
    """Bound an exam."""

    calls: int = MOST_CALLS
    seconds: float = MOST_S


@dataclass
class _Room:
    """Hold the means of an exam under way."""

    purse: Purse
    model: ModelSettings
    home: Path
    goal: str
    end_s: float
    clock: Callable[[], float]

    @property
    def left_s(self) -> float:
        return self.end_s - self.clock()

    @asynccontextmanager
    async def brain(self, mode: JsonMode | None) -> AsyncIterator[EndpointBrain]:
        """Lend a brain that asks in one way, patient to the end of the exam at most."""
        brain = EndpointBrain(self._asked_by(mode), self.home, meter=self.purse)
        try:
            yield brain
        finally:
            await brain.close()

    @asynccontextmanager
    async def line(self, mode: JsonMode | None) -> AsyncIterator[Line]:
        """Lend a line that asks in one way, for what is asked of the server itself."""
        line = Line(self._asked_by(mode), self.home, None, self.purse)
        try:
            yield line
        finally:
            await line.close()

    def _asked_by(self, mode: JsonMode | None) -> ModelSettings:
        timeout_s = max(0.5, min(self.model.timeout_s, self.left_s))
        changes = {"mode": mode, "timeout_s": timeout_s, "allow_offhost": True}
        changes["allow_pictures_offhost"] = True  # the exam's own
        return self.model.model_copy(update=changes)


async def examine(
    settings: Settings,
    model: ModelSettings,
    home: Path,
    site: Path | None,
    caps: Caps,
    clock: Callable[[], float] = time.monotonic,
    slow: Callable[[], None] = lambda: None,
) -> Exam:
    """Return the exam's results.

    Args:
        settings: the owner's, for limits and prices.
        model: whom to ask. That its address may be asked was agreed on before.
        home: whose budget pays.
        site: whose places tell what a prompt costs here; None where none can be read.
        caps: where the exam ends, finished or not.
        clock: seconds that only rise.
        slow: is called where the first word takes long, for a person who waits.

    Raises:
        ConfigError: the address may not be asked at all, or the budget can't be read.
    """
    limits = GoalLimits(
        calls=caps.calls,
        prompt_tokens=caps.calls * PROMPT_TOKENS,
        reply_tokens=caps.calls * model.max_tokens,
        seconds=caps.seconds + model.load_timeout_s,
    )
    began_s, goal = clock(), f"{GOAL}-{time.time_ns()}"
    with open_purse(settings, model, home, limits) as (purse, folder):
        room = _Room(purse, model, folder, goal, began_s + caps.seconds, clock)
        speed = await _measure_speed(room, slow)
        held = await _find_binding(room) if speed.second_call_s is not None else {}
        room.end_s = clock() + caps.seconds  # what loading and the server's proof took is not lost
        rungs = await _try_modes(room, clock() + RUNGS_SHARE * caps.seconds)
        rungs = [replace(rung, held=held.get(rung.mode)) for rung in rungs]
        marked = await _answers(room, _best(rungs))
        eyes = await _eyes(room, _best(rungs))
        cost = spending_of(purse, goal)
    took_s = round(clock() - began_s, 2)
    host = Address.parse(model.url).host
    here = prompt_tokens(site)
    return Exam(model.name, host, tuple(rungs), marked, eyes, speed, cost, took_s, here)


async def _measure_speed(room: _Room, slow: Callable[[], None]) -> ServerPace:
    if room.left_s <= 0.0:
        return ServerPace()
    async with room.line(None) as line:
        return await measure_speed(line, room.goal, room.clock, slow)


async def _find_binding(room: _Room) -> dict[str, bool | None]:
    """Return by way of asking whether a schema binds, strictest first, until one is found."""
    found = dict[str, bool | None]()
    for mode in (mode for mode in JsonMode if mode.value in WITH_SCHEMA):
        async with room.line(mode) as line:
            found[mode.value] = await holds_schema(line, room.goal)
        if found[mode.value]:
            break
    return found


def _best(rungs: list[ModeResult]) -> JsonMode | None:
    """Return the strictest way that gave a right plan, else one that was taken at all."""
    good = [rung for rung in rungs if rung.right] or [rung for rung in rungs if rung.taken]
    return JsonMode(good[0].mode) if good else None


async def _try_modes(room: _Room, until_s: float) -> list[ModeResult]:
    """Try the rungs, strictest first; a slow model's time is kept for the orders themselves."""
    rungs: list[ModeResult] = []
    for mode in JsonMode:
        enough = any(rung.right for rung in rungs) and room.clock() >= until_s
        rungs.append(_not_tried(mode) if enough else await _try_mode(room, mode))
    return rungs


def _not_tried(mode: JsonMode) -> ModeResult:
    return ModeResult(mode.value, taken=False, right=False, why="not_asked", asked=False)


async def _try_mode(room: _Room, mode: JsonMode) -> ModeResult:
    if room.left_s <= 0.0:
        return _not_tried(mode)
    async with room.brain(mode) as brain:
        marked = await _ask(room, brain, QUESTIONS[0])
    right, taken = marked.result == "right", marked.result not in ("no_answer", "not_asked")
    asked = marked.result != "not_asked"
    return ModeResult(mode.value, taken, right, "" if right else marked.made, asked)


async def _answers(room: _Room, mode: JsonMode | None) -> tuple[MarkedAnswer, ...]:
    if mode is None:  # nothing was taken: to ask the rest would be more of the same
        return tuple(MarkedAnswer(question, "not_asked") for question in QUESTIONS)
    async with room.brain(mode) as brain:
        return tuple([await _ask(room, brain, question) for question in QUESTIONS])


async def _eyes(room: _Room, mode: JsonMode | None) -> PictureResult:
    if mode is None or room.left_s <= 0.0:
        return PictureResult()
    try:
        async with room.brain(mode) as brain, asyncio.timeout(room.left_s):
            return await examine_eyes(brain.looker(), room.goal)
    except TimeoutError:
        return PictureResult("not_asked", "the time was up")


async def _ask(room: _Room, brain: Brain, question: ExamQuestion) -> MarkedAnswer:
    if room.left_s <= 0.0:
        return MarkedAnswer(question, "not_asked")
    asked = {"language": question.language, "observed": question.observed}
    case = Case(question.text, question.part.value, read_expectation(question.right), asked=asked)
    request = request_of(case, _EXAM_WORLD, room.goal)
    before = room.purse.usage(room.goal).today.calls
    began_s = room.clock()
    try:
        async with asyncio.timeout(max(0.0, room.left_s)):
            thought = await brain.think(request)
    except TimeoutError:
        return MarkedAnswer(question, "not_asked", "the time was up")
    except OutOfBudget as spent:
        return MarkedAnswer(question, "not_asked", spent.said.en)
    except BrainDown as down:
        return MarkedAnswer(question, "no_answer", f"{down.why}: {down}"[:200])
    except BadPlan as rejected:
        return MarkedAnswer(question, "no_plan", str(rejected)[:200])
    seconds = room.clock() - began_s
    verdict = judge(case, thought.plan, _EXAM_WORLD, seconds)
    result: Result = "right" if verdict.right else "unsafe" if verdict.wrong else "wrong"
    calls = room.purse.usage(room.goal).today.calls - before
    return MarkedAnswer(question, result, thought.plan.model_dump_json()[:300], seconds, calls)


def prompt_tokens(site: Path | None) -> int:
    """Estimate the tokens of one call with the owner's places; 0 where there is no site."""
    if site is None:
        return 0
    request = ThinkRequest(
        text=QUESTIONS[4].text, vocabulary=vocabulary_of(Site.load(site)), language=Language.EN
    )
    return tokens(Prompt.load().messages(request))
