"""A board that runs our firmware stands where a twin's model stands, and says what it lacks."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim.twin.avr_board import AvrBoard, boot_build
from tests.firmware.conftest import board_build
from wire import ConfigError, RobotDescription
from wire.drive_config import DriveConfig

__all__ = ["board_build"]
ROBOT = RobotDescription(drive=DriveConfig(kind="pons_mcu", port="/dev/x", ticks_per_turn=400))


def test_what_was_not_built_is_refused_with_its_cure(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="make -C firmware board") as refused:
        boot_build(ROBOT, tmp_path)
    assert refused.value.code == "twin_not_built"


def test_a_drive_that_is_not_ours_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="expected pons_mcu") as refused:
        boot_build(RobotDescription(), tmp_path)
    assert refused.value.code == "twin_unknown"


def test_a_file_that_is_no_firmware_ends_the_board(board_build: Path, tmp_path: Path) -> None:
    (tmp_path / "board").symlink_to(board_build / "board")
    (tmp_path / "pons_mcu.elf").write_text("no firmware")
    board = AvrBoard(tmp_path)
    with pytest.raises(OSError, match=r"Broken pipe|ended with 2"):
        board.run(0.01)
    board.close()


def test_a_board_stands_still_while_no_time_passes(board_build: Path) -> None:
    with AvrBoard(board_build) as board:
        assert board.run(0.0)[1] == b""
