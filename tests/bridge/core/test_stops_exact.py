"""Hold the judge of stops, and the curve it judges by, to their numbers."""

from __future__ import annotations

from dataclasses import replace
from math import nan

import pytest

from bridge.core.modes import stop_monitor
from bridge.core.modes.stop_profile import (
    _against,
    _braking,
    plan_stop,
    planned_rim_mps,
    planned_twist,
    too_long,
    too_slow,
)
from bridge.core.state_motion import NO_STOP, LimiterState, Profile, Stopping, StopPlan
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import ROBOT, tick_of
from wire import STILL, Action, Mode, Twist2
from wire.robot import Limits

EPS = 1e-6
LAG_S = ROBOT.drive.lag_s
PLAN = StopPlan(Twist2(0.5, 0.0), 0.5, 0.2, 1.0, 0.08, 0.4, 0.1)
"""Rises in 0.08 s, brakes flat for 0.4 s, fades in 0.1 s."""


def stop_of(since_s: float, **more: object) -> Stopping:
    stop = Stopping(Action.HOLD2, "row", since_s, PLAN, "W", resumes=True)
    return replace(stop, **more)  # type: ignore[arg-type]  # names of its fields


def standing(start: str = "stopping_by_row", /, **more: object) -> TickContext:
    """Return a tick in which the robot has stood for 0.2 s and is told to stand."""
    tick = tick_of(reached(start))
    tick.s.drive.still_since_s = tick.now_s - 0.2
    tick.s.motion.limiter = LimiterState()
    tick.s.stopping = stop_of(tick.now_s - 0.3, **more)
    return tick


@table(
    ("more", "mode"),
    [
        ({}, Mode.HOLD),
        ({"action": Action.STOP1}, Mode.DISARMED),
        ({"action": Action.FAST1}, Mode.DISARMED),
        ({"reset_needed": True}, Mode.FAULT),
        ({"reset_needed": True, "action": Action.STOP1}, Mode.FAULT),
    ],
)
def test_a_stop_ends_as_its_action_says(more: dict[str, object], mode: Mode) -> None:
    tick = standing(**more)
    stop_monitor.judge(tick)
    assert (tick.s.mode, tick.s.stopping) == (mode, None)
    assert tick.events[-1] == ("mode", f"STOPPING {mode.value} row")


@table("start", ["estopped", "hold"])
def test_where_the_mode_stays_only_the_ramp_is_over(start: str) -> None:
    tick = standing(start, reset_needed=True)
    before = tick.s.mode
    stop_monitor.judge(tick)
    assert (tick.s.mode, tick.s.stopping) == (before, None)


def test_it_is_over_after_200_ms_at_rest_and_when_told_to_rest() -> None:
    for still_s, sent, over in (
        (0.2 - EPS, STILL, False),
        (0.2, STILL, True),
        (9.0, Twist2(0.01, 0.0), False),
    ):
        tick = standing()
        tick.s.drive.still_since_s = tick.now_s - still_s
        tick.s.motion.limiter = LimiterState(sent)
        stop_monitor.judge(tick)
        assert (tick.s.stopping is None) is over


@table(("silent_s", "ends"), [(0.25 - EPS, False), (0.25 + EPS, True)])
def test_a_stop_that_nobody_measures_ends_when_its_time_is_over(
    silent_s: float, ends: bool
) -> None:
    for elapsed_s, over in ((0.5, False), (1.5 * (0.58 + LAG_S) + 0.3 + EPS, True)):
        tick = standing()
        tick.s.drive.still_since_s = None
        tick.s.odometry = replace(tick.s.odometry, measured=STILL)
        tick.s.drive.received_s = tick.now_s - silent_s
        tick.s.stopping = stop_of(tick.now_s - elapsed_s)
        stop_monitor.judge(tick)
        said = ("stop_unmeasured", "row") in tick.events
        assert said is (ends and over)
        if said:
            assert tick.s.mode is Mode.HOLD
        tick.s.drive.received_s = None
        assert stop_monitor._is_unmeasured(tick)


def rolling(speed_mps: float, elapsed_s: float, **more: object) -> TickContext:
    tick = tick_of(reached("stopping_by_row"))
    tick.s.drive.still_since_s = None
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(speed_mps, 0.0))
    tick.s.stopping = stop_of(tick.now_s - elapsed_s, **more)
    return tick


@table(
    ("speed_mps", "before_s", "after_s", "failure"),
    [
        (0.5, 0.0, 0.01, None),
        (0.5, 0.14 - EPS, 0.15 - EPS, None),
        (0.5, 0.14 + EPS, 0.15, "stop_too_slow"),
        (0.05, 0.15, 0.1475, None),  # drains four times as slowly
        (0.05, 0.0, 0.0, None),
    ],
)
def test_too_slow_counts_after_150_ms_and_is_not_forgotten_at_once(
    speed_mps: float, before_s: float, after_s: float, failure: str | None
) -> None:
    tick = rolling(speed_mps, 0.8, slow_s=before_s)
    assert tick.dt_s == 0.01
    assert stop_monitor._failure(tick) == failure
    assert tick.s.stopping is not None
    assert tick.s.stopping.slow_s == pytest.approx(after_s, abs=EPS / 10)


def test_one_reading_in_two_that_is_slow_enough_hides_no_stop_that_is_not() -> None:
    """Wheels that read by turns 0.5 m/s and nothing, 8/3 of the time."""
    failures = []
    tick = rolling(0.5, 0.8)
    for index in range(41):
        tick.s.odometry = replace(tick.s.odometry, measured=Twist2(0.5 * (index % 2 == 0), 0.0))
        failures.append(stop_monitor._failure(tick))
    assert [index for index, failure in enumerate(failures) if failure] == [38, 40]


@table(("start", "mode"), [("stopping_by_row", Mode.FAULT), ("estopped", None)])
def test_a_failure_cuts_the_torque(start: str, mode: Mode | None) -> None:
    tick = tick_of(reached(start))
    before = tick.s.mode
    tick.s.drive.still_since_s = None
    tick.s.stopping = stop_of(tick.now_s - 9.0)
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(0.05, 0.0))
    stop_monitor.judge(tick)
    assert tick.s.stopping is None
    assert tick.s.mode is (mode or before)
    if mode is None:
        assert tick.events == [("stop_failed", "stop_too_long")]
    else:
        assert tick.s.fault == "stop_too_long"


def test_what_stands_is_never_too_long() -> None:
    tick = rolling(0.0, 9.0)
    tick.s.drive.still_since_s = tick.now_s
    assert stop_monitor._failure(tick) is None


@table(
    ("at_s", "rim_mps"),
    [
        (-1.0, 0.5),
        (0.0, 0.5),
        (nan, 0.5),
        (0.04, 0.484),
        (0.08, 0.452),
        (0.28, 0.25),
        (0.48, 0.05),
        (0.53, 0.0125),
        (0.58, 0.0),
        (0.59, 0.0),
    ],
)
def test_the_curve_is_as_drawn(at_s: float, rim_mps: float) -> None:
    assert planned_rim_mps(PLAN, at_s) == pytest.approx(rim_mps)


def test_a_curve_stays_on_its_arc_and_none_stands() -> None:
    turning = replace(PLAN, start=Twist2(0.4, 0.5))
    half = planned_twist(turning, 0.28)
    assert half.w_radps / half.v_mps == pytest.approx(1.25)
    assert half.v_mps == pytest.approx(0.4 * 0.25 / 0.5)
    assert planned_twist(NO_STOP, -1.0) == STILL


@table(
    ("sent", "accel", "profile", "shape"),
    [
        (Twist2(0.5, 0.0), (0.0, 0.0), Profile.STOP, (0.0, 1.0, 0.1, 0.4, 0.1)),
        (Twist2(-0.5, 0.0), (0.0, 0.0), Profile.STOP, (0.0, 1.0, 0.1, 0.4, 0.1)),
        (Twist2(0.5, 0.0), (-0.5, -0.4), Profile.STOP, (0.5, 1.0, 0.05, 0.4125, 0.1)),
        (Twist2(-0.5, 0.0), (0.4, 0.5), Profile.STOP, (0.5, 1.0, 0.05, 0.4125, 0.1)),
        (Twist2(0.5, 0.0), (9.0, 9.0), Profile.STOP, (0.0, 1.0, 0.1, 0.4, 0.1)),
        (Twist2(0.5, 0.0), (-9.0, 0.0), Profile.STOP, (1.0, 1.0, 0.0, 0.45, 0.1)),
        (Twist2(0.025, 0.0), (0.0, 0.0), Profile.STOP, (0.0, 0.5, 0.05, 0.0, 0.05)),
        (Twist2(0.0, 1.0), (0.3, 0.0), Profile.STOP, None),
    ],
)
def test_a_plan_is_drawn_by_speed_and_by_what_is_under_way(
    sent: Twist2,
    accel: tuple[float, float],
    profile: Profile,
    shape: tuple[float, float, float, float, float] | None,
) -> None:
    plan = plan_stop(LimiterState(sent, *accel), ROBOT.base, ROBOT.limits, profile)
    if shape is None:  # turning in place, the left wheel back: it slows by what it gains
        assert plan.rim_mps == pytest.approx(ROBOT.base.wheel_separation_m / 2)
        assert plan.first_mps2 == pytest.approx(0.3)
        return
    drawn = (plan.first_mps2, plan.peak_mps2, plan.rise_s, plan.flat_s, plan.fall_s)
    assert drawn == pytest.approx(shape)
    assert plan.start == sent


@table(
    ("elapsed_s", "speed_mps", "slow"),
    [
        (LAG_S + 0.2, 9.0, False),
        (LAG_S + 0.2 + EPS, 0.6 - EPS, False),
        (LAG_S + 0.2 + EPS, 0.6 + EPS, True),
        (LAG_S + 0.2 + 0.58, 0.1, False),
        (LAG_S + 0.2 + 0.58, 0.1 + EPS, True),
        (LAG_S + 0.2 + 0.58, nan, True),
        (nan, 9.0, False),
    ],
)
def test_too_slow_is_faster_than_the_delayed_curve_and_a_little(
    elapsed_s: float, speed_mps: float, slow: bool
) -> None:
    assert too_slow(PLAN, Twist2(speed_mps, 0.0), elapsed_s, LAG_S, ROBOT.base) is slow


def test_too_long_is_half_as_long_again_and_a_little() -> None:
    most_s = 1.5 * (0.58 + LAG_S) + 0.3
    assert not too_long(PLAN, most_s - EPS, LAG_S)
    assert too_long(PLAN, most_s + EPS, LAG_S)
    assert too_long(PLAN, nan, LAG_S)


SLOW = Limits(max_decel_mps2=0.8, stop_jerk_mps3=4.0)


@table("accel", [(0.0, 0.0), (-0.3, -0.5), (0.4, -0.2), (-9.0, -9.0)])
@table("sent", [Twist2(0.5, 0.0), Twist2(0.02, 0.0), Twist2(0.2, 0.6)])
def test_a_plan_takes_off_the_whole_speed_and_keeps_its_bounds(
    sent: Twist2, accel: tuple[float, float]
) -> None:
    plan = plan_stop(LimiterState(sent, *accel), ROBOT.base, SLOW, Profile.STOP)
    half = ROBOT.base.wheel_separation_m / 2
    assert plan.rim_mps == pytest.approx(sent.v_mps + half * sent.w_radps)
    rising = (plan.first_mps2 + plan.peak_mps2) / 2 * plan.rise_s
    taken = rising + plan.peak_mps2 * (plan.flat_s + plan.fall_s / 2)
    assert taken == pytest.approx(plan.rim_mps)
    assert plan.rise_s == pytest.approx((plan.peak_mps2 - plan.first_mps2) / 4.0)
    assert plan.fall_s == pytest.approx(plan.peak_mps2 / 4.0)
    assert plan.first_mps2 <= plan.peak_mps2 <= 0.8
    assert (plan.peak_mps2 == 0.8) is (sent.v_mps > 0.1)
    braking = max(0.0, -accel[1], -accel[0] if sent.v_mps > half * sent.w_radps else accel[0])
    most = (2 * 4.0 * plan.rim_mps) ** 0.5
    assert plan.first_mps2 == pytest.approx(min(braking, 0.8, most))


def test_the_hardest_plan_is_one_flat_ramp_and_wild_speeds_have_none() -> None:
    sent = Twist2(0.5, 0.4)
    hard = ROBOT.limits.hardest_decel_mps2
    plan = plan_stop(LimiterState(sent, -0.5, -0.5), ROBOT.base, ROBOT.limits, Profile.FASTEST)
    assert plan == StopPlan(sent, 0.6, hard, hard, 0.0, 0.6 / hard, 0.0)
    for rim_mps, planless in ((1000.0, False), (1000.1, True), (nan, True), (0.0, True)):
        wild = LimiterState(Twist2(rim_mps, 0.0))
        made = plan_stop(wild, ROBOT.base, ROBOT.limits, Profile.STOP)
        assert (made == NO_STOP) is planless


@table(
    ("speed", "accel", "braking"),
    [(0.5, -1.0, 1.0), (0.5, 1.0, -1.0), (-0.5, 1.0, 1.0), (-0.5, -1.0, -1.0), (0.0, 1.0, 0.0),
     (0.0, -1.0, 0.0)],
)  # fmt: skip
def test_braking_is_what_goes_against_the_speed(speed: float, accel: float, braking: float) -> None:
    assert _against(speed, accel) == braking


@table("accel", [(0.3, 0.0), (0.0, -0.3), (0.3, -0.1)])
def test_each_wheel_brakes_its_own_way(accel: tuple[float, float]) -> None:
    # the left wheel at -0.025 m/s, the right one at 0.225 m/s
    assert _braking(LimiterState(Twist2(0.1, 0.5), *accel), ROBOT.base) == pytest.approx(0.3)
