"""Step the core and everybody around it on a fake clock: operator, lidar, localization, noise."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cache
from math import pi, tau
from typing import Any

from bridge.core import (
    EMPTY,
    CoreConfig,
    Decision,
    Inbox,
    LoopFacts,
    OperatorArrival,
    initial,
    step,
)
from bridge.core.geometry.fence import build_fence
from bridge.core.state import draft
from tests.bridge.core.fake_planner import (
    BOOT,
    FENCE_HASH,
    MAP_ID,
    PERIOD_S,
    FakeDrive,
    FakePlanner,
)
from tests.bridge.core.room import BEAMS, ranges_m
from wire import (
    IDENTITY,
    DriveCommand,
    DriveState,
    Event,
    Imu,
    Localization,
    Mode,
    OpKind,
    OpRequest,
    Pose2,
    Proof,
    RobotDescription,
    Scan,
    Status,
    Stop,
    Twist2,
    Velocity,
    compose,
    wrap,
)

ROBOT = RobotDescription()
FENCE = build_fence(MAP_ID, (((-5.5, -5.5), (5.5, -5.5), (5.5, 5.5), (-5.5, 5.5)),))


def config(robot: RobotDescription | None = None) -> CoreConfig:
    made = ROBOT if robot is None else robot
    return CoreConfig(
        robot=made,
        robot_hash=made.hash,
        fence=FENCE,
        fence_hash=FENCE_HASH,
        map_id=MAP_ID,
        boot=BOOT,
    )


@dataclass
class World:
    """Step the core and everybody around it, one period at a time."""

    core: CoreConfig = field(default_factory=config)
    now_s: float = 100.0
    drive: FakeDrive = field(default_factory=FakeDrive)
    planner: FakePlanner | None = field(default_factory=FakePlanner)
    obstacle_m: tuple[float, float, float] | None = None
    """Centre and radius of a round thing, in ``map``."""
    drive_silent: bool = False
    lidar_silent: bool = False
    lidar_frozen: bool = False
    lidar_blind: bool = False
    hidden_rad: tuple[float, float] | None = None
    """Middle and half of a sector of the lidar from which nothing comes."""
    localization_silent: bool = False
    gyro_silent: bool = False
    gyro_off_radps: float = 0.0
    """What the gyro says beside the truth."""
    odom_in_map: Pose2 = IDENTITY
    quality: float = 1.0
    recorder_ok: bool = True
    recorder_says: str = ""
    real_time: bool = True
    chance: str = ""
    """What the shell draws; the number of the tick where a test draws nothing."""
    extra: Inbox = EMPTY
    """Added to the next tick's inbox: stops, ops, teleop, rejected, loop."""
    last: Decision | None = None
    status: Status | None = None
    ticks: int = 0
    scans: int = 0
    poses: int = 0
    ids: int = 0
    events: list[Event] = field(default_factory=list)
    statuses: list[Status] = field(default_factory=list)
    inboxes: list[tuple[Inbox, float]] = field(default_factory=list)
    decisions: list[Decision] = field(default_factory=list)
    keep: bool = False
    delay_ticks: int = 2
    """How long a status takes to the planner."""
    mail: list[Status | None] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.state = initial(self.core, self.now_s)

    def fork(self) -> World:
        """Return a world that goes on from here by itself. Messages and records are shared: frozen.

        A deep copy costs 50 ms of a processor, more than most tests that begin with one.
        """
        other = copy(self)
        for name, kept in vars(self).items():
            if isinstance(kept, list):
                setattr(other, name, list(kept))
        other.drive = copy(self.drive)
        other.planner = copy(self.planner)
        other.state = draft(self.state)
        return other

    @property
    def mode(self) -> Mode:
        return self.state.mode

    def is_in(self, mode: Mode) -> bool:
        """Tell the mode now; a question, so that no type checker remembers its answer."""
        return self.state.mode is mode

    @property
    def brain(self) -> FakePlanner:
        """Return the planner of a world that has one."""
        assert self.planner is not None
        return self.planner

    @property
    def shown(self) -> Status:
        """Return the newest status."""
        assert self.status is not None
        return self.status

    @property
    def told(self) -> DriveCommand:
        """Return the command of the newest tick, where one was given."""
        assert self.last is not None
        assert self.last.command is not None
        return self.last.command

    def asked(self, kind: OpKind, *, authentic: bool = True, nonce: str | None = None) -> str:
        """Put an operator's request, take the tick and return its verdict."""
        request_id = self.op(kind, authentic=authentic, nonce=nonce)
        self.tick()
        return self.verdict(request_id)

    @property
    def sent(self) -> Twist2:
        return self.state.motion.limiter.sent

    @property
    def here(self) -> Pose2:
        return compose(self.odom_in_map, self.state.odometry.base_in_odom)

    def tick(self, period_s: float = PERIOD_S) -> Decision:
        self.now_s += period_s
        self.ticks += 1
        inbox = self._inbox()
        decision = step(self.core, self.state, inbox, self.now_s)
        if self.keep:
            self.inboxes.append((inbox, self.now_s))
            self.decisions.append(decision)
        self.state, self.last = decision.state, decision
        self.drive.hear(decision, self.now_s)
        self.events.extend(decision.events)
        self.mail.append(decision.status)
        if decision.status is not None:
            self.status = decision.status
            self.statuses.append(decision.status)
        return decision

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / PERIOD_S)):
            self.tick()

    def until(self, mode: Mode, limit_s: float = 10.0) -> None:
        for _ in range(round(limit_s / PERIOD_S)):
            if self.mode is mode:
                return
            self.tick()
        said = [f"{event.code} {event.detail}" for event in self.events[-12:]]
        raise AssertionError(f"{mode} not reached, still {self.mode}: {said}")

    def next_id(self, prefix: str) -> str:
        self.ids += 1
        return f"{prefix}{self.ids}"

    def op(self, kind: OpKind, *, authentic: bool = True, nonce: str | None = None) -> str:
        """Put an operator's request in the next tick."""
        request_id = self.next_id(kind)
        shown = self.status.nonce if self.status is not None else "none"
        proof = Proof(nonce=shown if nonce is None else nonce, mac="0" * 64)
        request = OpRequest(id=request_id, source="test", proof=proof)
        arrived = OperatorArrival(kind, request, authentic)
        self.extra = replace(self.extra, ops=(*self.extra.ops, arrived))
        return request_id

    def stop(self, stop_id: str | None = None) -> str:
        made = stop_id or self.next_id("stop")
        self.extra = replace(self.extra, stops=(*self.extra.stops, Stop(id=made, source="test")))
        return made

    def teleop(self, v: float = 0.0, w: float = 0.0, *, held: bool, source: str = "stick") -> None:
        """Put one message of a stick in the next tick."""
        status = self.status
        assert status is not None
        self.ids += 1
        velocity = Velocity(
            source_id=source,
            epoch=status.epoch,
            seq=self.ids,
            seen=status.seq,
            v_mps=v,
            w_radps=w,
            dead_man=held,
        )
        self.extra = replace(self.extra, teleop=(*self.extra.teleop, velocity))

    def late(self, late_s: float = 0.0, missed: int = 0) -> None:
        self.extra = replace(self.extra, loop=LoopFacts(late_s=late_s, missed_ticks=missed))

    def verdict(self, request_id: str) -> str:
        for answered in self.state.operator.answers:
            if answered.answer.id == request_id:
                return answered.answer.code
        raise AssertionError(f"no verdict on {request_id}")

    def rows(self) -> set[str]:
        return set(self.state.rows)

    def ready(self) -> World:
        """Bring the world to DISARMED."""
        return self._once(World._ready)

    def armed(self) -> World:
        return self.ready().arm()

    def driving(self, goal_m: tuple[float, float] = (4.0, 0.0), mission: str = "m1") -> World:
        """Arm, own, grant and come up to speed."""
        return self._once(World._driving, goal_m, mission)

    def _once(self, go: Callable[..., World], *said: object) -> World:
        """Go there; of all worlds that begin as they are made, one goes and the others fork it."""
        if self.ticks or type(self) is not World or _all_of(self) != _all_of(World(keep=self.keep)):
            return go(self, *said)
        vars(self).update(vars(_gone(go, self.keep, *said).fork()))
        return self

    def _ready(self) -> World:
        self.until(Mode.DISARMED)
        self.run(0.6)
        return self

    def _driving(self, goal_m: tuple[float, float], mission: str) -> World:
        return self.armed().drive_to(goal_m, mission)

    def arm(self) -> World:
        request_id = self.op("arm")
        self.tick()
        assert self.verdict(request_id) == "ok"
        self.run(0.04)  # until the status shows the new epoch
        return self

    def drive_to(self, goal_m: tuple[float, float], mission: str = "m1") -> World:
        assert self.planner is not None
        self.planner.mission, self.planner.goal_m = mission, goal_m
        self.until(Mode.ACTIVE)
        self.run(1.5)
        assert self.mode is Mode.ACTIVE
        return self

    def _inbox(self) -> Inbox:
        extra, self.extra = self.extra, EMPTY
        state = self.drive.tick(self.now_s)
        said: dict[str, Any] = {
            "recorder_ok": self.recorder_ok,
            "recorder_says": self.recorder_says,
            "real_time": self.real_time,
            "chance": self.chance or f"{self.ticks:016x}",
        }
        if not self.drive_silent:
            said["drive"] = (state,)
        if not self.gyro_silent:
            said["imu"] = self._gyro(state)
        if self.ticks % 10 == 3 and not self.lidar_silent:
            said["scan"] = self._scan()
        if self.ticks % 10 == 6 and not self.localization_silent:
            said["localization"] = self._localization()
        if self.planner is not None:
            late = self.mail.pop(0) if len(self.mail) >= self.delay_ticks else None
            said |= self.planner.says(late, self.now_s)
        return Inbox(**said) if extra is EMPTY else replace(extra, **said)

    def _gyro(self, state: DriveState) -> Imu:
        base = self.core.robot.base
        turn = (state.right_radps - state.left_radps) * base.wheel_radius_m
        return Imu(
            boot_id="g0",
            seq=self.ticks,
            stamp_s=self.now_s,
            yaw_rate_radps=turn / base.wheel_separation_m + self.gyro_off_radps,
            accel_x_mps2=0.0,
            accel_y_mps2=0.0,
        )

    def _localization(self) -> Localization:
        self.poses += 1
        return Localization(
            odom_id=BOOT,
            seq=self.poses,
            stamp_s=self.now_s,
            odom_in_map=self.odom_in_map,
            quality=self.quality,
            map_id=MAP_ID,
        )

    def _scan(self) -> Scan:
        if not self.lidar_frozen:
            self.scans += 1
        self.frozen_at = getattr(self, "frozen_at", None)
        here = self.here if not self.lidar_frozen else (self.frozen_at or self.here)
        self.frozen_at = here
        noise = 1e-6 * self.scans
        seen = (r + noise for r in ranges_m(here, self.obstacle_m))
        angles = (index * tau / BEAMS - pi for index in range(BEAMS))
        shows = [not self.lidar_blind and not self._hides(angle) for angle in angles]
        return Scan(
            boot_id="l0",
            seq=self.ticks,
            stamp_s=self.now_s,
            angle_min_rad=-pi,
            angle_increment_rad=tau / BEAMS,
            range_min_m=0.12,
            range_max_m=20.0,
            ranges_m=tuple(
                r if r <= 20.0 and shown else None for r, shown in zip(seen, shows, strict=True)
            ),
        )

    def _hides(self, angle_rad: float) -> bool:
        """Tell whether a beam lies in the hidden sector."""
        if self.hidden_rad is None:
            return False
        middle_rad, half_rad = self.hidden_rad
        return abs(wrap(angle_rad - middle_rad)) <= half_rad


def _all_of(world: World) -> tuple[dict[str, object], ...]:
    """Return all that makes a world what it is, with what a test put beside the fields."""
    return vars(world), vars(world.drive), vars(world.planner) if world.planner else {}


@cache
def _gone(go: Callable[..., World], keep: bool, *said: object) -> World:
    return go(World(keep=keep), *said)
