"""Hold the path and speed of a stop, and what a ramp teaches, to numbers worked out by hand."""

from __future__ import annotations

from dataclasses import replace
from math import nan, sqrt
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geometry.stopping import speed_before, speed_within, stop_length_m
from bridge.core.motion import braking as module
from bridge.core.motion.braking import after_cut, after_stop, speed_scale
from bridge.core.motion.free_distance import FreeLength
from bridge.core.state_motion import AS_CONFIGURED, UNLEARNT, Braking, Learnt, LimiterState, Ramp
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at
from tests.bridge.core.table import table
from wire import STILL, RobotDescription, Twist2

EPS = 1e-6


ROBOT = RobotDescription.model_validate({"limits": {"max_decel_mps2": 0.8, "stop_jerk_mps3": 5.0}})
"""Brakes at 0.8 m/s2 and takes 0.08 s of mean delay to build that up; 0.06 s late; 0.5 m wide."""
BASE, LIMITS = ROBOT.base, ROBOT.limits


def free(s_m: float, *, touching: bool = False, known: bool = True) -> FreeLength:
    return FreeLength(s_m, known, True, touching)


def within(s_m: float, decel: float, late_s: float) -> float:
    """Return the speed of which s = v t + v^2 / 2a, by the school's formula."""
    return decel * (sqrt(late_s * late_s + 2 * s_m / decel) - late_s)


@table(
    ("s_m", "decel", "late_s", "speed"),
    [
        (0.5, 0.8, 0.0, sqrt(0.8)),
        (0.0, 0.8, 0.0, 0.0),
        (-1.0, 0.8, 0.3, 0.0),
        (0.5, 0.0, 0.3, 0.0),
        (0.5, -1.0, 0.3, 0.0),
        (0.5, 0.8, -EPS, 0.0),
        (nan, 0.8, 0.3, 0.0),
        (0.5, nan, 0.3, 0.0),
        (0.5, 0.8, nan, 0.0),
    ],
)
def test_the_speed_that_stops_within_a_length(
    s_m: float, decel: float, late_s: float, speed: float
) -> None:
    assert speed_within(s_m, decel, late_s) == pytest.approx(speed)


@given(st.floats(0.001, 3), st.floats(0.05, 5), st.floats(0, 1))
def test_the_speed_within_a_length_stops_within_it(s_m: float, decel: float, late_s: float) -> None:
    v = speed_within(s_m, decel, late_s)
    assert v * late_s + v * v / (2 * decel) == pytest.approx(s_m)


@table(
    ("way", "twist", "scale"),
    [
        (free(9.0), Twist2(0.5, 0.2), 1.0),
        (free(0.2), Twist2(0.5, 0.0), within(0.2, 0.8, 0.3) / 0.5),
        (free(0.2), Twist2(-0.5, 0.0), within(0.2, 0.8, 0.3) / 0.5),
        (free(0.2), Twist2(0.5, 0.5), within(0.2, 0.64, 0.3) / 0.5),
        (free(0.0062), Twist2(0.5, 0.0), 0.0),  # 0.0199 m/s would be standing
        (free(0.0063), Twist2(0.5, 0.0), within(0.0063, 0.8, 0.3) / 0.5),
        (free(0.005), Twist2(0.01, 0.0), 1.0),
        (free(0.0), Twist2(0.5, 0.0), 0.0),
        (free(9.0, touching=True), Twist2(0.5, 0.0), 0.2),
        (free(9.0, touching=True), Twist2(-0.5, 0.0), 0.2),
        (free(9.0, touching=True), Twist2(0.2, 1.0), 0.3),
        (free(9.0, touching=True), Twist2(0.05, -1.0), 0.3),
        (free(9.0, touching=True), Twist2(0.05, 0.1), 1.0),
        (free(0.01, touching=True), Twist2(0.5, 0.0), within(0.01, 0.8, 0.3) / 0.5),
        (free(0.001, touching=True), Twist2(0.5, 0.0), within(0.001, 0.8, 0.3) / 0.5),
        (free(0.0), Twist2(0.99e-4, 1.0), 1.0),
        (free(0.0), Twist2(1e-4, 1.0), 0.0),
        (free(0.0, touching=True), Twist2(0.0, 1.0), 0.3),
        (free(0.0, touching=True), Twist2(0.0, 0.2), 1.0),
        (free(0.5), Twist2(nan, 0.0), 0.0),
    ],
)
def test_what_a_free_length_lets_pass(way: FreeLength, twist: Twist2, scale: float) -> None:
    assert speed_scale(way.s_m, twist, BASE, LIMITS, 0.3, touching=way.touching) == pytest.approx(
        scale
    )
    if 0.0 < scale < 1.0 and not way.touching:
        weak = within(way.s_m, 0.4 * 0.5 / (0.5 + abs(twist.w_radps) / 4), 0.3) / 0.5
        assert speed_scale(
            way.s_m, twist, BASE, LIMITS, 0.3, 0.5, touching=way.touching
        ) == pytest.approx(weak if weak * 0.5 >= 0.02 else 0.0)


@table(
    ("twist", "share", "length_m"),
    [
        (Twist2(0.4, 0.0), 1.0, 0.4 * 0.3 + 0.16 / 1.6),
        (Twist2(-0.4, 0.0), 0.5, 0.4 * 0.3 + 0.16 / 0.8),
        (Twist2(0.4, -0.8), 1.0, 0.4 * 0.3 + 0.16 * 3 / 3.2),
        (STILL, 1.0, 0.0),
        (Twist2(0.0, 1.0), 1.0, 0.0),
    ],
)
def test_the_path_until_standstill(twist: Twist2, share: float, length_m: float) -> None:
    assert stop_length_m(twist, BASE, LIMITS, 0.3, share) == pytest.approx(length_m)


@pytest.mark.parametrize("gap_m", [0.01, 0.1, 0.5])
@pytest.mark.parametrize(("decel", "late_s"), [(1.0, 0.0), (0.5, 0.2)])
def test_a_speed_before_a_slow_area_is_down_to_its_speed_at_the_edge(
    gap_m: float, decel: float, late_s: float
) -> None:
    slow = 0.2
    speed = speed_before(gap_m, slow, decel, late_s)
    assert speed >= slow
    needed_m = speed * late_s + (speed * speed - slow * slow) / (2 * decel)
    assert speed == slow or needed_m == pytest.approx(gap_m)


@pytest.mark.parametrize("gap_m", [0.0, -1.0, float("nan")])
def test_inside_a_slow_area_its_speed_is_the_bound(gap_m: float) -> None:
    assert speed_before(gap_m, 0.2, 1.0, 0.1) == 0.2


LAG = Learnt(lag_more_s=0.1, lag_at_mps=0.5)
WEAK = Learnt(decel_share=0.5, share_at_mps=0.5)


def lag(better: int, worst_s: float) -> Learnt:
    return replace(LAG, lag_better=better, lag_worst_s=worst_s)


def weak(better: int, worst: float) -> Learnt:
    return replace(WEAK, share_better=better, share_worst=worst)


def ramp(sent_s: float = 0.5, real_s: float = 0.5, late_s: float = 0.06, **more: float) -> Ramp:
    """Return a stop from 0.5 m/s: the marks of what was sent and measured, and both paths."""
    marks = (1.0, 1.0 + sent_s, 1.0 + late_s, 1.0 + late_s + real_s)
    return replace(Ramp(0.9, 0.5, 0.5, 0.0, 0.0, 0.2, 0.23, 0.0, *marks), **more)


def test_what_is_known_is_in_force() -> None:
    assert UNLEARNT.in_force() is AS_CONFIGURED
    assert LAG.in_force() == Braking(0.1, 1.0)
    assert WEAK.in_force() == Braking(0.0, 0.5)
    for share, factor in ((1.0, 1.0), (0.5, 1.0), (0.5 - EPS, 0.5 - EPS), (0.1, 0.1)):
        assert Learnt(decel_share=share).speed_share() == factor


@table(
    ("known", "more_s", "from_mps", "after"),
    [
        (UNLEARNT, 0.01, 0.4, UNLEARNT),
        (UNLEARNT, 0.01 + EPS, 0.4, Learnt(lag_more_s=0.01 + EPS, lag_at_mps=0.4)),
        (UNLEARNT, 0.9, 0.4, Learnt(lag_more_s=0.5, lag_at_mps=0.4)),
        (UNLEARNT, -1.0, 0.4, UNLEARNT),
        (lag(3, 0.05), 0.11 - EPS, 0.4, LAG),
        (LAG, 0.12, 0.3, Learnt(lag_more_s=0.12, lag_at_mps=0.3)),
        (lag(3, 0.05), 0.11 + EPS, 0.4, Learnt(lag_more_s=0.11 + EPS, lag_at_mps=0.4)),
        (lag(3, 0.05), 0.09 + EPS, 0.5, LAG),
        (LAG, 0.09 - EPS, 0.5, lag(1, 0.09 - EPS)),
        (LAG, 0.02, 0.4, lag(1, 0.02)),
        (LAG, 0.02, 0.4 - EPS, LAG),
        (lag(3, 0.05), 0.02, 0.5, lag(4, 0.05)),
        (lag(48, 0.01), 0.02, 0.5, lag(49, 0.02)),
        (lag(49, 0.05), 0.02, 0.5, Learnt(lag_more_s=0.05, lag_at_mps=0.5)),
    ],
)
def test_lag_is_worse_at_once_and_better_after_fifty(
    known: Learnt, more_s: float, from_mps: float, after: Learnt
) -> None:
    assert module._with_lag(known, more_s, from_mps) == after


@table(
    ("known", "share", "from_mps", "after"),
    [
        (UNLEARNT, 0.95, 0.5, UNLEARNT),
        (WEAK, 0.55, 0.5, WEAK),
        (WEAK, 0.55 + EPS, 0.5, weak(1, 0.55 + EPS)),
        (WEAK, 2.0, 0.4, weak(1, 1.0)),
        (WEAK, 2.0, 0.4 - EPS, WEAK),
        (weak(48, 0.7), 0.8, 0.5, weak(49, 0.7)),
        (weak(49, 0.9), 0.8, 0.5, Learnt(decel_share=0.8, share_at_mps=0.5)),
    ],
)
def test_stronger_brakes_count_after_fifty(
    known: Learnt, share: float, from_mps: float, after: Learnt
) -> None:
    assert module._with_better(known, share, from_mps) == after


@table(
    ("known", "share", "after"),
    [
        (UNLEARNT, 0.95, UNLEARNT),
        (UNLEARNT, 0.95 - EPS, Learnt(decel_share=0.95 - EPS, share_at_mps=0.4)),
        (UNLEARNT, 0.05, Learnt(decel_share=0.1, share_at_mps=0.4)),
        (weak(3, 0.6), 0.45, WEAK),
        (weak(3, 0.6), 0.45 - EPS, Learnt(decel_share=0.45 - EPS, share_at_mps=0.4)),
    ],
)
def test_weaker_brakes_count_at_once(known: Learnt, share: float, after: Learnt) -> None:
    assert module._with_weaker(known, share, 0.4) == after


# between the marks, 0.375 and 0.125 m/s, brakes of 0.8 m/s2 take 0.3125 s
@table(
    ("known", "stop", "share", "better"),
    [
        (UNLEARNT, ramp(), 1.0, 0),
        (UNLEARNT, ramp(0.3125, 0.625, 0.06), 0.5, 0),  # later by 0.3125 s at the second mark
        (UNLEARNT, ramp(0.3125, 0.625, 0.3125), 0.5, 0),
        (UNLEARNT, ramp(0.3125, 0.625, 0.3126), 1.0, 0),  # not twice as late: a lag
        (UNLEARNT, ramp(0.3125, 0.3125 / 0.85 + EPS, 0.01), 0.85, 0),
        (UNLEARNT, ramp(0.3125, 0.3125 / 0.85 - EPS, 0.01), 1.0, 0),
        (UNLEARNT, ramp(0.1999, 0.625), 1.0, 0),
        (UNLEARNT, ramp(0.2001, 0.625), 0.5, 0),
        (UNLEARNT, ramp(0.3125, 0.625, rise_mps=0.025), 0.5, 0),
        (UNLEARNT, ramp(0.3125, 0.625, rise_mps=0.025 + EPS), 1.0, 0),
        (UNLEARNT, ramp(0.3125, 0.0), 1.0, 0),
        (WEAK, ramp(0.3125, 0.0), 0.5, 0),
        (WEAK, ramp(0.3125, 0.3125), 0.5, 1),
        (WEAK, ramp(0.3125, 0.3125, from_mps=0.3), 0.5, 0),
    ],
)
def test_the_slope_between_the_marks_tells_weak_brakes(
    known: Learnt, stop: Ramp, share: float, better: int
) -> None:
    after = module._with_slope(known, stop, ROBOT)
    assert after.decel_share == pytest.approx(share, abs=1e-4)
    assert after.share_better == better
    for mark in ("sent_high_s", "sent_low_s", "real_high_s", "real_low_s"):
        cut: dict[str, Any] = {mark: None}
        assert module._with_slope(known, replace(stop, **cut), ROBOT) == known


def test_what_a_better_slope_shows_is_told_with_its_slack() -> None:
    # measured in as much time as sent: 1.0 of the brakes; over 0.85, held at 1
    after = module._with_slope(WEAK, ramp(0.5, 0.5), ROBOT)
    assert after.share_worst == pytest.approx(0.3125 / 0.5 / 0.85)


@table(
    ("known", "stop", "lag_s", "stops"),
    [
        # sent 0.2 m, rolled 0.23 m from 0.5 m/s: as late as it is said to be
        (UNLEARNT, ramp(), 0.0, 1),
        (UNLEARNT, ramp(real_m=0.28), 0.1, 1),
        (UNLEARNT, ramp(real_m=0.28, real_from_mps=0.4), 0.14, 1),
        (UNLEARNT, ramp(real_m=0.9, real_from_mps=0.1 - EPS), 0.0, 0),
        (UNLEARNT, ramp(real_m=0.9, real_from_mps=0.1), 0.5, 1),
        # sent harder than 0.156 m, the brakes' own path: nothing of lag, unless it is more
        (UNLEARNT, ramp(sent_m=0.1, real_m=0.17), 0.0, 1),
        (UNLEARNT, ramp(sent_m=0.1, real_m=0.23), (0.23 - 0.15625) / 0.5 - 0.06, 1),
        (LAG, ramp(sent_m=0.1, real_m=0.2), 0.1, 1),
        (LAG, ramp(sent_m=0.1, real_m=0.3), (0.3 - 0.15625) / 0.5 - 0.06, 1),
        (replace(LAG, stops=10**9), ramp(), 0.1, 10**9),
    ],
)
def test_what_brakes_do_not_explain_is_lag(
    known: Learnt, stop: Ramp, lag_s: float, stops: int
) -> None:
    after = after_stop(known, stop, ROBOT)
    assert after.lag_more_s == pytest.approx(lag_s)
    assert after.stops == stops


def test_a_stop_sent_harder_than_it_brakes_ends_no_count_of_better_ones() -> None:
    counting = lag(7, 0.01)
    assert after_stop(counting, ramp(sent_m=0.15, real_m=0.17), ROBOT).lag_better == 7
    assert after_stop(counting, ramp(sent_m=0.16, real_m=0.17), ROBOT).lag_better == 8
    weaker = replace(counting, decel_share=0.5, share_at_mps=0.9)  # its own path is 0.3125 m
    assert after_stop(weaker, ramp(sent_m=0.3, real_m=0.32), ROBOT).lag_better == 7
    assert after_stop(weaker, ramp(sent_m=0.32, real_m=0.33), ROBOT).lag_better == 8


@table(
    ("known", "at_s", "sent_mps", "real_mps", "share"),
    [
        # late by 0.06 s and 0.08 s: 0.4 s of braking at 1.44 s after the start at 0.9 s
        (UNLEARNT, 1.44, 0.1, 0.34, 0.16 / 0.4 / 0.8),
        (UNLEARNT, 1.44, 0.1, 0.15, 1.0),  # 0.35 of 0.4 m/s: nearly as told
        (UNLEARNT, 1.44, 0.3, 0.34, 0.16 / 0.4 / 0.8),
        (UNLEARNT, 1.44, 0.1, 0.5, 0.1),
        (UNLEARNT, 1.23999, 0.1, 0.45, 1.0),
        (UNLEARNT, 1.24001, 0.1, 0.45, 0.05 / 0.2 / 0.8),
        (LAG, 1.33999, 0.1, 0.45, 1.0),
        (LAG, 1.34001, 0.1, 0.45, 0.05 / 0.2 / 0.8),
        (UNLEARNT, 1.34, 0.0, 0.28, 1.0),  # 0.22 of 0.5 m/s in 0.3 s, 0.92 of the brakes
        (UNLEARNT, 1.34, 0.0, 0.3, 0.2 / 0.3 / 0.8),
        (UNLEARNT, 1.34, 0.3, 0.33001, 0.16999 / 0.3 / 0.8),
        (UNLEARNT, 1.34, 0.3, 0.32999, 1.0),
    ],
)
def test_a_stop_that_was_cut_teaches_what_it_braked_until_then(
    known: Learnt, at_s: float, sent_mps: float, real_mps: float, share: float
) -> None:
    stop = ramp(sent_mps=sent_mps, real_mps=real_mps)
    after = after_cut(known, stop, ROBOT, at_s)
    assert after.decel_share == pytest.approx(share, abs=1e-4)
    taught = share < 1.0 or (at_s, real_mps) == (1.34, 0.28)
    assert after.stops == taught
    assert after.lag_more_s == known.lag_more_s
    full = after_cut(replace(known, stops=10**9), stop, ROBOT, at_s)
    assert full.stops == 10**9


@table(
    ("at_s", "before", "after", "crossed_s"),
    [
        (None, 0.5, 0.4, None),
        (None, 0.5, 0.3, 9.99),
        (None, 0.4, 0.2, 9.99 + 0.005),
        (None, 0.35, 0.15, 9.99 + 0.0025),
        (None, 0.3, 0.3, 10.0),
        (None, 0.2, 0.25, 10.0),
        (7.0, 0.4, 0.2, 7.0),
    ],
)
def test_when_a_mark_was_crossed_is_told_between_two_ticks(
    at_s: float | None, before: float, after: float, crossed_s: float | None
) -> None:
    expected = {9.99: 10.0}.get(crossed_s or 0.0, crossed_s)
    found = module._crossing_s(at_s, before, after, 0.3, 10.0, 0.01)
    assert found == (None if expected is None else pytest.approx(expected))


def ticking(
    sent: Twist2, was: Twist2, real: Twist2, measured: Twist2
) -> tuple[TickContext, TickContext]:
    """Return a tick that sends one motion, and the one before it; both measure something."""
    before, tick = at(), at()
    for one, limiter, odometry in ((before, was, measured), (tick, sent, real)):
        one.now_s = 10.0
        one.config = replace(one.config, robot=ROBOT)
        one.s.motion.limiter = LimiterState(limiter)
        one.s.odometry = replace(one.s.odometry, measured=odometry)
        one.s.drive.received_s, one.s.ramp, one.s.learnt = 10.0, None, UNLEARNT
        one.s.motion.powered = True
    before.s.now_s = 9.99
    return tick, before


@table(
    ("sent", "was", "begins"),
    [
        (0.39, 0.4, True), (-0.39, -0.4, True), (0.4, 0.4, False), (0.41, 0.4, False),
        (0.09, 0.1, True), (0.09, 0.1 - EPS, False), (0.0, 0.1, True),
    ],
)  # fmt: skip
def test_a_ramp_begins_where_what_is_sent_falls(sent: float, was: float, begins: bool) -> None:
    tick, before = ticking(Twist2(sent, 0.0), Twist2(was, 0.0), Twist2(0.1, 0.4), Twist2(0.1, 0.2))
    module.watch(tick, before.s)
    made = tick.s.ramp
    assert (made is not None) is begins
    if made is not None:
        speed = abs(was)
        assert made == Ramp(
            9.99, speed, made.real_from_mps, abs(sent), 0.2, made.sent_m, made.real_m, 0.0,
            made.sent_high_s, made.sent_low_s, made.real_high_s, made.real_low_s,
        )  # fmt: skip
        assert (made.sent_m, made.real_m) == pytest.approx((speed * 0.01, 0.002))
        assert made.real_from_mps == pytest.approx(0.15)


@table("why", ["unpowered", "unmeasured", "old", "slept"])
def test_no_ramp_begins_where_nothing_could_be_learnt(why: str) -> None:
    tick, before = ticking(Twist2(0.3, 0.0), Twist2(0.4, 0.0), STILL, STILL)
    before.s.motion.powered = why != "unpowered"
    tick.s.drive.received_s = {"unmeasured": None, "old": 9.95 - EPS}.get(why, 9.951)
    tick.dt_s = 0.05 + EPS if why == "slept" else 0.05
    module.watch(tick, before.s)
    assert tick.s.ramp is None
    before.s.motion.powered, tick.s.drive.received_s, tick.dt_s = True, 9.951, 0.05
    module.watch(tick, before.s)
    assert tick.s.ramp is not None


UNDER_WAY = Ramp(9.5, 0.4, 0.4, 0.31, 0.35, 0.1, 0.12, 0.01)


@table(
    ("sent", "real", "goes_on"),
    [
        (0.29, 0.34, True), (0.39, 0.34, True), (0.4, 0.34, False), (0.41, 0.34, False),
        (0.29, 0.55, True), (0.29, 0.55 + EPS, False),
    ],
)  # fmt: skip
def test_a_ramp_goes_on_until_it_rises_to_its_beginning(
    sent: float, real: float, goes_on: bool
) -> None:
    tick, before = ticking(Twist2(sent, 0.0), Twist2(0.31, 0.0), Twist2(real, 0.0), STILL)
    tick.s.ramp = UNDER_WAY
    module.watch(tick, before.s)
    after = tick.s.ramp
    assert (after is not None) is goes_on
    if after is not None:
        assert (after.sent_mps, after.real_mps) == (sent, real)
        assert after.sent_m == pytest.approx(0.1 + 0.31 * 0.01)
        assert after.real_m == pytest.approx(0.12 + real * 0.01)
        assert after.rise_mps == pytest.approx(0.01 + max(0.0, sent - 0.31))
        crossed = after.sent_high_s if sent < 0.3 else None
        assert crossed == (pytest.approx(9.995) if sent < 0.3 else None)
    for age_s, kept in ((5.0, True), (5.0 + EPS, False)):
        tick, before = ticking(Twist2(0.29, 0.0), Twist2(0.31, 0.0), Twist2(0.34, 0.0), STILL)
        tick.s.ramp = replace(UNDER_WAY, since_s=10.0 - age_s)
        module.watch(tick, before.s)
        assert (tick.s.ramp is not None) is kept


@table("which", ["sent_high_s", "sent_low_s", "real_high_s", "real_low_s"])
def test_each_mark_is_its_own(which: str) -> None:
    low, real = "low" in which, "real" in which
    mark = 0.1 if low else 0.3
    above, below = mark + 0.005, mark - 0.005
    sent, was = (below, above) if not real else (0.35, 0.36)
    tick, before = ticking(Twist2(sent, 0.0), Twist2(was, 0.0), Twist2(0.35, 0.0), STILL)
    real_mps = below if real else 0.35
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(real_mps, 0.0))
    tick.s.ramp = replace(UNDER_WAY, sent_mps=was, real_mps=above if real else 0.36)
    if low and not real:
        tick.s.ramp = replace(tick.s.ramp, sent_high_s=9.0)
    if low and real:
        tick.s.ramp = replace(tick.s.ramp, real_high_s=9.0)
    module.watch(tick, before.s)
    assert tick.s.ramp is not None
    assert getattr(tick.s.ramp, which) == pytest.approx(9.995)
    marks = ("sent_high_s", "sent_low_s", "real_high_s", "real_low_s")
    seen = {name for name in marks if getattr(tick.s.ramp, name) is not None}
    assert seen == {which, *([which.replace("low", "high")] if low else [])}


def test_a_ramp_ends_where_the_robot_stands_and_says_what_changed() -> None:
    for stands, sent, ends in ((True, 0.0, True), (False, 0.0, False), (True, 0.01, False)):
        tick, before = ticking(Twist2(sent, 0.0), Twist2(0.02, 0.0), STILL, STILL)
        tick.s.ramp = replace(UNDER_WAY, sent_mps=0.02, real_mps=0.0, sent_m=0.1, real_m=0.18)
        tick.s.drive.still_since_s = 9.9 if stands else None
        module.watch(tick, before.s)
        assert (tick.s.ramp is None) is ends
        assert tick.s.learnt.stops == ends
    # 0.1002 m were sent, 0.08 m at most by the brakes' own path of 0.1 m; 0.18 m rolled from 0.4
    tick, before = ticking(STILL, Twist2(0.02, 0.0), STILL, STILL)
    tick.s.ramp = replace(UNDER_WAY, sent_mps=0.02, real_mps=0.0, sent_m=0.1, real_m=0.18)
    tick.s.drive.still_since_s = 9.9
    module.watch(tick, before.s)
    assert tick.s.learnt.lag_more_s == pytest.approx((0.18 - 0.1002) / 0.4 - 0.06)
    ((code, detail),) = tick.events
    assert code == "braking_learnt"
    assert detail == (
        "a stop from 0.40 m/s took 0.180 m, sent 0.100 m: lag 0.199 s, deceleration 0.80 m/s2"
    )


def test_a_stop_cut_in_the_middle_teaches_from_what_it_was_and_says_nothing_else() -> None:
    tick, before = ticking(STILL, Twist2(0.3, 0.0), Twist2(0.3, 0.0), STILL)
    tick.s.ramp = replace(UNDER_WAY, since_s=9.46, sent_mps=0.1, real_mps=0.24)
    tick.s.motion.powered = False
    module.watch(tick, before.s)
    assert tick.s.learnt.decel_share == pytest.approx(0.16 / 0.4 / 0.8)
    assert tick.s.ramp is None
    assert tick.events[0][1].endswith("lag 0.060 s, deceleration 0.40 m/s2")
    again, before = ticking(STILL, Twist2(0.3, 0.0), Twist2(0.3, 0.0), STILL)
    again.s.ramp, again.s.learnt = replace(UNDER_WAY, since_s=9.9), tick.s.learnt
    again.s.motion.powered = False
    module.watch(again, before.s)
    assert (again.events, again.s.learnt) == ([], tick.s.learnt)


def test_who_keeps_the_speed_is_not_looked_at() -> None:
    tick, before = ticking(Twist2(0.4, 0.0), Twist2(0.4, 0.0), STILL, STILL)
    module.watch(tick, before.s)
    assert tick.s.ramp is None
    tick.s.ramp, tick.s.motion.limiter = UNDER_WAY, LimiterState(Twist2(0.31, 0.0))
    before.s.motion.limiter = tick.s.motion.limiter
    module.watch(tick, before.s)
    assert tick.s.ramp is not None
    assert tick.s.ramp.sent_m > UNDER_WAY.sent_m
