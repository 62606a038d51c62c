"""Hold running away, being stuck and turning unlike the gyro to their numbers, by single calls."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.faults import detect_motion
from bridge.core.modes.mode_logic import detect
from bridge.core.state_motion import Gate, LimiterState
from bridge.core.state_senses import SentBounds
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import STILL, Imu, Pose2, Twist2, Waypoints

EPS = 1e-6
Dirty = list[tuple[str, str]]
STOOD = SentBounds(0.0, 0.0, 0.0, 0.0, 0.0)


def at(sent: Twist2, real: Twist2, start: str = "active", base_m: float = 0.5) -> TickContext:
    """Return a tick that asks for one motion and measures another, on wheels so far apart."""
    tick = tick_of(reached(start))
    base = ROBOT.base.model_copy(update={"wheel_separation_m": base_m})
    tick.config = replace(tick.config, robot=ROBOT.model_copy(update={"base": base}))
    tick.s.motion.limiter = LimiterState(sent)
    tick.s.odometry = replace(tick.s.odometry, measured=real)
    tick.s.drive.received_s = tick.now_s
    return tick


def rows_of(tick: TickContext, detector: str) -> list[str]:
    dirty: Dirty = []
    getattr(detect_motion, detector)(tick, dirty)
    return [name for name, _ in dirty]


def last_place(tick: TickContext) -> Pose2 | None:
    """Tell where it last got on; a question, so that no type checker remembers its answer."""
    return tick.s.watch.progress_at


@table(
    ("start", "sent", "real", "had_s", "old_s", "rows", "left_s"),
    [
        # 0.4 m/s was sent; 0.15 m/s more is slack
        ("active", Twist2(0.4, 0.0), Twist2(0.55, 0.0), 0.0, 0.0, 0, 0.0),
        ("active", Twist2(0.4, 0.0), Twist2(0.55 + EPS, 0.0), 0.085, 0.0, 0, 0.095),
        ("active", Twist2(0.4, 0.0), Twist2(0.55 + EPS, 0.0), 0.095, 0.0, 1, 0.105),
        ("active", Twist2(0.4, 0.0), Twist2(0.55 + EPS, 0.0), 0.235, 0.0, 1, 0.245),
        ("active", Twist2(0.4, 0.0), Twist2(0.55 + EPS, 0.0), 0.24, 0.0, 2, 0.25),
        ("active", Twist2(0.4, 0.0), Twist2(0.55 + EPS, 0.0), 0.25, 0.0, 2, 0.25),
        ("active", Twist2(0.4, 0.0), Twist2(-0.15, 0.0), 0.0, 0.0, 0, 0.0),
        ("active", Twist2(0.4, 0.0), Twist2(-0.15 - EPS, 0.0), 0.095, 0.0, 1, 0.105),
        ("active", Twist2(0.4, 0.0), Twist2(0.5, 0.0), 0.2, 0.0, 0, 0.1975),
        ("active", Twist2(0.4, 0.0), Twist2(0.5, 0.0), 1.0, 0.0, 0, 0.25),
        # wheels 0.5 m apart: 1 rad/s is 0.25 m/s more at the right one, and less at the left
        ("active", Twist2(0.2, 1.0), Twist2(0.2, 1.6 - EPS), 0.09, 0.0, 0, 0.0875),
        ("active", Twist2(0.2, 1.0), Twist2(0.2, 1.6 + EPS), 0.095, 0.0, 1, 0.105),
        ("active", Twist2(0.2, -1.0), Twist2(0.2, -1.6 - EPS), 0.095, 0.0, 1, 0.105),
        ("active", Twist2(0.2, 1.0), Twist2(-0.2, 0.0), 0.095, 0.0, 1, 0.105),
        ("active", Twist2(-0.2, 0.5), Twist2(-0.475, 0.0), 0.095, 0.0, 1, 0.105),
        ("active", STILL, Twist2(0.0, 0.6), 0.09, 0.0, 0, 0.0875),
        ("active", STILL, Twist2(0.0, 0.61), 0.095, 0.0, 1, 0.105),
        ("disarmed", STILL, Twist2(1.0, 0.0), 0.09, 0.0, 0, 0.0875),
        ("active", STILL, Twist2(1.0, 0.0), 0.095, 0.08, 1, 0.105),
        ("active", STILL, Twist2(1.0, 0.0), 0.09, 0.08 + EPS, 0, 0.09),
        ("active", STILL, Twist2(1.0, 0.0), 0.09, None, 0, 0.09),
    ],
)
def test_a_wheel_runs_away_beyond_all_that_was_sent(
    start: str, sent: Twist2, real: Twist2, had_s: float, old_s: float | None, rows: int,
    left_s: float,
) -> None:  # fmt: skip
    tick = at(sent, real, start)
    tick.s.watch.sent, tick.s.watch.runaway_s = (), had_s
    tick.now_s = 100.0
    tick.s.drive.received_s = None if old_s is None else 100.0 - old_s
    assert rows_of(tick, "runaway") == ["RUNAWAY.0", "RUNAWAY.1"][:rows]
    assert tick.s.watch.runaway_s == pytest.approx(left_s)
    half = 0.25 * sent.w_radps
    left, right = sent.v_mps - half, sent.v_mps + half
    assert list(tick.s.watch.sent) == [SentBounds(100.0, left, left, right, right)]


def test_the_slack_is_the_same_all_the_way() -> None:
    # what was sent of late may still show, and anything between it and standing
    recent = (SentBounds(9.0, 0.3, 0.4, -0.4, -0.3), SentBounds(9.5, 0.0, 0.1, 0.0, 0.1))
    cases = (
        (0.55, -0.55, True), (0.55 + EPS, 0.0, False), (0.0, -0.55 - EPS, False),
        (-0.15, 0.25, True), (-0.15 - EPS, 0.0, False), (0.0, 0.25 + EPS, False),
        (0.5, 0.2, True), (0.15, -0.15, True), (0.2, 0.5, False),
    )  # fmt: skip
    for left, right, fits in cases:
        assert detect_motion._fits(recent, left, right) is fits, (left, right)
    fast = (SentBounds(9.0, 0.5, 0.6, -0.6, -0.5),)  # and slower than that
    assert detect_motion._fits(fast, 0.2, -0.2)
    assert detect_motion._fits((), 0.15, -0.15)
    assert not detect_motion._fits((), 0.15 + EPS, 0.0)
    assert not detect_motion._fits((), 0.0, -0.15 - EPS)


def test_what_was_sent_is_kept_in_buckets_as_long_as_it_may_show() -> None:
    tick = at(STILL, STILL)
    tick.now_s = 8.0
    newest = SentBounds(7.95 + EPS, 0.1, 0.2, 0.3, 0.4)
    for left, right, bounds in (
        (0.1, 0.4, (0.1, 0.2, 0.3, 0.4)), (0.2, 0.3, (0.1, 0.2, 0.3, 0.4)),
        (0.0, 0.35, (0.0, 0.2, 0.3, 0.4)), (0.3, 0.35, (0.1, 0.3, 0.3, 0.4)),
        (0.15, 0.2, (0.1, 0.2, 0.2, 0.4)), (0.15, 0.5, (0.1, 0.2, 0.3, 0.5)),
    ):  # fmt: skip
        tick.s.watch.sent = (STOOD, newest)
        detect_motion._remember(tick, left, right)
        assert tick.s.watch.sent == (STOOD, SentBounds(newest.since_s, *bounds))
    # 0.06 s of lag and 0.2 s: what began 0.26 s ago or earlier tells of all before it
    begun = SentBounds(8.0, 0.5, 0.5, 0.6, 0.6)
    for ages, kept in (
        ((0.5, 0.4, 0.27, 0.0625), 2), ((0.5, 0.4, 0.25, 0.0625), 3), ((0.4, 0.25, 0.2, 0.0625), 4),
        ((0.9, 0.8, 0.5), 1), ((9.0,), 1), ((0.5, 0.06 + 0.2, 0.1), 2),
    ):  # fmt: skip
        tick.s.watch.sent = tuple(replace(STOOD, since_s=8.0 - age_s) for age_s in ages)
        before = tick.s.watch.sent
        detect_motion._remember(tick, 0.5, 0.6)
        assert tick.s.watch.sent == (*before[-kept:], begun)
    tick.now_s, tick.s.watch.sent = 0.05, (STOOD,)
    detect_motion._remember(tick, 0.5, 0.6)
    assert list(tick.s.watch.sent) == [STOOD, replace(begun, since_s=0.05)]


@table(
    ("sent", "real", "held"),
    [
        (Twist2(0.10, 0.0), STILL, False),
        (Twist2(0.10 + EPS, 0.0), STILL, True),
        (Twist2(-0.5, 0.0), Twist2(-0.03 + EPS, 0.0), True),
        (Twist2(0.5, 0.0), Twist2(0.03, 0.0), False),
        (Twist2(0.12, 0.0), Twist2(0.024 - EPS, 0.0), True),
        (Twist2(0.12, 0.0), Twist2(0.024 + EPS, 0.0), False),
        (Twist2(0.0, 0.2), STILL, False),
        (Twist2(0.0, 0.2 + EPS), STILL, True),
        (Twist2(0.0, -0.9), Twist2(0.0, 0.05 - EPS), True),
        (Twist2(0.0, 0.3), Twist2(0.0, 0.05), False),
        (Twist2(0.3, 0.0), Twist2(0.15, 0.6), True),  # round its left wheel
        (Twist2(0.3, 0.0), Twist2(0.15, -0.6), True),
        (Twist2(0.3, 0.0), Twist2(0.15, 0.4), False),
        (Twist2(0.3, 0.8), Twist2(0.3, 0.8), False),  # its left wheel moves at 0.1 m/s
        (Twist2(0.2, 0.8), Twist2(0.2, 0.8), False),  # its left wheel is to stand
    ],
)
def test_what_is_asked_and_does_not_move_is_held(sent: Twist2, real: Twist2, held: bool) -> None:
    for had_s, after_s, seen in ((0.5, 0.51, False), (0.985, 0.995, False), (0.99, 1.0, True)):
        tick = at(sent, real)
        tick.s.watch.stuck_s = had_s
        evidence = detect_motion._standing_evidence(tick)
        assert (evidence is not None) is (seen and held)
        assert tick.s.watch.stuck_s == pytest.approx(after_s if held else had_s - 0.0025)
    tick = at(sent, real, "hold")  # nobody is followed: nothing is asked
    assert detect_motion._standing_evidence(tick) is None
    assert tick.s.watch.stuck_s == 0.0


def test_a_robot_that_gets_nowhere_loses_its_grant_and_in_the_end_its_arms() -> None:
    for ago_s, rows in (
        ((), 1), ((-5.0,), 1), ((-300.0 - EPS, -5.0), 1), ((-300.0 + EPS, -5.0), 2),
        ((-9.0, -8.0, -7.0), 2), ((-999.0, -400.0, -7.0), 1),
    ):  # fmt: skip
        tick = at(Twist2(0.3, 0.0), STILL)
        tick.s.watch.stuck_s, tick.s.watch.progress_at = 0.995, Pose2(0.0, 0.0, 0.0)
        tick.s.watch.stuck_at_s = tuple(tick.now_s + one for one in ago_s)
        assert rows_of(tick, "progress") == ["STUCK.0", "STUCK.1"][:rows]
        assert tick.s.watch.stuck_at_s == (
            *[tick.now_s + one for one in ago_s[-2:]],
            tick.now_s,
        )
        assert tick.s.watch.stuck_s == 0.0
        assert last_place(tick) is None
        assert tick.s.grants.mission == "m1", "a detector tells; whoever decides ends the grant"
        tick = at(Twist2(0.3, 0.0), STILL)
        tick.s.watch.stuck_s, tick.s.watch.progress_at = 0.995, Pose2(0.0, 0.0, 0.0)
        tick.robot_in_map = Pose2(0.0, 0.0, 0.0)
        detect(tick)
        assert tick.s.grants.mission is None
        assert (tick.s.leg.horizon, tick.s.leg.path) == (None, None)
        assert tick.s.grants.book[-1].mission == "m1"


def test_who_follows_nobody_is_not_watched_but_what_was_seen_drains() -> None:
    tick = at(STILL, STILL, "hold_granted")
    tick.s.watch.stuck_s, tick.s.watch.progress_at = 0.5, Pose2(0.0, 0.0, 0.0)
    assert rows_of(tick, "progress") == []
    assert tick.s.watch.stuck_s == pytest.approx(0.4975)
    tick.s.watch.stuck_s, tick.s.watch.progress_at = 0.0, Pose2(0.0, 0.0, 0.0)
    assert rows_of(tick, "progress") == []
    assert tick.s.watch.progress_at is None
    assert tick.s.grants.mission is not None


@table(
    ("gone", "waited_s", "seen", "anew"),
    [
        ((0.0, 0.0, 0.0), 5.0 - EPS, False, False),
        ((0.0, 0.0, 0.0), 5.0, True, False),
        ((0.0, 0.0, 0.05 - EPS), 6.0, True, False),
        ((0.0, 0.0, 0.05 + EPS), 6.0, False, True),
        ((0.0, 0.0, -0.05 - EPS), 6.0, False, True),
        ((0.02 - EPS, 0.0, 0.0), 6.0, True, False),
        ((0.02 + EPS, 0.0, 0.0), 6.0, False, True),
        ((-0.015, 0.015, 0.0), 6.0, False, True),
        ((0.0, -0.02 - EPS, 0.0), 6.0, False, True),
    ],
)
def test_progress_is_2_cm_or_3_degrees_in_5_s(
    gone: tuple[float, float, float], waited_s: float, seen: bool, anew: bool
) -> None:
    tick = at(STILL, STILL)
    tick.s.gate = Gate()
    tick.now_s = 50.0
    tick.s.leg = replace(tick.s.leg, sent_s=50.0)
    x, y, yaw = gone
    was = Pose2(-1.0, 1.0, 0.5)
    here = Pose2(was.x_m + x, was.y_m + y, was.yaw_rad + yaw)
    tick.s.odometry = replace(tick.s.odometry, base_in_odom=here)
    tick.s.watch.progress_at, tick.s.watch.progress_s = was, 50.0 - waited_s
    assert (detect_motion._no_progress(tick) is not None) is seen
    watch = tick.s.watch
    assert (watch.progress_at, watch.progress_s) == ((here, 50.0) if anew else (was, 50 - waited_s))
    watch.progress_at = None
    assert detect_motion._no_progress(tick) is None
    assert here == watch.progress_at
    assert watch.progress_s == 50.0


@table("why", ["blocked", "shut", "mode", "source", "no way"])
def test_progress_is_asked_of_waypoints_with_an_open_way_alone(why: str) -> None:
    start = {"mode": "hold_granted", "source": "teleop"}.get(why, "active")
    tick = at(STILL, STILL, start)
    tick.s.gate = Gate(1.0 if why == "shut" else None, blocked=why == "blocked")
    horizon = tick.s.leg.horizon
    if why == "no way":
        assert isinstance(horizon, Waypoints)
        tick.s.leg = replace(tick.s.leg, horizon=horizon.model_copy(update={"points": ()}))
    tick.s.watch.progress_at, tick.s.watch.progress_s = tick.s.odometry.base_in_odom, 0.0
    assert detect_motion._no_progress(tick) is None
    assert tick.s.watch.progress_at is None


@table(
    ("wheels", "gyro", "age_s", "had_s", "seen", "left_s"),
    [
        (0.5, 0.2 + EPS, 0.0, 0.495, False, 0.4925),
        (0.5, 0.2 - EPS, 0.0, 0.485, False, 0.495),
        (0.5, 0.2 - EPS, 0.0, 0.495, True, 0.5),
        (-0.5, -0.2 + EPS, 0.0, 0.495, True, 0.5),
        (0.0, 0.0, 0.25, 0.495, False, 0.4925),
        (0.0, 0.0, 0.25 + EPS, 0.495, True, 0.5),
        (0.0, 0.0, None, 0.495, True, 0.5),
        (0.0, 0.0, 0.0, 0.0, False, 0.0),
    ],
)
def test_wheels_and_gyro_agree_on_a_turn(
    wheels: float, gyro: float, age_s: float | None, had_s: float, seen: bool, left_s: float
) -> None:
    tick = at(STILL, Twist2(0.0, wheels))
    tick.now_s = 100.0
    imu = Imu(
        boot_id="g0", seq=1, stamp_s=200.0, yaw_rate_radps=gyro, accel_x_mps2=0.0, accel_y_mps2=0.0
    )
    received_s = None if age_s is None else 100.0 - age_s
    tick.s.pose = replace(tick.s.pose, imu=imu, imu_received_s=received_s)
    tick.s.watch.yaw_s = had_s
    assert rows_of(tick, "yaw") == ["YAW_DISAGREE.0"] * seen
    assert tick.s.watch.yaw_s == pytest.approx(left_s)
    without = tick.config.robot.model_copy(
        update={"inputs": ROBOT.inputs.model_copy(update={"imu": False})}
    )
    tick.config = replace(tick.config, robot=without)
    tick.s.watch.yaw_s = 0.0
    assert rows_of(tick, "yaw") == ["YAW_DISAGREE.0"]
