"""A twin sits at the end of a line as a base does: what it hears there moves the body."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest

from devices import SerialPort, pons_mcu
from devices.pons_mcu import McuCommand, encode_command
from sim.twin import DriveTwin
from tests.wire.examples import EXAMPLES
from wire import ConfigError, DriveState, RobotDescription
from wire.drive_config import DriveConfig

CONFIG = RobotDescription(drive=DriveConfig(kind="pons_mcu", port="/dev/x", ticks_per_turn=400))
BODY = cast("DriveState", EXAMPLES[DriveState])
GO = McuCommand(7, 0xB1, 1500, -1500, 400, 200, pons_mcu.ENABLE)


@pytest.fixture
def twin(tmp_path: Path) -> Iterator[DriveTwin]:
    made = DriveTwin(CONFIG, tmp_path / "twins" / "drive")
    yield made
    made.close()


@pytest.fixture
def port(twin: DriveTwin, tmp_path: Path) -> Iterator[SerialPort]:
    with SerialPort(tmp_path / "twins" / "drive", 115_200) as opened:
        yield opened


def test_the_bodys_commands_rise_and_stand_still_without_a_host(twin: DriveTwin) -> None:
    first, second = twin.command(0.0), twin.command(0.01)
    assert second.seq == first.seq + 1
    assert (second.left_radps, second.right_radps, second.enable) == (0.0, 0.0, False)


def test_a_host_that_dies_is_braked_by_the_firmware(twin: DriveTwin, port: SerialPort) -> None:
    port.write(encode_command(GO))
    assert twin.command(1.0).left_radps == 1.5
    assert twin.command(1.2).enable
    assert not twin.command(1.201).enable


def test_what_no_body_can_do_is_bounded(twin: DriveTwin, port: SerialPort) -> None:
    port.write(encode_command(replace(GO, left_mradps=2**31 - 1, right_mradps=-(2**31))))
    got = twin.command(1.0)
    assert (got.left_radps, got.right_radps) == (1000.0, -1000.0)


def test_what_came_in_a_freeze_is_thrown_away(twin: DriveTwin, port: SerialPort) -> None:
    for seq in range(20):
        port.write(encode_command(replace(GO, seq=seq)))
    twin.discard()
    assert not twin.command(1.0).enable


def test_a_reset_forgets_the_command(twin: DriveTwin, port: SerialPort) -> None:
    port.write(encode_command(GO))
    assert twin.command(1.0).enable
    twin.reset()
    assert not twin.command(1.01).enable


def test_a_full_line_loses_and_blocks_nobody(twin: DriveTwin, port: SerialPort) -> None:
    for tick in range(2_000):
        twin.report(BODY, 0.01 * tick)
    assert port.read()


def test_the_link_goes_with_the_twin(tmp_path: Path) -> None:
    DriveTwin(CONFIG, tmp_path / "drive").close()
    assert not os.path.lexists(tmp_path / "drive")


def test_a_drive_without_a_twin_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"^twin_unknown: .*'sim'.*these have: .*pons_mcu"):
        DriveTwin(RobotDescription(), tmp_path / "drive")


def test_a_line_that_can_not_be_made_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ConfigError, match="twin_line"):
        DriveTwin(CONFIG, tmp_path / "file" / "drive")
