"""Hold what a person's requests do: by which proof, from which mode, and what they end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import cast

import pytest

from bridge.core import Inbox, OperatorArrival
from bridge.core.authority.requests import bad_proof
from bridge.core.faults.fault_table import STAGES
from bridge.core.modes import operator
from bridge.core.modes.mode_table import RequestCause, after
from bridge.core.modes.operator import arm_lacks, ready_lacks, reset_lacks
from bridge.core.state import RowUp
from bridge.core.state_orders import PendingFence
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at, reached, tick_of
from tests.bridge.core.scripted import World
from tests.bridge.core.table import table
from wire import IDENTITY, HeldReason, Mode, OpKind, OpRequest, Proof, StandingHold, Stop

IN = {
    Mode.BOOT: "boot",
    Mode.SELFTEST: "selftest",
    Mode.DISARMED: "disarmed",
    Mode.HOLD: "hold",
    Mode.ACTIVE: "active",
    Mode.TELEOP: "teleop",
    Mode.STOPPING: "stopping_by_person",
    Mode.ESTOPPED: "estopped",
    Mode.FAULT: "fault",
}


@pytest.mark.parametrize("kind", ["arm", "disarm", "estop", "reset", "resume"])
@pytest.mark.parametrize("mode", Mode, ids=str)
def test_a_request_does_what_the_table_says_or_nothing(mode: Mode, kind: OpKind) -> None:
    world = reached(IN[mode])
    assert world.mode is mode
    if mode is Mode.BOOT:
        proof = Proof(nonce="b0.1", mac="0" * 64)
        request = OpRequest(id="early", source="test", proof=proof)
        world.extra = Inbox(ops=(OperatorArrival(kind, request, True),))
    else:
        world.op(kind)
    world.tick()
    table = None if kind == "resume" else after(mode, RequestCause(kind))
    expected = {table if table is not None else mode}
    if mode is Mode.BOOT and kind != "estop":
        expected = {Mode.SELFTEST}  # the tick itself brings it up
    if (mode, kind) == (Mode.HOLD, "disarm"):
        expected = {Mode.STOPPING, Mode.DISARMED}  # it stands already
    assert world.mode in expected
    assert len(world.state.operator.answers) >= 1


@pytest.mark.parametrize("kind", ["arm", "reset", "resume"])
@pytest.mark.parametrize(
    ("authentic", "nonce", "code"),
    [(False, None, "bad_proof"), (True, "b0.77", "old_nonce"), (True, "other.1", "old_nonce")],
)
def test_without_a_proof_nothing_starts(
    kind: OpKind, authentic: bool, nonce: str | None, code: str
) -> None:
    world = World().ready()
    world.stop()
    world.tick()
    assert world.asked(kind, authentic=authentic, nonce=nonce) == code
    assert world.is_in(Mode.DISARMED)
    assert world.state.held is not None


def test_a_request_without_any_proof_is_refused() -> None:
    world = World().ready()
    world.extra = Inbox(ops=(OperatorArrival("arm", OpRequest(id="bare", source="t"), True),))
    world.tick()
    assert world.verdict("bare") == "bad_proof"


def test_a_nonce_changes_when_used_and_stays_valid_for_what_was_signed() -> None:
    world = World(planner=None).ready()
    first = world.shown.nonce
    world.op("resume", nonce=first)
    world.run(0.1)
    assert world.shown.nonce != first
    world.run(9.7)
    late = world.op("resume", nonce=first)
    world.tick()
    assert world.verdict(late) == "ok"
    world.run(10.2)
    too_late = world.op("resume", nonce=first)
    world.tick()
    assert world.verdict(too_late) == "old_nonce"


@pytest.mark.parametrize("kind", ["arm", "reset", "resume"])
@pytest.mark.parametrize("halt", ["stop", "estop", "estop once more", "disarm"])
def test_a_proof_from_before_a_stop_does_not_end_it(kind: OpKind, halt: str) -> None:
    world = World().armed()
    if halt == "estop once more":
        world.op("estop")
        world.run(0.1)
    signed_before = world.shown.nonce
    if halt == "stop":
        world.stop()
    else:
        world.op("disarm" if halt == "disarm" else "estop")
    world.tick()
    late = world.op(kind, nonce=signed_before)
    world.tick()
    assert world.verdict(late) == "old_nonce"
    assert world.state.held is not None or halt == "disarm"


def test_one_id_gets_one_verdict_and_no_proof_works_twice() -> None:
    world = World().ready()
    nonce = world.shown.nonce
    request_id = world.op("arm", nonce=nonce)
    again = world.extra
    world.tick()
    assert world.is_in(Mode.HOLD)
    for _ in range(70):
        world.op("resume", authentic=False)
    world.tick()
    assert all(item.answer.id != request_id for item in world.state.operator.answers)
    world.extra = again
    world.tick()
    assert world.verdict(request_id) == "repeated", "though its verdict was pushed out of memory"
    world.op("disarm")
    world.until(Mode.DISARMED, 1.0)
    world.run(0.6)
    world.extra = again
    world.tick()
    assert world.is_in(Mode.DISARMED), "a repeat is ignored"


@pytest.mark.parametrize(
    ("spoil", "code"),
    [
        (lambda world: setattr(world, "recorder_ok", False), "recorder_down"),
        (lambda world: setattr(world.drive, "deaf", True), "driver_nack"),
        (lambda world: setattr(world, "drive_silent", True), "enc_stale"),
        (lambda world: setattr(world, "lidar_silent", True), "lidar_stale"),
    ],
)
def test_arming_says_what_it_lacks(spoil: Callable[[World], None], code: str) -> None:
    world = World().ready()
    spoil(world)
    world.run(0.4)
    assert code in world.shown.waiting_for
    assert world.asked("arm") == code
    assert world.is_in(Mode.DISARMED)


def test_a_lost_pose_or_brain_keeps_nobody_from_arming() -> None:
    world = World(planner=None, localization_silent=True).ready()
    world.op("arm")
    world.tick()
    assert world.is_in(Mode.HOLD)


def test_disarming_ramps_first_and_sets_no_hold() -> None:
    world = World().driving()
    world.op("disarm")
    world.tick()
    assert world.is_in(Mode.STOPPING)
    assert world.told.enable
    world.until(Mode.DISARMED, 2.0)
    assert world.state.held is None
    assert world.sent.v_mps == 0.0


def test_a_row_that_disarms_sets_held_and_arming_clears_it() -> None:
    world = World().driving()
    world.brain.silent = True
    world.run(6.0)
    assert world.state.held is not None
    assert world.state.held.reason is HeldReason.FAULT
    assert world.state.held.id == "brain_gone"
    world.op("arm")
    world.tick()
    assert world.state.held is None


HELD = StandingHold(reason=HeldReason.STOP, id="s1")


def test_each_act_of_a_person_ends_what_it_should() -> None:
    tick = at("hold")
    tick.s.held = HELD
    tick.s.grants = replace(tick.s.grants, operator_metres=0.0, operator_seconds=0.0)
    operator._resume(tick, "r1")
    assert tick.s.held is None
    assert (tick.s.grants.operator_metres, tick.s.grants.operator_seconds) == (500.0, 3600.0)
    assert tick.s.operator.accepted[-1].endswith("resume r1")
    tick = at("disarmed")
    tick.s.held = HELD
    tick.s.grants = replace(tick.s.grants, operator_metres=0.0, since_arm=True)
    tick.s.rows = {"ENC_STALE.1": RowUp(0.0, 0.0, "old")}
    epoch = tick.s.epoch_no
    operator._arm(tick, "a1")
    assert (tick.s.mode, tick.s.held, tick.s.rows) == (Mode.HOLD, None, {})
    assert (tick.s.grants.operator_metres, tick.s.grants.since_arm) == (500.0, False)
    assert tick.s.epoch_no == epoch + 1
    tick = at("estopped")
    tick.s.buttons = replace(tick.s.buttons, ordered=True)
    tick.s.rows = {"ESTOP.0": RowUp(0.0, 0.0, "old")}
    operator._reset(tick, "x1")
    assert (tick.s.mode, tick.s.buttons.ordered, tick.s.rows) == (Mode.DISARMED, False, {})
    tick = at("estopped")
    tick.s.selftest = replace(tick.s.selftest, passed=False)
    operator._reset(tick, "x1")
    assert tick.s.mode is Mode.SELFTEST
    tick = at("active")
    epoch, nonce = tick.s.epoch_no, tick.s.operator.nonce_no
    operator._estop(tick, "e1")
    assert (tick.s.mode, tick.s.buttons.ordered) == (Mode.ESTOPPED, True)
    assert tick.s.epoch_no == epoch + 1
    assert (tick.s.operator.nonce_no, tick.s.operator.old_nonce_no) == (nonce + 1, None)
    operator._estop(tick, "e1")
    assert tick.s.epoch_no == epoch + 1


def test_many_stops_at_once_are_one_change_of_epoch_and_a_verdict_each() -> None:
    tick = at("active")
    epoch, nonce = tick.s.epoch_no, tick.s.operator.nonce_no
    tick.inbox = replace(
        tick.inbox,
        stops=(Stop(id="s0", source="a"), Stop(id="s1", source="a"), Stop(id="s2", source="b")),
    )
    operator.hear_stops(tick)
    assert (tick.s.epoch_no, tick.s.mode, tick.stopped) == (epoch + 1, Mode.STOPPING, True)
    told = [(one.answer.id, one.answer.code) for one in tick.s.operator.answers[-3:]]
    assert told == [("s0", "ok"), ("s1", "ok"), ("s2", "ok")]
    assert tick.s.held == StandingHold(reason=HeldReason.STOP, id="s2")
    assert (tick.s.operator.nonce_no, tick.s.operator.old_nonce_no) == (nonce + 1, None)
    tick.stopped = False
    before = tick.s.operator
    operator.hear_stops(tick)
    assert not tick.stopped, "said again it changes nothing"
    assert tick.s.operator == before


def test_a_stop_is_a_repeat_for_as_long_as_senders_repeat() -> None:
    tick = at("active")
    tick.inbox = replace(tick.inbox, stops=(Stop(id="s0", source="a"),))
    operator.hear_stops(tick)
    said_s, epoch = tick.now_s, tick.s.epoch_no
    for late_s, is_new in ((5.0, False), (5.001, True)):
        tick.stopped, tick.now_s = False, said_s + late_s
        operator.hear_stops(tick)
        assert tick.stopped is is_new
    assert tick.s.epoch_no == epoch + 1
    assert [one.answer.id for one in tick.s.operator.answers].count("s0") == 1


@table(
    ("kind", "let_go"),
    [("stop", "resume"), ("stop", "arm"), ("estop", "reset"), ("estop", "arm"), ("disarm", "arm")],
)
def test_a_known_id_stops_again_once_the_robot_was_let_go(kind: str, let_go: OpKind) -> None:
    world = reached({"resume": "active", "reset": "estopped", "arm": "disarmed"}[let_go])

    def halt() -> bool:
        """Say it under the one id; return whether it got a verdict in this tick."""
        if kind == "stop":
            world.stop("known")
        else:
            request = OpRequest(id="known", source="test")
            arrived = OperatorArrival(cast("OpKind", kind), request, authentic=False)
            world.extra = replace(world.extra, ops=(arrived,))
        known = [event for event in world.tick().events if event.code == "answered"]
        return any(f"{kind} known ok" in event.detail for event in known)

    assert halt()
    world.run(2.5)  # the clean time that a reset asks for
    assert not halt(), "a repeat changes nothing"
    world.run(0.1)
    request_id = world.op(let_go)
    world.tick()
    if (kind, let_go) == ("estop", "arm"):
        assert world.verdict(request_id) == "not_disarmed"
        assert not halt(), "what was refused let nothing go"
        return
    assert world.verdict(request_id) == "ok"
    assert halt()


@table(("start", "kind"), [("disarmed", "arm"), ("estopped", "reset"), ("hold", "resume")])
def test_an_act_needs_a_proof_and_spends_it(start: str, kind: OpKind) -> None:
    for authentic, code in ((False, "bad_proof"), (True, "ok")):
        world = reached(start)
        nonce = world.state.operator.nonce_no
        request_id = world.op(kind, authentic=authentic)
        tick = tick_of(world)
        operator.hear_op(tick, world.extra.ops[0])
        world.state = tick.s
        assert world.verdict(request_id) == code
        spent = f"{nonce} {kind} {request_id}" in tick.s.operator.accepted
        assert spent is authentic
        assert tick.s.operator.nonce_no == nonce + authentic


@table(("kind", "mode"), [("disarm", Mode.STOPPING), ("estop", Mode.ESTOPPED)])
def test_what_takes_power_away_needs_no_proof(kind: OpKind, mode: Mode) -> None:
    world = reached("active")
    request_id = world.op(kind, authentic=False)
    tick = tick_of(world)
    operator.hear_op(tick, world.extra.ops[0])
    world.state = tick.s
    assert (world.verdict(request_id), tick.s.mode) == ("ok", mode)


NOW_S, EPS = 10.0, 1e-6


def standing(start: str) -> TickContext:
    """Return a tick at 10 s of a robot that has long stood and is being recorded."""
    tick = at(start)
    tick.now_s, tick.s.rows = NOW_S, {}
    tick.s.drive.received_s, tick.s.drive.still_since_s = NOW_S, 0.0
    tick.s.loop = replace(tick.s.loop, recorder_ok=True)
    return tick


@table(
    ("what", "codes"),
    [
        ("nothing", []),
        ("fence", ["fence_changing"]),
        ("moves", ["not_standing"]),
        ("stick", ["stick_not_neutral"]),
        ("stick_before", []),
        ("unrecorded", ["disk_full"]),
    ],
)
def test_each_thing_alone_speaks_against_arming(what: str, codes: list[str]) -> None:
    tick = standing("disarmed")
    if what == "fence":
        tick.s.fence_asked = PendingFence("f1", "test", "{}", IDENTITY)
    elif what == "moves":
        tick.s.drive.still_since_s = NOW_S - 0.4
    elif what.startswith("stick"):
        pressed_s = NOW_S - 0.25 - EPS * (what == "stick_before")
        tick.s.stick = replace(tick.s.stick, pressed_s=pressed_s)
    elif what == "unrecorded":
        tick.s.loop = replace(tick.s.loop, recorder_ok=False)
        tick.inbox = Inbox(recorder_says="disk_full: nothing is left")
    assert [code for code, _ in ready_lacks(tick)] == codes


@table(
    ("name", "age_s", "speaks"),
    [
        ("RUNAWAY.0", 2.0, True),
        ("RUNAWAY.0", 2.0 + EPS, False),
        ("ENC_STALE.0", 0.01 - EPS, True),
        ("ENC_STALE.0", 0.01 + EPS, False),
        ("LIDAR_STALE.0", 0.0, True),
        ("NO_RANGE.0", 0.0, False),
        ("LOOP_LATE.0", 0.0, False),
        ("BRAIN_GONE.0", 0.0, False),
    ],
)
def test_a_row_speaks_against_arming_while_it_is_dirty(
    name: str, age_s: float, speaks: bool
) -> None:
    tick = standing("disarmed")
    tick.s.rows = {name: RowUp(0.0, tick.now_s - age_s, "seen")}
    lacks = [(STAGES[name].row.lower(), "seen")] if speaks else []
    assert list(ready_lacks(tick)) == lacks


@table(
    ("change", "code"),
    [
        ("nothing", None),
        ("pressed_ago", "estop_just_released"),
        ("moves", "not_standing"),
        ("row", "runaway"),
        ("estop_row", None),
        ("other_row", None),
    ],
)
def test_a_reset_waits_for_one_thing_each(change: str, code: str | None) -> None:
    for age_s in (2.0 - EPS, 2.0):
        tick = standing("fault")
        tick.s.buttons = replace(tick.s.buttons, pressed_s=None)
        if change == "pressed_ago":
            tick.s.buttons = replace(tick.s.buttons, pressed_s=tick.now_s - age_s)
        elif change == "moves":
            tick.s.drive.still_since_s = tick.now_s - age_s + 1.5
        elif change.endswith("row"):
            name = {"row": "RUNAWAY.0", "estop_row": "ESTOP.0"}.get(change, "ENC_STALE.1")
            tick.s.rows = {name: RowUp(0.0, tick.now_s - age_s, "seen")}
        lacks = [one for one, _ in reset_lacks(tick)]
        assert lacks == ([code] if code and age_s < 2.0 else [])


def test_nobody_is_armed_before_a_scan_has_come() -> None:
    world = reached("disarmed")
    world.state.lidar = replace(world.state.lidar, received_s=None)
    world.lidar_silent = True
    assert world.asked("arm") == "lidar_stale"


def test_every_reason_is_told_to_the_last() -> None:
    tick = at()
    assert [code for code, _ in arm_lacks(tick)] == ["not_disarmed"]
    assert [code for code, _ in reset_lacks(tick)] == ["not_latched"]
    for nonce, authentic, code in ((None, True, "bad_proof"), ("b0.0", True, "old_nonce")):
        told = [one for one, _ in bad_proof(tick, "arm", "a1", nonce, authentic=authentic)]
        assert told == [code]


REASON = "No space left on device in /home/pons/recordings"


def unrecorded(world: World, says: str = f"disk_full: {REASON}") -> World:
    world.recorder_ok, world.recorder_says = False, says
    return world


def waiting(world: World) -> tuple[str, ...]:
    return world.shown.waiting_for


def test_a_full_disk_stops_nobody_and_is_told_once() -> None:
    world = unrecorded(World().driving((3.0, 0.0)))
    world.run(2.0)
    assert world.mode is Mode.ACTIVE
    told = [event.detail for event in world.events if event.code == "disk_full"]
    assert told == [REASON]
    assert waiting(world) == ("disk_full",)
    world.recorder_ok, world.recorder_says = True, ""
    world.run(0.2)
    assert waiting(world) == ()
    assert [event.code for event in world.events].count("recorder_up") == 1


def test_a_recorder_that_does_not_say_why_is_down() -> None:
    world = unrecorded(World().armed(), says="")
    world.run(0.1)
    assert waiting(world) == ("recorder_down",)
