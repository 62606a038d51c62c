"""Be a planner's surroundings without a robot: what it plans is taken in, and nothing is driven.

The planner's own shell on a simulated clock, as in every world here. The bridge says that an armed
robot stands where it was put, and echoes stops. What a goal set going is ended by ``settle``.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from lockstep.bus import LockstepBus
from lockstep.goal_handle import GoalHandle
from lockstep.latencies import TICK_S, Pace, ticks
from lockstep.planner_process import Notebook, PlannerProcess
from lockstep.scene import folder_of, scene
from lockstep.world import STAND_IN_ROBOT, START_S, TooLong
from planner.mission.follow_up import way_back_of
from planner.plan import GoalState
from planner.site.site_view import facts_of
from tools.lockstep.eyes import PerceptionProcess
from tools.lockstep.truth_detector import TruthFinder
from wire import (
    PROTOCOL,
    Action,
    Answer,
    BrakingReport,
    DriveReport,
    LimitsInForce,
    Mode,
    Pose2,
    Status,
    Stop,
    TickStats,
    Twist2,
)
from wire.keys import STATUS, STOP, Party

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from planner.brain import Brain
    from planner.brain.image_questions import Looker
    from planner.mission.state import Mission

PACE = Pace(planner_bridge=(0, 0), brain=0, route=10_000, journal=0)
"""No way is ever found: a drive that is under way stays so."""
STATUS_TICKS = 5
ASIDE_M = 0.7
"""A side of a thing is not worked out here: so far from it the robot stands then."""
_OPEN = (GoalState.QUEUED, GoalState.RUNNING, GoalState.PAUSED)
_ECHO = Answer(id="stop", kind="stop", accepted=True, code="accepted", detail="")
_NONE, _STILL = "0" * 16, Twist2(0.0, 0.0)


class StandingWorld:
    """Hold one planner, and a bridge that only ever says where the robot stands."""

    def __init__(self, *, site: Path | str, brain: Brain) -> None:
        """Put the parts together, and let the planner hear where the robot is."""
        self.scene = scene(folder_of(site), STAND_IN_ROBOT)
        self.bus = LockstepBus(1, {})
        bridge = self.bus.port(Party.BRIDGE)
        self._statuses, self._stops = bridge.publisher(STATUS), bridge.subscriber(STOP)
        facts = facts_of(self.scene.site)
        self._pose = facts.targets[facts.home].pose
        self._facts, self._goals, self._seq = facts, 0, 0
        self.planner = PlannerProcess(
            self.scene, self.bus.port(Party.PLANNER), brain, PACE, Notebook(), "planner-1",
            self._new_goal_id, self.now_s,
        )  # fmt: skip
        self.run(0.2)

    @property
    def now_s(self) -> float:
        """Return the time on every part's monotonic clock [s]."""
        return START_S + self.bus.tick * TICK_S

    def open_eyes(self, looker: Looker | None = None) -> PerceptionProcess:
        """Give the planner eyes to which no picture ever comes."""
        eyes = PerceptionProcess(self.scene, TruthFinder(self.scene.robot.camera, 1))
        self.planner.see_with(eyes, looker)
        return eyes

    def think_with(self, brain: Brain) -> None:
        """Let another brain turn sentences into plans from now on."""
        self.planner.think_with(brain)

    def say(self, text: str) -> GoalHandle:
        """Give a goal in words."""
        self.planner.say(text, None, self.now_s)
        return self.goal(f"goal-{self._goals}")

    def goal(self, goal_id: str) -> GoalHandle:
        """Follow a goal that was given before."""
        return GoalHandle(goal_id, lambda: self.planner.book)

    def answer(self, goal: GoalHandle, text: str) -> None:
        """Answer a goal's question."""
        self.planner.answer(goal.id, text, self.now_s)

    def run(self, seconds: float) -> None:
        """Let simulated time pass [s]."""
        for _ in range(ticks(seconds)):
            self._tick()

    def run_until(self, done: Callable[[StandingWorld], object], limit_s: float) -> None:
        """Let time pass until something holds.

        Raises:
            TooLong: it did not hold within the limit.
        """
        for _ in range(ticks(limit_s)):
            if done(self):
                return
            self._tick()
        raise TooLong(f"not within {limit_s} simulated seconds")

    def settle(self, stays: str | None) -> None:
        """Have all that is open be done, and the robot where it led; a goal that ``stays`` runs."""
        book = self.planner.book
        missions, running = dict(book.missions), book.running if stays is not None else None
        for id_, mission in missions.items():
            if mission.state not in _OPEN:
                continue
            runs = stays is not None and (id_ == stays or mission.state is GoalState.RUNNING)
            state = GoalState.RUNNING if runs else GoalState.SUCCEEDED
            if runs:
                running = running or id_
            else:
                self._pose = self._pose_after(mission)
            missions[id_] = mission.model_copy(update={"state": state})
        engine = self.planner.missions.loop._engine  # noqa: SLF001  # nobody else may end a goal
        engine.book = replace(book, missions=missions, running=running, queue=(), activity=None)

    def _pose_after(self, mission: Mission) -> Pose2:
        """Return where a goal that was done has led, as far as its steps name places."""
        pose, back = self._pose, way_back_of(mission)
        for step in mission.steps:
            place = self._facts.home if step.kind == "return_home" else step.place
            place = step.places[-1] if step.places else place
            if step.kind == "come_back":
                pose = Pose2(*back) if back is not None else pose
            elif step.kind != "recall" and (target := self._facts.targets.get(place or "")):
                aside_m = ASIDE_M if step.kind == "stand_at" else 0.0
                at = target.pose
                pose = Pose2(at.x_m + aside_m, at.y_m + aside_m, at.yaw_rad)
        return pose

    def _new_goal_id(self) -> str:
        self._goals += 1
        return f"goal-{self._goals}"

    def _tick(self) -> None:
        self.bus.tick += 1
        stops = self._stops.drain().items
        if stops or self.bus.tick % STATUS_TICKS == 0:
            self._seq += 1
            answers = tuple(
                _ECHO.model_copy(update={"id": s.id}) for s in stops if isinstance(s, Stop)
            )
            self._statuses.put(self._status(answers))
        self.planner.turn(self.now_s)

    def _status(self, answers: tuple[Answer, ...]) -> Status:
        """Return the status of an armed robot that stands."""
        return Status(
            protocol=PROTOCOL, robot="r1", boot="b1", seq=self._seq, at_s=self.now_s,
            mode=Mode.HOLD, action=Action.NONE, epoch="b1-1", nonce="n1", owner=None, held=None,
            grant=None, leg=None, base_in_odom=self._pose, base_in_map=self._pose, asked=_STILL,
            sent=_STILL, measured=_STILL,
            limits=LimitsInForce(v_mps=0.5, w_radps=1.0, by="max_speed", free_m=None), rows=(),
            answers=answers, waiting_for=(), blocked=False, robot_hash=_NONE, fence_hash=_NONE,
            map_id=_NONE, operator_metres=500.0, operator_seconds=3600.0,
            drive=DriveReport(kind="sim", virtual=True, enabled=True, timed_out=False,
                              boot_id="d1", battery=None, real_time=False),
            braking=BrakingReport(lag_s=0.06, decel_mps2=1.0, learnt=False, stops=0, trouble=None),
            ticks=TickStats(ticks=0, missed=0, late_p50_us=0, late_max_us=0, step_max_us=0,
                            dropped=0, record_gaps=0),
        )  # fmt: skip
