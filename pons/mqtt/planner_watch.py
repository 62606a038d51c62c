"""Keep the planner's newest word: the robot, its goals and places, by the event socket.

Owns the socket and the view that it builds; knows no broker. A planner that is away is dialled
again for ever.
"""

from __future__ import annotations

import asyncio
import base64
import json
import logging
import os
import ssl
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from websockets.asyncio.client import connect
from websockets.exceptions import WebSocketException

from pons.http import AUTHORITY, PlannerDown, PlannerProblem, call
from processes.backoff import Backoff

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.settings import LaunchSettings

log = logging.getLogger("home")

Json = dict[str, Any]

MOST_GOALS = 100
MOST_EVENTS = 100
"""Events that wait for a broker that is away; the oldest goes first."""
SILENT_S = 5.0
"""The planner says how the robot is at least five times a second."""
_FIRST_S, _LONGEST_S = 0.5, 5.0
_MAX_FRAME_BYTES = 4_000_000
_HEAD = 60
"""A frame's kind stands so early; a scan is not worth parsing."""
_KINDS = ('"kind":"snapshot"', '"kind":"robot"', '"kind":"goal"', '"kind":"places"')
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
        backoff, told = Backoff(_FIRST_S, _LONGEST_S), ""
        while True:
            try:
                await self._follow(backoff)
            except (OSError, TimeoutError, WebSocketException, PlannerDown, PlannerProblem) as why:
                if (trouble := f"planner_down: {self._settings.url}: {why}") != told:
                    told = trouble
                    log.warning("%s", trouble)
            self._view.is_there = False
            self._changed()
            await asyncio.sleep(backoff.pause_after())

    async def _follow(self, backoff: Backoff) -> None:
        url = self._settings.url.replace("http", "ws", 1) + "/v1/events"
        async with connect(
            url,
            ssl=_trusted(self._settings),
            subprotocols=_subprotocols(),  # type: ignore[arg-type]  # plain words are enough
            max_size=_MAX_FRAME_BYTES,
            max_queue=4,
            compression=None,
            open_timeout=SILENT_S,
            close_timeout=1.0,
            proxy=None,
        ) as socket:
            while True:
                async with asyncio.timeout(SILENT_S):
                    text = await socket.recv()
                if not isinstance(text, str) or not any(k in text[:_HEAD] for k in _KINDS):
                    continue
                if self._view.take(json.loads(text), time.monotonic()):
                    await self._read_places()
                    backoff.reset()
                    self._view.is_there = True
                self._changed()

    async def _read_places(self) -> None:
        told = await asyncio.to_thread(call, self._settings, "GET", "/v1/places")
        self._view.places, self._view.home = told["places"], told["home"]


def _trusted(settings: LaunchSettings) -> ssl.SSLContext | None:
    """Return what judges the planner's certificate, as ``pons.http`` does."""
    if not settings.tls:
        return None
    file = settings.authority or settings.home / AUTHORITY
    there = settings.authority is not None or os.access(file, os.R_OK)
    return ssl.create_default_context(cafile=str(file) if there else None)


def _subprotocols() -> list[str] | None:
    """Return how the token is shown where one is set (planner/api/access.py)."""
    token = os.environ.get("PONS_OPERATOR_TOKEN", "")
    if not token:
        return None
    word = base64.urlsafe_b64encode(token.encode()).decode().rstrip("=")
    return ["pons.v1", f"bearer.{word}"]
