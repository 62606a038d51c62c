"""Hold operator's requests to their proofs, nonces and verdicts, in every mode."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from bridge.core import Inbox, OperatorArrival
from bridge.core.modes.mode_table import RequestCause, after
from tests.bridge.core.scripted import World
from wire import HeldReason, Mode, OpKind, OpRequest, Proof


def _armed_teleop() -> World:
    world = World().armed()
    world.teleop(0.0, held=False)
    world.tick()
    world.teleop(0.3, held=True)
    world.tick()
    return world


def _stopping() -> World:
    world = World().driving()
    world.stop()
    world.tick()
    return world


def _estopped() -> World:
    world = World().armed()
    world.op("estop")
    world.run(0.6)
    return world


def _fault() -> World:
    world = World().driving()
    world.drive.runs_on = True
    world.stop()
    world.until(Mode.FAULT, 2.0)
    world.drive.runs_on = False
    world.run(1.0)
    return world


IN: dict[Mode, Callable[[], World]] = {
    Mode.BOOT: World,
    Mode.SELFTEST: lambda: _run(World(), 0.3),
    Mode.DISARMED: lambda: World().ready(),
    Mode.HOLD: lambda: World().armed(),
    Mode.ACTIVE: lambda: World().driving(),
    Mode.TELEOP: _armed_teleop,
    Mode.STOPPING: _stopping,
    Mode.ESTOPPED: _estopped,
    Mode.FAULT: _fault,
}


def _run(world: World, seconds: float) -> World:
    world.run(seconds)
    return world


@pytest.mark.parametrize("kind", ["arm", "disarm", "estop", "reset", "resume"])
@pytest.mark.parametrize("mode", Mode, ids=str)
def test_a_request_does_what_the_table_says_or_nothing(mode: Mode, kind: OpKind) -> None:
    world = IN[mode]()
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
    request_id = world.op(kind, authentic=authentic, nonce=nonce)
    world.tick()
    assert world.verdict(request_id) == code
    assert world.is_in(Mode.DISARMED)
    assert world.state.held is not None


def test_a_request_without_any_proof_is_refused() -> None:
    world = World().ready()
    world.extra = Inbox(ops=(OperatorArrival("arm", OpRequest(id="bare", source="t"), True),))
    world.tick()
    assert world.verdict("bare") == "bad_proof"


def test_a_nonce_changes_when_used_and_stays_valid_for_what_was_signed() -> None:
    world = World(planner=None).ready()
    assert world.status is not None
    first = world.status.nonce
    world.op("resume", nonce=first)
    world.run(0.1)
    assert world.status.nonce != first
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
    assert world.status is not None
    signed_before = world.status.nonce
    if halt == "stop":
        world.stop()
    else:
        world.op("disarm" if halt == "disarm" else "estop")
    world.tick()
    late = world.op(kind, nonce=signed_before)
    world.tick()
    assert world.verdict(late) == "old_nonce"
    assert world.state.held is not None or halt == "disarm"


def test_a_nonce_changes_every_minute() -> None:
    world = World(planner=None).ready()
    number = world.state.operator.nonce_no
    world.run(61.0)
    assert world.state.operator.nonce_no == number + 1


def test_one_id_gets_one_verdict_and_no_proof_works_twice() -> None:
    world = World().ready()
    assert world.status is not None
    nonce = world.status.nonce
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
    assert world.status is not None
    assert code in world.status.waiting_for
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == code
    assert world.is_in(Mode.DISARMED)


def test_arming_needs_a_standing_robot_and_a_free_stick() -> None:
    world = World().ready()
    world.drive.runs_on, world.drive.speeds = True, (1.0, 1.0)
    world.run(0.1)
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "not_standing"
    world.drive.runs_on = False
    world.run(1.5)
    world.teleop(0.3, held=True)
    world.tick()
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "stick_not_neutral"
    world.run(0.3)
    world.op("arm")
    world.tick()
    assert world.is_in(Mode.HOLD)


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
    assert world.last is not None
    assert world.last.command is not None
    assert world.last.command.enable
    world.until(Mode.DISARMED, 2.0)
    assert world.state.held is None
    assert world.sent.v_mps == 0.0


def test_a_row_that_disarms_sets_held_and_arming_clears_it() -> None:
    world = World().driving()
    assert world.planner is not None
    world.planner.silent = True
    world.run(6.0)
    assert world.state.held is not None
    assert world.state.held.reason is HeldReason.FAULT
    assert world.state.held.id == "brain_gone"
    world.op("arm")
    world.tick()
    assert world.state.held is None


def test_answers_and_stops_are_told_at_once_but_at_most_40_times_a_second() -> None:
    world = World().driving()
    world.statuses.clear()
    for number in range(100):
        world.stop(f"s{number}")
        world.tick()
    assert 30 <= len(world.statuses) <= 41
    quiet = World().driving()
    quiet.statuses.clear()
    quiet.run(1.0)
    assert 20 <= len(quiet.statuses) <= 21
    stop_id = quiet.stop()
    quiet.run(0.03)
    assert quiet.status is not None
    assert stop_id in {answer.id for answer in quiet.status.answers}
    assert replace(quiet.extra) == Inbox()
