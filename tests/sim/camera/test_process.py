"""The simulated camera as a real process: two pictures an instant, and none of what is gone."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import psutil
import pytest

from sim.camera.__main__ import main
from wire import Image, SimControl, SimFault, keys
from wire.keys import Party
from wire.session import Session, open_session

LIMIT_S = 30.0
QUIET_S = 0.6
"""Six periods: long enough for what was under way to arrive, and for the next to be missed."""


def start(repository: Path, home: Path, module: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", module, "--site", "sites/two_room", "--home", str(home)]
    return subprocess.Popen(command, cwd=repository, stderr=subprocess.PIPE, text=True)


@pytest.fixture
def processes(repository: Path, tmp_path: Path) -> Iterator[tuple[subprocess.Popen[str], ...]]:
    """Start simulator and camera."""
    started = tuple(start(repository, tmp_path, module) for module in ("sim", "sim.camera"))
    yield started
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate(timeout=LIMIT_S)


class Eyes:
    """Hear both pictures."""

    def __init__(self, session: Session) -> None:
        self._subscribers = (
            session.image_subscriber(keys.CAMERA_COLOR),
            session.image_subscriber(keys.CAMERA_DEPTH),
        )
        self._controls = session.publisher(keys.SIM_CONTROL)
        self._wishes = 0

    def pair(self, limit_s: float = LIMIT_S) -> tuple[Image, Image] | None:
        """Return the next two pictures of one instant, if they come in time."""
        held: dict[int, Image] = {}
        end_s = time.monotonic() + limit_s
        while time.monotonic() < end_s:
            for index, subscriber in enumerate(self._subscribers):
                image = subscriber.newest()
                if isinstance(image, Image):
                    held[index] = image
            if len(held) == 2 and held[0].header == held[1].header:
                return held[0], held[1]
            time.sleep(0.005)
        return None

    def until(self, done: Callable[[], bool]) -> None:
        """Wait for something."""
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, "nothing came of it"

    def silent(self) -> bool:
        """Tell whether no picture of now comes for a while."""
        began_s = time.monotonic()
        found = self.pair(QUIET_S)
        return found is None or found[0].header.stamp_s < began_s

    def break_down(self, *faults: SimFault) -> None:
        self._wishes += 1
        self._controls.put(SimControl(id=f"f{self._wishes}", faults=faults))


@pytest.mark.e2e
def test_it_takes_pictures_while_there_is_something_to_draw(
    processes: tuple[subprocess.Popen[str], ...], tmp_path: Path
) -> None:
    simulator, camera = processes
    with open_session(Party.JUDGE, "r1", tmp_path) as session:
        eyes = Eyes(session)
        first, second = eyes.pair(), eyes.pair()
        assert first is not None
        assert second is not None
        header = first[0].header
        assert (header.width, header.height, header.center_x_px) == (320, 240, 160.0)
        assert header.focal_px == pytest.approx(233.9, abs=0.1)
        assert second[0].header.seq > header.seq
        assert second[0].header.stamp_s > header.stamp_s
        assert first[0].data.startswith(b"\xff\xd8")
        assert first[1].data.startswith(b"\x89PNG")
        assert psutil.Process(camera.pid).nice() >= 5
        eyes.break_down(SimFault.CAMERA_OFF)
        eyes.until(eyes.silent)
        eyes.break_down()
        assert eyes.pair() is not None
        simulator.kill()
        simulator.wait(LIMIT_S)
        eyes.until(eyes.silent)
    camera.send_signal(signal.SIGTERM)
    assert camera.wait(LIMIT_S) == 0


@pytest.mark.usefixtures("signals_kept")
def test_a_robot_without_a_simulated_camera_is_refused_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.nice", lambda _: 0)  # it would stay with this process
    robot = tmp_path / "robot.toml"
    robot.write_text('[camera]\nkind = "none"\n', "utf-8")
    assert main(["--site", "sites/two_room", "--robot", str(robot)]) == 2
    said = capsys.readouterr().err
    assert said.startswith("camera: camera_not_simulated: ")
    assert said.count("\n") == 1
