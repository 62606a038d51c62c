"""Hold when a status, odometry and events go out."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan
from typing import Any

import pytest

from bridge.core import Inbox, LoopFacts
from bridge.core.faults.fault_table import STAGES
from bridge.core.motion.limiter import stopping_m
from bridge.core.motion.obstacle_gate import weak_m
from bridge.core.reporting import report
from bridge.core.state import BridgeState, RowUp, Voice, draft
from bridge.core.state_motion import Gate, Learnt, LimiterState
from tests.bridge.core.fake_planner import BOOT
from tests.bridge.core.reached import at, reached
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import HeldReason, Imu, Mode, StandingHold, Twist2

EPS = 1e-9


@table(
    ("last_s", "now_s", "changed", "pending", "sent"),
    [
        (None, 0.0, False, False, True),
        (0.0, 0.05 - 0.001, False, False, True),
        (0.0, 0.05 - 0.001 - EPS, False, False, False),
        (100.0, 100.04, False, False, False),
        (0.0, 0.025 - 0.001, True, False, True),
        (0.0, 0.025 - 0.001 - EPS, True, False, False),
        (0.0, 0.03, False, True, True),
        (0.0, 0.02, False, True, False),
        (0.0, 0.02, True, True, False),
    ],
)
def test_a_status_is_due_20_times_a_second_or_at_once_but_never_over_40(
    last_s: float | None, now_s: float, changed: bool, pending: bool, sent: bool
) -> None:
    tick = at()
    before = reached("active").state
    tick.now_s = now_s
    tick.s.voice = voice = Voice(status_seq=7, ring=(3.0,), status_s=last_s, pending=pending)
    if changed:
        tick.s.epoch_no += 1
    status = report.status_of(tick, before)
    assert (status is not None) is sent
    if status is not None:
        assert status.seq == 8
        assert tick.s.voice == Voice(status_seq=8, ring=(3.0, now_s), status_s=now_s)
    elif changed and not pending:
        assert tick.s.voice == replace(voice, pending=True)
    else:
        assert tick.s.voice is voice


@table(
    ("change", "told"),
    [
        ({}, False),
        ({"mode": Mode.HOLD}, True),
        ({"epoch_no": 77}, True),
        ({"held": StandingHold(reason=HeldReason.STOP, id="s1")}, True),
        ({"gate": Gate(blocked=True)}, True),
        ({"gate": Gate(free_scans=3)}, False),
        ({"operator": {"nonce_no": 99}}, True),
        ({"ownership": {"owner": None}}, True),
        ({"ownership": {"echo_s": 1.0}}, False),
        ({"grants": {"mission": "other"}}, True),
        ({"grants": {"metres": 1.0}}, False),
        ({"leg": {"sent_s": 1.0}}, False),
        ({"leg": {"mission": "other"}}, True),
        ({"leg": {"leg": 99}}, True),
        ({"leg": {"reached": True}}, True),
        ({"leg": {"refusal": "fence"}}, True),
    ],
)
def test_what_others_wait_for_is_told_at_once(change: dict[str, Any], told: bool) -> None:
    old: BridgeState = reached("active").state
    new = draft(old)
    for name, value in change.items():
        made = replace(getattr(old, name), **value) if isinstance(value, dict) else value
        setattr(new, name, made)
    assert report._has_news(old, new) is told


@table(
    ("number", "heard", "same_host", "received_s", "stamp_s"),
    [
        (8, True, True, 3.0, 2.5),
        (8, True, False, 3.0, 3.0),
        (8, True, False, None, 4.0),
        (7, True, True, 3.0, None),
        (8, False, True, 3.0, None),
        (7, False, True, 3.0, None),
    ],
)
def test_odometry_goes_out_every_other_tick_as_of_its_reading(
    number: int, heard: bool, same_host: bool, received_s: float | None, stamp_s: float | None
) -> None:
    imu = Imu(boot_id="g0", seq=1, stamp_s=1.0, yaw_rate_radps=0.5, accel_x_mps2=0, accel_y_mps2=0)
    for gyro in (imu, None):
        tick = at()
        drive = tick.s.drive
        assert drive.newest is not None
        drive.newest = drive.newest.model_copy(update={"stamp_s": 2.5}) if heard else None
        drive.received_s, tick.s.tick, tick.now_s = received_s, number, 4.0
        tick.inbox = Inbox(sensors_same_host=same_host)
        tick.s.pose = replace(tick.s.pose, imu=gyro)
        told = report.odometry_of(tick)
        assert (told is None) is (stamp_s is None)
        if told is not None:
            rate = 0.5 if gyro else None
            assert (told.stamp_s, told.yaw_rate_radps, told.seq) == (stamp_s, rate, number)


@table(("now_s", "at_s"), [(0.5, 0.5), (-1.0, 0.0), (0.0, 0.0)])
def test_events_are_numbered_on(now_s: float, at_s: float) -> None:
    tick = at()
    tick.now_s, tick.s.voice = now_s, replace(tick.s.voice, event_seq=4)
    assert report.events_of(tick) == ()
    assert tick.s.voice.event_seq == 4
    tick.say("one", "x" * 500)
    tick.say("two")
    events = report.events_of(tick)
    assert [(one.seq, one.code, one.at_s, one.boot) for one in events] == [
        (5, "one", at_s, BOOT), (6, "two", at_s, BOOT),
    ]  # fmt: skip
    assert events[0].detail == "x" * 400
    assert tick.s.voice.event_seq == 6


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
