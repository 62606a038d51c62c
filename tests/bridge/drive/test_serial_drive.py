"""A base on a line: commands go out, states come in, and nothing waits for the line."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn, cast

import pytest

from bridge.drive import Drive, SerialDrive, open_serial_drive, require_brakes
from bridge.drive.pons_mcu import PonsMcuProtocol
from devices import LastingPort
from devices.pons_mcu import McuCommand, McuReader
from sim.twin import DriveTwin
from sim.twin.line import TwinLine
from tests.waiting import until
from tests.wire.examples import EXAMPLES
from wire import ConfigError, DriveCommand, DriveState, RobotDescription
from wire.drive_config import DriveConfig
from wire.trial_record import TrialRecord, wiring_of

BODY = cast("DriveState", EXAMPLES[DriveState])


def robot(line: Path) -> RobotDescription:
    return RobotDescription(drive=DriveConfig(kind="pons_mcu", port=str(line), ticks_per_turn=4096))


def command(left: float, right: float, seq: int = 7) -> DriveCommand:
    return DriveCommand(boot="b1", seq=seq, left_radps=left, right_radps=right, enable=True)


@pytest.fixture
def line(tmp_path: Path) -> Path:
    return tmp_path / "drive"


@pytest.fixture
def twin(line: Path) -> Iterator[DriveTwin]:
    made = DriveTwin(robot(line), line)
    yield made
    made.close()


@pytest.fixture
def drive(twin: DriveTwin, line: Path) -> Iterator[SerialDrive]:
    made = open_serial_drive(robot(line), "b1")
    yield made
    made.close()


def test_it_is_metal_that_brakes(drive: SerialDrive) -> None:
    taken: Drive = require_brakes(drive)
    assert (taken.kind, taken.virtual, taken.braking) == ("pons_mcu", False, "brake")


def test_a_command_turns_the_motors_and_comes_back_as_an_echo(
    drive: SerialDrive, twin: DriveTwin
) -> None:
    drive.write(command(1.25, -0.5))
    got = twin.command(1.0)
    assert (got.left_radps, got.right_radps, got.enable) == (1.25, -0.5, True)
    twin.report(BODY, 1.0)
    (state,) = drive.read()
    assert isinstance(state, DriveState)
    assert (state.echo_boot, state.echo_seq, state.enabled) == ("b1", 7, True)
    assert drive.read() == ()


def test_of_a_stalls_readings_the_newest_four_count(drive: SerialDrive, twin: DriveTwin) -> None:
    for tick in range(9):
        twin.report(BODY, 1.0 + 0.01 * tick)
    seqs = [state.seq for state in drive.read() if isinstance(state, DriveState)]
    assert seqs == [6, 7, 8, 9]


def test_none_sends_nothing(drive: SerialDrive, twin: DriveTwin) -> None:
    drive.write(None)
    assert twin.line.read() == b""


def test_halt_sends_zero_without_torque_and_numbers_that_rise(
    drive: SerialDrive, twin: DriveTwin
) -> None:
    drive.write(command(2.0, 2.0, seq=40))
    drive.halt()
    reader, frames = McuReader(), list[McuCommand]()

    def are_all_here() -> bool:
        frames.extend(f for f in reader.read(twin.line.read()) if isinstance(f, McuCommand))
        return len(frames) >= 6

    until(are_all_here)
    assert [frame.seq for frame in frames] == [40, 41, 42, 43, 44, 45]
    assert {(f.left_mradps, f.right_mradps, f.flags) for f in frames[1:]} == {(0, 0, 0)}
    assert twin.command(1.0).enable is False


def test_halt_never_raises(
    drive: SerialDrive, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def broken(_: bytes) -> NoReturn:
        raise OSError("the line is gone")

    monkeypatch.setattr(drive._port, "write", broken)
    drive.halt()
    assert "halt_not_sent: OSError('the line is gone')" in capfd.readouterr().err


def test_a_line_that_hangs_up_is_silence_and_then_goes_on(
    drive: SerialDrive, twin: DriveTwin
) -> None:
    assert isinstance(twin.line, TwinLine)
    twin.line.hang_up()
    assert drive.read() == ()
    drive.write(command(1.0, 1.0))

    def obeys() -> bool:
        drive.write(command(1.0, 1.0, seq=9))
        return twin.command(5.0).left_radps == 1.0

    until(obeys)
    twin.report(BODY, 5.0)
    until(lambda: len(drive.read()) == 1)


def test_nobody_at_the_other_end_reads_and_nothing_waits(drive: SerialDrive) -> None:
    for seq in range(2_000):
        drive.write(command(1.0, 1.0, seq=seq))
    assert isinstance(drive._port, LastingPort)
    assert drive._port._port is not None
    assert drive._port._port.dropped_bytes > 0


def test_a_port_that_waiting_will_not_mend_is_refused_with_its_cure(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ConfigError, match="port_not_serial") as refused:
        open_serial_drive(robot(tmp_path / "file"), "b1", for_trial=True)
    assert refused.value.code == "port_not_serial"
    assert "/dev/serial/by-id" in str(refused.value)


def test_metal_that_nobody_tried_is_not_opened(tmp_path: Path) -> None:
    (tmp_path / "metal").write_text("")
    described = robot(tmp_path / "metal")
    record = TrialRecord(date="2026-11-24", wiring="0" * 16, dead_man_s=0.2, brake_s=0.0)
    for trial, words in ((None, "it holds none"), (record, "one of 2026-11-24, of another")):
        with pytest.raises(ConfigError, match=words) as refused:
            open_serial_drive(described.model_copy(update={"trial": trial}), "b1")
        assert refused.value.code == "robot_untried"
        assert "pons robot try" in str(refused.value)


def test_metal_that_was_tried_is_opened(tmp_path: Path) -> None:
    (tmp_path / "metal").write_text("")
    described = robot(tmp_path / "metal")
    wiring = wiring_of(described)
    record = TrialRecord(date="2026-11-24", wiring=wiring, dead_man_s=0.2, brake_s=0.0)
    with pytest.raises(ConfigError) as refused:
        open_serial_drive(described.model_copy(update={"trial": record}), "b1")
    assert refused.value.code == "port_not_serial"


def test_a_line_may_stand_in_for_the_port_of_robot_toml(twin: DriveTwin, line: Path) -> None:
    drive = open_serial_drive(robot(Path("/dev/ttyNONE")), "b1", line)
    drive.write(command(0.5, 0.5))
    assert twin.command(1.0).left_radps == 0.5
    drive.close()


def test_bytes_of_another_kind_are_no_state(drive: SerialDrive, twin: DriveTwin) -> None:
    twin.line.write(b'{"T":1001,"L":0,"R":0}\r\n' * 20)
    assert drive.read() == ()
    twin.report(BODY, 1.0)
    (state,) = drive.read()
    assert isinstance(state, DriveState)
    assert state.enabled is False


def test_a_base_that_speaks_by_itself_is_asked_nothing(drive: SerialDrive, twin: DriveTwin) -> None:
    for _ in range(4):
        drive.ask()
    assert twin.line.read() == b""


def test_what_can_not_be_read_is_counted_and_said_every_ten_seconds(
    twin: DriveTwin, line: Path, caplog: pytest.LogCaptureFixture
) -> None:
    clock = [100.0]
    port = LastingPort(line, 115_200)
    drive = SerialDrive(PonsMcuProtocol(robot(line).drive, "b1"), port, "b1", lambda: clock[0])
    twin.report(BODY, 1.0)
    assert len(drive.read()) == 1
    for after_s, said in ((0.0, 1), (9.0, 1), (1.0, 2)):
        clock[0] += after_s
        twin.line.write(b"spoilt")
        drive.read()
        assert caplog.text.count("base_spoilt") == said
    assert drive.spoilt == 18
    drive.close()
