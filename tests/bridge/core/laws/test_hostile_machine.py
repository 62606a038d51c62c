"""Let hypothesis choose who misbehaves and how, rule by rule, and hold each tick to the laws.

Unlike a script by seed, a run that breaks a law shrinks to the few rules that it takes. The world
around goes on as it should; every rule makes one part of it lie, or sends one hostile message.
"""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from bridge.core import BridgeState, Decision, Inbox, LoopFacts, RejectedAt, step
from tests.bridge.core import oracle
from tests.bridge.core.hostile import KEYS, OPS, Hostile
from tests.bridge.core.laws.test_step_laws import check
from tests.bridge.core.reached import STARTS, reached
from tests.bridge.core.scripted import World
from wire import DecodeFailure, Mode, OpKind, Waypoint

COMING = ("hellos", "grants", "heartbeats", "waypoints", "teleop", "external", "stops", "ops")
STOP_S = 0.15 + 0.75 + 0.2
"""Ramp of the faster wheel from its limit at 1 m/s2, the jerk's time, and half a dozen ticks."""
starts = st.sampled_from(sorted(STARTS))
seeds = st.integers(0, 2**20)


class Bridge(RuleBasedStateMachine):
    """Be the bridge and everybody around it."""

    BUSY: ClassVar[set[Mode]] = {Mode.ACTIVE, Mode.TELEOP}

    def __init__(self) -> None:
        super().__init__()
        self.world = World()
        self.past: list[Inbox] = []
        self.left_s: float | None = None
        self.first_metres: dict[str, float] = {}

    @initialize(start=starts)
    def begin(self, start: str) -> None:
        self.world = reached(start)

    def tick(self, ticks: int = 1, period_s: float = 0.01) -> None:
        """Take ticks, each held to the laws."""
        for _ in range(ticks):
            before, sent = self.world.state, self.world.extra
            decision = self.world.tick(period_s)
            if sent != Inbox():
                self.past = [*self.past[-6:], sent]
            check(self.world, before, decision)
            self.judge(before, decision)

    def judge(self, before: BridgeState, decision: Decision) -> None:
        """Assert what needs more than one step's memory."""
        after, now_s = decision.state, self.world.now_s
        if after.mode in self.BUSY:
            self.left_s = None
        elif self.left_s is None:
            self.left_s = now_s
        elif now_s - self.left_s > STOP_S and after.now_s - before.now_s <= 0.02:
            assert oracle.rim_mps(after.motion.limiter.sent) == 0.0, "the ramp must be over"
        worst = oracle.worst(set(after.rows), before.source)
        if oracle.ORDER.index(worst) >= 2 and before.mode in self.BUSY and not after.held:
            assert after.mode not in self.BUSY, f"{worst} acts, and it drives on"
        grants = after.grants
        if grants.mission is not None:
            first = self.first_metres.setdefault(grants.mission, grants.metres)
            assert grants.metres <= first + 1e-9, "no grant adds to what is left"

    @rule(ticks=st.integers(1, 40))
    def time_passes(self, ticks: int) -> None:
        self.tick(ticks)

    @rule(gap_s=st.sampled_from([0.0, 0.004, 0.03, 0.099, 0.101, 0.35, 2.0]))
    def the_host_stalls(self, gap_s: float) -> None:
        self.tick(1, gap_s)

    @rule(seed=seeds, count=st.integers(1, 4), kind=st.sampled_from(COMING))
    def somebody_says_something(self, seed: int, count: int, kind: str) -> None:
        hostile = Hostile(seed, self.world.core)
        hostile.calm = 0.7
        hostile.state, hostile.now_s = self.world.state, self.world.now_s
        make = getattr(hostile, f"_{kind.removesuffix('s') if kind != 'waypoints' else kind}", None)
        make = hostile._velocity if kind in {"teleop", "external"} else make
        assert make is not None
        said = {kind: tuple(make() for _ in range(count))}
        self.world.extra = replace(self.world.extra, **said)  # type: ignore[arg-type]  # a field and its messages
        self.tick()

    @rule(which=st.integers(0, 5))
    def something_is_said_again(self, which: int) -> None:
        if self.past:
            old = self.past[which % len(self.past)]
            self.world.extra = replace(old, drive=(), scan=None, imu=None, localization=None)
            self.tick()

    @rule(key=st.sampled_from(KEYS), count=st.integers(1, 8))
    def bytes_are_no_message(self, key: str, count: int) -> None:
        why = DecodeFailure("invalid", "x_m: input should be a finite number")
        self.world.extra = replace(self.world.extra, rejected=(RejectedAt(key, why),) * count)
        self.tick()

    @rule(kind=st.sampled_from(OPS), authentic=st.booleans())
    def a_person_asks(self, kind: OpKind, authentic: bool) -> None:  # drawn
        self.world.op(kind, authentic=authentic)
        self.tick()

    @rule(v=st.floats(-10.0, 10.0), w=st.floats(-20.0, 20.0), held=st.booleans())
    def a_stick_speaks(self, v: float, w: float, held: bool) -> None:  # drawn
        if self.world.status is not None:
            self.world.teleop(v if held else 0.0, w if held else 0.0, held=held)
        self.tick(5)

    @rule(
        part=st.sampled_from(["drive_silent", "lidar_silent", "lidar_blind", "lidar_frozen",
                              "localization_silent", "gyro_silent", "planner"]),
        broken=st.booleans(),
    )  # fmt: skip
    def a_part_falls_silent_or_speaks_again(self, part: str, broken: bool) -> None:
        if part != "planner":
            setattr(self.world, part, broken)
        elif self.world.planner is not None:
            self.world.brain.silent = broken
        self.tick()

    @rule(
        what=st.sampled_from(["deaf", "runs_on", "estop_pressed", "never_times_out"]),
        on=st.booleans(),
        left=st.floats(-12.0, 12.0),
        right=st.floats(-12.0, 12.0),
    )
    def the_drive_misbehaves(self, what: str, on: bool, left: float, right: float) -> None:
        setattr(self.world.drive, what, on)
        if what == "runs_on" and on:
            self.world.drive.speeds = (left, right)
        self.tick()

    @rule(mission=st.sampled_from([None, "m1", "m2"]), x=st.floats(-5, 5), y=st.floats(-5, 5))
    def the_planner_wants_something_else(self, mission: str | None, x: float, y: float) -> None:
        planner = self.world.planner
        assert planner is not None
        planner.mission, planner.goal_m = mission, (x, y)
        planner.leg += 1
        self.tick(10)

    @rule(x=st.floats(-6, 6), y=st.floats(-6, 6))
    def something_stands_in_the_way(self, x: float, y: float) -> None:
        self.world.obstacle_m = (x, y, 0.3)
        self.tick()

    @rule(late_s=st.floats(0.0, 0.05), missed=st.integers(0, 5))
    def the_loop_is_late(self, late_s: float, missed: int) -> None:
        self.world.extra = replace(
            self.world.extra, loop=LoopFacts(late_s=late_s, missed_ticks=missed)
        )
        self.tick()

    @rule(speed=st.floats(-2.0, 2.0), step_m=st.floats(-0.4, 0.4), count=st.integers(0, 50))
    def a_horizon_of_any_shape(self, speed: float, step_m: float, count: int) -> None:
        status, planner = self.world.status, self.world.planner
        if status is None or planner is None or status.base_in_map is None:
            return
        here = status.base_in_map
        points = tuple(
            Waypoint(x_m=here.x_m + i * step_m, y_m=here.y_m, speed_mps=speed) for i in range(count)
        )
        said = planner.horizon(status).model_copy(update={"points": points})
        self.world.extra = replace(self.world.extra, waypoints=(said,))
        self.tick()

    @invariant()
    def the_same_step_gives_the_same_decision(self) -> None:
        world = self.world
        now_s = world.now_s + 0.01
        assert step(world.core, world.state, Inbox(), now_s) == step(
            world.core, world.state, Inbox(), now_s
        )


TestBridge = Bridge.TestCase
TestBridge.settings = settings(
    max_examples=12,
    stateful_step_count=20,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)
