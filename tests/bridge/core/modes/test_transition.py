"""Hold how stops begin, grow harder and end, and what each transition leaves."""

from __future__ import annotations

from dataclasses import replace
from math import nan

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import fastest_rim, saturate
from bridge.core.modes import selftest, transition
from bridge.core.modes.mode_table import Cause, Fact, RequestCause
from bridge.core.modes.transition import (
    _braking,
    escalate,
    go,
    plan_stop,
    planned_rim_mps,
    planned_twist,
    too_long,
    too_slow,
)
from bridge.core.motion.limiter import shape, stopping_m
from bridge.core.motion.wheel_command import requested_twist
from bridge.core.state_motion import NO_STOP, LimiterState, Profile, Stopping, StopPlan, profile_of
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import STILL, Action, HeldReason, Mode, RobotDescription, StandingHold, Twist2
from wire.robot import Base, Limits

LATER_S = 0.5


def later(start: str) -> TickContext:
    """Return a tick half a second after the mode was reached."""
    tick = at(start)
    tick.now_s += LATER_S
    return tick


@table(
    ("start", "cause", "action", "resumes"),
    [
        ("active", Action.HOLD2, Action.HOLD2, True),
        ("active", Action.STOP1, Action.STOP1, False),
        ("active", Action.FAST1, Action.FAST1, False),
        ("active", RequestCause.STOP, Action.HOLD2, False),
        ("active", RequestCause.DISARM, Action.STOP1, False),
        ("teleop", Action.HOLD2, Action.HOLD2, False),
        ("teleop", RequestCause.STOP, Action.HOLD2, False),
        ("hold", Action.STOP1, Action.STOP1, False),
    ],
)
@table("reset_needed", [False, True])
def test_a_stop_begins_as_its_cause_says(
    start: str, cause: Cause, action: Action, resumes: bool, reset_needed: bool
) -> None:
    tick = later(start)
    before, source = tick.s.mode, tick.s.source
    assert go(tick, cause, "why", reset_needed=reset_needed)
    plan = plan_stop(tick.s.motion.limiter, ROBOT.base, ROBOT.limits, profile_of(action))
    assert tick.s.stopping == Stopping(
        action, "why", tick.now_s, plan, source, resumes, reset_needed
    )
    assert (tick.s.mode, tick.s.mode_since_s) == (Mode.STOPPING, tick.now_s)
    assert tick.events == [("mode", f"{before.value} STOPPING why")]


def test_only_the_hardest_stop_has_the_hardest_ramp() -> None:
    assert {action: profile_of(action) for action in Action} == {
        action: Profile.FASTEST if action is Action.FAST1 else Profile.STOP for action in Action
    }


def stopping(action: Action, *, reset_needed: bool = False) -> TickContext:
    tick = later("stopping_by_row")
    assert tick.s.stopping is not None
    tick.s.stopping = replace(tick.s.stopping, action=action, slow_s=0.1, reset_needed=reset_needed)
    return tick


@table(
    ("had", "came", "faster"),
    [
        (Action.HOLD2, Action.STOP1, False),
        (Action.HOLD2, Action.FAST1, True),
        (Action.STOP1, Action.FAST1, True),
    ],
)
@table("needed", [(False, False), (False, True), (True, False)])
def test_a_stop_grows_harder_and_only_a_harder_ramp_is_planned_anew(
    had: Action, came: Action, faster: bool, needed: tuple[bool, bool]
) -> None:
    tick = stopping(had, reset_needed=needed[0])
    before = tick.s.stopping
    assert before is not None
    escalate(tick, came, "worse", reset_needed=needed[1])
    harder = plan_stop(tick.s.motion.limiter, ROBOT.base, ROBOT.limits, Profile.FASTEST)
    assert tick.s.stopping == Stopping(
        action=came,
        cause="worse",
        since_s=tick.now_s if faster else before.since_s,
        plan=harder if faster else before.plan,
        source=before.source,
        resumes=False,
        reset_needed=any(needed),
        slow_s=0.0 if faster else 0.1,
    )
    assert tick.events == [("stop_escalated", f"{came.value} worse")]


@table("came", [Action.HOLD2, Action.STOP1])
@table("needed", [(False, False), (False, True), (True, True), (True, False)])
def test_a_stop_never_grows_milder_but_learns_that_a_reset_is_needed(
    came: Action, needed: tuple[bool, bool]
) -> None:
    tick = stopping(Action.STOP1, reset_needed=needed[0])
    before = tick.s.stopping
    assert before is not None
    escalate(tick, came, "other", reset_needed=needed[1])
    if needed == (False, True):
        before = replace(before, reset_needed=True, cause="other")
    assert tick.s.stopping == before
    assert tick.events == []
    tick.s.stopping = None
    escalate(tick, Action.FAST1, "none", reset_needed=True)
    assert tick.s.stopping is None


def test_a_person_who_stops_a_stop_ends_its_going_on() -> None:
    tick = stopping(Action.HOLD2)
    assert go(tick, RequestCause.DISARM, "disarm")
    assert tick.s.stopping is not None
    assert (tick.s.stopping.action, tick.s.stopping.resumes) == (Action.STOP1, False)
    assert tick.s.mode_since_s < tick.now_s, "the mode is the same"
    assert ("mode", "STOPPING STOPPING disarm") not in tick.events


HELD = StandingHold(reason=HeldReason.STOP, id="s1")


@table("held", [None, HELD])
@table("start", ["active", "disarmed", "stopping_by_row", "selftest"])
def test_a_protective_stop_ramps_where_there_is_torque(
    start: str, held: StandingHold | None
) -> None:
    tick = later(start)
    tick.s.held = held
    powered = tick.is_powered
    if not powered:  # nothing of a motion is left in these modes, and nothing may come back
        tick.s.motion.limiter = LimiterState(Twist2(0.1, 0.0))
        tick.s.stopping = Stopping(Action.HOLD2, "old", 0.0, NO_STOP, "W", resumes=True)
    source, had = tick.s.source, tick.s.motion.limiter
    go(tick, RequestCause.ESTOP, "estop")
    plan = plan_stop(had, ROBOT.base, ROBOT.limits, Profile.FASTEST)
    if powered:
        assert tick.s.stopping == Stopping(
            Action.FAST1, "estop", tick.now_s, plan, source, resumes=False
        )
        assert tick.s.motion.limiter == had
    else:
        assert tick.s.stopping is None
        assert tick.s.motion.limiter == LimiterState()
    assert tick.s.source == ""
    assert tick.s.held == (held or StandingHold(reason=HeldReason.FAULT, id="estop"))


def test_after_a_hand_on_the_stick_the_ramp_is_judged_like_a_stop() -> None:
    tick = later("teleop")
    plan = plan_stop(tick.s.motion.limiter, ROBOT.base, ROBOT.limits, Profile.STOP)
    assert go(tick, Fact.RELEASED, "released")
    assert tick.s.stopping == Stopping(
        Action.HOLD2, "released", tick.now_s, plan, "T", resumes=False
    )
    assert tick.s.source == ""
    assert requested_twist(tick) == (STILL, False)


@table("held", [None, HELD])
@table(
    ("start", "cause", "stop_cause", "mode", "fault", "holds"),
    [
        ("stopping_by_row", Fact.TOO_SLOW, "x", Mode.FAULT, "why", "why"),
        ("stopping_by_row", Fact.STOOD_DISARM, "stuck", Mode.DISARMED, None, "stuck"),
        ("stopping_by_row", Fact.STOOD_DISARM, "disarm", Mode.DISARMED, None, None),
        ("fault", RequestCause.RESET, None, Mode.DISARMED, None, None),
        ("fault", Fact.UNPROVEN_RESET, None, Mode.SELFTEST, None, None),
        ("active", Action.CUT0, None, Mode.FAULT, "why", "why"),
    ],
)
def test_without_torque_nothing_of_the_motion_is_left(
    start: str,
    cause: Cause,
    stop_cause: str | None,
    mode: Mode,
    fault: str | None,
    holds: str | None,
    held: StandingHold | None,
) -> None:
    tick = later(start)
    tick.s.held = held
    if stop_cause is not None:
        assert tick.s.stopping is not None
        tick.s.stopping = replace(tick.s.stopping, cause=stop_cause)
    before = tick.s.selftest
    if mode is Mode.SELFTEST:
        selftest.enter(tick, cause, "why")
    else:
        assert go(tick, cause, "why")
    assert (tick.s.mode, tick.s.fault) == (mode, fault)
    expected = None if holds is None else StandingHold(reason=HeldReason.FAULT, id=holds)
    assert tick.s.held == (held or expected)
    assert (tick.s.stopping, tick.s.source) == (None, "")
    assert requested_twist(tick) == (STILL, False)
    assert tick.s.motion.limiter == LimiterState()
    if mode is Mode.SELFTEST:
        assert (tick.s.selftest.since_s, tick.s.selftest.passed) == (tick.now_s, False)
        assert tick.s.selftest.phase == "echo"
    else:
        assert tick.s.selftest == before


def test_motion_goes_on_from_what_was_sent_last() -> None:
    tick = later("stopping_by_row")
    had = tick.s.motion.limiter
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(-0.5, 1.0))
    assert had.sent.v_mps > 0.1
    assert go(tick, Fact.CLEARED, "m1", source="W")
    assert tick.s.stopping is None
    assert tick.s.motion.limiter == had, "whatever is measured"
    assert tick.s.source == "W", "whoever calls sets it"


BASE, LIMITS = Base(), Limits()
DT, LAG = 0.01, 0.06
stops = st.sampled_from([Profile.STOP, Profile.FASTEST])
moving = st.builds(Twist2, st.floats(-0.5, 0.5), st.floats(-1, 1)).map(
    lambda twist: saturate(twist, BASE, LIMITS)
)


@given(moving, st.floats(-1, 1), stops)
def test_the_limiter_follows_the_plan(twist: Twist2, accel: float, profile: Profile) -> None:
    memory = LimiterState(twist, accel, accel)
    plan = plan_stop(memory, BASE, LIMITS, profile)
    for tick in range(1, 130):
        memory = shape(twist, memory, BASE, LIMITS, DT, profile=profile)
        rim = fastest_rim(memory.sent, BASE.wheel_separation_m)
        assert rim <= planned_rim_mps(plan, (tick - 2) * DT) + 0.006
        assert not too_slow(plan, memory.sent, tick * DT, LAG, BASE)
    assert memory.sent == STILL
    adapter = TypeAdapter(StopPlan)
    assert adapter.validate_json(adapter.dump_json(plan)) == plan


@given(moving, st.floats(0, 1), stops, st.floats(0, 2), st.floats(0, 0.2))
def test_the_plan_never_rises(
    twist: Twist2, braking: float, profile: Profile, at_s: float, later_s: float
) -> None:
    plan = plan_stop(LimiterState(twist, -braking, -braking), BASE, LIMITS, profile)
    assert planned_rim_mps(plan, at_s + later_s) <= planned_rim_mps(plan, at_s) + 1e-12


@given(st.floats(), st.floats(), st.floats(), st.floats())
def test_no_number_raises(v: float, w: float, accel: float, elapsed: float) -> None:
    plan = plan_stop(LimiterState(Twist2(v, w), accel, accel), BASE, LIMITS, Profile.STOP)
    assert planned_rim_mps(plan, elapsed) >= 0.0 or elapsed != elapsed


CART = RobotDescription.model_validate(
    {
        "base": {"wheel_separation_m": 0.8, "radius_m": 0.5},
        "limits": {"max_decel_mps2": 0.8, "stop_jerk_mps3": 5.0, "hardest_decel_mps2": 2.0},
    }
)
FRAME, BOUNDS = CART.base, CART.limits


def test_a_wheel_that_stands_brakes_nothing() -> None:
    assert transition._against(0.0, 1.0) == transition._against(0.0, -1.0) == 0.0
    assert (transition._against(0.5, -1.0), transition._against(-0.5, -1.0)) == (1.0, -1.0)


def test_the_hardest_stop_is_a_straight_line() -> None:
    made = plan_stop(LimiterState(Twist2(0.3, 0.5)), FRAME, BOUNDS, Profile.FASTEST)
    assert made == StopPlan(Twist2(0.3, 0.5), 0.5, 2.0, 2.0, 0.0, 0.25, 0.0)
    for at_s, rim_mps in ((0.0, 0.5), (0.1, 0.3), (0.2, 0.1), (0.25, 0.0)):
        assert planned_rim_mps(made, at_s) == pytest.approx(rim_mps)


def test_the_path_of_a_stop_by_numbers() -> None:
    # 0.5 m/s at the rim: 0.25 / 1.6 and 0.5 (0.6^2 / 8 + 0.01) and 0.512 / 600; the body's 0.6
    need_m = 0.15625 + 0.5 * (0.045 + 0.01) + 0.512 / 600
    assert stopping_m(Twist2(0.3, 0.5), 0.2, FRAME, BOUNDS, 0.01) == pytest.approx(0.6 * need_m)
    assert stopping_m(Twist2(-0.5, 0.0), 0.9, FRAME, BOUNDS, 0.01) == pytest.approx(
        0.15625 + 0.005 + 0.512 / 600
    )
    assert stopping_m(STILL, 0.0, FRAME, BOUNDS, 0.01) == 0.0


EPS = 1e-6
LAG_S = ROBOT.drive.lag_s
PLAN = StopPlan(Twist2(0.5, 0.0), 0.5, 0.2, 1.0, 0.08, 0.4, 0.1)


"""Rises in 0.08 s, brakes flat for 0.4 s, fades in 0.1 s."""


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


@table("accel", [(0.3, 0.0), (0.0, -0.3), (0.3, -0.1)])
def test_each_wheel_brakes_its_own_way(accel: tuple[float, float]) -> None:
    # the left wheel at -0.025 m/s, the right one at 0.225 m/s
    assert _braking(LimiterState(Twist2(0.1, 0.5), *accel), ROBOT.base) == pytest.approx(0.3)


def test_a_stop_as_long_as_it_may_be_is_not_too_long() -> None:
    lag_s = ROBOT.drive.lag_s
    most_s = 1.5 * (PLAN.duration_s + lag_s) + 0.3
    assert not too_long(PLAN, most_s, lag_s)
    assert too_long(PLAN, most_s + EPS, lag_s)
