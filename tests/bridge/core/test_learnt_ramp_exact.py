"""Follow ramps tick by tick as the core does: where they begin, go on and end."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.motion import brake_learning as module
from bridge.core.state_motion import UNLEARNT, LimiterState, Ramp
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_learnt_exact import EPS, ROBOT
from tests.bridge.core.test_quick_core import tick_of
from wire import STILL, Twist2


def ticking(
    sent: Twist2, was: Twist2, real: Twist2, measured: Twist2
) -> tuple[TickContext, TickContext]:
    """Return a tick that sends one motion, and the one before it; both measure something."""
    before, tick = tick_of(reached("active")), tick_of(reached("active"))
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
