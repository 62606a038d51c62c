"""The simulated drive sends what it is given, past the dead zone, and halts come what may."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn

import pytest

from bridge.drive import Drive, SimDrive
from tests.waiting import until
from tests.wire.examples import EXAMPLES
from wire import ConfigError, DriveCommand, DriveState
from wire.keys import DRIVE_COMMAND, DRIVE_STATE, Party
from wire.session import Session, Subscriber, open_session

STATE = EXAMPLES[DriveState]


def command(left: float, right: float, seq: int = 7) -> DriveCommand:
    return DriveCommand(boot="b1", seq=seq, left_radps=left, right_radps=right, enable=True)


@pytest.fixture
def bridge(tmp_path: Path) -> Iterator[Session]:
    with open_session(Party.BRIDGE, "r1", tmp_path) as session:
        yield session


@pytest.fixture
def robot(bridge: Session, tmp_path: Path) -> Iterator[Session]:
    with open_session(Party.ROBOT, "r1", tmp_path) as session:
        until(lambda: bridge.peers() == 1)
        yield session


def drive_of(session: Session) -> SimDrive:
    return SimDrive(session, "b1")


def next_command(drive: Drive, ears: Subscriber[DriveCommand], sent: DriveCommand) -> DriveCommand:
    got: list[DriveCommand] = []

    def heard() -> bool:
        drive.write(sent)
        items = [item for item in ears.drain().items if isinstance(item, DriveCommand)]
        got.extend(item for item in items if item.seq == sent.seq)
        return bool(got)

    until(heard)
    return got[-1]


def test_it_is_virtual_and_brakes(bridge: Session) -> None:
    drive: Drive = drive_of(bridge)
    assert (drive.kind, drive.virtual, drive.braking) == ("sim", True, "brake")


def test_a_command_arrives_as_it_was_given(bridge: Session, robot: Session) -> None:
    drive, ears = drive_of(bridge), robot.subscriber(DRIVE_COMMAND)
    assert next_command(drive, ears, command(1.25, -0.5)) == command(1.25, -0.5)


def test_readings_come_in_order(bridge: Session, robot: Session) -> None:
    drive, mouth = drive_of(bridge), robot.publisher(DRIVE_STATE)
    got: list[object] = []

    def heard() -> bool:
        for seq in range(3):
            mouth.put(STATE.model_copy(update={"seq": seq}))  # type: ignore[arg-type]  # its own kind
        got.extend(drive.read())
        return len(got) >= 6

    until(heard)
    assert {type(item) for item in got} == {DriveState}
    assert drive.read() == () or until(lambda: drive.read() == ())


def test_none_sends_nothing_and_halt_sends_zero_without_torque(
    bridge: Session, robot: Session
) -> None:
    drive, ears = drive_of(bridge), robot.subscriber(DRIVE_COMMAND)
    last = next_command(drive, ears, command(2.0, 2.0, seq=40))
    until(lambda: not ears.drain().arrived)
    drive.write(None)
    drive.halt()
    got: list[DriveCommand] = []

    def heard() -> bool:
        got.extend(item for item in ears.drain().items if isinstance(item, DriveCommand))
        return bool(got)

    until(heard)
    assert all((c.left_radps, c.right_radps, c.enable) == (0.0, 0.0, False) for c in got)
    assert got[0].seq > last.seq
    assert got[0].boot == "b1"


def test_halt_with_nobody_there_is_no_error(bridge: Session) -> None:
    drive_of(bridge).halt()


def test_halt_never_raises(
    bridge: Session, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    drive = drive_of(bridge)

    def broken(_: DriveCommand) -> NoReturn:
        raise OSError("the wire is gone")

    monkeypatch.setattr(drive._commands, "put", broken)
    drive.halt()
    assert "halt_not_sent: OSError('the wire is gone')" in capfd.readouterr().err


def test_an_unknown_kind_of_drive_is_refused_by_the_description(tmp_path: Path) -> None:
    from wire import load_robot

    path = tmp_path / "robot.toml"
    path.write_text('[drive]\nkind = "warp"\n')
    with pytest.raises(ConfigError, match=r"drive\.kind: got 'warp'"):
        load_robot(path)
