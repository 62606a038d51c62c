"""Ask brain and router in tasks, and bring their answers back as events. One task per question.

The way of a plan's first step is searched while the rest of the plan is still being written. What
was searched ahead is used only where the very same way is asked for later, by a plan that was
validated whole; nothing moves by it. Nothing is searched ahead while the robot drives or has other
goals: from where it would start is then unknown.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import time
from collections.abc import Awaitable, Callable, Coroutine
from dataclasses import dataclass, replace
from math import hypot
from typing import Any, Protocol, TypeVar

from planner.bridge_client.bridge_status import standing
from planner.language.catalogue import message, say
from planner.mission import effects
from planner.mission.events import Planned, Recalled, Told, ToolAnswered
from planner.mission.perception_requests import EyeDoor
from planner.mission.state import MissionState
from planner.navigation import RouteFailure, RouteRequest, RouteResult
from planner.navigation.obstruction import points_of
from planner.plan import Code, GoTo, Outcome, ReturnHome, Step
from planner.skills.perception import ImageAnswer
from wire import Pose2

log = logging.getLogger(__name__)

Recaller = Callable[[effects.AskMemory], Awaitable[Recalled]]
"""Look up what is remembered."""
ToolCaller = Callable[[effects.AskTool], Awaitable[ToolAnswered]]
"""Call a tool of the owner's servers."""
Think = Callable[[effects.AskBrain], Awaitable[Planned]]
"""Understand a sentence. Cancelled at once when nobody waits for the answer any more."""


async def call_nothing(ask: effects.AskTool) -> ToolAnswered:
    """Answer for a robot without tools."""
    why = say("tool_problem.tool_unknown")
    said = message(Code.TOOL_FAILED, call=ask.tool, why=why)
    return ToolAnswered(ask.id, ask.ticket, said, problem="tool_unknown")


class RouteService(Protocol):
    """Find routes, in another process."""

    async def route(self, request: RouteRequest) -> RouteResult:
        """Find the way, or raise ``RouteFailure``."""


@dataclass(frozen=True, slots=True)
class Answers:
    """Name where answers go, and the lidar's points when a way round is wanted."""

    event: Callable[[Planned | Told | Recalled | ToolAnswered], None]
    routed: Callable[[effects.AskRoute, RouteResult | None, str | None], None]
    obstacles: Callable[[], tuple[tuple[float, float], ...]]
    broken: Callable[[BaseException], None]
    """Ours is broken, not the brain's or the router's: the mission loop must not go on."""
    call: ToolCaller


class MissionTasks:
    """Own the tasks."""

    def __init__(
        self,
        think: Think,
        router: RouteService,
        answers: Answers,
        eyes: EyeDoor,
        recall: Recaller,
    ) -> None:
        self._think, self._recall, self._eyes, self._router = think, recall, eyes, router
        self._answers = answers
        self._thoughts: dict[str, asyncio.Task[None]] = {}
        self._inquiries: dict[int, asyncio.Task[None]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def help(self, ask: effects.TaskEffect) -> None:
        """Start to think, to search or to ask about pictures; keep one; stop thinking."""
        match ask:
            case effects.AskBrain():
                self._drop(ask.id)
                self._eyes.note(ask.id)
                self._thoughts[ask.id] = self._start(self._understand(ask))
            case effects.DropBrain():
                self._drop(ask.id)
            case effects.AskRoute():
                self.spawn(self._search(ask))
            case effects.KeepPicture():
                self._eyes.keep(ask)
            case effects.SavePicture():
                saving = self._eyes.save(ask)
                if saving is not None:
                    self.spawn(saving)
            case effects.AskMemory():
                self.spawn(self._look_up(ask))
            case effects.AskTool():
                self.spawn(self._ask_tool(ask))
            case effects.AskEyes():
                self._inquiries[ask.ticket] = self._start(self._inquire(ask))

    def await_answer(self, ticket: int | None) -> None:
        """Cancel every question about a picture but this one: nobody waits for the others."""
        for other in [t for t in self._inquiries if t != ticket]:
            self._inquiries.pop(other).cancel()

    def spawn(self, work: Coroutine[Any, Any, None]) -> None:
        """Run something beside, and keep hold of it until it ends."""
        self._tasks.add(self._start(work))

    def _start(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._note_end)
        return task

    def _note_end(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            self._answers.broken(error)

    def _drop(self, mission_id: str) -> None:
        task = self._thoughts.pop(mission_id, None)
        if task is not None:
            task.cancel()

    async def close(self) -> None:
        """Cancel everything and wait until it is gone."""
        tasks = tuple(self._tasks)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    async def _understand(self, ask: effects.AskBrain) -> None:
        said = Outcome(code=Code.MODEL_UNAVAILABLE, message=message(Code.MODEL_UNAVAILABLE))
        answer = await _answer_of(self._think, ask, "the brain", Planned(ask.id, None, said))
        if self._thoughts.get(ask.id) is asyncio.current_task():
            del self._thoughts[ask.id]
            self._answers.event(answer)

    async def _inquire(self, ask: effects.AskEyes) -> None:
        unseen = Told(ask.id, ask.ticket, ImageAnswer(failure="unavailable"))
        told = await _answer_of(self._eyes.ask, ask, "the eyes", unseen)
        if self._inquiries.get(ask.ticket) is asyncio.current_task():
            del self._inquiries[ask.ticket]
            self._answers.event(told)

    async def _look_up(self, ask: effects.AskMemory) -> None:
        code = Code.MEMORY_UNAVAILABLE
        unknown = Recalled(ask.id, ask.ticket, code, message(code))
        self._answers.event(await _answer_of(self._recall, ask, "memory", unknown))

    async def _ask_tool(self, ask: effects.AskTool) -> None:
        said = message(Code.TOOL_FAILED, call=ask.tool, why=say("tool_problem.bad_reply"))
        failed = ToolAnswered(ask.id, ask.ticket, said, problem="bad_reply")
        self._answers.event(await _answer_of(self._answers.call, ask, "a tool", failed))

    async def _search(self, ask: effects.AskRoute) -> None:
        obstacles = self._answers.obstacles() if ask.obstacles else ()
        obstacles += tuple(point for way in ask.shut for point in points_of(way))
        try:
            result = await self._router.route(replace(ask.request, obstacles=obstacles))
        except RouteFailure as failure:
            level = logging.DEBUG if ask.request.strict else logging.WARNING
            log.log(level, "no route for goal %s: %s", ask.id, failure)
            self._answers.routed(ask, None, failure.code)
            return
        self._answers.routed(ask, result, None)


Asked = TypeVar("Asked", effects.AskBrain, effects.AskEyes, effects.AskMemory, effects.AskTool)
Answer = TypeVar("Answer", Planned, Told, Recalled, ToolAnswered)


async def _answer_of(
    answer: Callable[[Asked], Awaitable[Answer]], ask: Asked, who: str, otherwise: Answer
) -> Answer:
    """Return an answer. Whoever is asked, its fault ends no planner: the goal is told so, typed."""
    try:
        return await answer(ask)
    except Exception:
        log.exception("%s failed on goal %s", who, ask.id)
        return otherwise


SAME_M = 0.1
"""How far the pose may have wandered, standing, since the search began; a horizon may begin 0.3 m
from the robot."""
KEPT_S = 30.0


class StateHolder(Protocol):
    """Hold where everything stands, as the mission loop does."""

    @property
    def book(self) -> MissionState: ...


@dataclass(slots=True)
class _Search:
    request: RouteRequest
    task: asyncio.Task[RouteResult]
    began_s: float


class RouteAhead:
    """Be a router that may have the answer already."""

    def __init__(
        self,
        router: RouteService,
        missions: StateHolder,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._router, self._missions, self._clock = router, missions, clock
        self._search: _Search | None = None
        self.used = 0
        """Routes that were there before they were asked for."""

    def expect(self, steps: tuple[Step, ...]) -> None:
        """Begin to search the way of the first step, if it names a place and the robot is free."""
        request = self._request(steps[0]) if steps else None
        now = self._search
        if request is None or (now is not None and _is_same(now.request, request)):
            return
        self._drop()
        task = asyncio.get_running_loop().create_task(self._router.route(request))
        task.add_done_callback(_looked_at)
        self._search = _Search(request, task, self._clock())

    async def route(self, request: RouteRequest) -> RouteResult:
        """Find the way, or have it found already. Raises what the router raises."""
        ahead, self._search = self._search, None
        if ahead is None:
            return await self._router.route(request)
        fresh = self._clock() - ahead.began_s <= KEPT_S
        if fresh and _is_same(ahead.request, request):
            with contextlib.suppress(RouteFailure):
                result = await ahead.task
                self.used += 1
                return result
        ahead.task.cancel()
        return await self._router.route(request)

    async def close(self) -> None:
        """Let go of the search under way."""
        search = self._search
        self._drop()
        if search is not None:
            await asyncio.gather(search.task, return_exceptions=True)

    def _request(self, step: Step) -> RouteRequest | None:
        book = self._missions.book
        status = book.status
        if status is None or status.base_in_map is None or not standing(status):
            return None
        if book.running is not None or book.queue:
            return None
        match step:
            case GoTo(place=place):
                target = book.facts.targets.get(place)
            case ReturnHome():
                target = book.facts.targets.get(book.facts.home)
            case _:
                return None
        return None if target is None else RouteRequest(status.base_in_map, target.pose)

    def _drop(self) -> None:
        if self._search is not None:
            self._search.task.cancel()
            self._search = None


def _is_same(ahead: RouteRequest, asked: RouteRequest) -> bool:
    plain = not (
        asked.obstacles or asked.straight or asked.aside or asked.strict or asked.keep_right_m
    )
    return plain and ahead.goal == asked.goal and _near(ahead.start, asked.start)


def _near(one: Pose2, other: Pose2) -> bool:
    return hypot(one.x_m - other.x_m, one.y_m - other.y_m) <= SAME_M


def _looked_at(task: asyncio.Task[RouteResult]) -> None:
    """Take note of a failure that nobody may ask for: it is no one's any more."""
    if not task.cancelled():
        task.exception()
