"""A scan through a lidar twin's bytes and the decoder is the simulator's own scan."""

from __future__ import annotations

from collections.abc import Iterator
from math import tau
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from devices import SerialPort
from sensors.lidar.kinds import kind_of
from sensors.lidar.reader import LidarReader
from sim import Hardware, SimRobot
from sim.sensor_channel import Trouble
from sim.twin.lidar import LIDAR_TWINS, LidarFirmware, LidarTwin
from tests.sensors.lidar.ports import MemoryPort
from wire import ConfigError, Pose2, RobotDescription, Scan, SimFault
from wire.lidar_config import LIDAR_MODELS, WITHOUT_LINE, LidarConfig

pytestmark = pytest.mark.nightly(keep=6)


PRECISE = Hardware(lidar_noise_m=0.0, lidar_dropout=0.0)
TURNS_S = 3.0
UNITS_M = {"ld": 0.001, "rp81": 0.000_25, "rp82": 0.001, "rp85": 0.001, "yd_mm": 0.001}
"""Half a unit is the most that rounding does; the scan's own ranges have 0.1 mm."""


def config(kind: str, model: str | None, **more: object) -> LidarConfig:
    return LidarConfig.model_validate({"kind": kind, "model": model, "port": "/dev/x", **more})


def scans_of(chosen: LidarConfig, look: object, seconds: float = TURNS_S) -> list[Scan]:
    """Return what the reader makes of a twin's bytes."""
    port, firmware = MemoryPort(), LidarFirmware(chosen)
    reader = LidarReader(kind_of(chosen), port, "/dev/x", "b")
    found: list[Scan] = []
    for tick in range(1, round(seconds / 0.01)):
        now_s = 10.0 + 0.01 * tick
        port.coming += firmware.tick(port.take_requests(), now_s, look)  # type: ignore[arg-type]  # a callable
        found += reader.turn(now_s)
    return found


ALIGNED = [
    key
    for key, model in LIDAR_TWINS.items()
    if model.form in UNITS_M and model.beams_per_s * 0.1 <= 1440
]
"""Models of which each beam has a direction of the scan for itself."""


@pytest.mark.parametrize("key", ALIGNED, ids=lambda key: "_".join(filter(None, key)))
@given(upside_down=st.booleans(), data=st.data())
def test_any_ranges_come_back_within_the_formats_quantisation(
    key: tuple[str, str | None], upside_down: bool, data: st.DataObject
) -> None:
    chosen = config(*key, upside_down=upside_down)
    count = round(LIDAR_TWINS[key].beams_per_s * 0.1)
    few = data.draw(
        st.lists(st.none() | st.integers(100, 7_900), min_size=1, max_size=40), label="mm"
    )
    wanted = [None if mm is None else mm / 1000 for mm in (few * count)[:count]]

    def look(directions_rad: NDArray[np.float64]) -> tuple[float | None, ...]:
        at = np.floor((directions_rad % tau) / tau * count).astype(int) % count
        return tuple(wanted[index] for index in at.tolist())

    scan = scans_of(chosen, look, 0.5)[-1]
    assert scan.clockwise is not upside_down
    assert scan.angle_min_rad == pytest.approx(0.5 * tau / count)
    unit_m = UNITS_M[LIDAR_TWINS[key].form]
    for range_m, true_m in zip(scan.ranges_m, wanted, strict=True):
        assert (range_m is None) == (true_m is None)
        if range_m is not None and true_m is not None:
            assert abs(range_m - true_m) <= unit_m / 2 + 0.000_051


@pytest.mark.parametrize("key", ALIGNED[:3], ids=lambda key: "_".join(filter(None, key)))
def test_a_scan_of_the_home_is_the_simulators(
    key: tuple[str, str | None], repository: Path
) -> None:
    """Standing robot, no noise: what differs is the format's rounding alone."""
    chosen = config(*key, x_m=0.1, yaw_rad=0.7)
    robot = RobotDescription.model_validate({"lidar": chosen.model_dump()})
    start = Pose2(3.0, 2.0, 0.4)
    site = repository / "sites" / "two_room"
    simulated = SimRobot(site, robot, start=start, hardware=PRECISE)
    (*_, scan) = scans_of(chosen, simulated.look)
    steps = np.arange(len(scan.ranges_m), dtype=np.float64)
    angles = np.asarray(scan.angle_min_rad + scan.angle_increment_rad * steps, np.float64)
    wanted = simulated.look(angles)
    unit_m = UNITS_M[LIDAR_TWINS[key].form]
    off_m = [
        abs(range_m - true_m)
        for range_m, true_m in zip(scan.ranges_m, wanted, strict=True)
        if range_m is not None and true_m is not None
    ]
    assert len(off_m) >= 0.9 * len(wanted)
    assert [r is None for r in scan.ranges_m] == [r is None for r in wanted]
    # Beams are sent in steps of 1/64 or 1/100 degree, and looked where they are sent.
    assert max(off_m) <= unit_m / 2 + 0.001


def test_every_model_of_robot_toml_has_a_twin() -> None:
    known = {
        (kind, model)
        for kind, models in LIDAR_MODELS.items()
        if kind not in WITHOUT_LINE
        for model in (models or (None,))
    }
    assert set(LIDAR_TWINS) == known
    for key in LIDAR_TWINS:
        assert kind_of(config(*key)).baud == LIDAR_TWINS[key].baud


def test_a_simulated_lidar_has_no_twin() -> None:
    with pytest.raises(ConfigError, match=r"twin_unknown: .*'sim'.*rplidar_a1"):
        LidarFirmware(LidarConfig())


@pytest.fixture
def twin(tmp_path: Path) -> Iterator[LidarTwin]:
    made = LidarTwin(config("ld19", None), tmp_path / "line")
    yield made
    made.close()


def far(directions_rad: NDArray[np.float64]) -> tuple[float | None, ...]:
    return (2.0,) * len(directions_rad)


def read(
    twin: LidarTwin, path: Path, baud: int, *troubles: Trouble, ticks: int = 40, at_s: float = 5.0
) -> bytes:
    with SerialPort(path, baud) as port:
        came = b""
        for tick in range(ticks):
            twin.tick(at_s + 0.01 * tick, far, frozenset(troubles))
            came += port.read()
    return came


def test_a_host_at_the_right_baud_reads_frames_and_at_another_noise(
    twin: LidarTwin, tmp_path: Path
) -> None:
    good = read(twin, tmp_path / "line", 230_400)
    twin.line.hang_up()
    bad = read(twin, tmp_path / "line", 115_200, at_s=6.0)
    assert good.count(b"\x54\x2c") >= 100
    assert bad.count(b"\x54\x2c") <= 3
    assert len(bad) > 1_000


def test_a_lidar_that_is_off_says_nothing(twin: LidarTwin, tmp_path: Path) -> None:
    assert read(twin, tmp_path / "line", 230_400, Trouble.OFF) == b""
    twin.line.hang_up()
    assert read(twin, tmp_path / "line", 230_400, Trouble.DELAYED, ticks=20, at_s=6.0) == b""


@pytest.mark.parametrize(
    ("fault", "blind"), [(SimFault.LIDAR_BLIND, True), (SimFault.LIDAR_GARBAGE, False)]
)
def test_faults_of_the_lens_show_in_what_is_cast(
    fault: SimFault, blind: bool, repository: Path
) -> None:
    simulated = SimRobot(repository / "sites" / "two_room")
    simulated.break_down(fault)
    ranges = simulated.look(np.linspace(0.0, 6.0, 50))
    assert all((r is None) == blind for r in ranges)


def test_a_robot_with_a_lidar_of_metal_says_no_scan_itself(repository: Path) -> None:
    robot = RobotDescription.model_validate({"lidar": config("ld19", None).model_dump()})
    simulated = SimRobot(repository / "sites" / "two_room", robot)
    assert all(report.scan is None for report in simulated.step_to(0.5))
