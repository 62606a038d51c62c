"""Rows about brains and budgets: one tick before and after each window, action, clearing."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.faults.fault_table import ROWS, Clears, FaultRow
from tests.bridge.core.scripted import World
from tests.bridge.core.windows import age_ticks, bad_bytes, raised, silent_for, until_age
from wire import SEVERITY, Action, Mode


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_only_what_caps_or_holds_clears_by_itself(row: FaultRow) -> None:
    for stage in row.stages:
        if stage.clears in {Clears.AUTO, Clears.ON_GRANT}:
            assert SEVERITY[stage.action] <= SEVERITY[Action.HOLD2]
        assert (stage.action is Action.CAP) == (
            stage.cap_factor is not None or stage.cap_mps is not None or stage.cap_zone
        )
        assert stage.name.startswith(f"{stage.row}.")


def test_brain_late_caps_at_half_after_150_ms_and_lost_holds_after_300() -> None:
    world = World().driving()
    assert world.planner is not None
    world.planner.silent = True
    echo_s = world.state.ownership.echo_s
    until_age(world, echo_s, 14)
    assert not raised(world, "BRAIN_LATE.0")
    until_age(world, echo_s, 16)
    assert raised(world, "BRAIN_LATE.0")
    assert world.state.motion.cap == 0.5
    assert world.is_in(Mode.ACTIVE)
    until_age(world, echo_s, 29)
    assert world.is_in(Mode.ACTIVE)
    until_age(world, echo_s, 31)
    assert raised(world, "BRAIN_LOST.0")
    assert world.is_in(Mode.STOPPING)
    assert world.state.ownership.owner is None
    assert world.state.grants.mission is None


@pytest.mark.parametrize("phase", range(20))
def test_silence_is_held_within_31_ticks_of_the_newest_echo(phase: int) -> None:
    world = World().driving()
    silent_for(world, phase)
    assert world.planner is not None
    world.planner.silent = True
    echo_s = world.state.ownership.echo_s
    while world.is_in(Mode.ACTIVE):
        world.tick()
        echo_s = world.state.ownership.echo_s
        assert age_ticks(world, echo_s) <= 31
    assert world.is_in(Mode.STOPPING)


def test_a_lost_brain_that_returns_while_the_robot_stops_is_not_called_lost() -> None:
    world = World().driving()
    assert world.planner is not None
    world.planner.silent = True
    while world.is_in(Mode.ACTIVE):
        world.tick()
    world.planner.silent, world.planner.mission = False, None  # it is back and wants nothing
    for _ in range(200):
        if world.state.ownership.owner is None:
            world.tick()
    assert world.state.ownership.owner is not None
    assert world.is_in(Mode.STOPPING), "it stands, and the stop's 200 ms are not over"
    assert raised(world, "BRAIN_LOST.0"), "a stop is finished before it is forgotten"
    world.until(Mode.HOLD, 2.0)
    world.run(0.1)
    assert not raised(world, "BRAIN_LOST.0")


def test_brain_gone_disarms_after_5_s() -> None:
    world = World().driving()
    assert world.planner is not None
    world.planner.silent = True
    until_age(world, world.state.ownership.echo_s, 499)
    assert world.is_in(Mode.HOLD)
    silent_for(world, 2)
    assert world.is_in(Mode.DISARMED)
    assert raised(world, "BRAIN_GONE.0")
    world.op("arm")
    world.run(0.1)
    assert not raised(world, "BRAIN_GONE.0")
    assert world.is_in(Mode.HOLD)


def test_a_brain_that_thinks_on_stale_data_is_held_after_1_s() -> None:
    world = World().driving()
    assert world.planner is not None
    world.run(0.1)
    assert world.status is not None
    world.planner.used = world.status.seq
    world.run(0.1)
    used_s = world.state.ownership.used_s
    until_age(world, used_s, 99)
    assert world.is_in(Mode.ACTIVE)
    silent_for(world, 2)
    assert raised(world, "BRAIN_STALE.0")
    assert world.is_in(Mode.STOPPING)
    world.planner.used = None
    world.run(0.3)
    assert raised(world, "BRAIN_STALE.0")
    world.run(0.5)
    assert not raised(world, "BRAIN_STALE.0")
    world.until(Mode.ACTIVE, 1.0)


def test_an_old_horizon_is_held_after_its_ttl() -> None:
    world = World().driving()
    assert world.planner is not None
    world.planner.next_horizon_s = 1e9
    world.tick()
    sent_s = world.state.leg.sent_s
    until_age(world, sent_s, 49)
    assert world.is_in(Mode.ACTIVE)
    silent_for(world, 2)
    assert raised(world, "CMD_STALE.0")
    assert world.is_in(Mode.STOPPING)
    world.planner.next_horizon_s = 0.0
    world.until(Mode.ACTIVE, 2.0)
    assert not raised(world, "CMD_STALE.0")


def test_four_bad_messages_are_forgiven_and_five_are_not() -> None:
    world = World().driving()
    bad_bytes(world, 4)
    world.tick()
    assert not raised(world, "CMD_BAD.0")
    world.run(2.5)
    assert world.is_in(Mode.ACTIVE)
    bad_bytes(world, 6)
    world.tick()
    assert raised(world, "CMD_BAD.0")
    assert world.is_in(Mode.STOPPING)
    world.until(Mode.ACTIVE, 4.0)


def test_bad_bytes_of_who_may_not_speak_are_only_counted() -> None:
    world = World().driving()
    dropped = world.state.voice.dropped
    bad_bytes(world, 4, "cmd/external")
    world.tick()
    bad_bytes(world, 4, "cmd/hello")
    world.tick()
    assert world.state.voice.dropped == dropped + 8
    assert world.state.bad_bucket == 0.0


def test_a_spent_grant_holds_at_once_and_a_new_mission_goes_on() -> None:
    world = World()
    assert world.planner is not None
    world.planner.metres = 1.0
    world.driving((4.0, 0.0))
    world.until(Mode.STOPPING, 5.0)
    assert raised(world, "BUDGET.0")
    assert world.state.grants.metres == 0.0
    world.run(2.0)
    assert world.is_in(Mode.HOLD)
    world.planner.mission = "m2"
    world.until(Mode.ACTIVE, 1.0)
    assert not raised(world, "BUDGET.0")
    world.stop()
    world.run(2.0)
    world.op("resume")
    world.planner.mission = "m1"
    world.run(1.0)
    assert world.is_in(Mode.HOLD), "what m1 had is spent for good"


def test_the_operator_cap_is_spent_and_refilled_by_a_person() -> None:
    world = World().driving()
    grants = world.state.grants
    world.state.grants = replace(grants, operator_metres=0.001)
    world.until(Mode.STOPPING, 0.5)
    assert raised(world, "BUDGET.0")
    world.run(2.0)
    assert world.is_in(Mode.HOLD)
    world.op("resume")
    world.until(Mode.ACTIVE, 1.0)
