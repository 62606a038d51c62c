"""Hold which stick is heard, when one takes the robot, and when it lets go."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.modes import teleop
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at, reached
from tests.bridge.core.table import table
from tests.bridge.core.windows import dropped
from wire import HeldReason, Mode, StandingHold, Velocity

EPS = 1e-6


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
        assert tick.s.held == StandingHold(reason=HeldReason.TELEOP, id="s")
    else:
        assert tick.reasons == ["stick_not_ready"]


def test_eight_sticks_are_remembered_as_ready_the_newest_ones() -> None:
    tick = at("hold")
    for number in range(9):
        teleop.hear_teleop(tick, velocity(tick, dead_man=False, source_id=f"s{number}"))
    newest = tuple(f"s{number}" for number in range(1, 9))
    assert (tick.s.stick.released, tick.s.stick.ready) == (newest, newest)


@table(
    ("now_s", "received_s", "sent_s", "fresh"),
    [
        (0.25, 0.0, 0.25, True),
        (0.4, 0.4, 0.0, True),
        (0.25 + EPS, 0.0, 0.25, False),
        (0.4 + EPS, 0.4, 0.0, False),
    ],
)
def test_a_stick_steers_while_it_is_fresh(
    now_s: float, received_s: float, sent_s: float, fresh: bool
) -> None:
    tick = at("teleop")
    tick.now_s = now_s
    tick.s.stick = replace(tick.s.stick, received_s=received_s, sent_s=sent_s)
    teleop.watch(tick)
    assert (tick.s.mode is Mode.TELEOP) is fresh
    if not fresh:
        assert (tick.s.mode, tick.s.stick.source_id) == (Mode.HOLD, None)
        assert tick.s.stick.pressed_s is not None
        assert tick.s.held == StandingHold(reason=HeldReason.TELEOP, id="stick")


@table(
    ("changes", "reason"),
    [
        ({"epoch": "b0-99"}, "old_epoch"),
        ({"seen": 999_999}, "teleop_stale"),
        ({"source_id": "other"}, "stick_taken"),
        ({"seq": 0}, "seq_backwards"),
        ({"seq": 5}, "repeated"),
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
    assert tick.s.held == StandingHold(reason=HeldReason.TELEOP, id=str(source))
    assert (tick.s.stick.source_id, tick.s.stick.ready, tick.s.stick.pressed_s) == (None, (), 1.0)
    assert tick.s.stick.released == (source,)
    teleop.hear_teleop(tick, velocity(tick, 0.0, source_id=source))
    assert tick.is_moving, "released, then neutral, in the taking itself"
    assert tick.s.epoch_no == epoch + 1
    assert not tick.s.grants.since_arm


def test_taking_over_forgets_that_a_grant_was_given() -> None:
    tick = at("hold_granted")
    assert tick.s.grants.since_arm
    teleop.hear_teleop(tick, velocity(tick, dead_man=False))
    teleop.hear_teleop(tick, velocity(tick))
    assert (tick.s.mode, tick.s.grants.since_arm) == (Mode.TELEOP, False)
    assert tick.s.grants.mission is None


@pytest.mark.parametrize("mode", ["disarmed", "estopped", "fault"])
def test_a_stick_moves_nothing_that_may_not_move(mode: str) -> None:
    world = reached(mode)
    world.run(0.1)
    world.teleop(0.0, held=False, source="other")
    world.tick()
    world.run(0.1)
    world.teleop(0.3, held=True, source="other")
    assert dropped(world, "teleop_not_now")
    assert not world.is_in(Mode.TELEOP)


def test_a_hand_that_a_new_epoch_has_voided_leaves_the_mode_too() -> None:
    """A brain that falls silent and comes back must leave no robot that waits for a hand's end."""
    world = reached("teleop")
    world.planner = None
    world.teleop(0.0, held=True)
    for _ in range(300):
        if world.state.stick.source_id is None:
            break
        world.teleop(0.0, held=True)
        world.tick()
    world.run(0.1)
    assert world.is_in(Mode.HOLD)
    assert world.state.held is not None
    assert world.state.held.reason is HeldReason.TELEOP
