"""The command carries the dead zone once; what is remembered does not."""

from __future__ import annotations

import pytest

from bridge.core.kinematics import wheels_of
from tests.bridge.core.scripted import World


def test_the_dead_zone_is_fed_forward_once_and_not_remembered() -> None:
    world = World().driving()
    world.run(1.0)
    assert world.last is not None
    assert world.last.command is not None
    robot = world.core.robot
    meant = wheels_of(world.sent, robot.base)
    assert meant.left_radps > 0.0
    over = world.last.command.left_radps - meant.left_radps
    assert over == pytest.approx(robot.drive.dead_zone_radps)
