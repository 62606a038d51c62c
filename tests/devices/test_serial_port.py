"""A port never blocks, has one owner, and says by a code why it can't be used."""

from __future__ import annotations

import fcntl
import os
import pty
import struct
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from devices import PORT_CURES, PortTrouble, SerialPort
from devices.serial_port import MOST_NAMED


@pytest.fixture
def line() -> Iterator[tuple[int, Path]]:
    """Return the far end of a line and the path of the near one."""
    far, near = pty.openpty()
    path = Path(os.ttyname(near))
    os.close(near)
    os.set_blocking(far, False)
    yield far, path
    os.close(far)


def test_bytes_go_both_ways_untouched(line: tuple[int, Path]) -> None:
    far, path = line
    every = bytes(range(256))
    with SerialPort(path, 230_400) as port:
        assert port.read() == b""
        assert port.write(every)
        assert os.read(far, 4096) == every
        os.write(far, every)
        assert port.read() == every


def test_a_full_line_blocks_nobody_and_what_it_did_not_take_is_counted(
    line: tuple[int, Path],
) -> None:
    _, path = line
    with SerialPort(path, 115_200) as port:
        taken = sum(port.write(b"x" * 1000) for _ in range(200))
        assert taken < 200
        assert port.dropped_bytes > 0


def test_a_port_that_hangs_up_is_gone(line: tuple[int, Path]) -> None:
    far, path = line
    with SerialPort(path, 115_200) as port:
        os.dup2(os.open(os.devnull, os.O_RDONLY), far)
        with pytest.raises(PortTrouble, match="port_gone"):
            port.read()
        with pytest.raises(PortTrouble, match="port_gone"):
            port.write(b"hello")


def test_a_port_has_one_owner(line: tuple[int, Path]) -> None:
    _, path = line
    words = (
        "import sys; from pathlib import Path; from devices import SerialPort, PortTrouble\n"
        "import os; os.setuid(65534)\n"
        "try: SerialPort(Path(sys.argv[1]), 115200); print('mine')\n"
        "except PortTrouble as trouble: print(trouble.code)"
    )
    if os.getuid() != 0:
        words = words.replace("os.setuid(65534)", "")
    else:
        path.chmod(0o666)  # root is let in by the kernel whoever owns the port
    with SerialPort(path, 115_200):
        run = subprocess.run(
            [sys.executable, "-c", words, str(path)], capture_output=True, text=True, check=True
        )
    assert run.stdout.strip() == "port_busy"


def test_a_port_without_right_is_refused_with_the_group_as_its_cure(
    line: tuple[int, Path],
) -> None:
    """By a user who is not in the port's group; root may open everything."""
    _, path = line
    path.chmod(0o660)
    words = (
        "import os, sys; from pathlib import Path; from devices import LastingPort, PortTrouble\n"
        "os.getuid() or (os.setgroups([]), os.setgid(65534), os.setuid(65534))\n"
        "try: LastingPort(Path(sys.argv[1]), 115200); print('mine')\n"
        "except PortTrouble as trouble: print(trouble)"
    )
    if os.getuid() != 0:
        path.chmod(0)  # its owner needs a right, too
    run = subprocess.run(
        [sys.executable, "-c", words, str(path)], capture_output=True, text=True, check=True
    )
    assert run.stdout.startswith("port_forbidden: ")
    assert "group that owns it (often dialout)" in run.stdout


@pytest.mark.parametrize(
    ("name", "code"),
    [("nowhere", "port_missing"), ("a_file", "port_not_serial"), ("/dev/null", "port_not_serial")],
)
def test_what_is_no_port_is_refused_by_name(tmp_path: Path, name: str, code: str) -> None:
    (tmp_path / "a_file").write_text("")
    with pytest.raises(PortTrouble, match=code) as refused:
        SerialPort(tmp_path / name, 115_200)
    assert refused.value.code == code


def test_a_missing_port_names_what_is_plugged_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What came back by another name is among them."""
    monkeypatch.setattr("devices.serial_port._BY_ID", tmp_path / "by-id")
    with pytest.raises(PortTrouble, match=r"there is nothing below .*by-id; plug it in"):
        SerialPort(tmp_path / "ttyUSB0", 115_200)
    (tmp_path / "by-id").mkdir()
    for number in range(MOST_NAMED + 1):
        (tmp_path / "by-id" / f"usb-{number}").touch()
    with pytest.raises(PortTrouble, match=r"there is .*/usb-0, .*/usb-5, …; plug it in"):
        SerialPort(tmp_path / "ttyUSB0", 115_200)


def test_every_trouble_has_its_cure_in_both_languages() -> None:
    for code, (english, chinese) in PORT_CURES.items():
        assert english.isascii(), code
        assert any(ord(letter) > 0x2E80 for letter in chinese), code


def test_a_speed_without_a_name_is_set(line: tuple[int, Path]) -> None:
    """A YDLidar X4 talks at 128 000 baud, which termios does not know."""
    far, path = line
    with SerialPort(path, 128_000) as port:
        kernels = bytearray(44)
        fcntl.ioctl(port.fileno(), 0x802C542A, kernels)  # TCGETS2
        assert struct.unpack_from("<II", kernels, 36) == (128_000, 128_000)
        assert port.write(b"x")
        assert os.read(far, 1) == b"x"
