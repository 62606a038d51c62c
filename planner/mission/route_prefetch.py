"""Search the way of a plan's first step while the rest of the plan is still being written.

Stands before the route search as one itself. What was searched ahead is used only where the very
same way is asked for later, by a plan that was validated whole; nothing moves by it. Nothing is
searched ahead while the robot drives or has other goals: from where it would start is then unknown.
"""

from __future__ import annotations

import asyncio
import contextlib
import time
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot
from typing import Protocol

from planner.mission.bridge_status import standing
from planner.mission.state import MissionState
from planner.mission.tasks import RouteService
from planner.navigation import RouteFailure, RouteRequest, RouteResult
from planner.plan import GoTo, ReturnHome, Step
from wire import Pose2

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
