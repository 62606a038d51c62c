"""Sentences turn and move the robot by an amount: the truth, odometry and the record agree."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, hypot, pi, remainder, sin

import pytest

from tests.e2e.robot import SETTLE_S, Robot
from tests.e2e.system import ENDED, Json

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

OFF_RAD, OFF_M = 0.15, 0.12
"""Reached is 0.10 m and 0.10 rad by the robot's own pose, and that pose is noisy."""


def ended_well(robot: Robot, text: str) -> Json:
    goal = robot.system.until_goal(robot.system.give(text)["id"], *ENDED, limit_s=20.0)
    assert goal["state"] == "succeeded", (goal, robot.judge.describe())
    robot.judge.until_standing(SETTLE_S)
    (step,) = goal["plan"]["steps"]
    return {**step, "message": goal["outcome"]["message"]}


def test_turn_around_and_move_half_a_metre(
    robot: Robot, record_property: Callable[[str, object], None]
) -> None:
    kitchen = robot.place("kitchen")
    if robot.away_m(kitchen) > 0.4:  # room to move, whatever the story before left
        robot.arrive(kitchen, robot.system.give("go to the kitchen"))
    began = robot.judge.truth.base_in_map
    turn = ended_well(robot, "turn around")
    turned = robot.judge.truth.base_in_map
    assert abs(remainder(turned.yaw_rad - began.yaw_rad - pi, 2 * pi)) < OFF_RAD
    assert hypot(turned.x_m - began.x_m, turned.y_m - began.y_m) < 0.05
    assert abs(turn["turned_rad"] - pi) < OFF_RAD
    assert abs(turn["residual_rad"]) < OFF_RAD
    assert "180°" in turn["message"]["en"]

    done = robot.system.pons("say", "move forward half a metre")
    assert done.returncode == 0, (done.stdout, done.stderr)
    robot.judge.until_standing(SETTLE_S)
    moved, move = robot.judge.truth.base_in_map, robot.system.goals()[0]["plan"]["steps"][0]
    dx, dy = moved.x_m - turned.x_m, moved.y_m - turned.y_m
    ahead_m = dx * cos(turned.yaw_rad) + dy * sin(turned.yaw_rad)
    assert abs(ahead_m - 0.5) < OFF_M
    assert abs(move["moved_m"] - ahead_m) < 0.05
    assert move["residual_m"] < OFF_M
    assert move["left_m"] is None
    robot.judge.assert_no_contact()
    record_property("turned_deg", round(turn["turned_rad"] * 180 / pi, 1))
    record_property("moved_m", round(ahead_m, 3))
    print(f"turned {turn['turned_rad'] * 180 / pi:.1f} deg, moved {ahead_m:.3f} m")
