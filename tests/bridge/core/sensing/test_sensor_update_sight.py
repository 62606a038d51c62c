"""Hold how far anybody needs to look."""

from __future__ import annotations

import pytest

from bridge.core.sensing.sensor_update import look_m, sight_m
from bridge.core.state_motion import Braking
from tests.bridge.core.table import table
from wire import RobotDescription


def robot_of(**parts: dict[str, float]) -> RobotDescription:
    return RobotDescription.model_validate(parts)


ROBOT = robot_of(limits={"max_decel_mps2": 0.8, "stop_jerk_mps3": 5.0})
"""Brakes at 0.8 m/s2 and takes 0.08 s of mean delay to build that up; 0.06 s late; 0.5 m wide."""


@table(
    ("robot", "known_as", "look"),
    [
        # v d / 2 j + v rim / 2 d + v (0.15 + scan + lag), and a millimetre
        (ROBOT, Braking(), 0.04 + 0.5 * 0.75 / 1.6 + 0.5 * 0.31),
        (ROBOT, Braking(0.1, 0.5), 0.04 + 0.5 * 0.75 / 0.8 + 0.5 * 0.41),
        (robot_of(limits={"max_wheel_radps": 6.0}), Braking(), 0.025 + 0.5 * 0.6 / 2 + 0.155),
        (robot_of(lidar={"scan_s": 0.05}), Braking(), 0.025 + 0.1875 + 0.5 * 0.26),
        # a late drive: the limiter wants 2 v (tick + lag) + d^3 / 24 j^2 more
        (
            robot_of(limits={"max_decel_mps2": 0.8, "stop_jerk_mps3": 2.5}, drive={"lag_s": 0.4}),
            Braking(),
            0.08 + 0.5 * 0.75 / 1.6 + 0.41 + 0.512 / 150,
        ),
        (robot_of(limits={"max_speed_mps": 0.2, "max_turn_radps": 0.5}), Braking(), 0.3),
        (robot_of(limits={"max_speed_mps": 1.0, "max_decel_mps2": 0.2}), Braking(), 1.999),
    ],
)
def test_how_far_anybody_needs_to_look(
    robot: RobotDescription, known_as: Braking, look: float
) -> None:
    assert look_m(robot, known_as) == pytest.approx(look + 0.001)
    moved_m = robot.limits.max_speed_mps * 0.15
    assert sight_m(robot, known_as) == pytest.approx(look + 0.001 + 0.3 + 0.05 + moved_m + 0.002)
