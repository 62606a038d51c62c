"""Run reducer, link, helpers and journal on the event loop: one round after the other.

Reacts to each fact as it comes, and sends at once. Holds the loop for no longer than one
reduction; brain and router run beside, the journal in its thread. The reducer decides all. Time
(:class:`Clocks`), disk and link are given to it, tasks are those of the running event loop: the
lockstep harness turns the rounds itself, on a clock, a disk and an event loop of its own.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Coroutine
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from planner.bridge_client import Link, LinkError
from planner.bridge_client.bridge_status import at_rest
from planner.mission.api_view import Progress, goal_of, progress_of
from planner.mission.clocks import Clocks, Collector, WaypointLatency
from planner.mission.effects import AskRoute, ClearHold, Effect, GoalChange, Journal, SayAloud
from planner.mission.engine import Engine, Leg, Output, WayAhead
from planner.mission.errors import MissionError
from planner.mission.event_hub import Hub
from planner.mission.events import Command, Event, Journalled, Restarted, Sighted, Tick
from planner.mission.journal_sync import Disk
from planner.mission.perception_requests import EyeDoor, EyeNeeds, Wording, warm_up
from planner.mission.reducer import asked_about_picture
from planner.mission.scan_sender import Surveyor
from planner.mission.state import GoalKey, MissionState, Rules
from planner.mission.tasks import Answers, MissionTasks, call_nothing
from planner.mission.transitions import refusal
from planner.navigation import RouteResult
from planner.skills import Eyesight
from wire import OpRequest, Status, Waypoints

if TYPE_CHECKING:
    from planner.brain.image_questions import Looker
    from planner.mission.perception_requests import Spent
    from planner.mission.scan_sender import ScanSender
    from planner.mission.tasks import Recaller, RouteService, Think, ToolCaller
    from planner.perception.interfaces import Eyes
    from planner.perception.snapshot import Sight
    from planner.skills.perception import PictureLimits
    from wire import CameraConfig

TICK_S = 0.1
AHEAD_M = 6.0
"""Of the way, on which somebody who comes is seen."""
STATUS_NEWS_S = 0.2
"""Statuses are told to listeners at 5 Hz, and at once when mode, epoch or hold change."""


class Loop:
    """Own what runs between ``start`` and ``close``."""

    def __init__(
        self, engine: Engine, link: Link, disk: Disk, clocks: Clocks, surveyor: Surveyor
    ) -> None:
        self.hub, self.accepted = Hub(), WaypointLatency()
        self._engine, self._link, self._disk, self._clocks = engine, link, disk, clocks
        self._collector = Collector()
        self._key_now: GoalKey | None = None
        self._helpers: MissionTasks | None = None
        self._wording: Wording | None = None
        self._task: asyncio.Task[None] | None = None
        self._broken: BaseException | None = None
        self._ticked_s = self._told_s = float("-inf")
        self._told: tuple[object, ...] = ()
        self._progress: Progress | None = None
        self._eyes: Eyes | None = None
        self.door = EyeDoor(None)
        self._needs = EyeNeeds()
        self._acts: dict[str, OpRequest] = {}
        self._surveyor = surveyor
        self.obstacles: ScanSender | None = None
        """Shows scans to the route search."""
        self.call_tool: ToolCaller = call_nothing

    @property
    def book(self) -> MissionState:
        """Return the book as it stands."""
        return self._engine.book

    @property
    def status_age_s(self) -> float:
        """Return how old the newest status is [s]; inf before any came."""
        heard = self._link.status
        return heard.age_s if heard is not None else float("inf")

    @property
    def leg(self) -> Leg | None:
        """Return the leg that is driven now."""
        return self._engine.leg

    @property
    def failure(self) -> BaseException | None:
        """Return the error that ended the loop, if one did."""
        task = self._task
        if task is None or not task.done() or task.cancelled():
            return None
        return task.exception()

    @property
    def trouble(self) -> str | None:
        """Return why the journal can't be written, or None."""
        return self._disk.trouble

    def see(self, eyes: Eyes, looker: Looker | None, camera: CameraConfig) -> None:
        """Take the eyes, and the model that may be asked about their pictures."""
        self._eyes = eyes
        self.door.see(eyes, looker)
        self._wording = Wording(eyes.classes, self._spawn, self._seen_anew)
        eyesight = Eyesight(camera, eyes.classes, model=looker is not None)
        self._engine.book = replace(self._engine.book, eyes=eyesight, sight=eyes.sight)
        eyes.listen(self._on_sight)

    def bound_search(self, pictures: PictureLimits, spent: Spent) -> None:
        """Bound one search by the vision model; ``spent`` tells what a goal's calls have cost."""
        self.door.spent = spent
        self._engine.book = replace(self.book, eyes=replace(self.book.eyes, pictures=pictures))

    def way_ahead(self) -> WayAhead | None:
        """Return the way from the robot on; None while it is to stand."""
        return self._engine.way_ahead(AHEAD_M)

    async def start(
        self,
        think: Think,
        router: RouteService,
        rules: Rules,
        *,
        freeze: bool,
        rounds: bool,
        recall: Recaller,
    ) -> tuple[GoalKey, ...]:
        """Take up the journal and begin; return the idempotency keys it kept.

        Args:
            think: understands sentences.
            router: finds ways.
            rules: bound what goals may do by themselves.
            freeze: take the garbage collector over.
            rounds: turn the rounds; else whoever owns the clock calls ``hear`` and ``tick``.
            recall: asks memory.

        Raises:
            ConfigError: the journal holds what this version can't read.
        """
        self._engine.book = replace(self.book, rules=rules)
        kept = await self._disk.open(self._on_safe)
        await asyncio.to_thread(warm_up, self.book.facts, self.book.eyes.classes)
        answers = Answers(
            self.event, self._on_routed, self._link.obstacles, self._break,
            lambda ask: self.call_tool(ask),  # noqa: PLW0108  # set later
        )  # fmt: skip
        self._helpers = MissionTasks(think, router, answers, self.door, recall)
        offset_s = self._clocks.wall() - self._clocks.monotonic()
        local_s = float(time.localtime().tm_gmtoff)
        self.event(Restarted(kept.missions, kept.queue, offset_s, local_s))
        if freeze:
            self._collector.freeze(self._clocks.monotonic())
        if rounds:
            self._task = asyncio.get_running_loop().create_task(self._pump(), name="missions")
        return kept.keys

    async def close(self) -> None:
        """End everything; goals that ran come back paused in the next process."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        if self._helpers is not None:
            await self._helpers.close()
        await self._disk.close()
        self.hub.close()
        self._collector.thaw()

    def event(self, event: Event, key: GoalKey | None = None) -> None:
        """Take an event and do what follows from it; ``key`` is written with its entry."""
        self._key_now = key
        self._carry(self._engine.event(event, self._clocks.monotonic()))
        self._key_now = None

    async def wait_written(self) -> None:
        """Wait until all that happened so far is on disk.

        Raises:
            JournalDown: it was not within 3 s.
        """
        await self._disk.wait(self.book.written)

    def obey(self, command: Command) -> MissionError | None:
        """Obey a command at once, or return why it can't be obeyed."""
        error = refusal(self.book, command)
        if error is None:
            self.event(command)
        return error

    def keep_act(self, goal_id: str, act: OpRequest | None) -> None:
        """Keep a person's ``op/resume`` for a goal until its plan is accepted, or the goal ends."""
        if act is not None:
            self._acts[goal_id] = act

    def clear_hold(self, act: OpRequest | None) -> None:
        """Bring a person's ``op/resume`` to the bridge, beside everything else."""
        if act is not None:
            self._spawn(self._resume(act))

    def _spawn(self, work: Coroutine[Any, Any, None]) -> None:
        if self._helpers is not None:
            self._helpers.spawn(work)

    async def _resume(self, act: OpRequest) -> None:
        try:
            answer = await self._link.operate("resume", act)
        except LinkError as error:
            self.hub.publish({"type": "act", "accepted": False, "code": error.code})
            return
        self.hub.publish({"type": "act", "accepted": answer.accepted, "code": answer.code})

    async def _pump(self) -> None:
        while True:
            self.hear()
            now_s = self._clocks.monotonic()
            if now_s - self._ticked_s >= TICK_S:
                self._ticked_s = now_s
                self.tick()
            await asyncio.sleep(self._clocks.poll_s)

    def hear(self) -> None:
        """Take what the bridge said since the last round, and answer it.

        Raises:
            BaseException: what broke beside the loop; nothing may go on after it.
        """
        if self._broken is not None:
            raise self._broken
        status, now_s = self._link.poll(), self._clocks.monotonic()
        if status is not None:
            self._carry(self._engine.status(status, now_s))
            self._tell_status(status, now_s)
        if (said := self._link.nav2()) is not None:
            self._carry(self._engine.nav2(said, now_s))

    def tick(self) -> None:
        """Let the missions look at the clock, and do what is to be done now and then."""
        self.event(Tick())
        if self.obstacles is not None and self.obstacles.report is not None:
            movers = self.obstacles.report.movers
            self._surveyor.note_movers(movers, self._clocks.monotonic())
        told = self._surveyor.survey(self.book, self.leg, self._clocks.monotonic())
        if told is not None:
            self.event(told)
        if self.obstacles is not None and (seen := self.obstacles.due()) is not None:
            self._spawn(self.obstacles.show(seen, self.event))
        for event in self._link.events():
            self.hub.publish({"type": "bridge", "event": event.model_dump(mode="json")})
        newest = self.book.status
        standing = newest is None or at_rest(newest)
        self._collector.maybe(self._clocks.monotonic(), standing=standing)

    def _tell_status(self, status: Status, now_s: float) -> None:
        news = (status.mode, status.epoch, status.held, status.owner)
        if news != self._told or now_s - self._told_s >= STATUS_NEWS_S:
            self._told, self._told_s = news, now_s
            self.hub.publish({"type": "status", "status": status})
            self._tell_progress()

    def _tell_progress(self) -> None:
        """Tell the rest of the running step where it changed; the record shows it, too."""
        progress = progress_of(self.book)
        if progress is not None and progress != self._progress:
            self.hub.publish({"type": "progress", **progress})
        self._progress = progress

    def _on_safe(self, entry: int) -> None:
        try:
            self.event(Journalled(entry))
        except Exception as error:
            self._break(error)
            raise

    def _break(self, error: BaseException) -> None:
        """End the loop with an error that came up beside it."""
        self._broken = error

    def _on_routed(self, ask: AskRoute, result: RouteResult | None, failure: str | None) -> None:
        points = result.points if result is not None else None
        floor, faces = (result.floor, result.faces) if result is not None else (None, None)
        now_s = self._clocks.monotonic()
        self._carry(self._engine.take_route(ask, points, failure, now_s, floor, faces))

    def _carry(self, output: Output) -> None:
        """Send first, then do the rest in order."""
        self._link.send(output.messages)
        for message in output.messages:
            if isinstance(message, Waypoints) and message.points:
                goal, now_s = message.mission, self._clocks.monotonic()
                if (took_s := self.accepted.first_waypoint(goal, now_s)) is not None:
                    first = {"type": "first_waypoint", "goal": goal, "seconds": took_s}
                    self.hub.publish(first)
        for effect in output.effects:
            self._do(effect)
        self._needs.tell(self.book, self._eyes)
        if self._helpers is not None:
            self._helpers.await_answer(asked_about_picture(self.book))

    def _seen_anew(self) -> None:
        """Take what the eyes said last once more: their classes can be read now."""
        if self._eyes is not None:
            self._on_sight(self._eyes.sight)

    def _on_sight(self, sight: Sight) -> None:
        if self._eyes is None or self._wording is None:
            return
        try:
            self.event(Sighted(sight, self._wording.of(self._eyes.classes)))
        except Exception as error:
            self._break(error)
            raise

    def _do(self, effect: Effect) -> None:
        match effect:
            case Journal():
                self._disk.write(effect, self._key_now)
                self._key_now = None
            case ClearHold():
                self.clear_hold(self._acts.pop(effect.id, None))
            case SayAloud():
                language = self.book.missions[effect.id].language.value
                said = {"goal": effect.id, "text": effect.text, "language": language}
                self.hub.publish({"type": "say", **said})
            case GoalChange():
                if effect.id in self.book.missions:
                    if self.book.missions[effect.id].has_ended:
                        self._acts.pop(effect.id, None)
                    goal = goal_of(self.book, self.book.missions[effect.id]).model_dump(mode="json")
                    self.hub.publish({"type": "goal", "goal": goal})
            case _:
                if self._helpers is not None:
                    self._helpers.help(effect)
