"""With wheel control a robot whose motors are not as described does what was meant.

What is meant (the limiter's memory) is compared with what the physics does.
"""

from __future__ import annotations

from math import hypot, sqrt

import pytest

from bridge.core.geometry.kinematics import rim_speeds, roll
from sim import Hardware
from tools.lockstep import TICK_S, LockstepWorld
from wire import IDENTITY, Mode, Pose2, RobotDescription, compose, inverse

pytestmark = pytest.mark.nightly(keep=2)


LIMIT_MMPS, LIMIT_MM = 10.0, 8.0
"""Seen: 5 to 7 mm/s, and 2 to 5 mm per metre of path; without control 20 to 63, and 14 to 440."""
LIMIT_S = 60.0
NEAR = Pose2(1.4, 2.5, 1.0)
"""On the way to the living room, with a turn at its beginning."""
WEAK_RIGHT = Hardware(right_gain=0.9)


def drive(hardware: Hardware, robot: RobotDescription) -> tuple[float, float]:
    """Drive to the living room; return what its wheels and its path lack.

    The rims: the root mean square over both and all ticks under way [mm/s]. The path: between the
    truth and where what was meant would have led, per metre driven [mm].
    """
    world = LockstepWorld(seed=1, start=NEAR, robot=robot, hardware=hardware)
    width_m = world.scene.robot.base.wheel_separation_m
    goal = world.say("go to the living room")
    world.run_until(lambda w: w.status.mode is Mode.ACTIVE, LIMIT_S)
    began_s, began, meant_to = world.now_s, world.truth, IDENTITY
    squares, count, metres = 0.0, 0, 0.0
    while not goal.has_ended and world.now_s - began_s < LIMIT_S:
        world.tick()
        left, right = rim_speeds(world.bridge.state.motion.limiter.sent, width_m)
        meant_to = roll(meant_to, left * TICK_S, right * TICK_S, width_m)
        metres += abs(world.twist.v_mps) * TICK_S
        if world.bridge.state.mode is Mode.ACTIVE:
            real = rim_speeds(world.twist, width_m)
            squares += (real[0] - left) ** 2 + (real[1] - right) ** 2
            count += 2
    assert goal.state == "succeeded"
    truly = compose(inverse(began), world.truth)
    strayed_m = hypot(truly.x_m - meant_to.x_m, truly.y_m - meant_to.y_m)
    return 1e3 * sqrt(squares / max(1, count)), 1e3 * strayed_m / metres


@pytest.mark.parametrize(
    "hardware",
    [
        Hardware(left_gain=1.15, right_gain=1.15),
        Hardware(left_gain=0.85, right_gain=0.85),
        WEAK_RIGHT,
    ],
    ids=["motors +15 %", "motors -15 %", "right wheel -10 %"],
)
def test_wheels_turn_as_meant_and_the_path_is_the_one_meant(hardware: Hardware) -> None:
    rim_mmps, strayed_mm = drive(hardware, RobotDescription())
    assert rim_mmps < LIMIT_MMPS
    assert strayed_mm < LIMIT_MM


def test_without_control_they_do_not() -> None:
    robot = RobotDescription()
    plain = {"kp": 0.0, "ki_per_s": 0.0, "response_s": 0.0, "max_correction": 0.0}
    drives = robot.drive.model_copy(update=plain)
    rim_mmps, strayed_mm = drive(WEAK_RIGHT, robot.model_copy(update={"drive": drives}))
    assert rim_mmps > LIMIT_MMPS
    assert strayed_mm > LIMIT_MM
