"""Hold what a status says to the state it is built of."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

import pytest

from bridge.core import Inbox, LoopFacts
from bridge.core.faults.fault_table import STAGES
from bridge.core.motion.limiter import stopping_m
from bridge.core.motion.obstacle_gate import weak_m
from bridge.core.reporting import report
from bridge.core.state import RowUp
from bridge.core.state_motion import Learnt, LimiterState
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import Mode, Twist2


def at(start: str = "active") -> TickContext:
    return tick_of(reached(start))


@table(
    ("value", "most", "shown"),
    [(0.0, 7.0, 0.0), (3.0, 7.0, 3.0), (7.0, 7.0, 7.0), (7.1, 7.0, 7.0), (inf, 7.0, 7.0),
     (0.5, 7.0, 0.5), (-0.1, 7.0, 0.0), (-inf, 7.0, 0.0), (nan, 7.0, 0.0)],
)  # fmt: skip
def test_a_number_is_shown_within_what_can_be_said(value: float, most: float, shown: float) -> None:
    assert report._between(value, most) == shown


def test_a_leg_is_followed_while_its_horizon_moves_the_robot() -> None:
    leg = reached("active").state.leg
    assert leg.horizon is not None
    empty = replace(leg, horizon=leg.horizon.model_copy(update={"points": ()}))
    for start, held, follows in (
        ("active", leg, True), ("hold", leg, False), ("active", empty, False),
        ("active", replace(leg, horizon=None), False), ("hold", replace(leg, horizon=None), False),
    ):  # fmt: skip
        tick = at(start)
        tick.s.leg = held
        told = report.build(tick).leg
        assert told is not None
        assert told.following is follows
        tick.s.leg = replace(held, mission=None)
        assert report.build(tick).leg is None


@table("learnt", [Learnt(), Learnt(lag_more_s=0.2, decel_share=0.5)])
@table("v_mps", [0.4, -0.4])
def test_the_margin_is_what_is_free_beyond_the_stop(learnt: Learnt, v_mps: float) -> None:
    tick, sent = at(), Twist2(v_mps, 0.1)
    tick.s.learnt, tick.s.motion.limiter = learnt, LimiterState(sent)
    tick.s.motion.free_m, tick.s.motion.cap = 1.5, 0.5
    stop_m = stopping_m(sent, 0.0, ROBOT.base, ROBOT.limits, tick.config.period_s)
    stop_m += weak_m(sent, ROBOT, learnt.decel_share) + 0.4 * (
        ROBOT.drive.lag_s + learnt.lag_more_s
    )
    told = report.build(tick).limits
    assert told.margin_m == pytest.approx(1.5 - stop_m)
    assert (told.free_m, told.v_mps) == (1.5, ROBOT.limits.max_speed_mps * 0.5)
    tick.s.motion.free_m = None
    assert report.build(tick).limits.margin_m is None


@table(
    ("lag_more_s", "share", "learnt"),
    [(0.0, 1.0, False), (0.2, 1.0, True), (0.0, 0.5, True), (0.2, 0.5, True)],
)
def test_what_counts_when_braking_is_shown(lag_more_s: float, share: float, learnt: bool) -> None:
    tick = at()
    tick.s.learnt = Learnt(lag_more_s=lag_more_s, decel_share=share)
    told = report.build(tick).braking
    assert told.lag_s == ROBOT.drive.lag_s + lag_more_s
    assert told.decel_mps2 == pytest.approx(ROBOT.limits.max_decel_mps2 * share)
    assert told.learnt is learnt


@table(
    ("start", "names", "shown", "binding"),
    [
        ("active", ("LIDAR_STALE.0", "LIDAR_STALE.1"), "LIDAR_STALE.1", True),
        ("active", ("LIDAR_STALE.1", "LIDAR_STALE.0"), "LIDAR_STALE.1", True),
        # what binds comes before what is harder
        ("teleop", ("NO_RANGE.0", "NO_RANGE.1"), "NO_RANGE.1", True),
        ("teleop", ("NO_RANGE.1", "NO_RANGE.0"), "NO_RANGE.1", True),
        # of two that are as bad the first that rose
        ("disarmed", ("CMD_STALE.0", "CMD_STALE.1"), "CMD_STALE.0", False),
        ("disarmed", ("CMD_STALE.1", "CMD_STALE.0"), "CMD_STALE.1", False),
    ],
)
def test_a_row_is_shown_once_by_its_worst_stage(
    start: str, names: tuple[str, ...], shown: str, binding: bool
) -> None:
    tick = at(start)
    tick.s.rows = {name: RowUp(tick.now_s - 2.0 - int(name[-1]), 0.0, name) for name in names}
    [told] = report.build(tick).rows
    assert (told.row, told.evidence, told.binding) == (shown[:-2], shown, binding)
    assert told.action is STAGES[shown].action
    assert told.for_s == pytest.approx(2.0 + int(shown[-1]))


def test_what_is_too_long_to_say_is_cut() -> None:
    tick = at()
    tick.s.rows = {"BATTERY.0": RowUp(-1.0, 0.0, "e" * 500)}
    tick.now_s = 2e9
    tick.inbox = Inbox(loop=LoopFacts(late_p50_us=2e9, late_max_us=3.0, step_max_us=inf))
    told = report.build(tick)
    assert (told.at_s, told.rows[0].for_s, told.rows[0].evidence) == (1e9, 1e9, "e" * 400)
    ticks = told.ticks
    assert (ticks.late_p50_us, ticks.late_max_us, ticks.step_max_us) == (1e9, 3.0, 1e9)


@table(
    ("start", "fault", "recorded", "waits"),
    [
        ("fault", "stop_too_slow", True, ("stop_too_slow",)), ("fault", None, True, ()),
        ("fault", None, False, ()), ("hold", "old", True, ()), ("active", "old", True, ()),
        ("active", None, False, ("recorder_down",)), ("estopped", "old", False, ()),
        ("disarmed", None, False, ("recorder_down",)), ("disarmed", "old", True, ()),
    ],
)  # fmt: skip
def test_what_is_waited_for(
    start: str, fault: str | None, recorded: bool, waits: tuple[str, ...]
) -> None:
    tick = at(start)
    tick.s.fault, tick.s.rows = fault, {}
    tick.s.loop = replace(tick.s.loop, recorder_ok=recorded)
    tick.inbox = Inbox(recorder_ok=recorded)
    assert report.build(tick).waiting_for == waits


def test_eight_things_that_are_waited_for_are_told_and_no_more() -> None:
    tick = at("disarmed")
    everyones = [name for name, stage in STAGES.items() if stage.clears.value == "ON_RESET"]
    more = ["ENC_STALE.0", "LIDAR_STALE.0", "LIDAR_BLIND.0", "DRIVE_REBOOT.0", "BATTERY.1"]
    up = RowUp(tick.now_s, tick.now_s, "seen")
    tick.s.rows = dict.fromkeys((*everyones, *more), up)
    tick.s.drive.still_since_s, tick.s.lidar = None, replace(tick.s.lidar, received_s=None)
    assert tick.s.mode is Mode.DISARMED
    assert len(set(report._waiting(tick))) > 8
    assert report.build(tick).waiting_for == report._waiting(tick)[:8]
