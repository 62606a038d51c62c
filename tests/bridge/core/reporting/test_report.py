"""Hold when a status, odometry and events go out."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from bridge.core import Inbox
from bridge.core.reporting import report
from bridge.core.state import BridgeState, Voice, draft
from bridge.core.state_motion import Gate
from tests.bridge.core.fake_planner import BOOT
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table
from wire import HeldReason, Imu, Mode, StandingHold

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
    tick = tick_of(reached("active"))
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
        tick = tick_of(reached("active"))
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
    tick = tick_of(reached("active"))
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
