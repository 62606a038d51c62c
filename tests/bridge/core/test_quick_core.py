"""Take the corners that no story passes: what comes twice, too late, from elsewhere or never."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

import pytest

from bridge.core import Inbox, LoopFacts, initial, step
from bridge.core.faults.detect_motion import _wheel_held
from bridge.core.geometry.fence import FenceGrid, build_fence
from bridge.core.geometry.kinematics import wheels_of
from bridge.core.geometry.odometry import along_arc
from bridge.core.motion.contact_gate import touched_input
from bridge.core.motion.fence_gate import fence_scale
from bridge.core.motion.motion_gates import look, scan_age_s
from bridge.core.state import draft
from bridge.core.state_motion import NO_STOP
from bridge.core.tick_context import TickContext
from tests.bridge.core.fake_planner import MAP_ID, PERIOD_S
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import FENCE, World, config
from tests.bridge.core.test_external_brain import say
from wire import IDENTITY, STILL, EstopLink, Grant, Mode, RobotDescription, Status, Twist2

ROBOT = RobotDescription()


def dropped(world: World, code: str) -> bool:
    """Take a tick and tell whether it dropped something for this reason."""
    return code in world.tick().reasons


def shown(world: World) -> Status:
    assert world.status is not None
    return world.status


def tick_of(world: World) -> TickContext:
    return TickContext(world.core, draft(world.state), Inbox(), world.now_s, PERIOD_S)


@pytest.mark.parametrize("start", ["hold", "active", "estopped", "fault", "stopping_by_row"])
def test_only_a_disarmed_robot_is_armed(start: str) -> None:
    world = reached(start)
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "not_disarmed"


@pytest.mark.parametrize("start", ["hold", "active", "disarmed"])
def test_only_what_is_latched_is_reset(start: str) -> None:
    world = reached(start)
    request_id = world.op("reset")
    world.tick()
    assert world.verdict(request_id) == "not_latched"


def test_a_proof_that_comes_with_a_stop_is_refused_with_it() -> None:
    world = reached("disarmed")
    world.stop()
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "stopped"


def test_nobody_is_armed_before_a_scan_has_come() -> None:
    world = reached("disarmed")
    world.state.lidar = replace(world.state.lidar, received_s=None)
    world.lidar_silent = True
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "lidar_stale"


def test_a_robot_that_rolls_is_not_reset() -> None:
    world = reached("estopped")
    world.drive.runs_on, world.drive.speeds = True, (2.0, 2.0)
    world.run(0.05)
    request_id = world.op("reset")
    world.tick()
    assert world.verdict(request_id) == "not_standing"


def test_a_stop_link_that_is_pressed_is_said() -> None:
    robot = RobotDescription.model_validate({"inputs": {"estop_link": True}})
    world = World(core=config(robot))
    world.extra = Inbox(estop_link=EstopLink(seq=1, pressed=True))
    world.tick()
    assert world.is_in(Mode.ESTOPPED)
    request_id = world.op("reset")
    world.tick()
    assert world.verdict(request_id) == "estop_pressed"


def test_the_same_number_again_is_dropped_and_not_scored() -> None:
    world = reached("active")
    assert world.planner is not None
    world.planner.seq -= 1
    world.planner.next_horizon_s = 0.0
    assert dropped(world, "repeated")
    assert world.state.bad_bucket == 0.0
    external = reached("active_external")
    say(external, 0.3, seq=external.state.ownership.external_seq)
    assert dropped(external, "repeated")
    stick = reached("teleop")
    stick.ids = stick.state.stick.seq - 1
    stick.teleop(0.3, held=True)
    assert dropped(stick, "repeated")
    assert stick.state.bad_bucket == 0.0


def test_numbers_that_go_backwards_are_scored_of_horizons_and_sticks() -> None:
    world = reached("active")
    assert world.planner is not None
    world.planner.seq -= 3
    world.planner.next_horizon_s = 0.0
    assert dropped(world, "seq_backwards")
    assert world.state.bad_bucket == 1.0
    stick = reached("teleop")
    stick.ids = stick.state.stick.seq - 5
    stick.teleop(0.3, held=True)
    assert dropped(stick, "seq_backwards")
    assert stick.state.bad_bucket == 1.0


def test_a_horizon_older_than_its_ttl_is_named() -> None:
    world = reached("active")
    assert world.planner is not None
    kept = shown(world)
    world.run(0.2)
    world.planner.ttl_s = 0.1
    old = world.planner.horizon(kept)
    world.planner.next_horizon_s = 1e9
    world.extra = replace(world.extra, waypoints=(old,))
    assert dropped(world, "too_old")
    assert world.state.leg.refusal == "too_old"


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


@pytest.mark.parametrize(
    ("metres", "seconds", "start", "code"),
    [
        (5.0, 9.0, "disarmed", "grant_not_armed"),
        (5.0, 9.0, "stopping_by_person", "grant_held"),
    ],
)
def test_a_grant_is_refused_by_name(metres: float, seconds: float, start: str, code: str) -> None:
    world = reached(start)
    world.run(0.1)
    status = shown(world)
    grant = Grant(
        planner_id="p1",
        epoch=status.epoch,
        seen=status.seq,
        mission="new",
        metres=metres,
        seconds=seconds,
    )
    world.extra = replace(world.extra, grants=(grant,))
    assert dropped(world, code)
    assert world.state.grants.mission is None


def test_an_operators_spent_cap_refuses_a_new_grant() -> None:
    world = reached("hold")
    world.state.grants = replace(world.state.grants, operator_metres=0.0)
    assert world.planner is not None
    world.planner.mission = "new"
    world.run(0.1)
    codes = [answer.code for answer in shown(world).answers if answer.kind == "grant"]
    assert codes == ["operator_budget"]
    assert world.state.grants.mission is None


def test_a_fence_that_is_missing_or_of_another_map_fails_the_self_test() -> None:
    for fence, code in ((None, "fence_missing"), (other_map(), "fence_of_another_map")):
        core = replace(config(), fence=fence)
        decision = step(core, initial(core, 1.0), Inbox(), 1.01)
        assert decision.state.mode is Mode.FAULT
        assert decision.state.fault == code


def other_map() -> FenceGrid:
    return build_fence("0" * 16, (((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)),))


def test_missed_ticks_are_a_reason_once_where_lateness_is_one_too() -> None:
    world = reached("active")
    for _ in range(4):
        world.late(0.006)
        world.tick()
    world.extra = replace(world.extra, loop=LoopFacts(late_s=0.006, missed_ticks=3))
    world.tick()
    assert "late ticks" in world.state.rows["LOOP_LATE.0"].evidence


@pytest.mark.parametrize(
    ("asked", "real", "held"),
    [
        (Twist2(0.4, 0.0), Twist2(0.2, 0.8), True),
        (Twist2(0.4, 0.0), Twist2(0.2, -0.8), True),
        (Twist2(0.4, 0.0), Twist2(0.4, 0.0), False),
        (Twist2(0.25, 1.0), Twist2(0.25, 1.0), False),
        (Twist2(0.05, 0.2), Twist2(0.05, 0.2), False),
    ],
)
def test_one_wheel_that_stands_and_should_not_is_held(
    asked: Twist2, real: Twist2, held: bool
) -> None:
    assert _wheel_held(asked, real, ROBOT.base) is held


def test_no_scan_shuts_every_way() -> None:
    world = reached("active")
    world.state.lidar = replace(world.state.lidar, picture=None)
    world.lidar_silent = True
    world.tick()
    assert world.state.motion.bound_by == "no_scan"
    assert look(tick_of(world), Twist2(0.3, 0.0)) is None
    world.state.lidar = replace(world.state.lidar, newest=None)
    assert scan_age_s(tick_of(world)) == 0.0


def test_a_hand_on_the_stick_crosses_the_fence_slowly() -> None:
    world = reached("teleop")
    edge_m = world.here.x_m + 0.4
    square = ((-5.0, -5.0), (edge_m, -5.0), (edge_m, 5.0), (-5.0, 5.0))
    world.core = replace(world.core, fence=build_fence(MAP_ID, (square,)))
    for _ in range(40):
        world.teleop(0.4, held=True)
        world.run(0.05)
    assert world.is_in(Mode.TELEOP)
    assert world.here.x_m > edge_m, "a person may"
    assert world.sent.v_mps == pytest.approx(0.2, abs=1e-6)
    assert world.state.motion.bound_by == "fence"


def test_a_blocked_way_is_forgotten_with_its_mission_and_judged_with_none() -> None:
    world = reached("active")
    world.state.gate = replace(world.state.gate, blocked=True)
    world.tick()
    assert world.is_in(Mode.STOPPING)
    world.stop()
    world.run(1.0)
    assert world.is_in(Mode.HOLD)
    assert not world.state.gate.blocked


def test_a_new_order_to_stop_ends_the_going_on_of_a_stop_in_progress() -> None:
    world = reached("stopping_by_row")
    assert world.state.stopping is not None
    assert world.state.stopping.resumes
    world.op("disarm")
    world.tick()
    assert world.state.stopping is not None
    assert not world.state.stopping.resumes
    assert world.state.stopping.action.value == "STOP1"
    world.op("disarm")
    world.tick()
    assert world.is_in(Mode.STOPPING)


def test_numbers_that_are_none_stand_still() -> None:
    base, limits = ROBOT.base, ROBOT.limits
    stopped = wheels_of(Twist2(0.0, 0.0), base)
    assert wheels_of(Twist2(1e308, 1e308), base.model_copy(update={"wheel_radius_m": 1e-300})) == (
        stopped
    )
    for v, w in ((inf, 0.0), (nan, 0.0), (0.1, inf)):
        assert fence_scale(FENCE, IDENTITY, Twist2(v, w), base, limits, 0.2) == 0.0
    assert along_arc(IDENTITY, 1.0, inf) == IDENTITY
    assert touched_input(None, 0.3) is None
    assert NO_STOP.start == STILL


def test_without_a_pose_or_a_path_nothing_is_followed() -> None:
    world = reached("active")
    world.state.leg = replace(world.state.leg, path=None)
    assert world.planner is not None
    world.planner.next_horizon_s = 1e9
    world.tick()
    assert world.state.motion.asked == STILL


def test_equal_scans_of_a_robot_that_hardly_moves_are_no_frozen_lidar() -> None:
    world = reached("hold")
    scan = world.state.lidar.newest
    assert scan is not None
    for count in range(1, 8):
        again = scan.model_copy(update={"seq": scan.seq + count, "stamp_s": world.now_s})
        world.lidar_silent = True
        world.extra = replace(world.extra, scan=again)
        world.run(0.1)
    assert world.state.lidar.equal >= 5
    assert "LIDAR_STALE.0" not in world.rows()
