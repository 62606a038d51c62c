"""The doctor names what is wrong with a lidar and what mends it, with and without its process."""

from __future__ import annotations

import secrets
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from pons.doctor import lidar_checks, running_process
from pons.doctor.finding import HealthVerdict
from sim.twin import LidarTwin
from tests.pons.doctor.speaking import speaking
from wire import LidarStatus, RobotDescription, keys
from wire.keys import Party
from wire.lidar_config import LidarConfig
from wire.session import open_session

pytestmark = pytest.mark.nightly(keep=4)


STATUS = LidarStatus(
    boot_id="lidar-1", seq=1, stamp_s=1.0, model="ld19", code=None, rate_hz=10.0, frames=500,
    spoilt=2, lost_bytes=94, broken_turns=1, opened=1,
)  # fmt: skip


def described(**lidar: object) -> RobotDescription:
    drive = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 4096}
    return RobotDescription.model_validate({"drive": drive, "lidar": lidar})


def room(directions_rad: NDArray[np.float64]) -> tuple[float | None, ...]:
    return tuple(np.full(len(directions_rad), 2.0).tolist())


@pytest.fixture
def line(tmp_path: Path) -> Iterator[Path]:
    """Yield a line at which an RPLidar A1 waits."""
    config = LidarConfig(kind="rplidar", model="a1", port="/dev/x", scan_s=0.18)
    twin, ending = LidarTwin(config, tmp_path / "line"), threading.Event()

    def play() -> None:
        while not ending.wait(0.01):
            twin.tick(time.monotonic(), room)

    thread = threading.Thread(target=play)
    thread.start()
    yield tmp_path / "line"
    ending.set()
    thread.join()
    twin.close()


def test_a_simulated_robot_has_a_simulated_lidar(tmp_path: Path) -> None:
    assert lidar_checks.lidar(tmp_path, RobotDescription()).verdict is HealthVerdict.OK


def test_a_base_of_metal_without_a_lidar_is_told_of_it(tmp_path: Path) -> None:
    found = lidar_checks.lidar(tmp_path, described())
    assert found.verdict is HealthVerdict.WARN
    assert "pons_mcu" in found.found.en


def test_a_lidar_that_turns_is_found_well_and_left_at_rest(tmp_path: Path, line: Path) -> None:
    robot = described(kind="rplidar", model="a1", port=str(line), scan_s=0.18)
    found = lidar_checks.lidar(tmp_path, robot)
    assert found.verdict is HealthVerdict.OK, found


@pytest.mark.parametrize(
    ("lidar", "code", "cure"),
    [
        ({"kind": "ld19", "port": "/dev/none"}, "port_missing", "robot find"),
        ({"kind": "ld19", "port": "/etc/hostname"}, "port_not_serial", "by-id"),
        ({"kind": "ydlidar", "model": "x2", "port": "LINE"}, "lidar_silent", "powered"),
        (
            {"kind": "rplidar", "model": "a1", "port": "LINE", "baud": 9600},
            "lidar_silent",
            "this port",
        ),
    ],
)
def test_what_is_wrong_is_named_with_its_cure(
    tmp_path: Path, line: Path, lidar: dict[str, object], code: str, cure: str
) -> None:
    if lidar["port"] == "LINE":
        lidar = lidar | {"port": str(line)}
    found = lidar_checks.lidar(tmp_path, described(**lidar))
    assert found.verdict is HealthVerdict.FAIL
    assert code in found.found.en
    assert found.fix is not None
    assert cure in found.fix.en
    assert found.fix.zh != found.fix.en


@pytest.mark.parametrize("code", [None, "lidar_spoilt", "port_gone"])
def test_a_running_process_is_asked_and_its_port_left_alone(
    tmp_path: Path, code: str | None
) -> None:
    said = STATUS.model_copy(update={"code": code, "detail": "61 of 800" if code else ""})
    robot = described(kind="ld19", port=f"/dev/{secrets.token_hex(4)}")
    with speaking(Party.LIDAR, tmp_path, (keys.LIDAR_STATE, said)):
        found = lidar_checks.lidar(tmp_path, robot)
    assert found.verdict is (HealthVerdict.FAIL if code else HealthVerdict.OK)
    assert (code or "10.0 turns/s, 2 of 502 frames spoilt") in found.found.en


def test_a_process_that_says_nothing_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running_process, "HEAR_S", 0.1)
    with open_session(Party.LIDAR, "r1", tmp_path):
        found = lidar_checks.lidar(tmp_path, described(kind="ld19", port="/dev/none"))
    assert found.verdict is HealthVerdict.FAIL
    assert "says nothing" in found.found.en
