"""A lidar is greeted, read and asked again, and its scans are dated however its bytes come."""

from __future__ import annotations

from math import cos, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from sensors.lidar.kinds import kind_of, recognize
from sensors.lidar.reader import LidarReader
from sim.twin.lidar import BOOT_S, LIDAR_TWINS, LidarFirmware
from tests.sensors.lidar.ports import MemoryPort
from wire import ConfigError, Scan
from wire.lidar_config import LidarConfig

EACH = [pytest.param(key, id="_".join(filter(None, key))) for key in LIDAR_TWINS]


def config(kind: str = "ld19", model: str | None = None, **more: object) -> LidarConfig:
    return LidarConfig.model_validate({"kind": kind, "model": model, "port": "/dev/x", **more})


def room(directions_rad: NDArray[np.float64]) -> tuple[float | None, ...]:
    return tuple((2.0 + np.cos(directions_rad)).tolist())


class Bench:
    """A reader and a twin's firmware with a line of memory between them."""

    def __init__(self, chosen: LidarConfig) -> None:
        self.port = MemoryPort()
        self.firmware = LidarFirmware(chosen)
        self.reader = LidarReader(kind_of(chosen), self.port, "/dev/x", "lidar-1")
        self.now_s = 50.0
        self.plugged = True

    def run(self, seconds: float) -> list[tuple[float, Scan]]:
        """Return the scans, each with the time at which it was whole."""
        found = []
        for _ in range(round(seconds / 0.01)):
            self.now_s += 0.01
            sent = self.firmware.tick(self.port.take_requests(), self.now_s, room)
            if self.plugged:
                self.port.coming += sent
            found += [(self.now_s, scan) for scan in self.reader.turn(self.now_s)]
        return found

    def code(self) -> str | None:
        verdict = self.reader.judge(self.now_s)
        return verdict.code if verdict else None


@pytest.mark.parametrize("key", EACH)
@pytest.mark.parametrize("scan_s", [0.1, 0.18])
def test_each_model_is_started_and_gives_fresh_scans_of_the_room(
    key: tuple[str, str | None], scan_s: float
) -> None:
    bench = Bench(config(*key, scan_s=scan_s))
    found = bench.run(2.5)
    assert bench.code() is None
    whens = [at for at, _ in found]
    oldest_s = max(
        later - scan.stamp_s for later, (_, scan) in zip(whens[6:], found[5:], strict=False)
    )
    assert oldest_s < 0.25, "or the bridge would call it stale between two scans"
    assert [scan.seq for _, scan in found] == list(range(1, len(found) + 1))
    for _, scan in found[5:]:
        off_m = [
            abs((range_m or 0.0) - 2.0 - cos(scan.angle_min_rad + k * scan.angle_increment_rad))
            for k, range_m in enumerate(scan.ranges_m)
        ]
        assert max(off_m) < 0.012, "half a direction"
    assert bench.reader.status(1, bench.now_s).rate_hz == pytest.approx(1 / scan_s, rel=0.1)


@pytest.mark.parametrize("upside_down", [False, True])
def test_a_lidar_upside_down_is_turned_right(upside_down: bool) -> None:
    bench = Bench(config(upside_down=upside_down))
    (_, scan), *_ = bench.run(1.0)
    assert scan.clockwise is not upside_down

    def post(directions_rad: NDArray[np.float64]) -> tuple[float | None, ...]:
        """Stand a post to the left."""
        away = np.abs((directions_rad - pi / 2 + pi) % (2 * pi) - pi)
        return tuple(1.0 if near < 0.05 else None for near in away.tolist())

    found: list[Scan] = []
    for _ in range(100):
        bench.now_s += 0.01
        bench.port.coming += bench.firmware.tick(b"", bench.now_s, post)
        found += bench.reader.turn(bench.now_s)
    seen = [
        found[-1].angle_min_rad + k * found[-1].angle_increment_rad
        for k, range_m in enumerate(found[-1].ranges_m)
        if range_m is not None
    ]
    assert seen
    assert all(abs(at - pi / 2) < 0.08 for at in seen)


def test_a_lidar_that_was_reset_is_asked_again() -> None:
    bench = Bench(config("rplidar", "a1"))
    bench.run(4.0)
    bench.firmware.tick(b"\xa5\x40", bench.now_s, room)
    bench.run(1.0)
    assert bench.code() == "lidar_silent"
    assert "powered" in bench.reader.status(1, bench.now_s).detail
    assert bench.run(BOOT_S + 3.0)
    bench.run(2.5)
    assert bench.code() is None


def test_a_lidar_that_shut_its_laser_off_is_begun_anew() -> None:
    bench = Bench(config("rplidar", "a1"))
    asked = b""
    for _ in range(800):
        bench.now_s += 0.01
        bench.reader.turn(bench.now_s)
        asked += bench.port.take_requests()
    assert asked.startswith(b"\xa5\x25\xa5\x20")
    assert b"\xa5\x40" in asked


def test_a_port_that_came_back_is_greeted_and_what_was_unfinished_is_forgotten() -> None:
    bench = Bench(config("rplidar", "a2"))
    bench.run(4.0)
    before = bench.reader.counts
    bench.port.opened += 1
    bench.firmware = LidarFirmware(config("rplidar", "a2"))
    assert bench.run(1.0)
    assert bench.reader.counts.frames > before.frames
    assert bench.reader.status(1, bench.now_s).opened == 2


def test_what_came_while_this_process_was_frozen_makes_no_scan() -> None:
    bench = Bench(config())
    bench.run(2.0)
    for _ in range(100):
        bench.now_s += 0.01
        bench.port.coming += bench.firmware.tick(b"", bench.now_s, room)
    thawed_s = bench.now_s
    found = bench.run(1.0)
    assert found
    assert all(scan.stamp_s > thawed_s - 0.02 for _, scan in found)


def test_a_burst_after_a_stall_is_as_old_as_it_is() -> None:
    bench = Bench(config())
    bench.run(2.0)
    for _ in range(20):
        bench.now_s += 0.01
        bench.port.coming += bench.firmware.tick(b"", bench.now_s, room)
    late = bench.reader.turn(bench.now_s)
    assert late
    assert late[0].stamp_s < bench.now_s - 0.15


def test_noise_on_the_line_is_counted_and_told() -> None:
    bench = Bench(config())
    bench.run(4.0)
    for k in range(200):
        bench.now_s += 0.01
        data = bytearray(bench.firmware.tick(b"", bench.now_s, room))
        if data and k % 3 == 0:
            data[len(data) // 2] ^= 0x10
        bench.port.coming += data
        bench.reader.turn(bench.now_s)
    assert bench.code() == "lidar_spoilt"
    counts = bench.reader.counts
    assert counts.lost_bytes == 47 * 67, "a frame for each"
    assert counts.spoilt >= 10, "less those whose head was hit"


@pytest.mark.parametrize("key", EACH)
def test_a_lidar_of_another_kind_is_named(key: tuple[str, str | None]) -> None:
    firmware = LidarFirmware(config(*key))
    firmware.tick(b"\xa5\x20" if key[0] == "rplidar" else b"\xa5\x60", 1.0, room)
    if LIDAR_TWINS[key].form in ("rp82", "rp85"):
        firmware.tick(b"\xa5\x82\x05\x00\x00\x00\x00\x00\x22", 1.0, room)
    data = b"".join(firmware.tick(b"", 1.0 + 0.01 * k, room) for k in range(1, 60))[50:2000]
    assert recognize(data) == key[0]
    kinds = {"ld19": None, "rplidar": "a1", "ydlidar": "x2"}
    other = next(kind for kind in kinds if kind[:2] != key[0][:2])  # an LD08's frames are an LD19's
    bench = Bench(config(other, kinds[other]))
    for _ in range(40):
        bench.now_s += 0.05
        bench.port.coming += data[:400]
        bench.reader.turn(bench.now_s)
    assert bench.code() == "lidar_other_kind"
    assert f"'{key[0]}'" in bench.reader.status(1, bench.now_s).detail


@given(st.binary(min_size=200, max_size=2000))
def test_noise_is_recognized_as_no_kind(noise: bytes) -> None:
    assert recognize(noise) is None


def test_a_wrong_baud_is_told_by_what_comes() -> None:
    bench = Bench(config())
    bench.plugged = False
    for k in range(150):
        bench.now_s += 0.01
        bench.port.coming += bytes((k * 37 + j * 101) % 251 for j in range(50))
        bench.reader.turn(bench.now_s)
    assert bench.code() == "lidar_unreadable"
    assert "baud" in bench.reader.status(1, bench.now_s).detail


def test_a_slow_motor_is_told_with_what_was_expected() -> None:
    bench = Bench(config(scan_s=0.1))
    bench.firmware = LidarFirmware(config(scan_s=0.14))
    bench.run(5.0)
    assert bench.code() == "lidar_slow"
    assert "7." in bench.reader.status(1, bench.now_s).detail


def test_a_motor_that_stands_is_told() -> None:
    bench = Bench(config(scan_s=0.1))
    bench.run(4.0)
    bench.firmware._turn_hz = 0.01  # its motor stalls; no request does that
    bench.firmware._format = bench.firmware._form()
    assert not bench.run(3.0)
    assert bench.code() == "lidar_no_turn"


def test_the_simulators_lidar_needs_no_process() -> None:
    with pytest.raises(ConfigError, match="lidar_simulated"):
        kind_of(LidarConfig())
