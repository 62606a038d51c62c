"""Every device that Pons knows is recognised at its port, and no question moves any of them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from devices import SerialPort
from devices.port_listing import PortHolder, describe_port
from pons.robot.command import describe
from pons.robot.port_finder import PROBES, PortFinding, question_port, question_ports
from sim.twin.lidar import LIDAR_TWINS, LidarFirmware
from sim.twin.twin import FIRMWARES
from tests.known import known
from tests.pons.robot.twin_ports import (
    BASES,
    PlayedBase,
    PlayedLidar,
    PlayedNoise,
    entry,
    played,
)
from wire.drive_config import DRIVE_KINDS
from wire.lidar_config import LidarConfig

pytestmark = pytest.mark.nightly(keep=25)


LIDARS = {"_".join(filter(None, key)): key for key in LIDAR_TWINS}
QUESTIONS = sorted({probe.question for probe in PROBES if probe.question})
TURNING = "rplidar that turns"


@pytest.fixture(scope="module")
def found() -> Iterator[dict[str, PortFinding]]:
    """Question every twin, a device nobody knows and a silent line, all at once."""
    with TemporaryDirectory(prefix="pons-find-") as folder:
        paths = {name: Path(folder, name.replace(" ", "_")) for name in LIDARS}
        devices = {name: PlayedLidar(paths[name], *key) for name, key in LIDARS.items()}
        paths |= {name: Path(folder, name) for name in ("unknown", "silent", *BASES)}
        paths[TURNING] = Path(folder, "turning")
        turning = PlayedLidar(paths[TURNING], "rplidar", "a1")
        turning.twin.firmware.tick(b"\xa5\x20", 0.0, lambda angles: (1.0,) * len(angles))
        noises = PlayedNoise(paths["unknown"], 20), PlayedNoise(paths["silent"], 0)
        bases = {kind: PlayedBase(paths[kind], kind) for kind in BASES}
        with played([*devices.values(), turning, *noises, *bases.values()]):
            findings = question_ports([entry(path) for path in paths.values()])
            found = dict(zip(paths, findings, strict=True))
            for name in (name for name in LIDARS if found[name].code == "port_silent"):
                # So many threads at once may starve one; alone it has to answer.
                (found[name],) = question_ports([entry(paths[name])])
        yield found
        assert [kind for kind, base in bases.items() if base.moved] == []


@pytest.mark.parametrize("name", sorted(LIDARS))
def test_each_lidar_is_named_with_its_model(name: str, found: dict[str, PortFinding]) -> None:
    kind, model = LIDARS[name]
    one = found[name]
    assert (one.code, one.part, one.kind) == ("port_found", "lidar", kind), one
    assert known(one.answer).keys.get("model") == model
    assert one.baud == LIDAR_TWINS[kind, model].baud
    given_keys = {"kind": kind, "port": "/dev/x", **known(one.answer).keys}
    assert LidarConfig.model_validate(given_keys).model == model  # robot.toml takes it


def test_a_motor_controller_is_named_with_its_battery(found: dict[str, PortFinding]) -> None:
    assert "battery" in known(found["pons_mcu"].answer).words


@pytest.mark.parametrize("kind", sorted(BASES))
def test_each_base_is_named(kind: str, found: dict[str, PortFinding]) -> None:
    one = found[kind]
    assert (one.code, one.part, one.kind) == ("port_found", "drive", kind), one
    assert set(known(one.answer).missing) == set(DRIVE_KINDS[kind].needed) - {"port"}


def test_a_lidar_that_still_turns_is_named_though_it_does_not_answer(
    found: dict[str, PortFinding],
) -> None:
    one = found[TURNING]
    assert (one.code, one.kind) == ("port_found", "rplidar"), one
    assert "model" in known(one.answer).missing


def test_what_nobody_knows_is_asked_nothing_and_silence_is_told(
    found: dict[str, PortFinding],
) -> None:
    assert found["unknown"].code == "port_unknown"
    assert "bytes" in found["unknown"].detail
    assert found["silent"].code == "port_silent"


def test_a_port_that_may_not_be_opened_is_not(tmp_path: Path) -> None:
    there = tmp_path / "tty"
    there.touch()
    holder = (PortHolder(7, "python -m bridge"),)
    assert question_port(entry(there, is_console=True)).code == "port_console"
    assert question_port(entry(there, holders=holder)).detail == "python -m bridge (pid 7)"
    assert question_port(entry(there, is_permitted=False)).code == "port_forbidden"
    assert question_port(entry(there)).code == "port_not_serial"
    assert question_port(entry(tmp_path / "none", is_permitted=False)).code == "port_missing"


def test_a_group_that_does_not_exist_is_never_to_be_joined(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with played([PlayedNoise(tmp_path / "line", 0)]):
        found = question_port(entry(tmp_path / "line", is_permitted=False, group=""))
        with SerialPort(tmp_path / "line", 115_200):  # whose holder this user could not see
            held = question_port(entry(tmp_path / "line"))
    (_, english) = describe([found])
    (_, busy) = describe([held])
    assert busy.startswith("  port_busy: held by a program of another user (`sudo fuser -v ")
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    (_, chinese) = describe([found])
    assert "没有任何用户组" in chinese
    assert "usermod" not in english + chinese


def test_a_port_that_a_program_holds_is_busy_and_is_not_spoken_to(tmp_path: Path) -> None:
    silent = PlayedNoise(tmp_path / "line", 0)
    with played([silent]), SerialPort(tmp_path / "line", 115_200):
        found = question_port(describe_port(tmp_path / "line"))
    assert found.code == "port_busy"
    assert str(os.getpid()) in found.detail
    assert silent.heard == b""


def test_a_port_that_goes_is_told(tmp_path: Path) -> None:
    class Unplugged(PlayedNoise):
        turns = 0

        def turn(self, now_s: float) -> None:
            super().turn(now_s)
            self.turns += 1
            if self.turns == 20:
                self.line.hang_up()

    with played([Unplugged(tmp_path / "line", 0)]):
        assert question_port(entry(tmp_path / "line")).code == "port_gone"


@pytest.mark.parametrize("question", QUESTIONS, ids=bytes.hex)
def test_no_question_turns_a_wheel(question: bytes) -> None:
    for kind, make in FIRMWARES.items():
        firmware = make(BASES[kind])
        for k in range(300):
            firmware.hear(question, 0.01 * k)
            assert firmware.motors(0.01 * k)[:2] == (0.0, 0.0), kind


@pytest.mark.parametrize("question", QUESTIONS, ids=bytes.hex)
@pytest.mark.parametrize("name", sorted(LIDARS))
def test_no_question_starts_stops_or_resets_a_lidar(name: str, question: bytes) -> None:
    kind, model = LIDARS[name]
    config = LidarConfig.model_validate({"kind": kind, "model": model, "port": "/dev/x"})

    def said_in_a_second(asked: bytes) -> int:
        """Return how much it says while it is at work, when it was asked so before."""
        firmware = LidarFirmware(config)
        begin = {"rplidar": b"\xa5\x20", "ydlidar": b"\xa5\x60"}.get(kind, b"")
        firmware.tick(begin, 0.0, _look)
        firmware.tick(asked, 0.01, _look)
        return sum(len(firmware.tick(b"", 0.01 * k, _look)) for k in range(2, 102))

    assert said_in_a_second(question) == pytest.approx(said_in_a_second(b""), abs=100)
    idle = LidarFirmware(config)
    idle.tick(question, 0.0, _look)
    talks = LIDAR_TWINS[kind, model].talks
    assert bool(sum(len(idle.tick(b"", 0.01 * k, _look)) for k in range(1, 50))) == talks


@given(data=st.binary(max_size=600))
def test_bytes_of_no_device_are_no_device(data: bytes) -> None:
    assert [probe.kind for probe in PROBES if probe.recognise(data) is not None] == []


def _look(angles: NDArray[np.float64]) -> tuple[float, ...]:
    return (1.5,) * len(angles)
