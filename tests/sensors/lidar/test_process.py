"""The lidar's process reads a line, says what is wrong with it, and refuses wrong files."""

from __future__ import annotations

import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from sensors.lidar.__main__ import main
from sim.twin import LidarTwin
from wire import LidarStatus, Scan, keys
from wire.keys import Party
from wire.lidar_config import LidarConfig
from wire.session import open_session

LIMIT_S = 20.0
SENSOR = "lidar"


def room(directions_rad: NDArray[np.float64]) -> tuple[float | None, ...]:
    return tuple((2.0 + np.cos(directions_rad)).tolist())


class Playing(threading.Thread):
    """Tick a twin in real time, until it is unplugged or the test ends."""

    def __init__(self, config: LidarConfig, link: Path) -> None:
        super().__init__(daemon=True)
        self.twin = LidarTwin(config, link)
        self.pulled = False
        self._ending = threading.Event()

    def run(self) -> None:
        while not self._ending.wait(0.01):
            if self.pulled:
                self.twin.line.hang_up()
                self.pulled = False
            self.twin.tick(time.monotonic(), room)
        self.twin.close()

    def end(self) -> None:
        self._ending.set()
        self.join()


class Ears:
    """Hear one lidar as a judge does."""

    def __init__(self, home: Path) -> None:
        self.session = open_session(Party.JUDGE, "r1", home)
        self._scan = self.session.subscriber(keys.SCAN)
        self._state = self.session.subscriber(keys.LIDAR_STATE)
        self.scans = 0
        self.scan: Scan | None = None
        self.state: LidarStatus | None = None

    def until(self, done: Callable[[], bool]) -> None:
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, f"nothing came of it; {self.scans} scans, {self.state}"
            time.sleep(0.02)
            scan = self._scan.newest()
            if scan is not None:
                self.scan, self.scans = scan, self.scans + 1
            self.state = self._state.newest() or self.state

    def code(self) -> str | None:
        return self.state.code if self.state else "nothing"


@pytest.fixture
def ears(tmp_path: Path) -> Iterator[Ears]:
    found = Ears(tmp_path)
    yield found
    found.session.close()


@pytest.mark.e2e
def test_it_reads_a_line_that_comes_and_goes(
    tmp_path: Path, ears: Ears, started: Callable[[str], subprocess.Popen[str]]
) -> None:
    line = tmp_path / "line"
    text = f'kind = "rplidar"\nmodel = "a1"\nport = "{line}"\nscan_s = 0.18'
    process = started(text)
    ears.until(lambda: ears.code() == "port_missing")
    playing = Playing(LidarConfig(kind="rplidar", model="a1", port="/dev/x", scan_s=0.18), line)
    playing.start()
    try:
        ears.until(lambda: ears.code() is None)
        ears.until(lambda: ears.scans >= 20)
        assert ears.scan is not None
        assert ears.scan.clockwise
        assert 0.0 <= time.monotonic() - ears.scan.stamp_s < 0.5
        playing.pulled = True
        ears.until(lambda: ears.state is not None and ears.state.opened == 2)
        before = ears.scans
        ears.until(lambda: ears.scans > before + 20 and ears.code() is None)
    finally:
        playing.end()
    ears.until(lambda: ears.code() == "port_missing" or ears.code() == "port_gone")
    process.send_signal(signal.SIGTERM)
    assert process.wait(LIMIT_S) == 0


@pytest.mark.nightly
@pytest.mark.e2e
def test_a_wrong_baud_is_told_and_mends(
    tmp_path: Path, ears: Ears, started: Callable[[str], subprocess.Popen[str]]
) -> None:
    line = tmp_path / "line"
    playing = Playing(LidarConfig(kind="ld19", port="/dev/x"), line)
    playing.start()
    try:
        process = started(f'kind = "ld19"\nport = "{line}"\nbaud = 115200')
        ears.until(lambda: ears.code() == "lidar_unreadable")
        assert ears.scans == 0
        assert ears.state is not None
        assert str(line) in ears.state.detail
        process.kill()
        process.wait(LIMIT_S)
        started(f'kind = "ld19"\nport = "{line}"')
        playing.pulled = True  # the kernel keeps a terminal busy while either end is open
        ears.until(lambda: ears.code() is None and ears.scans > 5)
    finally:
        playing.end()


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "lidar_simulated"),
        ('kind = "ld19"\nport = "/etc/hostname"', "port_not_serial"),
        ('kind = "ld19"', "lidar.port is missing"),
        ('kind = "rplidar"\nport = "/dev/x"', "knows: a1, a2"),
        ('kind = "ld19"\nmodel = "a1"\nport = "/dev/x"', "lidar.model is for kinds of several"),
        ('port = "/dev/x"', "not for kind 'sim'"),
        ('kind = "hokuyo"', "'ld19'"),
    ],
)
def test_a_wrong_file_refuses_the_start_and_says_why(
    text: str,
    code: str,
    tmp_path: Path,
    write_robot: Callable[[str], Path],
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["--robot", str(write_robot(text)), "--home", str(tmp_path)]) == 2
    assert code in capsys.readouterr().err
