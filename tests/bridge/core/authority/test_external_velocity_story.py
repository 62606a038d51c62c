"""Let another brain steer by velocity: owned, granted, aged and stopped like a planner."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.geometry.fence import build_fence
from tests.bridge.core.external_brain import drive_for, external_world, say
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.scripted import World
from wire import Action, Mode


def test_it_drives_within_limits_and_stands_when_it_lets_go() -> None:
    world = external_world()
    drive_for(world, 2.0)
    assert world.is_in(Mode.ACTIVE)
    assert world.sent.v_mps == pytest.approx(0.3)
    assert world.state.grants.metres < 20.0, "metered like a planner"
    drive_for(world, 2.0, v_mps=9.0)
    assert world.sent.v_mps <= world.core.robot.limits.max_speed_mps
    for _ in range(40):
        say(world, 0.3, held=False)
        world.run(0.05)
    assert world.is_in(Mode.HOLD)
    assert world.sent.v_mps == 0.0


def test_an_old_velocity_holds_after_a_quarter_second() -> None:
    world = external_world()
    drive_for(world, 1.0)
    world.run(0.15)
    assert world.is_in(Mode.ACTIVE)
    world.run(0.15)
    assert "CMD_STALE.1" in world.rows()
    assert world.is_in(Mode.STOPPING)
    world.run(2.0)
    assert world.is_in(Mode.HOLD)


def test_going_backwards_in_number_is_scored() -> None:
    world = external_world()
    drive_for(world, 1.0)
    for _ in range(7):
        say(world, 0.3, seq=1)
        world.tick()
    assert "CMD_BAD.0" in world.rows()


def test_a_planners_waypoints_are_not_its_to_send() -> None:
    world = external_world()
    drive_for(world, 0.5)
    assert world.planner is not None
    world.planner.next_horizon_s, world.planner.goal_m = 0.0, (4.0, 0.0)
    world.tick()
    assert world.last is not None
    assert "no_grant" in world.last.reasons
    assert world.state.leg.horizon is None


def test_stop_outranks_it() -> None:
    world = external_world()
    drive_for(world, 1.0)
    world.stop()
    world.tick()
    assert world.is_in(Mode.STOPPING)
    assert world.state.stopping is not None
    assert world.state.stopping.action is Action.HOLD2
    drive_for(world, 2.0)
    assert world.is_in(Mode.HOLD), "held until a person resumes"


def fenced_world(edge_m: float = 1.5) -> World:
    """Let an external brain own a robot in the middle of a square."""
    world = external_world()
    square = ((-edge_m, -edge_m), (edge_m, -edge_m), (edge_m, edge_m), (-edge_m, edge_m))
    world.core = replace(world.core, fence=build_fence(MAP_ID, (square,)))
    return world


def test_without_a_pose_it_is_held_as_waypoints_are() -> None:
    world = fenced_world()
    drive_for(world, 1.0)
    assert world.is_in(Mode.ACTIVE)
    world.localization_silent = True
    drive_for(world, 6.0)
    assert "POSE_LOST.0" in world.rows()
    assert world.is_in(Mode.HOLD)
    assert world.here.x_m < 0.7, "it would have been outside by now"
    world.localization_silent = False
    drive_for(world, 2.0)
    assert world.is_in(Mode.ACTIVE), "and goes on by itself"


def test_with_no_fence_to_keep_it_needs_a_pose_all_the_same() -> None:
    world = external_world()
    world.core = replace(world.core, fence=None)
    drive_for(world, 1.0)
    world.localization_silent = True
    drive_for(world, 2.0)
    assert world.is_in(Mode.HOLD)


def blocked_world(by: str = "obstacle") -> World:
    """Let an external brain push at something until the bridge calls its way blocked."""
    world = fenced_world() if by == "fence" else external_world()
    if by == "obstacle":
        world.obstacle_m = (1.5, 0.0, 0.3)
    elif by == "contact":
        world.drive.pressed = ("bumper_front",)
    drive_for(world, 7.0)
    assert world.state.gate.blocked
    assert world.is_in(Mode.HOLD)
    return world


@pytest.mark.parametrize("by", ["obstacle", "fence", "contact"])
def test_blocked_the_gate_that_shut_the_way_is_named(by: str) -> None:
    world = blocked_world(by)
    (blocked,) = [event.detail for event in world.events if event.code == "blocked"]
    assert blocked.startswith(f"by {by}, ")
    stops = [e.detail for e in world.events if e.code == "mode" and "STOPPING" in e.detail]
    assert stops == [f"ACTIVE STOPPING {by}", f"STOPPING HOLD {by}"]


@pytest.mark.parametrize("by", ["obstacle", "fence"])
@pytest.mark.parametrize("away", [(-0.2, 0.0), (0.0, 0.5)])
def test_blocked_it_may_turn_or_back_away(by: str, away: tuple[float, float]) -> None:
    world = blocked_world(by)
    before = world.here
    drive_for(world, 2.0, *away)
    assert world.is_in(Mode.ACTIVE)
    assert not world.state.gate.blocked
    assert before.x_m - world.here.x_m > 0.1 or world.here.yaw_rad > 0.1


def test_blocked_it_goes_on_when_the_way_is_free_again() -> None:
    world = blocked_world()
    world.obstacle_m = None
    drive_for(world, 0.4)
    assert world.state.gate.blocked, "five scans take half a second"
    drive_for(world, 1.0)
    assert world.is_in(Mode.ACTIVE)


@pytest.mark.parametrize("by", ["obstacle", "fence"])
def test_blocked_it_stays_so_while_it_pushes_on(by: str) -> None:
    world = blocked_world(by)
    seen = len(world.events)
    drive_for(world, 3.0, 9.0)
    assert world.state.gate.blocked
    assert world.is_in(Mode.HOLD)
    assert [event.code for event in world.events[seen:]] == []


@pytest.mark.parametrize("held", [True, False])
def test_blocked_it_stays_so_on_what_is_old_or_let_go_of(held: bool) -> None:
    world = blocked_world()
    say(world, -0.2, held=held)
    world.run(0.1)
    world.obstacle_m = None
    for _ in range(40):
        if not held:
            say(world, -0.2, held=False)
        world.run(0.05)
    assert world.state.gate.blocked
    assert world.is_in(Mode.HOLD)
