"""Hold who may order what to its numbers: owner and grant, and their rows."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.authority import grants, hello, message_score, ownership
from bridge.core.faults.detectors import brain, commands
from bridge.core.state_orders import External, Grants, MissionLeft
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import tick_of
from wire import Held, HeldReason

EPS = 1e-6
HELD = Held(reason=HeldReason.STOP, id="s1")


def at(start: str) -> TickContext:
    return tick_of(reached(start))


@table(("age_s", "lives"), [(0.0, True), (0.3 - EPS, True), (0.3 + EPS, False)])
def test_an_owner_lives_for_300_ms(age_s: float, lives: bool) -> None:
    tick = at("active")
    tick.s.ownership = replace(tick.s.ownership, echo_s=tick.now_s - age_s)
    assert ownership.is_alive(tick) is lives
    epoch = tick.s.epoch_no
    hello.free_lost_owner(tick)
    assert (tick.s.ownership.owner is not None) is lives
    assert tick.s.epoch_no == epoch + (not lives)
    assert (("owner_lost", "p1") in tick.events) is not lives
    for part in ({"owner": None}, {"echo_s": None}):
        tick.s.ownership = replace(at("active").s.ownership, **part)
        assert not ownership.is_alive(tick)
    tick.s.ownership = replace(tick.s.ownership, owner=None, echo_s=None)
    tick.events.clear()
    hello.free_lost_owner(tick)
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
        assert world.planner is not None
        [beat] = world.planner._on_status(status)["heartbeats"]
        beat = beat.model_copy(update={"used": seen, "epoch": tick.epoch})
        ownership.hear_heartbeat(tick, beat)
        assert tick.s.ownership.used_s == used_s
        assert tick.s.ownership.echo_s == ring[-1]


@table(
    ("sender", "epoch", "ahead", "code"),
    [("p2", "", 0, "not_owner"), ("p1", "old", 0, "old_epoch"), ("p1", "", 1, "seen_unknown")],
)
def test_what_is_not_the_owners_is_dropped_and_never_scored(
    sender: str, epoch: str, ahead: int, code: str
) -> None:
    tick = at("active")
    before = tick.s.ownership
    seen = tick.s.voice.status_seq + ahead
    assert ownership.sent_at_if_owner(tick, sender, epoch or tick.epoch, seen) is None
    assert (tick.reasons, tick.s.bad_bucket) == ([code], 0.0)
    assert tick.s.ownership == before


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
    grants.meter(tick, before)
    metered = metres < 5.0
    left = tick.s.grants
    assert (left.mission, left.book, left.since_arm) == (mission, BOOK, True)
    assert (left.metres, left.seconds) == pytest.approx((metres, seconds))
    operator_metres = 49.5 if metered else 50.0
    assert left.operator_metres == pytest.approx(operator_metres)
    assert left.operator_seconds == pytest.approx(operator_seconds)
    tick.s.odometry = replace(tick.s.odometry, travelled_m=far + 1e3)
    tick.dt_s = 1e3
    grants.meter(tick, before)
    left = tick.s.grants
    if metered:
        assert (left.metres, left.operator_metres) == (0.0, 0.0), "and no less than nothing"
    if operator_seconds < 100.0:
        assert (left.seconds, left.operator_seconds) == (0.0, 0.0)
    if before.stopping is not None:
        before.stopping = None
        had = tick.s.grants
        grants.meter(tick, before)
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
    held: Held | None,
    left: tuple[float, float],
    operator_left: tuple[float, float],
    code: str | None,
) -> None:
    tick = at(start)
    tick.s.held = held
    metres, seconds = operator_left
    tick.s.grants = replace(tick.s.grants, operator_metres=metres, operator_seconds=seconds)
    refusal = grants._refusal(tick, *left)
    assert (None if refusal is None else refusal[0]) == code


@table(
    ("echo_age_s", "since_arm", "start", "source", "rows"),
    [
        (0.15 - EPS, True, "active", "W", []),
        (0.15 + EPS, True, "active", "W", ["BRAIN_LATE.0"]),
        (0.3 - EPS, True, "active", "W", ["BRAIN_LATE.0"]),
        (0.3 + EPS, True, "active", "W", ["BRAIN_LOST.0"]),
        (5.0 - EPS, True, "active", "W", ["BRAIN_LOST.0"]),
        (5.0 + EPS, True, "active", "W", ["BRAIN_LOST.0", "BRAIN_GONE.0"]),
        (5.0 + EPS, False, "active", "W", ["BRAIN_LOST.0"]),
        (5.0 + EPS, True, "disarmed", "", ["BRAIN_LOST.0"]),
        (5.0 + EPS, True, "teleop", "T", ["BRAIN_LOST.0"]),
        (None, True, "active", "W", []),
    ],
)
def test_a_brain_is_late_lost_or_gone(
    echo_age_s: float | None, since_arm: bool, start: str, source: str, rows: list[str]
) -> None:
    tick = at(start)
    echo_s = None if echo_age_s is None else tick.now_s - echo_age_s
    tick.s.ownership = replace(tick.s.ownership, echo_s=echo_s, used_s=None)
    tick.s.grants = replace(tick.s.grants, since_arm=since_arm)
    tick.s.source = source
    dirty: list[tuple[str, str]] = []
    brain(tick, dirty)
    assert [name for name, _ in dirty] == rows


@table(
    ("used_age_s", "owned", "stale"),
    [(1.0 - EPS, True, False), (1.0 + EPS, True, True), (9.0, False, False), (None, True, False)],
)
def test_a_brain_that_thinks_on_old_facts_is_stale(
    used_age_s: float | None, owned: bool, stale: bool
) -> None:
    tick = at("active")
    used_s = None if used_age_s is None else tick.now_s - used_age_s
    owner = tick.s.ownership.owner if owned else None
    tick.s.ownership = replace(tick.s.ownership, used_s=used_s, owner=owner, echo_s=tick.now_s)
    dirty: list[tuple[str, str]] = []
    brain(tick, dirty)
    assert [name for name, _ in dirty] == ["BRAIN_STALE.0"] * stale


@table(
    ("changes", "rows"),
    [
        ({}, []),
        ({"age_s": 0.5 - EPS}, []),
        ({"age_s": 0.5 + EPS}, ["CMD_STALE.0"]),
        ({"age_s": 9.0, "reached": True}, []),
        ({"age_s": 9.0, "points": False}, []),
        ({"external_age_s": 0.25 - EPS}, []),
        ({"external_age_s": 0.25 + EPS}, ["CMD_STALE.1"]),
        ({"bucket": 5.0 - EPS}, []),
        ({"bucket": 5.0}, ["CMD_BAD.0"]),
        ({"metres": 0.0}, ["BUDGET.0"]),
        ({"metres": 0.0, "mission": None}, []),
    ],
)
def test_commands_grow_stale_bad_and_spent(changes: dict[str, object], rows: list[str]) -> None:
    tick = at("active")
    told = {"age_s": 0.0, "reached": False, "points": True, "bucket": 0.0, "metres": 5.0,
            "mission": "m1", "external_age_s": None} | changes  # fmt: skip
    horizon = tick.s.leg.horizon
    assert horizon is not None
    points = horizon.points if told["points"] else ()
    tick.s.leg = replace(
        tick.s.leg,
        horizon=horizon.model_copy(update={"points": points}),
        reached=bool(told["reached"]),
        sent_s=tick.now_s - float(str(told["age_s"])),
    )
    if told["external_age_s"] is not None:
        age_s = float(str(told["external_age_s"]))
        tick.s.external = External(0.1, 0.0, dead_man=True, sent_s=tick.now_s - age_s)
    tick.s.bad_bucket = float(str(told["bucket"]))
    mission = None if told["mission"] is None else "m1"
    tick.s.grants = replace(tick.s.grants, metres=float(str(told["metres"])), mission=mission)
    dirty: list[tuple[str, str]] = []
    commands(tick, dirty)
    assert [name for name, _ in dirty] == rows


def test_manners_fill_a_bucket_that_ends() -> None:
    tick = at("active")
    tick.dt_s = 0.1
    message_score.bad(tick, "x")
    assert (tick.s.bad_bucket, tick.reasons) == (1.0, ["x"])
    message_score.drain(tick)
    assert tick.s.bad_bucket == pytest.approx(0.8)
    message_score.good(tick)
    assert tick.s.bad_bucket == 0.0
    message_score.good(tick)
    message_score.drain(tick)
    assert tick.s.bad_bucket == 0.0
    tick.s.bad_bucket = 9.5
    message_score.bad(tick, "x")
    assert tick.s.bad_bucket == 10.0
    tick.s.bad_bucket = 0.1
    message_score.drain(tick)
    assert tick.s.bad_bucket == 0.0
