"""Let another brain steer by velocity: owned, granted, aged and stopped like a planner."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from bridge.core.authority import external_velocity
from bridge.core.geometry.fence import build_fence
from bridge.core.state_orders import External
from tests.bridge.core.external_brain import drive_for, external_world, say
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.reached import at
from tests.bridge.core.scripted import World
from tests.bridge.core.table import table
from wire import STILL, Action, Mode, Owner, Twist2, Velocity


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


def blocked_world(by: str = "obstacle") -> World:
    """Return a world of one's own in which another brain's way is called blocked."""
    return _blocked_world(by).fork()


@cache
def _blocked_world(by: str) -> World:
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


def test_another_brain_is_followed_as_its_hand_says() -> None:
    for held, asked in ((True, Twist2(0.2, 0.1)), (False, STILL)):
        tick = at("active_external")
        tick.s.bad_bucket = 3.0
        last = tick.s.ownership.external_seq
        assert last is not None
        said = Velocity(source_id="x1", epoch=tick.epoch, seq=last + 1, dead_man=held,
                        seen=tick.s.voice.status_seq, v_mps=0.2, w_radps=0.1)  # fmt: skip
        external_velocity.hear_external(tick, said)
        sent_s = tick.s.voice.ring[-1]
        assert tick.s.external == External(asked.v_mps, asked.w_radps, held, sent_s)
        assert (tick.s.ownership.external_seq, tick.s.bad_bucket) == (last + 1, 2.0)
        assert external_velocity.requested_twist(tick) == asked
        for age_s, calls in ((0.25, held), (0.2501, False)):
            tick.s.external = replace(tick.s.external, sent_s=0.0)
            tick.now_s = age_s
            assert external_velocity.asks_to_move(tick) is calls
        tick.s.external = None
        assert external_velocity.requested_twist(tick) == STILL
        assert not external_velocity.asks_to_move(tick)


@table(
    ("change", "code", "score"),
    [("mission", "no_grant", 3.0), ("kind", "no_grant", 3.0), ("back", "seq_backwards", 4.0),
     ("again", "repeated", 3.0)],
)  # fmt: skip
def test_another_brain_is_not_followed_without_its_rights(
    change: str, code: str, score: float
) -> None:
    tick = at("active_external")
    tick.s.bad_bucket = 3.0
    before, last = tick.s.external, tick.s.ownership.external_seq
    assert last is not None
    if change == "mission":
        tick.s.grants = replace(tick.s.grants, mission=None)
    elif change == "kind":
        owner = Owner(planner_id="x1", kind="planner")
        tick.s.ownership = replace(tick.s.ownership, owner=owner)
    seq = {"back": last - 1, "again": last}.get(change, last + 1)
    said = Velocity(source_id="x1", epoch=tick.epoch, seq=seq, dead_man=True,
                    seen=tick.s.voice.status_seq, v_mps=0.2, w_radps=0.1)  # fmt: skip
    external_velocity.hear_external(tick, said)
    assert (tick.reasons, tick.s.bad_bucket) == ([code], score)
    assert tick.s.external == before
