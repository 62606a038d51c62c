"""Build one planner: choose the concrete parts, start them in order, end them in reverse."""

from __future__ import annotations

import asyncio
import logging
import os
import signal
from contextlib import asynccontextmanager
from dataclasses import dataclass
from functools import cached_property
from time import monotonic, time_ns
from typing import TYPE_CHECKING

from planner.api import Access, build, warm_up
from planner.brain import ThinkRequest
from planner.brain_factory import brain_of, collector_of, model_of
from planner.bridge_client import Link, WireBus
from planner.budget import purse_of
from planner.language.semantic_parser.parser import load_network
from planner.memory import MemoryLimits, MemoryStore, Recollection, SightingRecorder
from planner.mission import JournalSync, MissionJournal, Missions, Rules
from planner.mission.goal_history import GoalHistory
from planner.mission.memory_lookup import step_kind
from planner.navigation import RouteLimits, RouteWorker
from planner.orders.factory import standing_orders_of
from planner.people import People
from planner.perception.object_store import ThingStore
from planner.perception_factory import Opening, eyes_of, looker_of, picture_limits, spent_by
from planner.plan_display import PlanDisplay
from planner.rehearsal import Rehearser
from planner.rehearsal_drive import RehearsalDrives
from planner.robot_service import LinkedRobot
from planner.settings import load_settings
from planner.settings_desk import SettingsDesk
from planner.setup_switch import ProcessSwitch, switches_of
from planner.setup_wizard import SetupWizard
from planner.site import FenceProposals, KnownPlaces, Site, TaughtPlaces
from planner.site.marks import marks_path
from planner.skill_files.folder import SkillFolder
from planner.skill_files.keep import SkillKeeper
from planner.skills.spatial_relations import support_of
from planner.spoken_replies import SpokenReplies
from planner.state_database import open_sound
from planner.tool_servers import ToolDesk
from planner.traces import traces_of
from planner.voice import VoiceAbilities
from planner.voice_factory import VoiceParts
from planner.watching import PlannerFigures
from processes.service import Service
from wire import RobotDescription, fingerprint, load_robot
from wire.keys import PLAN_VIEW, Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import AsyncIterator
    from pathlib import Path

    from fastapi import FastAPI


log = logging.getLogger(__name__)

WATCH_S = FEED_S = 0.5


@dataclass(frozen=True, slots=True)
class PlannerPaths:
    """Say where this planner's files are."""

    home: Path
    robot: Path
    site: Path
    may_set_up: bool = False
    """Who started this planner starts set-up in its place when it asks for that."""
    may_take_robot: bool = False
    """Who started this planner changes over to the home's own robot.toml when it asks for that."""
    may_map: bool = False
    """Who started this planner changes over to a map that grows, and back, when it asks."""


class Planner:
    """Hold the parts of one planner; the services behind its routes."""

    _warming: asyncio.Task[None] | None = None

    def __init__(self, where: PlannerPaths) -> None:
        """Load everything and take the planner's place in the home folder.

        Raises:
            ConfigError, SiteError: robot.toml, settings.toml or the site is wrong, or a planner
                runs here.
        """
        self._switches = switches_of(where.may_set_up, where.may_take_robot, where.may_map)
        self.setup, self.take_robot, self.change_map, self.restart = self._switches
        self.settings = load_settings(where.home, os.environ)
        self._where, self._state = where, open_sound(where.home)
        self.people, self.tools = People(self._state), ToolDesk(self.settings.tools, self._state)
        self.budget = purse_of(self.settings, where.home, self._state)
        self.replies = collector_of(self.settings)
        self._model = model_of(self.settings, where.home, self.budget, self.replies, self.tools)
        self.description: RobotDescription = load_robot(where.robot)
        self.site = Site.load(where.site)
        self.brain = brain_of(self._model, self.settings)
        self.fences = FenceProposals.in_home(where.home, self._state)
        self._session = open_session(Party.PLANNER, self.description.id, where.home)
        self.budget.prepare()
        self._journal = MissionJournal.in_home(where.home)
        self.history = GoalHistory.in_home(where.home)
        drawn = marks_path(where.home, self.site.map_id)
        limits = RouteLimits.of(self.description, self._speed_mps)
        self._router = RouteWorker(self.site.folder, self.site.map_id, limits, drawn)
        taught = TaughtPlaces.in_home(where.home, self._state)
        radius_m = self.description.base.radius_m
        self.memory = KnownPlaces(self.site, taught, radius_m=radius_m, marks=drawn)
        if self._model is not None:
            self._model.warm(self.memory.vocabulary)
        self._voice = VoiceParts(self.settings, self.memory)
        self.memory.listen(self._voice.learn_names)
        self.ears, self.speaker = self._voice.recogniser(), self._voice.speaker
        link = self._open_link()
        self.robot = LinkedRobot(link, self.description, self._speed_mps)
        self.detector = Opening(self.settings.vision, self.description)
        self._opening: asyncio.Task[None] | None = None
        worker = self.detector.worker
        self.eyes = eyes_of(
            worker, self.settings.vision, link, self._session,
            self.description, self.site,
            ThingStore.in_home(where.home, self.site.map_id, self._state),
        )  # fmt: skip
        self.goals = Missions(
            site=self.memory,
            robot=self.description,
            link=link,
            router=self._router,
            brain=self.brain,
            disk=JournalSync(self._journal),
        )
        self.orders = standing_orders_of(self.settings.orders, where.home, self._state, self.goals)
        self.goals.show_scans(self._router)
        self._begin_memory(where.home)
        self.goals.see(self.eyes, looker_of(self._model, self.brain, worker))
        self.goals.loop.bound_search(picture_limits(self.settings), spent_by(self.budget))

    def _open_link(self) -> Link:
        ros2 = self.description.ros2
        has_nav2 = ros2 is not None and ros2.nav2 is not None
        return Link(WireBus(self._session, nav2=has_nav2), self.description)

    @property
    def thrown_switch(self) -> ProcessSwitch | None:
        """Return by what this planner is to end, for another start to take its place."""
        return next((each for each in self._switches if each.is_thrown), None)

    @property
    def _speed_mps(self) -> float:
        """Return the robot's own speed limit, or the owner's below it."""
        return self.settings.limits.lower_speed(self.description.limits.max_speed_mps)

    @cached_property
    def settings_desk(self) -> SettingsDesk:
        """Show and change settings.toml; what is in force is what this planner began with."""
        return SettingsDesk(
            self._where.home, os.environ, self.settings, self._state,
            robot_mps=self.description.limits.max_speed_mps,
            adopt=lambda saved: self.budget.adopt(saved.budget),
        )  # fmt: skip

    @cached_property
    def wizard(self) -> SetupWizard:
        """Lead the owner of an empty home to a robot that knows its rooms."""
        where, site = self._where, self.site.folder
        return SetupWizard(
            where.home, self.description, site, lambda: self.memory, robot_file=where.robot
        )

    @cached_property
    def rehearser(self) -> Rehearser:
        """Show plans before they move, by the route search of drives."""
        where, ways = self.memory, self._router
        book, points = lambda: self.goals.loop.book, self.robot.obstacles
        return Rehearser(where, self.description, ways, book, points)

    @cached_property
    def rehearsal_drives(self) -> RehearsalDrives:
        """Drive plans in the simulator, in a process of its own while one is driven."""
        goals, eyes = self.goals, self.eyes
        return RehearsalDrives(
            self.rehearser, self.memory, self.description,
            lambda: None if goals.obstacles is None else goals.obstacles.report,
            lambda: eyes.sight.things,
        )  # fmt: skip

    @property
    def voice(self) -> VoiceAbilities:
        """Show what is heard and spoken."""
        return self._voice.abilities()

    def _begin_memory(self, home: Path) -> None:
        """Let what the eyes see and what people tell and teach be remembered."""
        self.goals.repeats.find_older = self.history.find_key
        keep, names = self.memory.keep_skills, lambda: self.memory.vocabulary
        self.skills = SkillFolder(home, names, lambda read: keep(read.skills))
        self.goals.commands.skills = SkillKeeper(self.skills)
        limits = MemoryLimits(**self.settings.memory.model_dump())
        self.recollection = Recollection(MemoryStore(self._state, limits))
        self.recorder = SightingRecorder(
            self.recollection, self.site.map_id,
            support=support_of, step=lambda: step_kind(self.goals.loop.book),
        )  # fmt: skip
        self.eyes.listen(self.recorder.take)
        self.recollection.flush_by(self.recorder.flush)
        self.recollection.listen(self._on_forgotten)
        self.goals.remember_by(self.recollection)
        self.goals.loop.call_tool = self.tools.answer

    def _on_forgotten(self, things: tuple[str, ...] | None) -> None:
        """Let the eyes forget what memory has: it comes back when it is seen again."""
        self.recorder.drop(things)
        for thing in (None,) if things is None else things:
            self.eyes.forget(thing)

    @cached_property
    def figures(self) -> PlannerFigures:
        """Return the counters of this planner."""
        return PlannerFigures(monotonic)

    def fence_is_old(self) -> bool:
        """Say whether the bridge holds what the site's fence.json has become since our start."""
        status, mine = self.robot.status, self.site.fence.fence_hash
        if status is None or status.fence_hash == mine:
            return False
        try:
            data = (self.site.folder / "fence.json").read_bytes()
        except OSError:
            return False
        return fingerprint(data) == status.fence_hash

    async def start(self) -> None:
        """Start the route process, then the missions; the detector's opens beside them."""
        self._opening = asyncio.create_task(self.detector.open(), name="open detector")
        await self._router.start()
        self._voice.start()
        await self.goals.start(freeze=True, rules=Rules(**self.settings.mission.model_dump()))
        loop = self.goals.loop
        loop.hub.join(SpokenReplies(self.speaker))
        loop.hub.join(self.figures)
        self.budget.on_settled.append(self.figures.model_call)
        if (traces := traces_of(self.description.id, time_ns)) is not None:
            loop.hub.join(traces)
            self.budget.on_settled.append(traces.model_call)
        if self.description.ros2 is not None:
            shown = self._session.publisher(PLAN_VIEW)
            places = self.memory
            loop.hub.join(PlanDisplay(shown, lambda: loop.leg, lambda: places.places, monotonic))
        await self.skills.start()
        await self.tools.start()
        await self.eyes.start()
        await self.recorder.start(self.eyes.sight.things)
        await self.orders.keeper.start()
        if self._model is not None:
            request = ThinkRequest(text="hello", vocabulary=self.memory.vocabulary)
            self._warming = asyncio.create_task(self._model.warm_up(request), name="warm up model")

    async def close(self) -> None:
        """End all parts; goals that ran come back paused in the next process."""
        await self.rehearsal_drives.close()
        await self.orders.keeper.close()
        await self.skills.close()
        await self.tools.close()
        await self.recorder.close()
        await self.eyes.close()
        await self.goals.close()
        for begun in (self._opening, self._warming):
            if begun is not None:
                begun.cancel()
                await asyncio.gather(begun, return_exceptions=True)
        await self.detector.worker.close()
        await self._router.close()
        await self._voice.close()
        if self._model is not None:
            await self._model.close()
        self.budget.close()
        self._state.close()
        self._journal.close()
        self._session.close()


def application(planner: Planner, access: Access, authority: bytes = b"") -> FastAPI:
    """Return the application that runs this planner while it serves."""

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        await planner.start()
        watch = asyncio.create_task(_end_with(planner))
        service = Service()
        service.ready()
        feeding = asyncio.create_task(_feed(service), name="feed the watchdog")
        reading = asyncio.create_task(asyncio.to_thread(load_network), name="load the reader")
        try:
            yield
        finally:
            feeding.cancel()
            reading.cancel()
            service.stopping()
            watch.cancel()
            await planner.close()
            service.close()

    app = build(planner, access, lifespan, authority=authority)
    warm_up(app)
    return app


async def _feed(service: Service) -> None:
    """Tell who supervises this process that its loop turns: one that hangs is started again."""
    while True:
        service.feed(monotonic())
        await asyncio.sleep(FEED_S)


async def _end_with(planner: Planner) -> None:
    """End the process when the mission loop has: a planner that can't drive must not look alive.

    And when the bridge holds the fence that now lies on the disk, and this planner an older one:
    whoever supervises it starts it anew, with the map's costs worked out for that fence.
    """
    while (failure := planner.goals.loop.failure or planner.orders.keeper.failure) is None:
        if planner.detector.refused is not None:
            log.critical("the detector that is set can't be used: %s", planner.detector.refused)
            break
        if planner.thrown_switch is not None:
            log.warning("leaving, so that %s", planner.thrown_switch.why)
            break
        if await asyncio.to_thread(planner.fence_is_old):
            log.warning("fence_changed: leaving, so that the next start routes by the new fence")
            break
        await asyncio.sleep(WATCH_S)
    else:
        log.critical("the mission loop ended", exc_info=failure)
    signal.raise_signal(signal.SIGTERM)
