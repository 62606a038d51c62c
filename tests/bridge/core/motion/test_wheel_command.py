"""The command carries what wheel control adds; what is remembered as meant does not."""

from __future__ import annotations

import pytest

from bridge.core.geometry.kinematics import wheels_of
from bridge.core.state_motion import AT_REST, Wheel
from bridge.core.tick_context import MOVING
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import World, config
from wire import STILL, Mode, RobotDescription


def test_the_dead_zone_is_fed_forward_once_and_not_remembered() -> None:
    described = RobotDescription()
    plain = {"kp": 0.0, "ki_per_s": 0.0, "response_s": 0.0}
    robot = described.model_copy(update={"drive": described.drive.model_copy(update=plain)})
    world = World(config(robot)).driving()
    world.run(1.0)
    assert world.last is not None
    assert world.last.command is not None
    meant = wheels_of(world.sent, robot.base)
    assert meant.left_radps > 0.0
    over = world.last.command.left_radps - meant.left_radps
    assert over == pytest.approx(robot.drive.dead_zone_radps)


@pytest.fixture
def world() -> World:
    """Drive on a motor without the dead zone that robot.toml states: there is much to learn."""
    world = reached("active")
    assert wheel(world).integral < -0.05
    return world


def wheel(world: World) -> Wheel:
    return world.state.motion.left


def told(world: World) -> float:
    assert world.last is not None
    assert world.last.command is not None
    return world.last.command.left_radps


def test_a_motor_unlike_its_description_turns_as_meant(world: World) -> None:
    meant = wheels_of(world.sent, world.core.robot.base)
    assert world.drive.speeds[0] == pytest.approx(meant.left_radps, abs=0.02)


def test_a_stop_forgets_what_was_learnt_and_only_falls(world: World) -> None:
    before = told(world)
    world.stop()
    while world.tick().state.mode is Mode.STOPPING:
        assert wheel(world).integral == 0.0
        assert wheel(world).push <= 0.0
        meant = abs(wheels_of(world.sent, world.core.robot.base).left_radps)
        assert 0.0 <= told(world) <= min(before, meant + world.core.robot.drive.dead_zone_radps)
        before = told(world)
    assert (told(world), wheel(world)) == (0.0, AT_REST)


def test_a_drive_without_torque_teaches_nothing(world: World) -> None:
    world.drive.enabled = False  # of itself: the bridge goes on telling it to turn
    world.drive.deaf = True
    world.tick()
    world.tick()
    assert world.is_in(Mode.ACTIVE)
    assert (wheel(world).integral, wheel(world).push) == (0.0, 0.0)


def test_another_drive_begins_with_nothing_learnt(world: World) -> None:
    world.drive.boot_id = "d9"
    world.tick()
    assert (wheel(world).integral, wheel(world).push) == (0.0, 0.0)


def test_stale_encoders_leave_the_feed_forward_alone(world: World) -> None:
    world.drive_silent = True
    for _ in range(9):
        world.tick()
        if "ENC_STALE.0" in world.rows():
            break
    assert "ENC_STALE.0" in world.rows()
    assert (wheel(world).integral, wheel(world).push) == (0.0, 0.0)
    assert told(world) > 0.0


def test_without_torque_the_wheels_are_told_nothing(world: World) -> None:
    world.op("disarm")
    world.until(Mode.DISARMED)
    assert (told(world), wheel(world), world.state.motion.right) == (0.0, AT_REST, AT_REST)


def test_standing_powered_with_a_wheel_that_creeps_tells_nothing() -> None:
    world = World().armed()
    world.drive.runs_on, world.drive.speeds = True, (0.1, 0.1)
    world.run(0.5)
    assert world.is_in(Mode.HOLD)
    assert (told(world), wheel(world)) == (0.0, AT_REST)


@pytest.mark.parametrize("start", ["active", "teleop", "stopping_by_person", "stopping_by_row"])
def test_after_a_freeze_nothing_is_ramped_down(start: str) -> None:
    """A bridge that froze for 3 s once told a robot that stood to go on at 0.07 m/s."""
    timeout_s = RobotDescription().drive.timeout_s
    for gap_s, begins_anew in ((timeout_s - 0.001, False), (timeout_s + 0.001, True), (3.0, True)):
        world = reached(start)
        had = world.sent
        assert had.v_mps > 0.1
        for _ in range(round(gap_s / 0.01) - 1):
            world.drive.tick(world.now_s)
        decision = world.tick(gap_s)
        assert decision.command is not None
        if begins_anew:
            assert world.sent == STILL
            assert decision.command.left_radps == decision.command.right_radps == 0.0
            assert world.mode not in MOVING
        else:
            assert abs(world.sent.v_mps - had.v_mps) < 0.05
