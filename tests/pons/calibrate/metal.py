"""Hold a lockstep world and a rig on it for tests of calibration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from math import pi
from typing import cast

from pons.calibrate.findings import CalibrationFinding
from pons.calibrate.procedure import CalibrationPlan, calibrate
from pons.calibrate.session import CalibrationRig
from sim import Hardware
from tests.pons.calibrate.tape import Tape
from tools.lockstep import LockstepWorld
from tools.lockstep.world_fork import fork_world
from wire import Pose2, RobotDescription
from wire.keys import Party
from wire.session import Session

TRUE = Hardware(wheel_radius_m=0.1, wheel_separation_m=0.5)
FACING = Pose2(0.9, 0.8, pi / 4)
"""At the dock, towards where there is most room: nothing to turn before the first run."""


def believed(**drive: float) -> RobotDescription:
    """Describe the robot wrongly: radius 5 % and separation 4 % off, no dead zone, half the lag."""
    robot = RobotDescription()
    base = {"wheel_radius_m": 0.105, "wheel_separation_m": 0.48}
    wrong = {"dead_zone_radps": 0.0, "lag_s": 0.03, **drive}
    return robot.model_copy(
        update={
            "base": robot.base.model_copy(update=base),
            "drive": robot.drive.model_copy(update=wrong),
        }
    )


@cache
def _ready(robot: RobotDescription, hardware: Hardware, start: Pose2 | None) -> LockstepWorld:
    return LockstepWorld(robot=robot, hardware=hardware, start=start)


@dataclass
class Bench:
    """Join a world, a rig and what was said."""

    robot: RobotDescription = field(default_factory=believed)
    hardware: Hardware = TRUE
    start: Pose2 | None = None
    said: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.world = fork_world(_ready(self.robot, self.hardware, self.start))
        operator = cast("Session", self.world.bus.port(Party.OPERATOR))
        judge = cast("Session", self.world.bus.port(Party.JUDGE))
        self.tape = Tape()
        self.rig = self.tape.rig(operator, judge, lambda: self.world.now_s, self.world.tick)

    def calibrate(self, plan: CalibrationPlan | None = None) -> dict[str, CalibrationFinding]:
        """Go through it, as briefly as may be."""
        wanted = plan or CalibrationPlan(None, shuttles=1, turns=1)
        return gone_through(self.rig, self.robot, wanted, self.said.append)


def gone_through(
    rig: CalibrationRig,
    robot: RobotDescription,
    plan: CalibrationPlan,
    say: Callable[[str], None],
    ask_m: Callable[[], float] = lambda: 0.0,
) -> dict[str, CalibrationFinding]:
    """Calibrate and return what was found by its name."""
    found = calibrate(rig, robot, plan, "now", say, ask_m)
    return {one.name: one for one in found}
