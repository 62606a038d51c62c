"""Hold how long an owner lives, and what of its messages counts."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.authority import epoch, ownership
from bridge.core.authority.requests import refuse_openly
from bridge.core.state_orders import Grants, MissionLeft
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at, reached
from tests.bridge.core.table import table
from wire import Grant, Heartbeat, HeldReason, StandingHold

EPS = 1e-6


@table(("age_s", "lives"), [(0.0, True), (0.3, True), (0.3 + EPS, False)])
def test_an_owner_lives_for_300_ms(age_s: float, lives: bool) -> None:
    tick = at("active")
    tick.now_s, tick.s.ownership = age_s, replace(tick.s.ownership, echo_s=0.0)
    assert ownership.is_alive(tick) is lives
    epoch_no = tick.s.epoch_no
    epoch.free_lost_owner(tick)
    assert (tick.s.ownership.owner is not None) is lives
    assert tick.s.epoch_no == epoch_no + (not lives)
    assert (("owner_lost", "p1") in tick.events) is not lives
    for part in ({"owner": None}, {"echo_s": None}):
        tick.s.ownership = replace(at("active").s.ownership, **part)
        assert not ownership.is_alive(tick)
    tick.s.ownership = replace(tick.s.ownership, owner=None, echo_s=None)
    tick.events.clear()
    epoch.free_lost_owner(tick)
    assert tick.events == []


def test_no_message_makes_an_owner_older_or_its_use_younger_than_it_is() -> None:
    tick = at("active")
    status = reached("active").status
    assert status is not None
    before = tick.s.ownership
    ring = tick.s.voice.ring
    assert ownership.sent_at_if_owner(tick, "p1", tick.epoch, status.seq - 5) == ring[-6]
    assert tick.s.ownership == before
    beat_used = before.used_s
    assert beat_used is not None
    for seen, used_s in ((status.seq - 9, beat_used), (status.seq, ring[-1])):
        world = reached("active")
        [beat] = world.brain._on_status(status)["heartbeats"]
        beat = beat.model_copy(update={"used": seen, "epoch": tick.epoch})
        ownership.hear_heartbeat(tick, beat)
        assert tick.s.ownership.used_s == used_s
        assert tick.s.ownership.echo_s == ring[-1]


@table(
    ("had_s", "back", "rightful", "used"),
    [
        (None, 0, True, True),
        (0.0, 0, True, True),
        (1e9, 0, True, False),
        (0.0, -1, True, False),  # of a status that was never sent
        (0.0, 0, False, False),
    ],
)
def test_what_a_brain_has_used_only_grows_newer(
    had_s: float | None, back: int, rightful: bool, used: bool
) -> None:
    tick = at("active")
    tick.s.ownership = replace(tick.s.ownership, used_s=had_s)
    newest = tick.s.voice.status_seq
    epoch = tick.epoch if rightful else "old-1"
    beat = Heartbeat(planner_id="p1", epoch=epoch, seen=newest, used=newest - back)
    ownership.hear_heartbeat(tick, beat)
    assert tick.s.ownership.used_s == (tick.s.voice.ring[-1] if used else had_s)


HELD = StandingHold(reason=HeldReason.STOP, id="s1")
BOOK = (MissionLeft("old", 1.0, 2.0),)


@table(
    ("start", "source", "mission", "metres", "seconds", "operator_seconds"),
    [
        ("active", "W", "m1", 4.5, 9.9, 99.9),
        ("active", "W", None, 0.0, 0.0, 99.9),
        ("stopping_by_row", "W", "m1", 4.5, 10.0, 100.0),
        ("stopping_by_row", "X", "m1", 4.5, 10.0, 100.0),
        ("stopping_by_row", "T", "m1", 5.0, 10.0, 100.0),
        ("teleop", "T", "m1", 5.0, 10.0, 100.0),
        ("hold", "", "m1", 5.0, 10.0, 100.0),
    ],
)
def test_way_and_time_are_metered_where_a_brain_causes_them(
    start: str,
    source: str,
    mission: str | None,
    metres: float,
    seconds: float,
    operator_seconds: float,
) -> None:
    before, tick = reached(start).state, at(start)
    if before.stopping is not None:
        before.stopping = replace(before.stopping, source=source)
    tick.dt_s = 0.1
    metres_had, seconds_had = (5.0, 10.0) if mission else (0.0, 0.0)
    tick.s.grants = Grants(mission, metres_had, seconds_had, BOOK, 50.0, 100.0, since_arm=True)
    far = before.odometry.travelled_m + 0.5
    tick.s.odometry = replace(tick.s.odometry, travelled_m=far)
    ownership.meter(tick, before)
    metered = metres < 5.0
    left = tick.s.grants
    assert (left.mission, left.book, left.since_arm) == (mission, BOOK, True)
    assert (left.metres, left.seconds) == pytest.approx((metres, seconds))
    operator_metres = 49.5 if metered else 50.0
    assert left.operator_metres == pytest.approx(operator_metres)
    assert left.operator_seconds == pytest.approx(operator_seconds)
    tick.s.odometry = replace(tick.s.odometry, travelled_m=far + 1e3)
    tick.dt_s = 1e3
    ownership.meter(tick, before)
    left = tick.s.grants
    if metered:
        assert (left.metres, left.operator_metres) == (0.0, 0.0), "and no less than nothing"
    if operator_seconds < 100.0:
        assert (left.seconds, left.operator_seconds) == (0.0, 0.0)
    if before.stopping is not None:
        before.stopping = None
        had = tick.s.grants
        ownership.meter(tick, before)
        assert tick.s.grants is had, "nobody's stop is nobody's way"


@table(
    ("start", "held", "left", "operator_left", "code"),
    [
        ("hold", None, (1.0, 1.0), (1.0, 1.0), None),
        ("active", None, (1.0, 1.0), (1.0, 1.0), None),
        ("hold", HELD, (1.0, 1.0), (1.0, 1.0), "held"),
        ("disarmed", None, (1.0, 1.0), (1.0, 1.0), "not_armed"),
        ("hold", None, (0.0, 1.0), (1.0, 1.0), "budget"),
        ("hold", None, (1.0, 0.0), (1.0, 1.0), "budget"),
        ("hold", None, (1.0, 1.0), (0.0, 1.0), "operator_budget"),
        ("hold", None, (1.0, 1.0), (1.0, 0.0), "operator_budget"),
    ],
)
def test_a_grant_is_refused_for_one_reason_each(
    start: str,
    held: StandingHold | None,
    left: tuple[float, float],
    operator_left: tuple[float, float],
    code: str | None,
) -> None:
    tick = at(start)
    tick.s.held = held
    metres, seconds = operator_left
    tick.s.grants = replace(tick.s.grants, operator_metres=metres, operator_seconds=seconds)
    refusal = ownership._refusal(tick, *left)
    assert (None if refusal is None else refusal[0]) == code


def grant(tick: TickContext, mission: str = "new", metres: float = 5.0) -> Grant:
    seen = tick.s.voice.status_seq
    return Grant(planner_id="p1", epoch=tick.epoch, seen=seen, mission=mission, metres=metres,
                 seconds=9.0)  # fmt: skip


def test_a_grant_puts_the_last_one_in_the_book_and_takes_its_own_rest_out() -> None:
    tick = at("hold_granted")
    tick.s.grants = replace(
        tick.s.grants, metres=3.0, seconds=4.0, since_arm=False,
        book=(MissionLeft("new", 1.0, 2.0), MissionLeft("other", 7.0, 8.0)),
    )  # fmt: skip
    refuse_openly(tick, "grant", "new", "held", "for a test")
    tick.events.clear()
    had = tick.s.grants
    assert ownership.hear_grant(tick, grant(tick)) == "new 1.0 m 2 s"
    assert tick.s.grants == Grants(
        "new", 1.0, 2.0, (MissionLeft("other", 7.0, 8.0), MissionLeft("m1", 3.0, 4.0)),
        had.operator_metres, had.operator_seconds, had.hand_metres, had.hand_seconds,
        since_arm=True,
    )  # fmt: skip
    assert tick.s.operator.refusals == ()
    again = tick.s.grants
    ownership.hear_grant(tick, grant(tick, metres=50.0))
    assert tick.s.grants is again, "the same mission again changes nothing"
    other = grant(tick, "third").model_copy(update={"planner_id": "p2"})
    ownership.hear_grant(tick, other)
    assert tick.s.grants is again


@table(("after_s", "granted"), [(-0.01, True), (0.0, False), (0.01, False)])
def test_a_grant_knows_of_the_jump_or_is_dropped(after_s: float, granted: bool) -> None:
    tick = at("hold")
    sent_s = tick.s.voice.ring[-1]
    tick.s.pose = replace(tick.s.pose, jumped_s=sent_s + after_s)
    ownership.hear_grant(tick, grant(tick))
    assert (tick.s.grants.mission == "new") is granted
    assert ("grant_before_jump" in tick.reasons) is not granted
    assert tick.s.grants.metres == (5.0 if granted else 0.0)


def test_a_voided_hand_has_nothing_left_and_what_a_brain_may_drive_stays() -> None:
    tick = at("active")
    before = tick.s.grants
    ownership.void_hand_budget(tick)
    assert tick.s.grants == replace(before, hand_metres=0.0, hand_seconds=0.0)


@table(
    ("start", "outside", "metres", "seconds"),
    [
        ("teleop", False, 7.5, 9.9),
        ("teleop", True, 0.0, 9.9),
        ("stopping_to_disarm", False, 7.5, 10.0),
    ],
)
def test_a_hand_pays_a_metre_for_a_metre_and_ten_outside(
    start: str, outside: bool, metres: float, seconds: float
) -> None:
    before, tick = reached(start).state, at(start)
    tick.dt_s = 0.1
    tick.s.grants = replace(tick.s.grants, hand_metres=8.0, hand_seconds=10.0)
    tick.s.watch.outside = outside
    far = before.odometry.travelled_m + (0.5 if not outside else 0.9)
    tick.s.odometry = replace(tick.s.odometry, travelled_m=far)
    ownership._meter_hand(tick, before)
    assert tick.s.grants.hand_metres == pytest.approx(metres)
    assert tick.s.grants.hand_seconds == pytest.approx(seconds)


def test_a_hands_budget_ends_at_nothing() -> None:
    before, tick = reached("teleop").state, at("teleop")
    tick.dt_s = 0.1
    tick.s.grants = replace(tick.s.grants, hand_metres=0.25, hand_seconds=0.05)
    far = before.odometry.travelled_m + 0.5
    tick.s.odometry = replace(tick.s.odometry, travelled_m=far)
    ownership._meter_hand(tick, before)
    assert (tick.s.grants.hand_metres, tick.s.grants.hand_seconds) == (0.0, 0.0)
