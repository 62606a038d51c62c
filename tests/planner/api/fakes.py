"""Stand behind the routes: goals and a robot that remember what they were asked."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from planner.brain import Brain, OfflineBrain
from planner.brain.model_replies import ReplyCollector
from planner.budget import Amounts, BudgetLimits, Usage
from planner.language.stop import is_stop
from planner.memory import MemoryStore, Recollection
from planner.mission import Leg
from planner.mission.errors import BadState, UnknownGoal
from planner.mission.goal_history import GoalHistory
from planner.mission.state import MissionState
from planner.navigation import (
    ObstacleReport,
    RouteFailure,
    RoutePoint,
    RouteRequest,
    RouteResult,
    RouteSurvey,
)
from planner.people import People
from planner.perception import Picture, Sight, Thing
from planner.plan import Goal, GoalState, Language, Means, Step
from planner.rehearsal import Rehearser
from planner.rehearsal_drive import RehearsalDrives
from planner.settings import Settings
from planner.settings_desk import SettingsDesk
from planner.setup_switch import ProcessSwitch
from planner.setup_wizard import SetupWizard
from planner.site import FenceProposals, KnownPlaces, Site
from planner.skill_files.folder import SkillFolder
from planner.state_database import StateDatabase
from planner.tool_servers import ToolDesk
from planner.voice import Recognition, Sound, StopListener, VoiceAbilities, VoiceFailure
from planner.watching import PlannerFigures
from tests.planner.orders.fakes import FakeMissions, MovedClocks, site_of, standing_orders
from tests.wire.examples import STATUS
from wire import (
    Answer,
    FenceRequest,
    HintCode,
    HintVerdict,
    LocalizerStatus,
    MarksRequest,
    OpKind,
    OpRequest,
    PoseHint,
    RobotDescription,
    Status,
    TrialOrder,
    TrialState,
)


def goal(goal_id: str = "g1", text: str = "go", state: GoalState = GoalState.RUNNING) -> Goal:
    now = datetime(2026, 1, 1, tzinfo=UTC)
    return Goal(id=goal_id, text=text, language=Language.EN, state=state, created=now, updated=now)


@dataclass(frozen=True)
class StopEcho:
    """Say that the bridge has confirmed."""

    is_echoed: bool = True


@dataclass
class FakeLayers:
    """Hold a report that a test sets."""

    report: ObstacleReport | None = None


class FakeGoals:
    """Keep one goal and every call."""

    def __init__(self) -> None:
        self.calls: list[tuple[Any, ...]] = []
        self.changes: list[dict[str, Any]] = []
        self.acts: list[OpRequest | None] = []
        self.doors: list[str] = []
        self.obstacles: FakeLayers | None = None
        self.stops: list[str] = []
        self.leg: Leg | None = None
        self.asks = False
        self.means = Means(camera=True)

    @property
    def points(self) -> FakeGoals:
        return self

    async def give(
        self,
        steps: tuple[Step, ...],
        *,
        language: Language,
        confirm: bool = False,
        replace: bool = False,
        idempotency_key: str | None = None,
        act: OpRequest | None = None,
        source: str = "api",
        by: str = "api",
    ) -> str:
        self.doors.append(by)
        self.calls.append(("give", steps, language, confirm, replace, idempotency_key))
        self.acts.append(act)
        return "g1"

    def hears_stop(self, text: str) -> bool:
        return is_stop(text)

    def awaits_answer(self) -> bool:
        return self.asks

    async def submit(
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
    ) -> Goal:
        self.calls.append(("submit", text, language, confirm, replace, idempotency_key))
        self.doors.append(by)
        self.acts.append(act)
        return goal(text=text, state=GoalState.PLANNING)

    def goal(self, goal_id: str) -> Goal:
        if goal_id != "g1":
            raise UnknownGoal(goal_id, ("g1",))
        return goal()

    def goals(self, limit: int = 50) -> Sequence[Goal]:
        return [goal()][:limit]

    async def _act(self, what: str, goal_id: str) -> Goal:
        self.calls.append((what, goal_id))
        return self.goal(goal_id)

    async def cancel(self, goal_id: str, *, source: str = "api") -> Goal:
        return await self._act("cancel", goal_id)

    async def pause(self, goal_id: str) -> Goal:
        return await self._act("pause", goal_id)

    async def resume(self, goal_id: str | None = None, *, act: OpRequest | None = None) -> Goal:
        self.acts.append(act)
        return await self._act("resume", goal_id or "g1")

    async def confirm(self, goal_id: str, *, act: OpRequest | None = None, by: str = "api") -> Goal:
        self.doors.append(by)
        raise BadState(goal_id, "confirm", GoalState.RUNNING, ("awaiting_confirmation",))

    async def answer(
        self, goal_id: str, text: str, *, act: OpRequest | None = None, by: str = "api",
        source: str = "api",
    ) -> Goal:  # fmt: skip
        self.doors.append(by)
        self.acts.append(act)
        self.calls.append(("answer", goal_id, text))
        return self.goal(goal_id)

    async def move(self, goal_id: str, before: str | None = None) -> Goal:
        self.calls.append(("move", goal_id, before))
        return self.goal(goal_id)

    async def stop(self, source: str) -> StopEcho:
        self.stops.append(source)
        return StopEcho()

    def path(self) -> Leg | None:
        return self.leg

    async def subscribe(self) -> AsyncIterator[tuple[int, dict[str, Any]]]:
        for seq, change in enumerate(self.changes):
            yield seq, change
        await asyncio.Event().wait()  # a subscription ends with its listener


class FakeRobot:
    """Answer every request as told."""

    def __init__(self, status: Status | None = STATUS) -> None:
        self._status = status
        self.asked: list[tuple[OpKind, OpRequest]] = []
        self.offered: list[FenceRequest] = []
        self.drawn: list[MarksRequest] = []
        self.hints: list[PoseHint] = []
        self.hint_code: HintCode | None = "accepted"
        self.hint_score = 0.4
        self.localizer: LocalizerStatus | None = None
        self.takes_hints = True
        self.max_speed_mps = 0.5
        self.localized_map: str | None = None
        self.steers: list[tuple[str, float, float, bool]] = []
        self.names: dict[str, str] = {}
        self.driver: dict[str, str] | None = None
        self.points: list[tuple[float, float]] = []
        self.trial: TrialState | None = None
        self.trial_orders: list[TrialOrder] = []
        self.takes_trial = True
        self.verdict: Answer | None = Answer(
            id="x", kind="arm", accepted=True, code="ok", detail=""
        )

    @property
    def status(self) -> Status | None:
        return self._status

    @property
    def description(self) -> RobotDescription:
        return RobotDescription()

    def obstacles(self) -> Sequence[tuple[float, float]]:
        return self.points

    async def order_trial(self, order: TrialOrder) -> bool:
        self.trial_orders.append(order)
        return self.takes_trial

    async def hint(self, hint: PoseHint) -> HintVerdict | None:
        self.hints.append(hint)
        code = self.hint_code
        return None if code is None else HintVerdict(id=hint.id, code=code, score=self.hint_score)

    def ages_s(self) -> dict[str, float | None]:
        return {"status": 0.02, "localization": 0.1, "scan": None}

    async def ask(self, kind: OpKind, request: OpRequest) -> Answer | None:
        self.asked.append((kind, request))
        return self.verdict

    async def offer_marks(self, request: MarksRequest) -> Answer | None:
        self.drawn.append(request)
        return self.verdict

    async def offer_fence(self, request: FenceRequest) -> Answer | None:
        self.offered.append(request)
        return self.verdict

    def steer(
        self, source: str, v_mps: float, w_radps: float, *, dead_man: bool, name: str = ""
    ) -> None:
        self.steers.append((source, v_mps, w_radps, dead_man))
        self.names[source] = name


class FakeEars:
    """Hear what the test says."""

    def __init__(self) -> None:
        self.heard: Recognition | VoiceFailure = Recognition(
            "go to the kitchen", 0.9, understood=True
        )
        self.sounds: list[Sound] = []
        self.awaited: list[bool] = []
        self.listeners: list[StopListener] = []
        self.warmed = 0

    async def hear(self, sound: Sound, *, awaits_answer: bool = False) -> Recognition:
        self.awaited.append(awaits_answer)
        self.sounds.append(sound)
        if isinstance(self.heard, VoiceFailure):
            raise self.heard
        return self.heard

    def warm(self) -> None:
        self.warmed += 1

    def listen(self) -> tuple[StopListener, ...]:
        return tuple(self.listeners)


class FakeSpeech:
    """Count what would be said, and how often it was broken off."""

    def __init__(self) -> None:
        self.said: list[str] = []
        self.hushed = 0

    def say(self, text: str, language: Language) -> None:
        self.said.append(text)

    def hush(self) -> None:
        self.hushed += 1


class FakeBudget:
    """Show a meter that a test sets."""

    def __init__(self) -> None:
        self.changes = 0
        self.calls = 0
        self.asked: list[str | None] = []

    async def look(self, goal: str | None = None) -> None:
        pass

    def usage(self, goal: str | None = None) -> Usage:
        self.asked.append(goal)
        spent = Amounts(calls=self.calls, prompt_tokens=9, reply_tokens=3, seconds=0.5, money=0.1)
        most = BudgetLimits(calls=20, prompt_tokens=100, reply_tokens=50, seconds=60.0, money=None)
        return Usage(
            model="m",
            day=datetime(2026, 1, 1, tzinfo=UTC).date(),
            resets_in_s=60.0,
            currency="USD",
            today=spent,
            day_limits=most,
            goal=None if goal is None else spent,
            goal_limits=most,
            under_way=1,
            calls_since_start=self.calls,
            idle_calls=0,
        )


class FakeEyes:
    """Show the sight that a test sets."""

    def __init__(self) -> None:
        self.sight = Sight(blind="no_camera")
        self.version = 0
        self.changed_s: dict[str, float] = {}
        self.now_s = 100.0
        self.classes: tuple[str, ...] = ("person", "cup")
        self.counts = {"looks": 3}
        self.skip_counts = {"stale": 2}
        self.lag_s, self.took_s = 0.08, 0.03
        self.picture: Picture | None = None
        self.shown = 0

    async def show(self) -> Picture | None:
        self.shown += 1
        return self.picture

    def forget(self, thing_id: str | None = None) -> tuple[Thing, ...]:
        gone = tuple(t for t in self.sight.things if thing_id in (None, t.id))
        self.sight = Sight(things=tuple(t for t in self.sight.things if t not in gone))
        return gone


_FOLDER = TemporaryDirectory(prefix="pons-fakes-")
HOME = Path(_FOLDER.name)
"""A home of this process alone: what is written there, no other run reads."""


def two_room() -> Site:
    return site_of("two_room")


class StraightRoutes:
    """Find a straight way everywhere but into the kitchen."""

    async def route(self, request: RouteRequest) -> RouteResult:
        kitchen = two_room().place("kitchen")
        if kitchen is not None and request.goal == kitchen.pose:
            raise RouteFailure("no_route", "a test shut the kitchen")
        ends = [RoutePoint(p.x_m, p.y_m, 0.5) for p in (request.start, request.goal)]
        survey = RouteSurvey(0.84, (1.0, 1.0), 0.0) if request.survey else None
        return RouteResult(tuple(ends), 2.0, 0.0, False, 0.0, survey=survey)


class FakeServices:
    """Hold one of each."""

    def __init__(self, status: Status | None = STATUS) -> None:
        self.goals = FakeGoals()
        self.robot = FakeRobot(status)
        self.setup = ProcessSwitch(is_there=True)
        self.restart = ProcessSwitch(is_there=True)
        self.take_robot = ProcessSwitch(is_there=True)
        self.change_map = ProcessSwitch(is_there=True)
        self.settings_desk = SettingsDesk(HOME, {}, Settings(), StateDatabase(HOME))
        self.ears = FakeEars()
        self.speaker = FakeSpeech()
        self.voice = VoiceAbilities()
        self.budget = FakeBudget()
        self.figures = PlannerFigures(lambda: 0.0)
        self.history = GoalHistory.in_home(HOME)
        self.replies = ReplyCollector(0)
        self.eyes = FakeEyes()
        self.brain: Brain = OfflineBrain()
        self.site = two_room()
        self.memory = KnownPlaces(self.site)
        self.wizard = SetupWizard(HOME, RobotDescription(), self.site.folder, lambda: self.memory)
        self.recollection = Recollection(MemoryStore(StateDatabase(HOME)))
        self.people = People(StateDatabase(HOME))
        self.fences = FenceProposals.in_home(HOME)
        self.skills = SkillFolder(HOME, lambda: self.memory.vocabulary)
        self.tools = ToolDesk({}, StateDatabase(HOME))
        self.rehearser = Rehearser(
            self.memory,
            RobotDescription(),
            StraightRoutes(),
            lambda: MissionState(self.memory.facts, status=self.robot.status),
        )
        self.rehearsal_drives = RehearsalDrives(
            self.rehearser, self.memory, RobotDescription(), module="tests.planner.small_rehearsal"
        )
        clock = MovedClocks()
        self.orders = standing_orders(HOME, clock, FakeMissions(clock, "two_room"))
