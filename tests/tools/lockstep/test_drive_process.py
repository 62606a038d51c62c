"""A base on a serial line drives in lockstep: by its model, and by our firmware's own bytes."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.plan import GoalState
from sim.twin.avr_board import AvrBoard, AvrFirmware
from tests.conftest import ROOT
from tests.firmware.conftest import board_build
from tests.known import known
from tools.lockstep import LockstepWorld
from tools.lockstep.serial_line import LineFault
from wire import load_robot
from wire.robot import LocalizationConfig, RobotDescription

pytestmark = pytest.mark.nightly(keep=3)


__all__ = ["board_build"]


def described() -> RobotDescription:
    """Return the preset, told where it is: this is about the drive."""
    robot = load_robot(ROOT / "robots" / "pons_mcu.toml")
    return robot.model_copy(update={"localization": LocalizationConfig(kind="stand_in")})


def drive_to_the_other_room(world: LockstepWorld) -> None:
    goal = world.say("go to the living room")
    world.run_until(lambda w: goal.has_ended, 90.0)
    assert goal.state is GoalState.SUCCEEDED, world.describe()
    assert world.room == "living_room"
    assert world.contacts == 0


def test_a_base_on_a_line_drives_to_the_other_room() -> None:
    drive_to_the_other_room(LockstepWorld(robot=described()))


def test_our_firmwares_own_bytes_drive_to_the_other_room(board_build: Path) -> None:
    with AvrBoard(board_build) as board:
        world = LockstepWorld(
            robot=described(), firmware=lambda robot: AvrFirmware(robot.drive, board)
        )
        drive_to_the_other_room(world)


@pytest.mark.parametrize("fault", list(LineFault))
def test_a_line_that_fails_in_mid_drive_stops_the_robot_or_is_survived(fault: LineFault) -> None:
    world = LockstepWorld(robot=described())
    world.say("go to the living room")
    world.run_until(lambda w: not w.standing, 30.0)
    known(world.base).line.break_down(fault)
    world.run(3.0)
    if fault in (LineFault.SILENT, LineFault.HUNG_UP, LineFault.WRONG_BAUD):
        assert world.standing, world.describe()
        assert world.status.rows
    assert world.contacts == 0
