"""Take goals and commands in and answer for them: the API's door to the missions.

Every call is judged against the book, journalled before it returns, and carried out by the loop. An
order to stop is judged before anything else and waits for no brain and no disk.
"""

from __future__ import annotations

import asyncio
import dataclasses
import uuid
from typing import TYPE_CHECKING, Any

from planner.brain.image_questions import Looker
from planner.brain.interface import Brain
from planner.bridge_client import Identity, Link, StopResult
from planner.language.sentence import parse
from planner.mission import events
from planner.mission.agents import is_agents, refuse_command
from planner.mission.api_view import goal_of, tell_book
from planner.mission.clocks import Clocks
from planner.mission.effects import AskBrain
from planner.mission.engine import Engine, Leg
from planner.mission.errors import NothingToResume, UnknownGoal
from planner.mission.given_points import RobotSurvey, StepGoals
from planner.mission.journal_sync import Disk
from planner.mission.loop import Loop
from planner.mission.memory_lookup import MemoryLookup
from planner.mission.plan_request import Hearing, thinker
from planner.mission.planner_commands import PlannerCommands
from planner.mission.reception import (
    Reception,
    awaits_answer,
    goal_to_resume,
    hears_stop,
    receive,
    receive_answer,
)
from planner.mission.request_keys import Repeats
from planner.mission.scan_sender import ScanObserver, ScanSender, Surveyor
from planner.mission.standing_goals import StandingGoals
from planner.mission.state import MissionState, Rules
from planner.mission.tasks import RouteAhead, RouteService
from planner.perception.interfaces import Eyes
from planner.plan import Goal, Language, Means
from planner.site import KnownPlaces, Site
from wire import OpRequest, RobotDescription

if TYPE_CHECKING:
    from planner.language.reading import ChangeReading
    from planner.memory import Recollection
    from planner.mission.event_hub import Subscription


class Missions:
    """Take goals, drive them, answer for them. See the package's door for the API."""

    def __init__(
        self,
        *,
        site: Site | KnownPlaces,
        robot: RobotDescription,
        link: Link,
        router: RouteService,
        brain: Brain,
        disk: Disk,
        planner_id: str | None = None,
        clocks: Clocks | None = None,
    ) -> None:
        """Put the parts together; ``site`` is a site, or the memory of its places."""
        self.link, self.memory = link, site if isinstance(site, KnownPlaces) else KnownPlaces(site)
        survey = RobotSurvey(link, router)
        self.memory.use(survey)
        site = self.memory.site
        self.planner_id = planner_id or f"planner-{uuid.uuid4().hex[:12]}"
        identity = Identity(self.planner_id, robot.hash, site.fence.fence_hash, site.map_id)
        engine = Engine(MissionState(self.memory.facts), identity, robot)
        self._clocks, self._robot, self._brain = clocks or Clocks(), robot, brain
        self.loop = Loop(engine, link, disk, self._clocks, Surveyor(link, robot, site.grid))
        clock, self.repeats = self._clocks.monotonic, Repeats()
        self._router = RouteAhead(router, self.loop, clock)
        self._hearing = Hearing(self.loop.hub.publish, self._router.expect, clock)
        self._lookup = MemoryLookup(self.loop, self._clocks.wall)
        self.commands = PlannerCommands(self._ask_brain, self.memory, self.loop, link, self._lookup)
        think = self.commands.think
        self.points = StepGoals(self.loop, self.memory, survey, self.repeats, self._clocks, think)
        self.standing = StandingGoals(self.loop, self._ask_brain, self.repeats)
        self.obstacles: ScanSender | None = None
        self.memory.listen(lambda: self.loop.event(events.Known(self.memory.facts)))

    def remember_by(self, recollection: Recollection) -> None:
        """Answer from this memory, and keep in it what people say."""
        self._lookup.remember_by(recollection)

    def see(self, eyes: Eyes, looker: Looker | None = None) -> None:
        """See with these eyes, and ask this model about their pictures."""
        self.loop.see(eyes, looker, self._robot.camera)

    def show_scans(self, observer: ScanObserver) -> None:
        """Show scans to the route search, which remembers what the map does not know."""
        of, ahead = (self._robot, self.memory.site.map_id, observer), self.loop.way_ahead
        self.obstacles = ScanSender(self.link, *of, ahead, self._clocks.monotonic)
        self.loop.obstacles = self.obstacles

    async def start(
        self, *, freeze: bool = False, rules: Rules | None = None, rounds: bool = True
    ) -> None:
        """Take up the journal and begin to listen to the bridge. Nothing of before goes on.

        Args:
            freeze: take the garbage collector over, which concerns the whole process.
            rules: how far a goal may go by itself.
            rounds: turn the rounds of ``loop``; else whoever owns the clock turns them.

        Raises:
            ConfigError: the journal holds what this version can't read.
        """
        kept = await self.loop.start(
            self.points.think, self._router, rules or Rules(), freeze=freeze, rounds=rounds,
            recall=self._lookup.answer,
        )  # fmt: skip
        self.repeats.recall(kept)

    async def close(self) -> None:
        """End everything; a running goal comes back paused in the next process."""
        await self.loop.close()
        await self._router.close()

    async def submit(  # noqa: PLR0913  # what a request may hold, by name
        self,
        text: str,
        *,
        language: Language | None = None,
        confirm: bool = False,
        replace: bool = False,
        idempotency_key: str | None = None,
        act: OpRequest | None = None,
        source: str = "api",
        by: str = "api",
        leaning: ChangeReading | None = None,
    ) -> Goal:
        """Take a goal in and return it, usually still in planning. An order to stop stops first.

        A plain yes or no answers the one question, plan or offer that alone can be meant.

        Args:
            text: what the person said.
            language: of ``text``; found out where not given.
            confirm: wait for a yes between plan and first step.
            replace: end the running goal once this one is understood, and go first.
            idempotency_key: the same key and request return the same goal.
            act: the person's ``op/resume``, signed, which clears the bridge's hold.
            source: whose order it is: a new one closes what a brain asked about older ones.
            by: the door that it came through, also for the bridge's record of stops.
            leaning: how it leans, where it was said as an answer: it answers nothing then.

        Raises:
            QueueFull: 33 goals are open, and none of them waits for an answer alone.
            IdempotencyConflict, ReservedKey: the key is another request's, or a standing order's.
            JournalDown: it can't be written down, so it was not taken.
            UnknownGoal: the request made a goal before that is at hand no more; the journal has it.
        """
        # A stop waits for no disk.
        if self.repeats.may_be_older(idempotency_key) and not self.hears_stop(text):
            await self.repeats.look_up(idempotency_key)
        said, goal_id = parse(text), self._clocks.new_id()
        act = None if is_agents(source) else act
        spoken, now_s = language or said.language, self._clocks.monotonic()
        given = events.Submitted(goal_id, text, spoken, confirm, replace, source=source, by=by)
        heard = receive(
            self.loop.book, said, given, now_s,
            leaning=leaning, key=idempotency_key, repeats=self.repeats,
        )  # fmt: skip
        if heard.refused is not None:
            raise heard.refused
        if heard.stops:
            return await self._stop_goal(heard.given, act)
        if heard.repeats is not None:
            return self.goal(heard.repeats)
        self.repeats.remember(heard.request)
        self._begin(heard, act)
        await self.repeats.ensure_written(self.loop, goal_id, heard.request)
        return self.goal(goal_id)

    def _begin(self, heard: Reception, act: OpRequest | None) -> None:
        given = heard.given
        if given.resumes:
            self.loop.clear_hold(act)
        else:
            for behind in (given.id, *given.asking):
                self.loop.keep_act(behind, act)
        self.loop.accepted.note(given.id, self._clocks.monotonic())
        self.loop.event(given, heard.request)
        if heard.takes_back is not None:
            self.loop.event(events.Cancel(heard.takes_back))

    def hears_stop(self, text: str) -> bool:
        """Return whether these words would stop the robot now, with any other meaning besides."""
        return hears_stop(self.loop.book, parse(text), self._clocks.monotonic())

    def awaits_answer(self) -> bool:
        """Return whether a question waits for a yes or no."""
        return awaits_answer(self.loop.book)

    async def cancel(self, goal_id: str, *, source: str = "api") -> Goal:
        """End a goal. Raises UnknownGoal, BadState; NotOwnGoal: of an agent, another's."""
        return await self._command(events.Cancel(goal_id), source=source)

    async def pause(self, goal_id: str) -> Goal:
        """Keep a goal's place, standing. Raises UnknownGoal, BadState."""
        return await self._command(events.Pause(goal_id))

    async def resume(self, goal_id: str | None = None, *, act: OpRequest | None = None) -> Goal:
        """Go on with a goal; without an id, with the one that was paused last.

        Raises UnknownGoal, BadState; NothingToResume: no id, and nothing is paused or kept waiting.
        """
        if (wanted := goal_id or goal_to_resume(self.loop.book)) is None:
            raise NothingToResume
        return await self._command(events.Resume(wanted), act)

    async def confirm(self, goal_id: str, *, act: OpRequest | None = None, by: str = "api") -> Goal:
        """Say yes to a plan. Raises UnknownGoal, BadState."""
        return await self._command(events.Confirm(goal_id, by), act)

    async def answer(
        self, goal_id: str, text: str, *, act: OpRequest | None = None, by: str = "api",
        source: str = "api",
    ) -> Goal:  # fmt: skip
        """Do what ``receive_answer`` makes of an answer, or raise its refusal."""
        now_s = self._clocks.monotonic()
        heard = receive_answer(self.loop.book, parse(text), goal_id, now_s, by, source)
        if heard.refused is not None:
            raise heard.refused
        if heard.stops:
            await self.stop(by)
            if heard.command is not None:
                self.loop.obey(heard.command)
        elif (command := heard.command) is not None:
            acts = isinstance(command, events.Reply) and not is_agents(source)
            await self._command(command, act if acts else None)
        if heard.sentence is not None:
            await self.submit(heard.sentence, act=act, by=by, leaning=heard.lean)
        return self.goal(goal_id)

    async def move(self, goal_id: str, before: str | None = None) -> Goal:
        """Put a queued goal before another, or last. Raises UnknownGoal, BadState."""
        return await self._command(events.Move(goal_id, before))

    async def stop(self, source: str = "api") -> StopResult:
        """Stop now: horizon, brains and queue at once, and the bridge until it echoes, or 2 s."""
        saying = asyncio.ensure_future(self.link.stop(source))
        await asyncio.sleep(0)  # the first stop is on the wire before anything is written
        self.loop.event(events.Stopped(source))
        return await saying

    @property
    def means(self) -> Means:
        """Return the robot's parts beyond wheels and a voice, as they are now."""
        return self.loop.book.means

    def goal(self, goal_id: str) -> Goal:
        """Return a goal. Raises UnknownGoal: there is none of that id at hand."""
        book = self.loop.book
        if goal_id not in book.missions:
            raise UnknownGoal(goal_id, tuple(book.missions))
        return goal_of(book, book.missions[goal_id])

    def goals(self, limit: int = 50) -> tuple[Goal, ...]:
        """Return goals: first all that are open, then those that ended, each newest first."""
        by_age = sorted(self.loop.book.missions.values(), key=lambda m: (m.has_ended, -m.order))
        return tuple(goal_of(self.loop.book, mission) for mission in by_age[: max(0, limit)])

    def path(self) -> Leg | None:
        """Return the leg that is driven now, with its whole path."""
        return self.loop.leg

    def subscribe(self) -> Subscription:
        """Iterate over (seq, event) from now on; take a ``snapshot`` after, and drop older seqs."""
        return self.loop.hub.subscribe()

    def snapshot(self) -> dict[str, Any]:
        """Return where everything stands, with the seq of the newest event it contains."""
        seq, goals = self.loop.hub.seq, self.goals()
        return {"seq": seq, "planner_id": self.planner_id, **tell_book(self.loop.book, goals)}

    async def _stop_goal(self, given: events.Submitted, act: OpRequest | None = None) -> Goal:
        result = await self.stop(given.by)
        act = self.link.sign_again(act)  # the stop has voided what was signed before it
        self.loop.keep_act(given.id, act if given.doubtful_stop else None)
        also = await self.commands.obey_beside_stop(given)
        self.loop.event(dataclasses.replace(given, echoed=result.is_echoed, also=also))
        return self.goal(given.id)

    async def _ask_brain(self, ask: AskBrain) -> events.Planned:
        book, find, refuse = self.loop.book, self._lookup.find_relevant, self.commands.refuse_offer
        eyes = (self.memory.vocabulary, self._hearing, book.means, book.eyes.classes)
        return await thinker(self._brain, *eyes, remember=find, refuse_offer=refuse)(ask)

    async def _command(
        self, command: events.Command, act: OpRequest | None = None, source: str = "api"
    ) -> Goal:
        if (error := refuse_command(self.loop.book, command, source)) is not None:
            raise error
        if isinstance(command, events.Resume):
            self.loop.clear_hold(act)
        else:
            self.loop.keep_act(command.id, act)
        self.loop.event(command)
        await self.loop.wait_written()
        return self.goal(command.id)
