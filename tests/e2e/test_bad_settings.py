"""``pons up`` refuses what can't be right: it names it, ends with 2, and leaves nothing running."""

from __future__ import annotations

import shutil
import socket
import subprocess
import time
from pathlib import Path

import pytest

from tests.e2e.system import ROOT, TWO_ROOM, System

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=3)]

REFUSED = 2
QUICKLY_S = 20.0


def refusal(system: System, *words: str, limit_s: float = QUICKLY_S) -> str:
    """Return what ``pons up`` says as it refuses; hold that it leaves nothing."""
    try:
        done = system.pons("up", *words, timeout_s=limit_s)
        assert done.returncode == REFUSED, (done.stdout, done.stderr)
        assert not system.processes()
    finally:
        system.destroy()
    assert "Traceback" not in done.stderr, done.stderr
    return done.stderr


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ("max_sped_mps = 0.5", ("unknown key 'limits.max_sped_mps'", "known there: max_speed_mps")),
        ("max_speed_mps = 50.0", ("got 50.0", "less than or equal to 2")),
    ],
)
def test_a_robot_file_that_cannot_be_right(home: Path, line: str, named: tuple[str, ...]) -> None:
    robot = home / "robot.toml"
    robot.write_text(f"[limits]\n{line}\n")
    said = refusal(System(home / "h", PONS_ROBOT=str(robot)))
    for word in ("robot_toml_invalid", str(robot), *named):
        assert word in said, said


@pytest.fixture
def site(home: Path) -> Path:
    """Return a site of our own to spoil."""
    return Path(shutil.copytree(TWO_ROOM, home / TWO_ROOM.name))  # a site bears its folder's name


def test_a_map_whose_image_is_missing(home: Path, site: Path) -> None:
    (site / "map.pgm").unlink()
    said = refusal(System(home / "h", site=site))
    assert "map_image_missing" in said
    assert str(site / "map.pgm") in said


@pytest.mark.parametrize("name", ["fence.json", "places.yaml"])
def test_a_site_that_lacks_a_file(home: Path, site: Path, name: str) -> None:
    (site / name).unlink()
    said = refusal(System(home / "h", site=site))
    assert name in said


def test_a_site_that_is_none(home: Path) -> None:
    said = refusal(System(home / "h", site=ROOT / "sites" / "castle"))
    assert "site_missing" in said
    assert "two_room" in said


def test_a_detector_that_is_no_model(home: Path) -> None:
    model = home / "best.onnx"
    model.write_bytes(b"weights of another kind")
    # It is opened by its own process, beside all that starts.
    said = refusal(System(home / "h", PONS_VISION_MODEL=str(model)), limit_s=3 * QUICKLY_S)
    assert "model_not_onnx" in said
    assert "best.onnx" in said


def test_a_port_that_somebody_uses(home: Path) -> None:
    system = System(home)
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        system.port = int(other.getsockname()[1])
        said = refusal(system)
    assert "port_in_use" in said
    assert str(system.port) in said


def test_a_home_too_long_for_sockets(home: Path) -> None:
    began_s = time.monotonic()
    said = refusal(System(home / ("x" * 100)))
    assert "socket_path_too_long" in said
    assert "PONS_HOME" in said
    assert time.monotonic() - began_s < QUICKLY_S


def test_a_stop_that_nobody_hears_is_not_called_one(home: Path) -> None:
    done: subprocess.CompletedProcess[str] = System(home).pons("stop")
    assert done.returncode == 6
    assert "no_bridge" in done.stderr
    assert "stopped" not in done.stdout
