"""Be the planner's process, one turn per tick: its real engine, bus, brain and router.

What takes time there (brain, route, disk) answers here a fixed number of ticks later. The journal
is a notebook that outlives this object, so that a kill loses what was not yet written and no more.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from heapq import heappop, heappush
from typing import TYPE_CHECKING, cast

from planner.bridge_client import Identity, WireBus
from planner.bridge_client.scan_to_map import points_in_map
from planner.language.utterance import parse
from planner.mission.allowed_commands import refusal
from planner.mission.effects import (
    AskBrain,
    AskEyes,
    AskRoute,
    ClearHold,
    DropBrain,
    Journal,
    SayAloud,
)
from planner.mission.engine import Engine, Output
from planner.mission.events import Cancel, Event, Restarted, Sighted, Stopped, Submitted, Tick, Told
from planner.mission.known_places import KnownPlaces
from planner.mission.plan_request import thinker
from planner.mission.planner_commands import PlannerCommands
from planner.mission.reception import receive
from planner.mission.site_view import facts_of
from planner.mission.skills import Answer, Eyesight, Way
from planner.mission.state import Mission, MissionState
from planner.navigation import RouteFailure, RouteRequest
from tools.lockstep.request_retry import Request, RequestRetry
from tools.lockstep.run_coroutine import at_once
from wire import VIRTUAL_KEY, OpKind, Scan, Status, Stop, signed_request

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.brain import Brain
    from planner.mission.errors import MissionError
    from planner.mission.events import Command
    from planner.perception.snapshot import Sight
    from planner.plan import Language
    from tools.lockstep.bus import Port
    from tools.lockstep.eyes import PerceptionProcess
    from tools.lockstep.latencies import Pace
    from tools.lockstep.scene import Scene
    from wire.session import Session

WALL_OFFSET_S = 1_700_000_000.0
"""A fixed calendar, so that two runs write the same records."""


@dataclass(slots=True)
class Notebook:
    """Be the disk: what was written survives the planner."""

    missions: dict[str, Mission] = field(default_factory=dict)
    queue: tuple[str, ...] = ()

    def write(self, entry: Journal) -> None:
        """Write one entry."""
        self.missions.update({mission.id: mission for mission in entry.missions})
        self.queue = entry.queue


class PlannerProcess:
    """Connect the mission engine to the bus."""

    def __init__(
        self,
        scene: Scene,
        port: Port,
        brain: Brain,
        pace: Pace,
        notebook: Notebook,
        planner_id: str,
        now_s: float,
    ) -> None:
        self.planner_id = planner_id
        self._eyes: PerceptionProcess | None = None
        self.said: list[str] = []
        self._scene, self._port, self._pace = scene, port, pace
        self._memory, self._now_s = KnownPlaces(scene.site), now_s
        self._notebook = notebook
        self.think_with(brain)
        self._bus = WireBus(cast("Session", port))
        self._insistence = RequestRetry(pace)
        self._later: list[tuple[int, int, Callable[[float], Output]]] = []
        self._count = 0
        self._status: Status | None = None
        self._scan: Scan | None = None
        robot, site = scene.robot, scene.site
        identity = Identity(planner_id, robot.hash, scene.fence_hash, site.map_id)
        self.engine = Engine(MissionState(facts_of(site)), identity)
        kept = tuple(notebook.missions.values())
        self._do(self.engine.event(Restarted(kept, notebook.queue, WALL_OFFSET_S), now_s))

    @property
    def status(self) -> Status | None:
        """Return the newest status that this planner has."""
        return self._status

    @property
    def waits(self) -> bool:
        """Tell whether a route, a plan, the disk or an answer is still to come."""
        return bool(self._later) or self._insistence.asks

    def think_with(self, brain: Brain) -> None:
        """Let this brain turn sentences into plans."""
        self._brain = brain

    def see_with(self, eyes: PerceptionProcess) -> None:
        """Use these eyes from now on."""
        self._eyes = eyes
        eyesight = Eyesight(self._scene.robot.camera, eyes.classes)
        self.engine.book = replace(self.engine.book, eyes=eyesight, sight=eyes.sight)

    def leave(self) -> None:
        """Be gone, as after SIGKILL."""
        self._port.close()

    def turn(self, now_s: float) -> None:
        """Hear, judge, answer, and carry out what is due."""
        self._now_s, tick = now_s, self._port.bus.tick
        self._scan = self._bus.scan() or self._scan
        status = self._bus.status()
        if status is not None:
            self._status = status
            self._insistence.hear(status)
            self._do(self.engine.status(status, now_s))
        if self._eyes is not None:
            self._eyes.hear(self._bus.odometry(), self._bus.localization())
        while self._later and self._later[0][0] <= tick:
            self._do(heappop(self._later)[2](now_s))
        if tick % self._pace.planner_tick_period == 0:
            self._do(self.engine.event(Tick(), now_s))
        self._insistence.tick(tick)

    def sighted(self, sight: Sight, now_s: float) -> None:
        """Take what the eyes say."""
        classes = self._eyes.classes if self._eyes is not None else ()
        self._do(self.engine.event(Sighted(sight, classes), now_s))

    def event(self, event: Event, now_s: float) -> None:
        """Take a person's command."""
        self._do(self.engine.event(event, now_s))

    def say(self, goal_id: str, text: str, language: Language | None, now_s: float) -> None:
        """Take a sentence by the planner's own door: stop lane first, then missions."""
        said = parse(text)
        given = Submitted(goal_id, text, language or said.language)
        heard = receive(self.engine.book, said, given, now_s)
        if heard.stops:
            self.order_stop("api", now_s)
            self.event(heard.given, now_s)
            return
        if heard.given.resumes:
            self.operate("resume")
        self.event(heard.given, now_s)
        if heard.takes_back is not None:
            self.event(Cancel(heard.takes_back), now_s)

    def order_stop(self, source: str, now_s: float) -> Request:
        """Stop through the API: the bridge and the missions both hear it."""
        request = self.stop(source)
        self.event(Stopped(source), now_s)
        return request

    def stop(self, source: str) -> Request:
        """Say stop until it is echoed."""
        message = Stop(id=self._new_id("stop"), source=source)
        return self._insist("stop", message.id, lambda: self._bus.send(message))

    def operate(self, kind: OpKind) -> Request | None:
        """Sign for a virtual drive and ask until answered; None before the first status."""
        status = self._status
        if status is None:
            return None
        request_id = self._new_id(kind)
        request = signed_request(VIRTUAL_KEY, kind, status, "api", request_id)
        return self._insist(kind, request_id, lambda: self._bus.ask(kind, request))

    def _insist(self, kind: str, request_id: str, say: Callable[[], None]) -> Request:
        return self._insistence.ask(kind, request_id, say, self._port.bus.tick)

    def _new_id(self, kind: str) -> str:
        self._count += 1
        return f"{self.planner_id}-{kind}-{self._count}"

    def _do(self, output: Output) -> None:
        for message in output.messages:
            self._bus.send(message)
        for effect in output.effects:
            match effect:
                case AskBrain():
                    self._in(self._pace.brain, self._thinking(effect))
                case AskRoute():
                    self._in(self._pace.route, self._routing(effect))
                case AskEyes():
                    self._in(self._pace.brain, self._telling(effect))
                case Journal():
                    self._in(self._pace.journal, self._writing(effect))
                case ClearHold():
                    self.operate("resume")
                case SayAloud():
                    self.said.append(effect.text)
                case DropBrain():
                    pass  # its answer comes and is ignored, as from a call that can't be recalled
                case _:
                    pass  # Changed: nobody listens here

    def _in(self, delay: int, act: Callable[[float], Output]) -> None:
        self._count += 1
        heappush(self._later, (self._port.bus.tick + delay, self._count, act))

    def _thinking(self, ask: AskBrain) -> Callable[[float], Output]:
        book = self.engine.book
        brain = thinker(self._brain, self._scene.vocabulary, None, book.means, book.eyes.classes)
        local = PlannerCommands(
            brain, self._memory, lambda: self.engine.book, self._obey, self._age_s
        )
        event = at_once(local.think(ask))
        return lambda now_s: self.engine.event(event, now_s)

    def _obey(self, command: Command) -> MissionError | None:
        """Obey a command that a sentence gave, or say why it can't be obeyed."""
        error = refusal(self.engine.book, command)
        if error is None:
            self.event(command, self._now_s)
        return error

    def _age_s(self) -> float:
        return self._now_s - self.engine.book.status_s

    def _telling(self, ask: AskEyes) -> Callable[[float], Output]:
        answer = Answer(failure="camera_silent") if self._eyes is None else self._eyes.answer(ask)
        event = Told(ask.id, ask.ticket, answer)
        return lambda now_s: self.engine.event(event, now_s)

    def _writing(self, entry: Journal) -> Callable[[float], Output]:
        def act(now_s: float) -> Output:
            self._notebook.write(entry)
            return self.engine.journalled(entry, now_s)

        return act

    def _routing(self, ask: AskRoute) -> Callable[[float], Output]:
        obstacles = self._seen_points() if ask.obstacles else ()

        def act(now_s: float) -> Output:
            try:
                found = self._scene.router.route(
                    RouteRequest(ask.start, ask.goal, obstacles, ask.way is Way.STRAIGHT),
                    lambda: now_s,
                )
            except RouteFailure as failure:
                return self.engine.routed(ask, None, failure.code, now_s)
            return self.engine.routed(ask, found.points, None, now_s)

        return act

    def _seen_points(self) -> tuple[tuple[float, float], ...]:
        status, scan = self._status, self._scan
        if status is None or scan is None or status.base_in_map is None:
            return ()
        return points_in_map(scan, self._scene.robot.lidar, status.base_in_map)
