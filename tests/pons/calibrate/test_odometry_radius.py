"""The wheel radius of a base that runs in the bridge is found by its odometry, before a wall."""

from __future__ import annotations

from typing import cast

import pytest

from pons.calibrate.errors import CalibrationRefusal, RunLost
from pons.calibrate.odometry_radius import find_radius, reckoned_m
from pons.calibrate.procedure import CalibrationPlan
from pons.calibrate.session import CalibrationRig
from pons.settings import CHECKOUT
from sim import Hardware
from tests.pons.calibrate.test_gyro_track import odometry
from tools.lockstep import LockstepWorld
from wire import Mode, Pose2, RobotDescription, distance, load_robot
from wire.keys import Party
from wire.robot import LocalizationConfig
from wire.session import Session

pytestmark = pytest.mark.nightly(keep=1)


CORNERED = Pose2(0.5, 2.5, 1.5708)
TRUE_M = 0.0345
"""Of wheels that robot.toml believes to be 0.033."""


def burger() -> RobotDescription:
    robot = load_robot(CHECKOUT / "robots" / "turtlebot3_burger.toml")
    return robot.model_copy(update={"localization": LocalizationConfig(kind="stand_in")})


def rig_on(robot: RobotDescription, start: Pose2) -> tuple[CalibrationRig, LockstepWorld]:
    hardware = Hardware(wheel_radius_m=TRUE_M)
    world = LockstepWorld(site="two_room", robot=robot, start=start, hardware=hardware)
    world.run(1.0)
    operator = cast("Session", world.bus.port(Party.OPERATOR))
    judge = cast("Session", world.bus.port(Party.JUDGE))
    return CalibrationRig(operator, judge, lambda: world.now_s, world.tick), world


def no_tape() -> float:
    raise AssertionError("the lidar measures")


@pytest.mark.slow
def test_wheels_that_are_larger_than_believed_are_found_and_nothing_else_is_written() -> None:
    robot, said = burger(), list[str]()
    rig, world = rig_on(robot, Pose2(1.5, 1.0, 1.5708))
    plan = CalibrationPlan(None, shuttles=1)
    (found,) = find_radius(rig, robot, plan, "2026-11-26T02:00:00Z", said.append, no_tape)
    assert found.name == "base.wheel_radius_m"
    assert found.value == pytest.approx(TRUE_M, rel=0.01)
    assert "odometry against the lidar" in found.evidence
    assert world.contacts == 0
    assert world.standing
    assert world.status.mode is Mode.HOLD


def test_a_robot_in_a_corner_is_not_moved() -> None:
    robot = burger()
    rig, world = rig_on(robot, CORNERED)
    before = world.truth
    with pytest.raises(CalibrationRefusal, match="no_room"):
        find_radius(rig, robot, CalibrationPlan(None), "now", print, no_tape)
    assert distance(world.truth, before) < 1e-6


def test_the_simulators_truth_is_no_reference_for_metal() -> None:
    robot = burger()
    rig, _ = rig_on(robot, CORNERED)
    with pytest.raises(CalibrationRefusal, match="no_truth"):
        find_radius(rig, robot, CalibrationPlan("truth"), "now", print, no_tape)


def test_odometry_that_was_not_heard_or_began_anew_is_no_way() -> None:
    said = odometry()
    for bad in (said[:2], [*said[:-1], said[-1].model_copy(update={"odom_id": "o-2"})]):
        with pytest.raises(RunLost):
            reckoned_m(bad)
