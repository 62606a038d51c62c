"""Compare wheel control with feed-forward alone on motors unlike their description.

Lockstep drives of one goal with the same seed, one after the other with and without the PI law:
interleaved pairs. What is meant (the limiter's memory) is compared with what the physics does; the
core, the link code and the physics are the shipped ones, and nothing of this machine is in it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, sqrt

from bridge.core.geometry.kinematics import rim_speeds, roll
from sim import Hardware
from tools.lockstep import TICK_S, LockstepWorld
from wire import IDENTITY, Mode, Pose2, RobotDescription, compose, inverse

START = Pose2(1.2, 0.8, 0.0)
LIMIT_S = 60.0
GOAL = "go to the living room"

METALS = {
    "as described": Hardware(),
    "motors +15 %": Hardware(left_gain=1.15, right_gain=1.15),
    "motors -15 %": Hardware(left_gain=0.85, right_gain=0.85),
    "dead zone twice what is believed": Hardware(dead_zone_radps=0.1),
    "dead zone half of what is believed": Hardware(dead_zone_radps=0.025),
    "right wheel -10 %": Hardware(right_gain=0.9),
    "lag twice what is believed": Hardware(motor_lag_s=0.12),
}


@dataclass(frozen=True, slots=True)
class TrackedDrive:
    """Tell how one drive went."""

    rim_mmps: float
    """Root mean square of what the wheels' rims lack, over both and all ticks under way [mm/s]."""
    strayed_mm: float
    """Between the truth and where what was meant would have led, per metre driven [mm]."""
    odometry_mm: float
    """Between the truth and odometry, per metre driven [mm]."""
    reached: bool
    seconds: float


def drive(hardware: Hardware, seed: int, *, control: bool, start: Pose2 = START) -> TrackedDrive:
    """Drive to the living room once."""
    world = LockstepWorld(
        seed=seed, start=start, robot=describe_robot(control=control), hardware=hardware
    )
    base = world.scene.robot.base
    goal = world.say(GOAL)
    world.run_until(lambda w: w.status.mode is Mode.ACTIVE, LIMIT_S)
    began_s, began = world.now_s, world.truth
    odom_began = world.bridge.state.odometry.base_in_odom
    meant_to = IDENTITY
    squares, count, metres = 0.0, 0, 0.0
    while not goal.has_ended and world.now_s - began_s < LIMIT_S:
        world.tick()
        sent = world.bridge.state.motion.limiter.sent
        left, right = rim_speeds(sent, base.wheel_separation_m)
        meant_to = roll(meant_to, left * TICK_S, right * TICK_S, base.wheel_separation_m)
        metres += abs(world.twist.v_mps) * TICK_S
        real = rim_speeds(world.twist, base.wheel_separation_m)
        if world.bridge.state.mode is Mode.ACTIVE:
            squares += (real[0] - left) ** 2 + (real[1] - right) ** 2
            count += 2
    truly = compose(inverse(began), world.truth)
    odom = compose(inverse(odom_began), world.bridge.state.odometry.base_in_odom)
    return TrackedDrive(
        rim_mmps=1e3 * sqrt(squares / max(1, count)),
        strayed_mm=1e3 * hypot(truly.x_m - meant_to.x_m, truly.y_m - meant_to.y_m) / metres,
        odometry_mm=1e3 * hypot(truly.x_m - odom.x_m, truly.y_m - odom.y_m) / metres,
        reached=goal.record.state.value == "succeeded",
        seconds=world.now_s - began_s,
    )


def describe_robot(*, control: bool) -> RobotDescription:
    """Return the default robot, with wheel control or with the dead zone's feed-forward alone."""
    robot = RobotDescription()
    if control:
        return robot
    plain = {"kp": 0.0, "ki_per_s": 0.0, "response_s": 0.0, "max_correction": 0.0}
    return robot.model_copy(update={"drive": robot.drive.model_copy(update=plain)})
