"""What is put ahead not nearer than a stop and a scan is not touched; nearer, only gently."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from math import cos, hypot, pi, sin, sqrt
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import pytest

from bridge.core.geometry.kinematics import along_arc
from tools.lockstep import LockstepWorld, TooLong
from tools.lockstep.constant_drive import ConstantDrive
from tools.lockstep.homes import HALL_M, hall
from tools.lockstep.hostile import TrustingOperator
from wire import Mode, Pose2


@pytest.mark.parametrize("seed", [3, 4])
def test_people_and_crates_ahead(seed: int) -> None:
    for one in trials(seed, 4):
        if one["far"]:
            assert one["contact_mps"] is None, one
        else:
            assert not faster_than_allowed(one), one


ROBOT_M, PERSON_M, CRATE_M = 0.30, 0.25, 0.25
SLACK_MPS = 0.05
TICKS_S = 0.02


@dataclass(frozen=True, slots=True)
class WalkTrial:
    """Tell what became of one thing put in the way."""

    far: bool
    thing: str
    by_hand: bool
    v_mps: float
    bend_per_m: float
    gap_m: float
    needed_m: float
    contact_mps: float | None
    allowed_mps: float
    least_m: float
    """Nearest that it came, in clearance."""


def needed_m(world: LockstepWorld, v_mps: float, w_radps: float) -> tuple[float, float, float]:
    """Return the stopping distance plus one scan, what goes before braking [s], deceleration."""
    robot = world.scene.robot
    limits = robot.limits
    rim = abs(v_mps) + abs(w_radps) * robot.base.wheel_separation_m / 2
    decel = limits.max_decel_mps2 * abs(v_mps) / rim
    build_s = limits.max_decel_mps2 / (2 * limits.stop_jerk_mps3)
    before_s = robot.drive.lag_s + build_s + robot.lidar.scan_s + TICKS_S
    return abs(v_mps) * before_s + v_mps * v_mps / (2 * decel), before_s, decel


def clearance_m(thing: str, at: Pose2, x_m: float, y_m: float) -> float:
    """Return the distance from the robot's disc to the thing."""
    dx, dy = x_m - at.x_m, y_m - at.y_m
    if thing.startswith("person"):
        return hypot(dx, dy) - PERSON_M - ROBOT_M
    c, s = cos(at.yaw_rad), sin(at.yaw_rad)
    ahead, aside = abs(c * dx + s * dy) - CRATE_M, abs(c * dy - s * dx) - CRATE_M
    outside = hypot(max(ahead, 0.0), max(aside, 0.0))
    return outside + min(max(ahead, aside), 0.0) - ROBOT_M


def gap_m(thing: str, at: Pose2, here: Pose2, direction: float, flow: float, far_m: float) -> float:
    """Return how far along its arc the robot can go before it touches the thing."""
    gone = 0.0
    while gone < far_m:
        pose = along_arc(here, direction * gone, flow * gone)
        if clearance_m(thing, at, pose.x_m, pose.y_m) <= 0.0:
            return gone
        gone += 0.005
    return far_m


class Trials:
    """Hold one world and do several trials in it."""

    def __init__(self, folder: Path, seed: int) -> None:
        self.random = Random(f"walls {seed}")
        self.world = LockstepWorld(site=hall(folder), seed=seed + 1)
        self.driver, self.person = ConstantDrive(self.world), TrustingOperator(self.world)

    def _run(self, ticks: int) -> None:
        for _ in range(ticks):
            self.world.tick()
            self.driver.turn()
            self.person.turn()

    def _ready(self) -> None:
        """Stand free in the middle, clear of what was before."""
        world = self.world
        for name in ("person_0", "crate_0"):
            world.sim.remove_obstacle(name)
        middle = HALL_M / 2
        self.driver.drive(0.3, 0.0, by_hand=False)
        if hypot(world.truth.x_m - middle, world.truth.y_m - middle) > middle - 3.0:
            world.teleport(Pose2(middle, middle, self.random.uniform(-3.0, 3.0)))
        self._run(60)

    def trial(self, *, far: bool) -> WalkTrial:
        """Come up to speed, put something ahead, look for three seconds.

        Raises:
            TooLong: the robot did not come up to speed.
        """
        world, r = self.world, self.random
        self._ready()
        speed = r.uniform(0.12, 0.5) * (1 if r.random() < 0.8 else -1)
        bend = r.choice((0.0, r.uniform(-1.4, 1.4)))
        by_hand = r.random() < 0.4
        self.driver.drive(speed, bend, by_hand=by_hand)
        moves = Mode.TELEOP if by_hand else Mode.ACTIVE
        for _ in range(1_500):
            self._run(1)
            v = world.twist.v_mps
            if world.bridge.state.mode is moves and v * speed > 0 and abs(v) > 0.85 * abs(speed):
                break
        else:
            raise TooLong(f"no speed {speed:.2f}; {world.describe()}")
        self._run(r.randrange(10, 40))
        thing, at, told = self._put(far=far)
        world.sim.place_obstacle(at.x_m, at.y_m, at.yaw_rad, thing)
        contacts, hit, least, before = world.contacts, None, 9.0, abs(world.twist.v_mps)
        for _ in range(300):
            self._run(1)
            least = min(least, clearance_m(thing, at, world.truth.x_m, world.truth.y_m))
            if hit is None and world.contacts > contacts:
                hit = before
            before = abs(world.twist.v_mps)
        v_mps, flow, gap, needed, allowed = told
        return WalkTrial(far, thing, by_hand, v_mps, flow, gap, needed, hit, allowed, least)

    def _put(self, *, far: bool) -> tuple[str, Pose2, tuple[float, float, float, float, float]]:
        """Find a place whose gap on the robot's true arc is at least what is needed, or less."""
        world, r = self.world, self.random
        here, twist = world.truth, world.twist
        v, w = twist.v_mps, twist.w_radps
        direction, flow = (1.0 if v > 0 else -1.0), w / abs(v)
        needed, before_s, decel = needed_m(world, v, w)
        wanted = needed * (r.uniform(1.0, 1.3) if far else r.uniform(0.1, 0.95))
        thing = r.choice(("person_0", "crate_0"))
        side, yaw = r.uniform(-1.3, 1.3), r.uniform(-pi, pi)
        reach = ROBOT_M + (PERSON_M if thing == "person_0" else CRATE_M)
        length, at, gap = wanted, here, 0.0
        for _ in range(200):
            pose = along_arc(here, direction * length, flow * length)
            heading = pose.yaw_rad + (0.0 if v > 0 else pi) + side
            at = Pose2(pose.x_m + reach * cos(heading), pose.y_m + reach * sin(heading), yaw)
            gap = gap_m(thing, at, here, direction, flow, needed + 1.0)
            if gap >= wanted:
                break
            length += 0.01
        rest = v * v - 2 * decel * max(0.0, gap - abs(v) * before_s)
        return thing, at, (v, flow, gap, needed, sqrt(max(0.0, rest)))


def trials(seed: int, each: int) -> list[dict[str, object]]:
    """Do several trials in one world, far and near in turn."""
    with TemporaryDirectory(prefix="pb-") as folder:
        world = Trials(Path(folder), seed)
        return [asdict(world.trial(far=index % 2 == 0)) for index in range(each)]


def faster_than_allowed(one: dict[str, object]) -> bool:
    """Tell whether a contact was faster than braking allows."""
    hit, allowed = one["contact_mps"], one["allowed_mps"]
    return isinstance(hit, float) and isinstance(allowed, float) and hit > allowed + SLACK_MPS
