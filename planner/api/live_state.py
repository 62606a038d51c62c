"""Build the pages' common state once for all watchers: robot, scan, path, meter, sight, as JSON.

Latest wins: a listener that falls behind skips to the newest and never holds the others up. Runs
only while somebody listens. Knows no socket.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from planner.api.objects import sight_view
from planner.api.robot import obstacle_view, path_view, robot_view, scan_view
from planner.api.usage import usage_view
from planner.loops import keep_going
from wire import Mode

if TYPE_CHECKING:
    from planner.api.interfaces import Services
    from planner.perception import LookSnapshot, Sight


PULSE_S = 0.02
"""How soon a change of mode, epoch, hold or owner is seen here."""
ROBOT_S = 0.1
STANDING_S = 0.2
"""Between two looks at a robot that stands: nothing of it changes but ages, which carry on by
themselves in whoever was told them. A turning point is told at once all the same."""
SCAN_S = 0.2
LAYERS_S = 0.5
"""Between two looks at what the route search remembers; told where it changed."""
SIGHT_S = 0.2
SAME_S = 0.5
"""So long a look that shows the same again is not told: boxes tremble, nothing has changed. A page
shows no boxes older than 1 s, so it must hear of them sooner."""
TREMBLE_PX = 4.0
STILL_MPS = 0.01
STILL_RADPS = 0.02

Body = str
"""A JSON object's text without its opening brace, so that each socket can put its seq in front."""


class Listener:
    """Hold the newest body of each kind until its socket takes it."""

    def __init__(self) -> None:
        self._waiting: dict[str, Body] = {}
        self._news = asyncio.Event()

    def offer(self, kind: str, body: Body) -> None:
        """Put a body in place of an older one of its kind."""
        self._waiting[kind] = body
        self._news.set()

    async def take(self) -> list[Body]:
        """Wait for news and take all of it."""
        await self._news.wait()
        self._news.clear()
        bodies, self._waiting = list(self._waiting.values()), {}
        return bodies


class Feed:
    """Look at the services while anybody listens."""

    def __init__(self, services: Services, *, clock: Callable[[], float] = time.monotonic) -> None:
        self._services = services
        self._clock = clock
        self._listeners: set[Listener] = set()
        self._task: asyncio.Task[None] | None = None
        self._robot_s = self._scan_s = float("-inf")
        self._told: tuple[Any, ...] = ()
        self._driven: tuple[str, int, str | None] | None = None
        self._metered = 0
        self._places = 0
        self._layers_s = float("-inf")
        self._layers: dict[str, Any] = {}
        self._sight = SightNews(services)

    def listen(self) -> Listener:
        """Begin to listen; the first listener starts the looking."""
        listener = Listener()
        self._listeners.add(listener)
        if self._task is None or self._task.done():
            self._metered = self._services.budget.changes  # the snapshot tells it so far
            self._task = asyncio.create_task(keep_going("feed", self._run), name="feed")
        return listener

    def leave(self, listener: Listener) -> None:
        """Hear no more; the last to leave ends the looking."""
        self._listeners.discard(listener)
        if not self._listeners and self._task is not None:
            self._task.cancel()
            self._task = None

    async def _run(self) -> None:
        while True:
            self.look()
            await asyncio.sleep(PULSE_S)

    def look(self) -> None:
        """Offer the parts that are due or have changed."""
        now_s = self._clock()
        news = _turning_point(self._services)
        due_s = STANDING_S if _stands(self._services) else ROBOT_S
        if news != self._told or now_s - self._robot_s >= due_s:
            self._told, self._robot_s = news, now_s
            self._offer("robot", {"robot": robot_view(self._services)})
        leg = self._services.goals.path()
        doubt = None if leg is None or leg.doubt is None else leg.doubt.code
        driven = None if leg is None else (leg.mission, leg.leg, doubt)
        if driven != self._driven:  # legs only rise, so a new path is a new number
            self._driven = driven
            self._offer("path", {"path": path_view(self._services)})
        changes = self._services.budget.changes
        if changes != self._metered:
            self._metered = changes
            self._offer("usage", {"usage": usage_view(self._services)})
        version = self._services.memory.version
        if version != self._places:
            self._places = version
            self._offer("places", {"version": version})
        if self._sight.due(now_s):
            self._offer("sight", {"sight": sight_view(self._services)})
        if now_s - self._layers_s >= LAYERS_S:
            self._layers_s = now_s
            layers = obstacle_view(self._services)
            if layers != self._layers:
                self._layers = layers
                self._offer("obstacles", {"obstacles": layers})
        if now_s - self._scan_s >= SCAN_S:
            self._scan_s = now_s
            self._offer("scan", {"scan": scan_view(self._services)})

    def _offer(self, kind: str, content: dict[str, Any]) -> None:
        body = text_of(kind, content)
        for listener in self._listeners:
            listener.offer(kind, body)


def text_of(kind: str, content: dict[str, Any]) -> Body:
    """Return a frame's JSON but for its opening brace and seq."""
    text = json.dumps({"kind": kind, **content}, ensure_ascii=False, separators=(",", ":"))
    return text[1:]


def _stands(services: Services) -> bool:
    """Say whether the robot neither moves nor is about to, as the bridge says and measures."""
    status = services.robot.status
    if status is None:
        return True
    turning, going = abs(status.measured.w_radps), abs(status.measured.v_mps)
    return status.mode not in _DRIVEN and going <= STILL_MPS and turning <= STILL_RADPS


_DRIVEN = frozenset({Mode.ACTIVE, Mode.TELEOP, Mode.STOPPING})


def _turning_point(services: Services) -> tuple[Any, ...]:
    status = services.robot.status
    if status is None:
        return ()
    return (status.boot, status.mode, status.epoch, status.held, status.owner)


class SightNews:
    """Decide when a sight is worth telling a page anew, by the one told last."""

    def __init__(self, services: Services) -> None:
        self._services = services
        self._told: Sight | None = None
        self._version = 0
        self._told_s = float("-inf")

    def due(self, now_s: float) -> bool:
        """Return whether to tell now; a yes counts as told."""
        eyes = self._services.eyes
        sight = eyes.sight
        if sight is self._told or not now_s - self._told_s >= SIGHT_S:
            return False
        told = self._told
        same = told is not None and eyes.version == self._version and _alike(told, sight)
        if same and not now_s - self._told_s >= SAME_S:
            return False
        self._told, self._version, self._told_s = sight, eyes.version, now_s
        return True


def _alike(before: Sight, now: Sight) -> bool:
    if before.blind != now.blind or (before.look is None) != (now.look is None):
        return False
    return before.look is None or now.look is None or _same_boxes(before.look, now.look)


def _same_boxes(before: LookSnapshot, now: LookSnapshot) -> bool:
    if before.here != now.here or len(before.detections) != len(now.detections):
        return False
    pairs = zip(before.detections, now.detections, strict=True)
    return all(
        a.label == b.label
        and a.color == b.color
        and all(abs(x - y) <= TREMBLE_PX for x, y in zip(a.box, b.box, strict=True))
        for a, b in pairs
    )
