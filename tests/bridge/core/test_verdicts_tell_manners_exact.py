"""Hold verdicts, what is told when, and the score of manners to their numbers, by single calls."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from bridge.core import Inbox
from bridge.core.authority import message_score, requests
from bridge.core.inbox import RejectedAt
from bridge.core.reporting import report
from bridge.core.state import BridgeState, Voice, draft
from bridge.core.state_motion import Gate
from bridge.core.state_orders import TimedAnswer
from bridge.core.tick_context import TickContext
from tests.bridge.core.fake_planner import BOOT
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import tick_of
from wire import Answer, Held, HeldReason, Imu, Mode, Rejected

EPS = 1e-9


def quiet() -> TickContext:
    """Return a tick in which nobody has been answered or refused anything yet."""
    tick = tick_of(reached("active"))
    tick.s.operator = replace(tick.s.operator, answers=(), refusals=())
    return tick


# Verdicts ---------------------------------------------------------------------------------------


def test_64_verdicts_are_remembered_and_the_newest_16_shown() -> None:
    tick = quiet()
    for number in range(70):
        requests.settle(tick, "arm", f"a{number}", "ok" if number % 2 else "stopped", "d" * 500)
    kept = [item.answer for item in tick.s.operator.answers]
    assert [answer.id for answer in kept] == [f"a{number}" for number in range(6, 70)]
    assert [answer.accepted for answer in kept[:2]] == [False, True]
    assert requests.answers_to_echo(tick) == tuple(kept[-16:])
    assert kept[0].detail == "d" * 400
    assert tick.events[-1] == ("answered", "arm a69 ok")
    assert requests.verdict_on(tick, "arm", "a6") is kept[0]
    assert requests.verdict_on(tick, "arm", "a5") is None
    assert requests.verdict_on(tick, "reset", "a6") is None


@table(("age_s", "settled", "refused"), [(1.0, 1, 1), (1.05, 1, 0), (10.0, 1, 0), (10.5, 0, 0)])
def test_a_verdict_is_shown_for_10_s_and_a_refusal_for_1(
    age_s: float, settled: int, refused: int
) -> None:
    tick = quiet()
    answer = Answer(id="a", kind="arm", accepted=True, code="ok", detail="")
    both = (TimedAnswer(tick.now_s, answer),)
    tick.s.operator = replace(tick.s.operator, answers=both, refusals=both)
    tick.now_s += age_s
    assert len(requests.answers_to_echo(tick)) == settled + refused


def test_of_refusals_the_newest_of_each_sender_counts_and_eight_in_all() -> None:
    tick = quiet()
    for number in range(12):
        requests.refuse_openly(tick, "hello", f"p{number}", "owned", "by another")
    senders = [item.answer.id for item in tick.s.operator.refusals]
    assert senders == [f"p{number}" for number in range(4, 12)]
    assert len(tick.events) == 12
    requests.refuse_openly(tick, "hello", "p11", "owned", "by another")
    assert len(tick.events) == 12, "the same again is no news"
    requests.refuse_openly(tick, "hello", "p11", "moving", "wait")
    assert tick.events[12:] == [("hello_refused", "p11 moving wait")]
    requests.refuse_openly(tick, "grant", "p11", "moving", "wait")
    last = [(item.answer.kind, item.answer.id) for item in tick.s.operator.refusals][-2:]
    assert last == [("hello", "p11"), ("grant", "p11")], "of one sender one of each kind"
    requests.settle_openly(tick, "hello", "p11")
    left = [(item.answer.kind, item.answer.id) for item in tick.s.operator.refusals]
    assert ("hello", "p11") not in left
    assert left[-1] == ("grant", "p11")
    assert len(left) == 7


# When a status is due ---------------------------------------------------------------------------


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
        ({"held": Held(reason=HeldReason.STOP, id="s1")}, True),
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


# Odometry and events ----------------------------------------------------------------------------


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


# Manners ----------------------------------------------------------------------------------------


@table(
    ("start", "key", "scored"),
    [
        ("active", "cmd/waypoints", True), ("active", "cmd/external", False),
        ("active", "cmd/teleop", False), ("active", "cmd/hello", False),
        ("active_external", "cmd/external", True), ("active_external", "cmd/waypoints", False),
        ("teleop", "cmd/teleop", True), ("disarmed", "cmd/waypoints", False),
    ],
)  # fmt: skip
def test_bytes_that_are_nothing_are_charged_to_whoever_may_use_their_key(
    start: str, key: str, scored: bool
) -> None:
    tick = tick_of(reached(start))
    tick.s.bad_bucket = 1.0
    message_score.hear_rejected(tick)
    assert tick.s.bad_bucket == 1.0
    tick.inbox = Inbox(rejected=(RejectedAt(key, Rejected("malformed", "no JSON")),))
    message_score.hear_rejected(tick)
    assert tick.reasons == ["rejected_malformed"]
    assert tick.s.bad_bucket == 1.0 + scored


def test_a_bucket_of_ten_loses_one_in_half_a_second_and_one_per_good_message() -> None:
    tick = tick_of(reached("active"))
    tick.s.bad_bucket, tick.dt_s = 0.0, 0.01
    for _ in range(12):
        message_score.bad(tick, "bad")
    assert tick.s.bad_bucket == 10.0
    message_score.drain(tick)
    message_score.good(tick)
    assert tick.s.bad_bucket == 8.98
    tick.s.bad_bucket = 0.01
    message_score.drain(tick)
    assert tick.s.bad_bucket == 0.0
    message_score.drain(tick)
    message_score.good(tick)
    assert tick.s.bad_bucket == 0.0
