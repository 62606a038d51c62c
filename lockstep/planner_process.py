"""Be the planner's process, one turn per tick: its real shell, on a simulated clock.

``planner.mission.Missions`` runs here as it does on a robot. Given to it are what a process has of
its surroundings: the bus, an event loop on ticks (``tick_loop``), brain and router that answer a
fixed number of ticks later, and a disk that outlives this object, so that a kill loses what was not
yet written and no more.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

from lockstep.latencies import TICK_S
from lockstep.marked_router import note_places, routers_of
from lockstep.tick_loop import TickLoop
from planner.bridge_client import Link, LinkError, StopResult, WireBus
from planner.language.sentence import parse
from planner.mission import Clocks, Missions
from planner.mission.journal import JournalContents
from planner.mission.perception_requests import nothing_spent
from planner.mission.state import GoalKey
from planner.navigation.frontier import FrontierMemory
from planner.skills.perception import PictureCost, PictureLimits
from wire import VIRTUAL_KEY, MarksFile, MarksRequest, OpKind, OpRequest, sign_marks, signed_request
from wire.fence import fence_text

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from typing import Any

    from lockstep.bus import Port
    from lockstep.latencies import Pace
    from lockstep.parts import WorldEyes
    from lockstep.scene import LockstepScene
    from planner.brain import Brain, ThinkRequest, ThinkResult
    from planner.brain.image_questions import Looker
    from planner.brain.streamed_draft import Hear
    from planner.mission.effects import Journal
    from planner.mission.event_hub import Message
    from planner.mission.state import Mission, MissionState
    from planner.navigation import ObstacleReport, RouteRequest, RouteResult, ScanObservation
    from planner.navigation.obstacle_memory import ObstacleMemory
    from planner.navigation.router import Router
    from planner.plan import BrainTag, GoToPose, Language
    from sim import SimRobot
    from wire import Answer, Status
    from wire.session import Session

PICTURES = PictureLimits(24, PictureCost(2100))
"""Of one search by a vision model, where a test has one."""
WALL_OFFSET_S = 1_700_000_000.0
"""A fixed calendar, so that two runs write the same records."""


@dataclass(slots=True)
class Notebook:
    """Hold what is on disk: what was written survives the planner."""

    missions: dict[str, Mission] = field(default_factory=dict)
    queue: tuple[str, ...] = ()
    keys: dict[str, GoalKey] = field(default_factory=dict)


@dataclass(slots=True)
class NotebookDisk:
    """Be one planner's disk: an entry is on it a fixed time after it was handed over."""

    notebook: Notebook
    delay_s: float
    safe: int = 0
    on_safe: Callable[[int], None] | None = None
    trouble: str | None = None

    async def open(self, on_safe: Callable[[int], None]) -> JournalContents:
        """Return what the planners before have written."""
        self.on_safe, book = on_safe, self.notebook
        return JournalContents(tuple(book.missions.values()), book.queue, tuple(book.keys.values()))

    def write(self, entry: Journal, key: GoalKey | None = None) -> None:
        """Have an entry written."""
        asyncio.get_running_loop().call_later(self.delay_s, self._write_down, entry, key)

    async def wait(self, entry: int) -> None:
        """Wait until an entry is written."""
        while self.safe < entry:  # noqa: ASYNC110  # a tick is the finest time that there is
            await asyncio.sleep(TICK_S)

    async def close(self) -> None:
        """Nothing is open."""

    def _write_down(self, entry: Journal, key: GoalKey | None) -> None:
        self.notebook.missions.update({mission.id: mission for mission in entry.missions})
        self.notebook.queue = entry.queue
        if key is not None:
            self.notebook.keys[key.key] = key
        self.safe = entry.entry
        if self.on_safe is not None:
            self.on_safe(entry.entry)


@dataclass(slots=True)
class PacedBrain:
    """Answer as a brain does, a fixed time later."""

    brain: Brain
    delay_s: float

    @property
    def tag(self) -> BrainTag:
        """Return the brain's own."""
        return self.brain.tag

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the brain's thought; raises what it raises."""
        brain = self.brain
        await asyncio.sleep(self.delay_s)
        return await brain.think(request, hear)


@dataclass(slots=True)
class PacedRouter:
    """Find ways in this process, a fixed time later."""

    newest: Callable[[], Router]
    delay_s: float
    memory: ObstacleMemory
    frontiers: FrontierMemory = field(default_factory=FrontierMemory)

    async def route(self, request: RouteRequest) -> RouteResult:
        """Find the way, or raise ``RouteFailure``."""
        await asyncio.sleep(self.delay_s)
        time = asyncio.get_running_loop().time
        return self.newest().route(request, time, self.memory, self.frontiers)

    async def observe(self, seen: ScanObservation) -> ObstacleReport:
        """Take a scan into the obstacle layer."""
        await asyncio.sleep(self.delay_s)
        return self.newest().observe(self.memory, seen)


@dataclass(slots=True)
class Request:
    """Follow one request to the bridge to its verdict."""

    task: asyncio.Task[Any]

    @property
    def answer(self) -> Answer | StopResult | None:
        """Return the verdict; None where there is none yet, or will be none."""
        if not self.task.done():
            return None
        verdict: Answer | StopResult | None = self.task.result()
        silent = isinstance(verdict, StopResult) and not verdict.is_echoed
        return None if silent else verdict


class PlannerProcess:
    """Compose the planner's shell, and turn it."""

    def __init__(
        self,
        scene: LockstepScene,
        port: Port,
        brain: Brain,
        pace: Pace,
        notebook: Notebook,
        planner_id: str,
        new_goal_id: Callable[[], str],
        now_s: float,
    ) -> None:
        self.planner_id = planner_id
        self.said: list[str] = []
        self._port, self._pace = port, pace
        self._count = 0
        self._eyes: WorldEyes | None = None
        self._tasks = TickLoop(now_s)  # type: ignore[abstract]  # what needs threads or sockets
        self._brain = PacedBrain(brain, pace.brain * TICK_S)
        self._link = Link(
            WireBus(cast("Session", port), nav2=scene.robot.ros2 is not None),
            scene.robot,
            clock=self._tasks.time,
            new_id=self._new_id,
        )
        self.obstacle_memory = scene.router.new_memory()
        newest = routers_of(scene)
        router = PacedRouter(newest, pace.route * TICK_S, self.obstacle_memory)
        self.missions = Missions(
            site=scene.site,
            robot=scene.robot,
            link=self._link,
            router=router,
            brain=self._brain,
            disk=NotebookDisk(notebook, pace.journal * TICK_S),
            planner_id=planner_id,
            clocks=Clocks(self._tasks.time, self._wall_s, new_goal_id),
        )
        note_places(newest, self.missions.memory)
        self.missions.show_scans(router)
        self.missions.loop.hub.join(self)
        self.run(now_s, self.missions.start(rounds=False))

    @property
    def book(self) -> MissionState:
        """Return where everything stands."""
        return self.missions.loop.book

    @property
    def status(self) -> Status | None:
        """Return the newest status that this planner has."""
        return self._link.status.value if self._link.status else None

    @property
    def waits(self) -> bool:
        """Tell whether a route, a plan, the disk or an answer is still to come."""
        return self._tasks.busy

    @property
    def link(self) -> Link:
        """Return the planner's way to the bridge."""
        return self._link

    def think_with(self, brain: Brain) -> None:
        """Let this brain turn sentences into plans."""
        self._brain.brain = brain

    def see_with(self, eyes: WorldEyes, looker: Looker | None = None) -> None:
        """Use these eyes from now on, and this model to ask about their pictures."""
        if self._eyes is not eyes:
            self._link.tell(eyes)
        self._eyes = eyes
        self._tasks.do(self._tasks.time(), lambda: self._see(eyes, looker))

    def _see(self, eyes: WorldEyes, looker: Looker | None) -> None:
        self.missions.see(eyes, looker)
        self.missions.loop.bound_search(PICTURES, nothing_spent)

    def leave(self) -> None:
        """Be gone, as after SIGKILL."""
        self._port.close()

    def turn(self, now_s: float) -> None:
        """Hear, judge, answer, and carry out what is due."""
        loop, tasks = self.missions.loop, self._tasks
        if self._port.bus.tick % self._pace.planner_hears == 0:
            tasks.do(now_s, loop.hear)
        tasks.do(now_s, tasks.fire)
        if self._port.bus.tick % self._pace.planner_tick_period == 0:
            tasks.do(now_s, loop.tick)

    def look(self, sim: SimRobot, now_s: float) -> None:
        """Let the eyes take their turn, where there are some."""
        eyes, tick = self._eyes, self._port.bus.tick
        if eyes is not None:
            self._tasks.do(now_s, lambda: eyes.turn(sim, tick, now_s))

    # What a person does -------------------------------------------------------------------------

    def run(self, now_s: float, work: Coroutine[Any, Any, Any]) -> Request:
        """Start something, a command of ``missions``, and raise what it raises at once."""
        task = self._tasks.do(now_s, lambda: self._tasks.create_task(work))
        if task.done():
            task.result()
        return Request(task)

    def say(self, text: str, language: Language | None, now_s: float) -> None:
        """Take a sentence by the planner's own door; a person's act comes with it, as by the API.

        Raises:
            MissionError: it was refused.
        """
        act = self._act_behind(text)
        self.run(now_s, self.missions.submit(text, language=language, act=act))

    def go(self, points: tuple[GoToPose, ...], now_s: float) -> None:
        """Take points of the map by the planner's own door, with a person's act."""
        self.run(now_s, self.missions.points.give(points, act=self._sign("resume")))

    def draw(self, marks: MarksFile, now_s: float) -> Request:
        """Put marks in force: the bridge first, then the routes, as the API does."""
        return self.run(now_s, self._draw(marks))

    async def _draw(self, marks: MarksFile) -> Answer | None:
        text, status, request_id = fence_text(marks), self.status, self._new_id()
        if status is None:
            return None
        proof = sign_marks(VIRTUAL_KEY, status.robot, status.nonce, request_id, text)
        request = MarksRequest(id=request_id, source="api", marks=text, proof=proof)
        answer = await self._link.offer_marks(request)
        if answer.accepted:
            await self.missions.memory.keep_marks(marks)
        return answer

    def answer(self, goal_id: str, text: str, now_s: float) -> None:
        """Take the answer to a goal's question. Raises MissionError where it takes none."""
        act = self._act_behind(text)
        self.run(now_s, self.missions.answer(goal_id, text, act=act))

    def stop(self, source: str, now_s: float) -> Request:
        """Stop through the API: the bridge and the missions both hear it."""
        return self.run(now_s, self.missions.stop(source))

    def resume(self, goal_id: str, now_s: float) -> None:
        """Go on with a goal; a hold of the bridge is cleared as the API's handler does."""
        status = self.status
        held = status is not None and status.held is not None
        act = self._sign("resume") if held else None
        self.run(now_s, self.missions.resume(goal_id, act=act))

    def operate(self, kind: OpKind, now_s: float) -> Request | None:
        """Sign for a virtual drive and ask until answered; None before the first status."""
        request = self._sign(kind)
        return None if request is None else self.run(now_s, self._ask(kind, request))

    # What the hub tells -------------------------------------------------------------------------

    def offer(self, message: Message) -> None:
        """Note what is said aloud."""
        if message[1]["type"] == "say":
            self.said.append(message[1]["text"])

    def close(self) -> None:
        """Nothing is kept open for the hub."""

    # Inside -------------------------------------------------------------------------------------

    async def _ask(self, kind: OpKind, request: OpRequest) -> Answer | None:
        try:
            return await self._link.operate(kind, request)
        except LinkError:
            return None

    def _act_behind(self, text: str) -> OpRequest | None:
        """Return the resume that comes with a sentence, where it may lead to motion."""
        return None if parse(text).stays_put else self._sign("resume")

    def _sign(self, kind: OpKind) -> OpRequest | None:
        status = self.status
        if status is None:
            return None
        return signed_request(VIRTUAL_KEY, kind, status, "api", self._new_id())

    def _new_id(self) -> str:
        self._count += 1
        return f"{self.planner_id}-{self._count}"

    def _wall_s(self) -> float:
        return self._tasks.time() + WALL_OFFSET_S
