"""A port that went is opened anew, and whoever reads and writes meanwhile never waits."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from devices import LastingPort, PortTrouble, SerialPort
from sim.twin.line import TwinLine
from tests.waiting import until


@pytest.fixture
def line(tmp_path: Path) -> Iterator[TwinLine]:
    made = TwinLine(tmp_path / "line")
    yield made
    made.close()


def test_bytes_go_both_ways(line: TwinLine, tmp_path: Path) -> None:
    port = LastingPort(tmp_path / "line", 115_200)
    try:
        assert port.opened == 1
        assert port.write(b"\x00\xff\r\n")
        assert line.read() == b"\x00\xff\r\n"
        line.write(b"\x03\x04")
        assert port.read() == b"\x03\x04"
    finally:
        port.close()


def test_a_port_that_was_pulled_comes_back(line: TwinLine, tmp_path: Path) -> None:
    port = LastingPort(tmp_path / "line", 115_200)
    try:
        line.hang_up()
        assert port.read() == b""
        until(lambda: port.opened == 2)
        until(lambda: port.write(b"x"))
        assert line.read() == b"x"
    finally:
        port.close()


def test_a_write_notices_the_pulled_plug_too(line: TwinLine, tmp_path: Path) -> None:
    port = LastingPort(tmp_path / "line", 115_200)
    try:
        line.hang_up()
        assert not port.write(b"x")
        until(lambda: port.opened == 2)
    finally:
        port.close()


def test_a_port_that_is_not_there_yet_is_waited_for(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    port = LastingPort(tmp_path / "line", 115_200)
    try:
        assert port.read() == b""
        assert not port.write(b"x")
        assert "port_missing" in caplog.text
        assert "/dev/serial/by-id" in caplog.text
        line = TwinLine(tmp_path / "line")
        until(lambda: port.opened == 1)
        until(lambda: "port_back" in caplog.text)
        line.close()
    finally:
        port.close()


def test_what_waiting_does_not_mend_is_refused_at_once(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(PortTrouble, match="port_not_serial"):
        LastingPort(tmp_path / "file", 115_200)


def test_closing_ends_its_thread_while_the_port_is_away(tmp_path: Path) -> None:
    port = LastingPort(tmp_path / "never", 115_200)
    port.close()
    assert not port._thread.is_alive()


def test_the_user_of_a_line_may_leave_and_come_again(line: TwinLine, tmp_path: Path) -> None:
    for number in range(3):
        port = LastingPort(tmp_path / "line", 115_200)
        assert port.write(b"%d" % number)
        assert line.read() == b"%d" % number
        port.close()
        assert line.read() == b""  # notices, and makes the line anew
    assert os.readlink(tmp_path / "line").startswith("/dev/pts/")  # noqa: PTH115


def test_a_port_that_another_program_holds_is_waited_for_and_named(
    line: TwinLine, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    other = SerialPort(tmp_path / "line", 115_200)
    port = LastingPort(tmp_path / "line", 115_200)
    try:
        assert port.trouble is not None
        assert port.trouble.code == "port_busy"
        assert not port.write(b"x")
        assert line.read() == b""
        assert "port_busy" in caplog.text
        other.close()
        line.hang_up()
        until(lambda: port.opened == 1)
        assert port.trouble is None
    finally:
        other.close()
        port.close()


def test_a_port_that_returns_under_another_name_is_found_by_the_name_that_lasts(
    tmp_path: Path,
) -> None:
    """ttyUSB0 went and came back as ttyUSB1; the link below /dev/serial/by-id leads there."""
    first, second = TwinLine(tmp_path / "ttyUSB0"), None
    by_id = tmp_path / "by-id"
    by_id.symlink_to(first_path := (tmp_path / "ttyUSB0").resolve())
    guarded: list[Path] = []
    port = LastingPort(by_id, 115_200, guard=lambda path: guarded.append(path.resolve()))
    raw = LastingPort(tmp_path / "ttyUSB0.gone", 115_200)
    try:
        first.close()
        by_id.unlink()
        assert port.read() == b""
        assert not port.write(b"lost")
        until(lambda: port.trouble is not None and port.trouble.code == "port_missing")
        second = TwinLine(tmp_path / "ttyUSB1")
        by_id.symlink_to((tmp_path / "ttyUSB1").resolve())
        until(lambda: port.opened == 2)
        until(lambda: port.write(b"x"))
        assert second.read() == b"x", "nothing of before: it may be another device"
        assert guarded[0] == first_path
        assert guarded[-1] == (tmp_path / "ttyUSB1").resolve(), "judged anew before it is opened"
        assert raw.trouble is not None
        assert "/dev/serial/by-id" in str(raw.trouble), "a name that does not last: the cure"
    finally:
        port.close()
        raw.close()
        if second is not None:
            second.close()
