"""Stand in for bridge, router and site: small, deterministic, without wheels or physics.

The bridge here keeps the wire's word (owner, epoch, held, grant, leg latched standing) and moves
the robot along the horizon it was sent, at 0.5 m/s, in steps of one status.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import ceil, hypot
from typing import Any

from planner.mission.state import Mission
from planner.navigation import RoutePoint
from planner.plan import Bilingual, Goal, Outcome
from planner.site.site_view import SiteView, Target
from wire import (
    IDENTITY,
    PROTOCOL,
    Action,
    Answer,
    BrakingReport,
    DriveReport,
    Event,
    Grant,
    GrantLeft,
    Heartbeat,
    HeldReason,
    Hello,
    LegReport,
    LimitsInForce,
    Localization,
    LocalizerStatus,
    Mode,
    Nav2State,
    Odometry,
    OpKind,
    OpRequest,
    Owner,
    Pose2,
    Record,
    RowReport,
    Scan,
    StandingHold,
    Status,
    Stop,
    TickStats,
    TrialState,
    Twist2,
    Velocity,
    Waypoint,
    Waypoints,
)

HASH = "0" * 16
PERIOD_S = 0.05


AT_REST: dict[str, Any] = {
    "protocol": PROTOCOL, "robot": "r1", "boot": "b1", "seq": 1, "at_s": 0.0, "mode": Mode.HOLD,
    "action": Action.NONE, "epoch": "b1-1", "nonce": "n1", "owner": None, "held": None,
    "grant": None, "leg": None, "base_in_odom": Pose2(0.0, 0.0, 0.0),
    "base_in_map": Pose2(0.0, 0.0, 0.0), "asked": Twist2(0.0, 0.0), "sent": Twist2(0.0, 0.0),
    "measured": Twist2(0.0, 0.0),
    "limits": LimitsInForce(v_mps=0.5, w_radps=1.0, by="max_speed", free_m=None),
    "rows": (), "answers": (), "waiting_for": (), "blocked": False, "robot_hash": HASH,
    "fence_hash": HASH, "map_id": HASH, "operator_metres": 500.0, "operator_seconds": 3600.0,
    "drive": DriveReport(kind="sim", virtual=True, enabled=True, timed_out=False,
                         boot_id="d1", battery=None, real_time=False),
    "braking": BrakingReport(lag_s=0.06, decel_mps2=1.0, learnt=False, stops=0, trouble=None),
    "ticks": TickStats(ticks=0, missed=0, late_p50_us=0, late_max_us=0, step_max_us=0,
                       dropped=0, record_gaps=0),
}  # fmt: skip
"""Frozen parts, made once: hours of statuses are told in these tests."""


def status(**changes: Any) -> Status:
    """Return a status of an armed robot that stands at the origin, with changes."""
    return Status(**{**AT_REST, **changes})


def row(name: str, action: Action = Action.HOLD2, *, binding: bool = True) -> RowReport:
    """Return one row that is up."""
    return RowReport(row=name, action=action, for_s=1.0, evidence="", binding=binding)


def room(place: str, x_m: float, y_m: float = 0.0) -> Target:
    """Return a room of 2 x 2 m around a point."""
    box = ((x_m - 1, y_m - 1), (x_m + 1, y_m - 1), (x_m + 1, y_m + 1), (x_m - 1, y_m + 1))
    return Target(place, True, Bilingual(en=place, zh=place), Pose2(x_m, y_m, 0.0), box)


FACTS = SiteView(
    {
        "hall": room("hall", 0.0),
        "kitchen": room("kitchen", 4.0),
        "dock": Target("dock", False, Bilingual(en="dock", zh="充电桩"), Pose2(0.0, 0.5, 1.0)),
    },
    home="dock",
)


def outcome_of(goal: Mission | Goal) -> Outcome:
    """Return what a goal has come to, or asks."""
    assert goal.outcome is not None
    return goal.outcome


def straight(start: Pose2, goal: Pose2, speed_mps: float = 0.5) -> tuple[RoutePoint, ...]:
    """Return a straight route, points 0.1 m apart."""
    length_m = hypot(goal.x_m - start.x_m, goal.y_m - start.y_m)
    count = max(1, ceil(length_m / 0.1))
    return tuple(
        RoutePoint(
            start.x_m + (goal.x_m - start.x_m) * i / count,
            start.y_m + (goal.y_m - start.y_m) * i / count,
            speed_mps,
        )
        for i in range(count + 1)
    )


@dataclass
class FakeBridge:
    """Be the bridge, one status at a time; also the ``Bus`` of a link."""

    mode: Mode = Mode.HOLD
    epoch: int = 1
    boot: str = "b1"
    owner: str | None = None
    held: StandingHold | None = None
    granted: str | None = None
    leg: LegReport | None = None
    pose: Pose2 = IDENTITY
    odom_m: float = 0.0
    rows: tuple[RowReport, ...] = ()
    blocked: bool = False
    limited_by: str = "max_speed"
    localized: bool = True
    deaf: bool = False
    seq: int = 0
    horizon: Waypoints | None = None
    heard: list[Record] = field(default_factory=list)
    dropped: list[Record] = field(default_factory=list)
    moved_epochs: list[str] = field(default_factory=list)
    answers: tuple[Answer, ...] = ()
    pending: Status | None = None
    last_owner: str | None = None
    ahead: list[Waypoint] = field(default_factory=list)

    @property
    def epoch_name(self) -> str:
        return f"{self.boot}-{self.epoch}"

    @property
    def waypoints(self) -> list[Waypoints]:
        return [m for m in self.heard if isinstance(m, Waypoints)]

    def turn(self) -> None:
        self.epoch += 1
        self.granted, self.horizon = None, None
        if self.leg is not None:
            self.leg = self.leg.model_copy(update={"following": False})

    def lose_owner(self) -> None:
        self.owner = None
        self.turn()

    def hold(self, reason: HeldReason, held_id: str = "h1") -> None:
        self.turn()
        self.held = StandingHold(reason=reason, id=held_id)
        self.mode = Mode.HOLD

    def reboot(self) -> None:
        self.boot = self.boot + "x"
        self.owner, self.held, self.leg, self.mode = None, None, None, Mode.DISARMED
        self.turn()

    def hear(self, message: Record) -> None:
        """Take one command, as the wire's law says."""
        if self.deaf:
            return
        self.heard.append(message)
        match message:
            case Stop():
                if not any(a.id == message.id for a in self.answers):
                    self.hold(HeldReason.STOP, message.id)
                    self._answer(message.id, "stop")
            case Hello() if self.owner is None and self.horizon is None:
                if self.last_owner not in (None, message.planner_id):
                    self.hold(HeldReason.NEW_PLANNER, message.planner_id)
                self.owner = self.last_owner = message.planner_id
            case Grant() if self._current(message) and self.held is None:
                if self.mode in (Mode.HOLD, Mode.ACTIVE):
                    self.granted = message.mission
                    self.rows = tuple(shown for shown in self.rows if shown.row != "BUDGET")
            case Waypoints() if self._current(message) and self.granted == message.mission:
                self._follow(message)
            case Heartbeat() | Hello():
                pass
            case _:
                self.dropped.append(message)

    def ask(self, kind: OpKind, request: OpRequest) -> None:
        if self.deaf or any(a.id == request.id for a in self.answers):
            return
        if kind == "resume":
            self.held = None
        if kind == "arm":
            self.held, self.mode = None, Mode.HOLD
            self.turn()
        self._answer(request.id, kind)

    def step(self) -> Status:
        """Move on by one status."""
        self.seq += 1
        speed_mps = self._move() if self._moving() else 0.0
        if self.mode is Mode.ACTIVE and self.horizon is None:
            self.mode = Mode.HOLD
        self.pending = status(
            seq=self.seq,
            boot=self.boot,
            epoch=self.epoch_name,
            mode=self.mode,
            owner=Owner(planner_id=self.owner, kind="planner") if self.owner else None,
            held=self.held,
            grant=GrantLeft(mission=self.granted, metres=50.0, seconds=500.0)
            if self.granted
            else None,
            leg=self.leg,
            base_in_map=self.pose if self.localized else None,
            base_in_odom=Pose2(self.odom_m, 0.0, 0.0),
            measured=Twist2(speed_mps, 0.0),
            rows=self.rows,
            blocked=self.blocked,
            limits=LimitsInForce(v_mps=0.5, w_radps=1.0, by=self.limited_by, free_m=None),
            answers=self.answers[-16:],
        )
        return self.pending

    def _current(self, message: Grant | Waypoints) -> bool:
        return message.planner_id == self.owner and message.epoch == self.epoch_name

    def _answer(self, request_id: str, kind: str) -> None:
        answer = Answer(id=request_id, kind=kind, accepted=True, code="ok", detail="")
        self.answers = (*self.answers, answer)

    def _follow(self, message: Waypoints) -> None:
        if not message.points:
            self.horizon = None
            return
        same = self.leg is not None and (self.leg.mission, self.leg.leg) == (
            message.mission,
            message.leg,
        )
        if same and self.leg is not None and self.leg.reached:
            return
        self.horizon, self.ahead = message, list(message.points)
        self.mode = Mode.ACTIVE
        self.leg = LegReport(mission=message.mission, leg=message.leg, following=True,
                             reached=False, residual_m=0.0, residual_rad=0.0,
                             refusal=None)  # fmt: skip

    def _moving(self) -> bool:
        return self.mode is Mode.ACTIVE and self.horizon is not None and not self.blocked

    def _move(self) -> float:
        horizon = self.horizon
        if horizon is None or not horizon.points or self.leg is None:
            return 0.0
        left_m = 0.5 * PERIOD_S
        before = self.pose
        while self.ahead:
            point = self.ahead[0]
            gap_m = hypot(point.x_m - self.pose.x_m, point.y_m - self.pose.y_m)
            if gap_m > left_m:
                share = left_m / gap_m
                x_m = self.pose.x_m + share * (point.x_m - self.pose.x_m)
                y_m = self.pose.y_m + share * (point.y_m - self.pose.y_m)
                self.pose = Pose2(x_m, y_m, 0.0)
                break
            self.pose, left_m = Pose2(point.x_m, point.y_m, 0.0), left_m - gap_m
            del self.ahead[0]
        moved_m = hypot(self.pose.x_m - before.x_m, self.pose.y_m - before.y_m)
        self.odom_m += moved_m
        if moved_m > 0.0:
            self.moved_epochs.append(self.epoch_name)
        end = horizon.points[-1]
        if horizon.final and hypot(end.x_m - self.pose.x_m, end.y_m - self.pose.y_m) < 0.05:
            self.leg = self.leg.model_copy(update={"reached": True, "following": False})
            if end.heading_rad is not None:
                self.pose = Pose2(self.pose.x_m, self.pose.y_m, end.heading_rad)
            self.horizon, self.mode = None, Mode.HOLD
            return 0.0
        return moved_m / PERIOD_S

    # The bus of a link ---------------------------------------------------------------------------

    def status(self) -> Status | None:
        pending, self.pending = self.pending, None
        return pending

    def nav2(self) -> Nav2State | None:
        return None

    def localizer(self) -> LocalizerStatus | None:
        return None

    def localization(self) -> Localization | None:
        return None

    def trial(self) -> TrialState | None:
        return None

    def odometry(self) -> Odometry | None:
        return None

    def scan(self) -> Scan | None:
        return None

    def events(self) -> tuple[Event, ...]:
        return ()

    def send(self, message: Record) -> None:
        self.hear(message)

    def steer(self, velocity: Velocity) -> None:
        self.heard.append(velocity)
