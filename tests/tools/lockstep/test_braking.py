"""A robot that brakes worse than robot.toml says stops short of a wall, more so once it knows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import hypot, pi, sqrt

import pytest

from bridge.core.geometry.kinematics import rim_speeds, roll
from sim import Hardware
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.world_fork import fork_world
from wire import IDENTITY, Mode, Pose2, RobotDescription, Velocity, compose, inverse, keys
from wire.keys import Party

pytestmark = pytest.mark.nightly(keep=5)


WALL_M = 0.05 + 0.30
"""Where the robot's centre is when it touches the kitchen's wall at y = 0."""
FROM = Pose2(1.5, 2.3, -pi / 2)
NEARER = Pose2(1.5, 1.7, -pi / 2)
"""Far enough for half a metre per second."""
MARGIN_M = 0.05
LATE = Hardware(motor_lag_s=0.25)
WEAK = Hardware(motor_torque_nm=0.86)
"""Half of the deceleration that robot.toml states; the brake is the motor."""
WEAKER = Hardware(motor_torque_nm=0.68)


@dataclass
class Driver:
    """Steer a lockstep world by hand."""

    world: LockstepWorld
    seq: int = 0
    epoch: str = ""
    mouth: object = field(init=False)

    def __post_init__(self) -> None:
        self.mouth = self.world.bus.port(Party.OPERATOR).publisher(keys.TELEOP)

    def hold(self, seconds: float, v_mps: float, *, dead_man: bool = True) -> None:
        for tick in range(round(seconds * 100)):
            if tick % 5 == 0:
                self._say(v_mps, dead_man=dead_man)
            self.world.tick()

    def take_over(self) -> None:
        if self.world.status.held is not None:
            self.world.operate("resume")
        self.hold(0.3, 0.0, dead_man=False)
        self.hold(0.3, 0.0)

    def _say(self, v_mps: float, *, dead_man: bool) -> None:
        status = self.world.status
        self.seq = self.seq + 1 if status.epoch == self.epoch else 1
        self.epoch = status.epoch
        self.mouth.put(  # type: ignore[attr-defined]  # a publisher of velocities
            Velocity(source_id="hand", epoch=status.epoch, seq=self.seq, seen=status.seq,
                     v_mps=v_mps, w_radps=0.0, dead_man=dead_man)
        )  # fmt: skip


def at_the_wall(world: LockstepWorld) -> float:
    """Drive at the wall by hand as fast as may be; return what is left before it [m]."""
    put_down(world, NEARER)
    driver = Driver(world)
    driver.take_over()
    driver.hold(1.5, 0.5)
    while not world.standing:
        driver.hold(0.2, 0.5)
    left_m = world.truth.y_m - WALL_M
    driver.hold(0.6, 0.0, dead_man=False)
    return left_m


def put_down(world: LockstepWorld, where: Pose2) -> None:
    world.teleport(where)
    world.run(0.3)


def stopped_once(world: LockstepWorld) -> None:
    put_down(world, FROM)
    driver = Driver(world)
    driver.take_over()
    driver.hold(1.6, 0.5)
    driver.hold(1.3, 0.0, dead_man=False)


@pytest.fixture(scope="module")
def first_wall(ready: Ready) -> Callable[[Hardware], tuple[LockstepWorld, float]]:
    """Return a maker of worlds that have stopped at the wall once, and what was left there [m]."""
    made: dict[Hardware, tuple[LockstepWorld, float]] = {}

    def copy(hardware: Hardware) -> tuple[LockstepWorld, float]:
        if hardware not in made:
            world = ready(seed=1, hardware=hardware, start=FROM)
            made[hardware] = world, at_the_wall(world)
        world, left_m = made[hardware]
        return fork_world(world), left_m

    return copy


@pytest.mark.parametrize("hardware", [LATE, WEAK, WEAKER], ids=["late", "half", "weaker"])
def test_the_first_wall_is_not_touched_and_later_ones_keep_the_margin(
    first_wall: Callable[[Hardware], tuple[LockstepWorld, float]], hardware: Hardware
) -> None:
    world, first_m = first_wall(hardware)
    assert world.contacts == 0, "what the first stop lacks is covered by the margin"
    assert first_m > 0.0
    second_m = at_the_wall(world)
    assert world.contacts == 0
    assert second_m >= MARGIN_M
    assert second_m >= first_m - 0.01
    assert world.status.braking.learnt


def test_a_late_and_a_weak_robot_are_told_apart(ready: Ready) -> None:
    late = ready(seed=1, hardware=LATE, start=FROM)
    stopped_once(late)
    assert late.status.braking.lag_s > 0.1
    assert late.status.braking.decel_mps2 == 1.0
    weak = ready(seed=1, hardware=WEAK, start=FROM)
    stopped_once(weak)
    assert weak.status.braking.decel_mps2 == pytest.approx(0.56, abs=0.1)


def test_brakes_under_half_are_capped_so_that_stopping_is_no_fault(
    first_wall: Callable[[Hardware], tuple[LockstepWorld, float]],
) -> None:
    # An ordinary ramp teaches it; a stop at 0.5 m/s would be found too slow.
    world, _ = first_wall(WEAKER)
    assert world.status.braking.decel_mps2 < 0.5
    stopped_once(world)
    assert world.status.mode is Mode.HOLD
    assert world.status.limits.by in {"weak_brakes", "obstacle"}


def test_a_robot_as_robot_toml_says_learns_nothing(ready: Ready) -> None:
    world = ready(seed=1, start=FROM)
    stopped_once(world)
    assert not world.status.braking.learnt
    assert world.status.braking.stops == 1


LIMIT_MMPS, LIMIT_MM = 10.0, 8.0
"""Seen: 5 to 7 mm/s, and 2 to 5 mm per metre of path; without control 20 to 63, and 14 to 440."""
LIMIT_S = 60.0
NEAR = Pose2(1.4, 2.5, 1.0)
"""On the way to the living room, with a turn at its beginning."""
WEAK_RIGHT = Hardware(right_gain=0.9)


def drive_to_the_living_room(hardware: Hardware, robot: RobotDescription) -> tuple[float, float]:
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
    rim_mmps, strayed_mm = drive_to_the_living_room(hardware, RobotDescription())
    assert rim_mmps < LIMIT_MMPS
    assert strayed_mm < LIMIT_MM


def test_without_control_they_do_not() -> None:
    robot = RobotDescription()
    plain = {"kp": 0.0, "ki_per_s": 0.0, "response_s": 0.0, "max_correction": 0.0}
    drives = robot.drive.model_copy(update=plain)
    rim_mmps, strayed_mm = drive_to_the_living_room(
        WEAK_RIGHT, robot.model_copy(update={"drive": drives})
    )
    assert rim_mmps > LIMIT_MMPS
    assert strayed_mm > LIMIT_MM
