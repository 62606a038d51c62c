"""Hold what is granted, metered and spent: missions, a person's cap, and what a hand may drive."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

import pytest
from pydantic import ValidationError

from bridge.core.authority.ownership import (
    HAND_METRES,
    HAND_SECONDS,
    OPERATOR_METRES,
    OPERATOR_SECONDS,
)
from bridge.core.geometry.fence import build_fence
from bridge.core.state_orders import MAX_MISSIONS, Grants
from tests.bridge.core.fake_planner import MAP_ID, FakePlanner
from tests.bridge.core.scripted import World, config
from wire import Grant, Mode


def way_m(world: World) -> float:
    return world.state.odometry.travelled_m


def left(world: World) -> Grants:
    return world.state.grants


def refused(world: World, mission: str) -> str | None:
    for item in world.state.operator.refusals:
        if item.answer.kind == "grant" and item.answer.id == mission:
            return item.answer.code
    return None


def ask(world: World, mission: str, metres: float = 60.0, seconds: float = 600.0) -> None:
    """Put a grant in the next tick, unchecked: as if the wire had let anything through."""
    status, planner = world.shown, world.brain
    grant = Grant.model_construct(
        planner_id=planner.planner_id,
        epoch=status.epoch,
        seen=status.seq,
        mission=mission,
        metres=metres,
        seconds=seconds,
    )
    world.extra = replace(world.extra, grants=(grant,))


def test_the_way_of_a_stop_is_metered_too() -> None:
    world = World().driving()
    before, at_m = left(world), way_m(world)
    world.stop()
    world.until(Mode.HOLD)
    rolled_m = way_m(world) - at_m
    assert rolled_m > 0.05
    assert before.operator_metres - left(world).operator_metres == pytest.approx(rolled_m, abs=0.01)


def test_stopping_again_and_again_drives_no_further_than_the_operator_cap() -> None:
    world = World().driving()
    world.state.grants = replace(left(world), operator_metres=1.0)
    at_m, planner = way_m(world), world.brain
    for _ in range(12):
        planner.silent = True  # held by BRAIN_LOST; its return is no person's act
        world.run(1.0)
        planner.silent = False
        world.run(1.0)
    assert way_m(world) - at_m <= 1.0 + 0.25, "and the stop after the last metre"
    assert left(world).operator_metres == 0.0
    assert world.is_in(Mode.HOLD)


def steer(world: World, v_mps: float, seconds: float) -> None:
    """Steer by hand, as a stick does that a person holds."""
    for _ in range(round(seconds / 0.05)):
        world.teleop(v_mps, held=True)
        world.run(0.05)


def test_a_hand_stands_when_its_metres_are_spent_and_a_signed_act_renews_them() -> None:
    world = World().armed()
    assert (left(world).hand_metres, left(world).hand_seconds) == (HAND_METRES, HAND_SECONDS)
    world.state.grants = replace(left(world), hand_metres=0.5)
    world.teleop(held=False)
    world.tick()
    at_m = way_m(world)
    steer(world, 0.3, 4.0)
    assert left(world).hand_metres == 0.0
    assert 0.5 <= way_m(world) - at_m <= 0.5 + 0.12, "and the ramp"
    assert world.is_in(Mode.HOLD)
    assert "HAND_BUDGET.0" in world.rows(), "said while the stick is held"
    stood_m = way_m(world)
    world.teleop(held=False)
    world.tick()
    steer(world, 0.3, 1.0)
    assert world.is_in(Mode.HOLD)
    assert way_m(world) == pytest.approx(stood_m, abs=1e-3)
    world.op("resume", authentic=False)
    world.run(0.1)
    assert left(world).hand_metres == 0.0
    world.op("resume")
    world.run(0.1)
    assert left(world).hand_metres == HAND_METRES
    world.teleop(held=False)
    world.tick()
    steer(world, 0.3, 1.0)
    assert world.is_in(Mode.TELEOP)
    assert "HAND_BUDGET.0" not in world.rows()
    assert way_m(world) > stood_m + 0.1


@pytest.mark.parametrize("driven_by", ["nobody", "hand"])
def test_after_a_stop_no_stick_moves_the_robot_before_a_signed_act(driven_by: str) -> None:
    """A client without a proof once let go, gripped again and drove 1.2 s after a person's stop."""
    world = World().armed()
    world.teleop(held=False)
    world.tick()
    if driven_by == "hand":
        steer(world, 0.3, 1.0)
    world.stop()
    world.run(2.0)
    stood_m = way_m(world)
    for _ in range(3):
        world.teleop(held=False)
        world.run(0.2)
        steer(world, 0.3, 1.0)
        assert world.is_in(Mode.HOLD)
        assert "HAND_BUDGET.0" in world.rows()
    assert way_m(world) == pytest.approx(stood_m, abs=1e-3)
    world.op("resume")
    world.run(0.1)
    world.teleop(held=False)
    world.tick()
    steer(world, 0.3, 1.0)
    assert world.is_in(Mode.TELEOP)


def test_a_hand_stands_when_its_seconds_are_spent() -> None:
    world = World().armed()
    world.state.grants = replace(left(world), hand_seconds=0.5)
    world.teleop(held=False)
    world.tick()
    steer(world, 0.0, 0.4)
    assert world.is_in(Mode.TELEOP)
    steer(world, 0.0, 0.4)
    assert "HAND_BUDGET.0" in world.rows()
    assert not world.is_in(Mode.TELEOP)
    world.run(1.1)
    assert "HAND_BUDGET.0" not in world.rows(), "nobody asks any more"


def test_a_metre_outside_the_fence_counts_ten_of_the_hands() -> None:
    outline = ((-1.0, -1.0), (0.5, -1.0), (0.5, 1.0), (-1.0, 1.0))
    world = World(core=replace(config(), fence=build_fence(MAP_ID, (outline,))), planner=None)
    world.ready().arm()
    world.teleop(held=False)
    world.tick()
    for _ in range(200):
        steer(world, 0.3, 0.05)
        if world.state.watch.outside:
            break
    world.state.grants = replace(left(world), hand_metres=12.0)
    had, at_m = left(world).hand_metres, way_m(world)
    steer(world, 0.3, 1.0)
    used_m = had - left(world).hand_metres
    assert used_m == pytest.approx(10.0 * (way_m(world) - at_m))
    assert used_m > 1.0
    steer(world, 0.3, 6.0)
    assert left(world).hand_metres == 0.0
    assert world.here.x_m < 0.5 + 0.1 * 12.0 + 0.3
    assert "HAND_BUDGET.0" in world.rows()


def test_what_is_left_outlives_a_restart_of_the_planner() -> None:
    world = World().driving()
    world.run(1.0)
    metres = left(world).metres
    world.planner = FakePlanner(planner_id="p2", mission="m1", goal_m=(4.0, 0.0))
    world.run(1.0)
    assert world.state.held is not None
    world.op("resume")
    world.until(Mode.ACTIVE, 3.0)
    assert left(world).metres <= metres


def test_new_missions_for_ever_drive_no_further_than_the_operator_cap() -> None:
    world = World().driving()
    world.state.grants = replace(left(world), operator_metres=0.8)
    at_m, planner = way_m(world), world.brain
    for number in range(2 * MAX_MISSIONS):
        planner.mission = f"again-{number}"
        world.run(0.1)
    assert way_m(world) - at_m <= 0.8 + 0.25
    assert refused(world, planner.mission or "") == "operator_budget"
    assert len(left(world).book) <= MAX_MISSIONS


def test_a_bridge_that_starts_lets_nobody_drive_before_a_person_armed() -> None:
    world = World().ready()
    assert (left(world).operator_metres, left(world).operator_seconds) == (0.0, 0.0)
    ask(world, "m1")
    world.tick()
    assert left(world).mission is None
    assert refused(world, "m1") == "not_armed"
    world.op("arm")
    world.tick()
    assert left(world).operator_metres == OPERATOR_METRES
    assert left(world).operator_seconds == OPERATOR_SECONDS


@pytest.mark.parametrize("metres", [nan, -1.0, 0.0, -inf])
def test_a_budget_that_is_no_number_grants_nothing_in_the_core(metres: float) -> None:
    world = World().armed()
    world.run(0.3)
    ask(world, "odd", metres=metres)
    world.tick()
    assert left(world).mission is None
    assert refused(world, "odd") == "budget"
    ask(world, "odder", seconds=metres)
    world.tick()
    assert refused(world, "odder") == "budget"


@pytest.mark.parametrize("odd", [nan, inf, -1.0, 0.0, 60.1, 1e999])
def test_a_budget_that_is_no_number_is_no_message(odd: float) -> None:
    with pytest.raises(ValidationError):
        Grant(planner_id="p", epoch="b-1", seen=1, mission="m", metres=odd, seconds=1.0)


def test_disarm_and_protective_stop_fill_nothing_up() -> None:
    world = World().driving()
    world.state.grants = replace(left(world), operator_metres=2.0, operator_seconds=9.0)
    world.op("estop")
    world.run(3.0)
    world.op("reset")
    world.run(0.1)
    assert world.is_in(Mode.DISARMED)
    assert left(world).operator_metres <= 2.0
    assert left(world).operator_seconds <= 9.0
