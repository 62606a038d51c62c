"""A gyro on a bus is read bit by bit, and believed only where it lives and is what it should be."""

from __future__ import annotations

from typing import cast

import pytest

from lockstep.scene import folder_of
from sensors.imu import reader as module
from sensors.imu.bno085 import Bno085, reports_in
from sensors.imu.bus import ImuTrouble, load_library
from sensors.imu.mpu6050 import CHECK_EACH, Mpu6050
from sensors.imu.reader import CODES, FROZEN, ImuReader
from sim.robot import SimRobot
from sim.twin.imu_chips import Bno085Twin, Mpu6050Twin
from tests.wire.examples import EXAMPLES
from wire import DriveCommand, Imu
from wire.imu_config import ImuConfig

STILL = cast("Imu", EXAMPLES[Imu]).model_copy(
    update={"yaw_rate_radps": 0.0, "accel_x_mps2": 0.0, "accel_y_mps2": 0.0}
)
MPU = ImuConfig(kind="mpu6050", bus=1)
BNO = ImuConfig(kind="bno085", bus=1)


@pytest.fixture(autouse=True)
def _no_sleep(monkeypatch: pytest.MonkeyPatch) -> None:
    """Chips are set without waiting: a twin needs none."""
    monkeypatch.setattr("time.sleep", lambda _seconds: None)


class Desk:
    """Hold a chip's twin, its reader and the time."""

    def __init__(self, twin: Mpu6050Twin | Bno085Twin, config: ImuConfig) -> None:
        self.twin, self.now_s = twin, 50.0
        self.reader = ImuReader(config, lambda: twin, "imu-1", self.now_s)
        self.heard: list[Imu] = []

    def run(self, seconds: float, radps: float = 0.0) -> None:
        for _ in range(round(seconds * 100)):
            self.now_s += 0.01
            self.twin.feel(STILL.model_copy(update={"yaw_rate_radps": radps, "accel_x_mps2": 0.5}))
            imu = self.reader.turn(self.now_s)
            if imu is not None:
                self.heard.append(imu)

    def code(self) -> str | None:
        trouble = self.reader.judge(self.now_s)
        assert trouble is None or trouble.code in CODES
        return trouble.code if trouble else None


def test_an_mpu6050_says_the_turn_without_what_it_says_standing() -> None:
    desk = Desk(Mpu6050Twin(offset_radps=0.2), MPU)
    desk.run(0.5)
    assert (desk.heard, desk.code()) == ([], "imu_starting"), "its bias is not known yet"
    desk.run(1.5)
    assert desk.code() is None
    assert desk.heard[-1].yaw_rate_radps == pytest.approx(0.0, abs=0.003)
    desk.run(1.0, 1.0)
    assert desk.heard[-1].yaw_rate_radps == pytest.approx(1.0, abs=0.003)
    assert desk.heard[-1].accel_x_mps2 == pytest.approx(0.5, abs=0.01)
    assert [one.seq for one in desk.heard] == list(range(1, len(desk.heard) + 1))
    status = desk.reader.status(1, desk.now_s)
    assert (status.code, status.errors, status.opened) == (None, 0, 1)
    assert status.rate_hz == pytest.approx(100.0, abs=1.0)
    assert status.bias_radps == pytest.approx(0.2, abs=0.005)


def test_beyond_its_range_it_stays_at_its_end_and_on_its_side() -> None:
    desk = Desk(Mpu6050Twin(), MPU)
    desk.run(2.0)
    desk.run(0.1, -15.0)
    assert desk.heard[-1].yaw_rate_radps == pytest.approx(-8.73, abs=0.1)


def test_one_that_sits_upside_down_is_turned() -> None:
    desk = Desk(Mpu6050Twin(), ImuConfig(kind="mpu6050", bus=1, up="-z"))
    desk.run(2.0)
    desk.run(0.1, 0.5)
    assert desk.heard[-1].yaw_rate_radps == pytest.approx(-0.5, abs=0.003)


def test_a_bno085_is_asked_for_its_reports_and_takes_its_bias_itself() -> None:
    twin = Bno085Twin()
    desk = Desk(twin, BNO)
    desk.run(0.2, 0.7)
    assert desk.code() is None
    assert twin.wanted == {0x01: 10_000, 0x02: 10_000}
    assert desk.heard[-1].yaw_rate_radps == pytest.approx(0.7, abs=0.002)
    assert desk.heard[-1].accel_x_mps2 == pytest.approx(0.5, abs=0.005)


def test_another_chip_is_named_and_nothing_of_it_believed() -> None:
    desk = Desk(Mpu6050Twin(who=0xEA), MPU)
    desk.run(3.0)
    assert desk.code() == "imu_other_chip"
    assert "0xea" in str(desk.reader.judge(desk.now_s))
    assert desk.heard == []
    assert cast("Mpu6050Twin", desk.twin).closed >= 2, "the bus is given back each time"
    silent = Desk(Mpu6050Twin(address=0x69), MPU)
    silent.run(1.5)
    assert silent.code() == "imu_silent"


def test_a_cable_that_goes_and_comes_back() -> None:
    twin = Mpu6050Twin()
    desk = Desk(twin, MPU)
    desk.run(2.0)
    twin.spoilt = 2
    desk.run(0.1)
    assert desk.code() is None, "a failed transfer is noise"
    twin.is_plugged = False
    desk.run(0.5)
    assert desk.code() == "imu_silent"
    before = len(desk.heard)
    twin.is_plugged = True
    twin.dip()
    desk.run(4.0)
    assert desk.code() is None
    assert len(desk.heard) > before
    assert desk.reader.status(1, desk.now_s).opened == 2


def test_a_dip_of_its_supply_is_noticed_by_its_settings() -> None:
    twin = Mpu6050Twin()
    desk = Desk(twin, MPU)
    desk.run(2.0)
    twin.dip()
    for _ in range(CHECK_EACH):
        desk.run(0.01)
        if desk.code() is not None:
            break
    assert desk.code() == "imu_reset"
    desk.run(3.5)
    assert desk.code() is None


def test_a_chip_that_repeats_itself_is_frozen_and_says_nothing_more() -> None:
    twin = Mpu6050Twin()
    desk = Desk(twin, MPU)
    desk.run(2.0)
    twin.is_frozen = True
    desk.run((FROZEN + 2) / 100)
    before = len(desk.heard)
    assert desk.code() == "imu_frozen"
    desk.run(1.0)
    assert len(desk.heard) == before


def test_a_robot_that_is_turned_while_it_starts_is_asked_to_stand() -> None:
    desk = Desk(Mpu6050Twin(offset_radps=0.0), MPU)
    for k in range(50):
        desk.run(0.1, 0.3 if k % 2 else 0.6)
    assert desk.code() == "imu_unsettled"
    assert desk.heard == []


def test_a_simulated_robot_turns_and_its_chip_says_so() -> None:
    """Physics on one side of the registers, the wire's message on the other."""
    robot = SimRobot(folder_of("two_room"), seed=3)
    twin = Mpu6050Twin()
    reader = ImuReader(MPU, lambda: twin, "imu-1", 0.0)
    off = []
    for tick in range(1, 500):
        now_s = tick * 0.01
        speed = 2.0 if tick > 200 else 0.0
        robot.command(
            DriveCommand(boot="b", seq=tick, left_radps=-speed, right_radps=speed, enable=True),
            now_s,
        )
        report = robot.tick(now_s)
        assert report.imu is not None
        twin.feel(report.imu)
        imu = reader.turn(now_s)
        if imu is not None and tick > 300:
            off.append(abs(imu.yaw_rate_radps - robot.twist.w_radps))
    assert robot.twist.w_radps > 0.7
    assert max(off) < 0.03


@pytest.mark.parametrize("words", CODES.values())
def test_each_cure_is_told(words: tuple[str, str]) -> None:
    assert all(words)


def test_what_follows_an_unknown_report_is_lost_and_no_bytes_fail() -> None:
    gyro = b"\x02\x00\x03\x00\x01\x00\x02\x00\x03\x00"
    assert reports_in(gyro + b"\x55" + gyro) == [(2, (1, 2, 3))]
    for size in range(len(gyro)):
        assert reports_in(gyro[:size]) == []


def test_chips_are_refused_by_what_they_say_at_once() -> None:
    with pytest.raises(ImuTrouble, match="imu_other_chip"):
        Mpu6050(Mpu6050Twin(who=0), None)
    with pytest.raises(OSError, match="Remote I/O"):
        Bno085(Bno085Twin(address=0x4B), None)


def test_without_the_library_the_cure_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sensors.imu.bus.LIBRARY", "smbus_that_is_nowhere")
    with pytest.raises(ImuTrouble, match=r"pip install 'pons-robot\[imu\]'"):
        load_library()
    assert "imu_library_missing" in module.CODES
