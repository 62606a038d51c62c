"""Keep the planner's newest word: the robot, its goals and places, by the event socket.

Owns the view that it builds of the frames; knows no broker.
"""

from __future__ import annotations

import asyncio
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from pons.event_socket import follow_events
from pons.http import call

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.settings import LaunchSettings

Json = dict[str, Any]

MOST_GOALS = 100
MOST_EVENTS = 100
"""Events that wait for a broker that is away; the oldest goes first."""
_OPEN = frozenset(
    {"queued", "planning", "needs_clarification", "awaiting_confirmation", "running", "paused"}
)
_TOLD = frozenset(
    {"needs_clarification", "awaiting_confirmation", "succeeded", "failed", "refused", "cancelled"}
)


class PlannerView:
    """Hold what the planner has told; goals that end or ask are kept as news until taken."""

    def __init__(self) -> None:
        self.is_there = False
        self.robot: Json = {}
        self.places: list[Json] = []
        self.home: str = ""
        self.news: deque[tuple[float, Json]] = deque(maxlen=MOST_EVENTS)
        self._goals: dict[str, Json] = {}

    @property
    def goals(self) -> list[Json]:
        """Return the goals, newest first."""
        return sorted(self._goals.values(), key=lambda goal: str(goal["created"]), reverse=True)

    @property
    def home_place(self) -> Json | None:
        """Return the place that the robot returns to."""
        return next((place for place in self.places if place["id"] == self.home), None)

    def take(self, frame: Json, now_s: float) -> bool:
        """Take one frame; return whether the places are to be asked for again."""
        if frame["kind"] == "snapshot":
            self.robot = frame["robot"]
            for goal in reversed(frame["goals"]):
                self._take_goal(goal, now_s, is_first=goal["id"] not in self._goals)
            return True
        if frame["kind"] == "robot":
            self.robot = frame["robot"]
        elif frame["kind"] == "goal":
            self._take_goal(frame["change"]["goal"], now_s, is_first=False)
        return bool(frame["kind"] == "places")

    def _take_goal(self, goal: Json, now_s: float, *, is_first: bool) -> None:
        """Keep a goal; one that a snapshot tells of first had ended before anybody listened."""
        before = self._goals.pop(goal["id"], None)
        self._goals[goal["id"]] = goal
        while len(self._goals) > MOST_GOALS:
            del self._goals[next(iter(self._goals))]
        changed = before is None or before["state"] != goal["state"]
        was_open = before is None or before["state"] in _OPEN
        if changed and was_open and not is_first and goal["state"] in _TOLD:
            self.news.append((now_s, goal))


class PlannerWatch:
    """Follow the planner and wake one listener at each change."""

    def __init__(
        self, settings: LaunchSettings, view: PlannerView, changed: Callable[[], None]
    ) -> None:
        self._settings, self._view, self._changed = settings, view, changed

    async def run(self) -> None:
        """Follow for ever; a planner that is away is no error."""
        kinds = ("snapshot", "robot", "goal", "places")
        await follow_events(self._settings, kinds, self._take, self._lose)

    async def _take(self, frame: Json) -> None:
        if self._view.take(frame, time.monotonic()):
            told = await asyncio.to_thread(call, self._settings, "GET", "/v1/places")
            self._view.places, self._view.home = told["places"], told["home"]
            self._view.is_there = True
        self._changed()

    def _lose(self) -> None:
        self._view.is_there = False
        self._changed()
