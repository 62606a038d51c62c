"""Hold what people order to its numbers: proofs, acts, what speaks against them, the stick."""

from __future__ import annotations

from dataclasses import replace

from bridge.core import Inbox
from bridge.core.authority import requests
from bridge.core.faults.fault_table import STAGES
from bridge.core.modes import operator, teleop
from bridge.core.modes.arming import ready_lacks, reset_lacks
from bridge.core.state import RowUp
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import tick_of
from wire import Held, HeldReason, Mode, OpKind, Stop, Velocity

EPS = 1e-6
HELD = Held(reason=HeldReason.STOP, id="s1")


def at(start: str) -> TickContext:
    return tick_of(reached(start))


@table(("age_s", "renewed"), [(60.0 - EPS, False), (60.0 + EPS, True)])
def test_a_nonce_lasts_for_a_minute_and_the_old_one_ten_seconds_more(
    age_s: float, renewed: bool
) -> None:
    tick = at("disarmed")
    tick.s.operator = replace(tick.s.operator, nonce_made_s=tick.now_s - age_s)
    tick.inbox = Inbox(chance="c" * 16)
    before = tick.s.operator
    requests.renew_nonce(tick)
    after = tick.s.operator
    assert after == (
        replace(
            before,
            nonce_no=before.nonce_no + 1,
            nonce_tag="c" * 16,
            nonce_made_s=tick.now_s,
            old_nonce_no=before.nonce_no,
            old_tag=before.nonce_tag,
            old_until_s=tick.now_s + 10.0,
        )
        if renewed
        else before
    )
    if renewed:
        old = f"b0.{before.nonce_no}.{before.nonce_tag}"
        assert requests.old_nonce_text(tick) == old
        for more_s, codes in ((10.0 - EPS, []), (EPS * 2, ["old_nonce"])):
            tick.now_s += more_s
            told = requests.bad_proof(tick, "arm", "a1", old, authentic=True)
            assert [code for code, _ in told] == codes


def test_a_proof_is_used_once_under_either_nonce() -> None:
    tick = at("disarmed")
    tick.inbox = Inbox(chance="c" * 16)
    requests.renew_nonce(tick)
    tick.now_s += 60.0
    requests.renew_nonce(tick)
    now, old = tick.s.operator.nonce_no, tick.s.operator.old_nonce_no
    assert old is not None
    requests.use_nonce(tick, "arm", "a1")
    assert {f"{now} arm a1", f"{old} arm a1"} <= set(tick.s.operator.accepted)
    text = requests.old_nonce_text(tick)
    for request_id, codes in (("a1", ["repeated"]), ("a2", [])):
        told = requests.bad_proof(tick, "arm", request_id, text, authentic=True)
        assert [code for code, _ in told] == codes
    for count in range(40):
        requests.use_nonce(tick, "arm", f"b{count}")
    assert len(tick.s.operator.accepted) == 16
    assert tick.s.operator.accepted[-1].endswith("b39")


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
    tick = at("disarmed")
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
    for age_s in (2.0 - EPS, 2.0 + EPS):
        tick = at("fault")
        tick.s.rows = {}
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


def velocity(
    tick: TickContext, v_mps: float = 0.0, w_radps: float = 0.0, **more: object
) -> Velocity:
    said = {"source_id": "s", "epoch": tick.epoch, "seq": 9, "seen": tick.s.voice.status_seq,
            "dead_man": True} | more  # fmt: skip
    return Velocity.model_validate(said | {"v_mps": v_mps, "w_radps": w_radps})


@table(
    ("v_mps", "w_radps", "ready"),
    [(0.02, 0.05, True), (-0.02, -0.05, True), (0.021, 0.0, False), (0.0, -0.051, False)],
)
def test_a_stick_is_ready_once_seen_released_and_neutral(
    v_mps: float, w_radps: float, ready: bool
) -> None:
    tick = at("hold")
    teleop.hear_teleop(tick, velocity(tick, v_mps, w_radps, dead_man=False))
    assert tick.s.stick.released == ("s",)
    assert tick.s.stick.ready == (("s",) if ready else ())
    teleop.hear_teleop(tick, velocity(tick, 0.3))
    assert (tick.s.mode is Mode.TELEOP) is ready
    if ready:
        assert (tick.s.stick.v_mps, tick.s.stick.received_s) == (0.3, tick.now_s)
        assert (tick.s.source, tick.s.grants.since_arm) == ("T", False)
        assert tick.s.held == Held(reason=HeldReason.TELEOP, id="s")
    else:
        assert tick.reasons == ["stick_not_ready"]


def test_eight_sticks_are_remembered_as_ready_the_newest_ones() -> None:
    tick = at("hold")
    for number in range(9):
        teleop.hear_teleop(tick, velocity(tick, dead_man=False, source_id=f"s{number}"))
    newest = tuple(f"s{number}" for number in range(1, 9))
    assert (tick.s.stick.released, tick.s.stick.ready) == (newest, newest)


@table(
    ("received_age_s", "sent_age_s", "fresh"),
    [(0.25, 0.4, True), (0.25 + EPS, 0.0, False), (0.0, 0.4 + EPS, False)],
)
def test_a_stick_steers_while_it_is_fresh(
    received_age_s: float, sent_age_s: float, fresh: bool
) -> None:
    tick = at("teleop")
    tick.s.stick = replace(
        tick.s.stick,
        received_s=tick.now_s - received_age_s + EPS / 2 * fresh,
        sent_s=tick.now_s - sent_age_s + EPS / 2 * fresh,
    )
    teleop.watch(tick)
    assert (tick.s.mode is Mode.TELEOP) is fresh
    if not fresh:
        assert (tick.s.mode, tick.s.stick.source_id) == (Mode.HOLD, None)
        assert tick.s.stick.pressed_s is not None
        assert tick.s.held == Held(reason=HeldReason.TELEOP, id="stick")


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
    assert tick.s.held == Held(reason=HeldReason.STOP, id="s2")
    assert (tick.s.operator.nonce_no, tick.s.operator.old_nonce_no) == (nonce + 1, None)
    tick.stopped = False
    before = tick.s.operator
    operator.hear_stops(tick)
    assert not tick.stopped, "said again it changes nothing"
    assert tick.s.operator == before


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


@table(
    ("changes", "reason"),
    [
        ({"epoch": "b0-99"}, "old_epoch"),
        ({"seen": 999_999}, "teleop_stale"),
        ({"source_id": "other"}, "stick_taken"),
        ({"seq": 0}, "seq_backwards"),
        ({}, None),
    ],
)
def test_a_stick_is_heard_where_it_may_be(changes: dict[str, object], reason: str | None) -> None:
    tick = at("teleop")
    tick.s.stick = replace(tick.s.stick, seq=5, pressed_s=None)
    tick.s.bad_bucket = 3.0
    held = tick.s.stick.source_id
    said = velocity(tick, 0.1, source_id=held, seq=6).model_copy(update=changes)
    teleop.hear_teleop(tick, said)
    assert tick.reasons == ([] if reason is None else [reason])
    assert tick.s.stick.pressed_s == tick.now_s, "somebody holds it, whatever it says"
    steers = reason is None
    assert (tick.s.stick.v_mps == 0.1) is steers
    assert tick.s.bad_bucket == {None: 2.0, "seq_backwards": 4.0}.get(reason, 3.0)


def test_on_the_edge_of_its_age_a_stick_is_heard() -> None:
    for age_s, heard in ((0.4, True), (0.4001, False)):
        tick = at("teleop")
        ring = tick.s.voice.ring
        tick.s.voice = replace(tick.s.voice, ring=(*ring[:-1], 0.0))
        tick.now_s = age_s
        tick.s.stick = replace(tick.s.stick, seq=5)
        teleop.hear_teleop(tick, velocity(tick, 0.1, source_id=tick.s.stick.source_id, seq=6))
        assert (tick.reasons == []) is heard


def test_letting_go_holds_and_the_hand_must_begin_anew() -> None:
    tick = at("teleop")
    source, epoch = tick.s.stick.source_id, tick.s.epoch_no
    tick.s.held = None
    tick.s.stick = replace(tick.s.stick, pressed_s=1.0)
    teleop.hear_teleop(tick, velocity(tick, 0.3, source_id=source, dead_man=False))
    assert tick.s.mode is Mode.HOLD
    assert tick.s.held == Held(reason=HeldReason.TELEOP, id=str(source))
    assert (tick.s.stick.source_id, tick.s.stick.ready, tick.s.stick.pressed_s) == (None, (), 1.0)
    assert tick.s.stick.released == (source,)
    teleop.hear_teleop(tick, velocity(tick, 0.0, source_id=source))
    assert tick.is_moving, "released, then neutral, in the taking itself"
    assert tick.s.epoch_no == epoch + 1
    assert not tick.s.grants.since_arm


def test_a_stick_that_nobody_holds_any_more_ends_no_mode() -> None:
    tick = at("active")
    tick.s.stick = replace(tick.s.stick, source_id="s", received_s=0.0)
    teleop.watch(tick)
    assert (tick.s.mode, tick.s.held, tick.s.stick.source_id) == (Mode.ACTIVE, None, None)


def test_taking_over_forgets_that_a_grant_was_given() -> None:
    tick = at("hold_granted")
    assert tick.s.grants.since_arm
    teleop.hear_teleop(tick, velocity(tick, dead_man=False))
    teleop.hear_teleop(tick, velocity(tick))
    assert (tick.s.mode, tick.s.grants.since_arm) == (Mode.TELEOP, False)
    assert tick.s.grants.mission is None
