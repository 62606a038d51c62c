"""Play stories of a place that is not what it seemed: poor poses, and a robot outside its fence."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.geometry.fence import build_fence
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.scripted import World, config
from wire import IDENTITY, Mode, Pose2


def test_a_jump_behind_a_poor_pose_is_a_jump() -> None:
    world = World().driving((4.0, 0.0))
    world.quality, world.odom_in_map = 0.2, Pose2(0.4, 0.0, 0.0)  # carried, say
    world.run(0.2)
    assert "POSE_JUMP.0" not in world.rows()
    world.quality = 1.0
    world.run(0.1)
    assert "POSE_JUMP.0" in world.rows()


def test_a_poor_pose_between_two_equal_ones_is_no_jump() -> None:
    world = World().driving((4.0, 0.0))
    world.quality, world.odom_in_map = 0.2, Pose2(0.4, 0.0, 0.0)
    world.run(0.2)
    world.quality, world.odom_in_map = 1.0, IDENTITY
    world.run(0.7)
    assert not {"POSE_JUMP.0", "POSE_LOST.0"} & world.rows()


@pytest.mark.parametrize("away_m", [0.01, 0.5, 3.0])
def test_a_robot_outside_its_fence_is_said_and_a_stick_brings_it_in(away_m: float) -> None:
    outline = ((away_m, -1.0), (5.0, -1.0), (5.0, 1.0), (away_m, 1.0))
    world = World(core=replace(config(), fence=build_fence(MAP_ID, (outline,))), planner=None)
    world.ready()
    assert world.status is not None
    assert world.status.waiting_for == ("fence_excludes_robot",)
    world.arm()
    world.run(0.2)
    assert world.status.waiting_for == ("fence_excludes_robot",)
    assert world.is_in(Mode.HOLD), "a stick needs torque"
    world.teleop(held=False)
    world.tick()
    for _ in range(round(2.0 * 100 + away_m / 0.15 * 100)):
        world.teleop(0.3, held=True)
        world.tick()
        assert world.sent.v_mps <= 0.2 or world.here.x_m > away_m
    assert world.here.x_m > away_m
    assert not world.status.waiting_for


def test_a_robot_that_does_not_know_where_it_is_is_not_said_to_be_outside() -> None:
    outline = ((3.0, -1.0), (5.0, -1.0), (5.0, 1.0), (3.0, 1.0))
    core = replace(config(), fence=build_fence(MAP_ID, (outline,)))
    world = World(core=core, localization_silent=True).ready()
    assert world.status is not None
    assert world.status.waiting_for == ()
