"""A robot that brakes worse than robot.toml says stops short of a wall, more so once it knows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import pi

import pytest

from sim import Hardware
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import LockstepWorld
from tools.lockstep.world_fork import fork_world
from wire import Mode, Pose2, Velocity, keys
from wire.keys import Party

pytestmark = pytest.mark.nightly(keep=3)


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
