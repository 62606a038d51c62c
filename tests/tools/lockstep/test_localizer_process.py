"""A whole robot that localizes by its scans: placed at start, held when carried, placed anew."""

from __future__ import annotations

from math import hypot

from localization.localizer import LocalizerState
from tests.known import known
from tools.lockstep import LockstepWorld
from wire import Pose2, RobotDescription, compose
from wire.robot import LocalizationConfig


def error_m(world: LockstepWorld) -> float:
    said = known(known(world.localizer).localizer.said)
    base = compose(said.odom_in_map, world.status.base_in_odom)
    return hypot(base.x_m - world.truth.x_m, base.y_m - world.truth.y_m)


def test_it_finds_itself_at_start_and_again_when_carried() -> None:
    robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
    world = LockstepWorld(site="two_room", seed=2, robot=robot)
    localizer = known(world.localizer).localizer
    assert error_m(world) < 0.05
    world.teleport(Pose2(world.truth.x_m + 0.9, world.truth.y_m, world.truth.yaw_rad + 1.0))
    world.run_until(lambda _: localizer.state is LocalizerState.LOST, 0.6)
    world.run(0.1)
    assert "POSE_LOST" in [row.row for row in world.status.rows]
    world.run_until(lambda _: localizer.state is LocalizerState.TRACKING, 2.0)
    world.run(0.2)
    assert error_m(world) < 0.05
    assert world.status.base_in_map is not None
