"""A gyro that is turned left says so, or the trial names how it sits."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import nan, pi

import pytest

from bridge.drive.base_gyro import KEPT
from devices.inertial import InertialReading, Mounting, Vector
from pons.robot.gyro_trial import STILL_S, BaseGyroSource, I2cGyroSource, Timed, try_gyro
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_words import PROMPTS, REFUSALS
from sim.twin.imu_chips import Mpu6050Twin
from tests.pons.robot.stand import Stand
from wire import Imu, RobotDescription
from wire.imu_config import ImuConfig

TICK_S = 0.01
TURN_S = 2.0


@dataclass
class Bench:
    """Be a gyro on a bench, its time, and a hand that turns it when asked."""

    about: Vector = (0.0, 0.0, 1.0)
    """In the sensor's axes: about what a turn of the robot to the left turns it."""
    angle_rad: float = pi / 2
    bias: Vector = (0.02, -0.01, 0.03)
    shakes_radps: float = 0.004
    says_until_s: float = 1e9
    time_s: float = 50.0
    asked: list[str] = field(default_factory=list)
    _left: int = 0
    _count: int = 0

    def now_s(self) -> float:
        return self.time_s

    def wait(self) -> None:
        self.time_s += TICK_S
        self._left = max(0, self._left - 1)
        self._count += 1

    def ask(self, code: str) -> None:
        self.asked.append(code)
        self._left = round(TURN_S / TICK_S)

    def has_answered(self) -> bool:
        return bool(self.asked) and self._left == 0

    def tell(self, step: str, seen: str = "") -> None:
        pass

    def require_watch(self) -> None:
        pass

    def readings(self) -> list[Timed]:
        if self.time_s > self.says_until_s or self._count % 2:
            return []
        rate = self.angle_rad / TURN_S if self._left else 0.0
        x, y, z = (
            bias + rate * share + self.shakes_radps * (-1) ** (self._count // 2)
            for bias, share in zip(self.bias, self.about, strict=True)
        )
        return [(self.time_s, InertialReading((x, y, z), (0.0, 0.0, 9.8)))]


def tried(bench: Bench, imu: ImuConfig | None = None) -> float:
    return try_gyro(imu or ImuConfig(), bench, bench, bench)


def refused(bench: Bench, imu: ImuConfig | None = None) -> TrialRefusal:
    with pytest.raises(TrialRefusal) as told:
        tried(bench, imu)
    assert told.value.code in REFUSALS
    assert set(bench.asked) <= set(PROMPTS)
    return told.value


def test_a_quarter_to_the_left_is_read_without_what_it_says_standing() -> None:
    assert tried(Bench()) == pytest.approx(pi / 2, abs=0.03)


@pytest.mark.parametrize("up", ["x", "-x", "y", "-y", "z", "-z"])
def test_a_gyro_that_sits_otherwise_is_told_how(up: str) -> None:
    sign = -1.0 if up.startswith("-") else 1.0
    about = tuple(sign * (up[-1] == axis) for axis in "xyz")
    bench = Bench(about=(about[0], about[1], about[2]))
    right = ImuConfig.model_validate({"up": up, "forward": "y" if up[-1] != "y" else "x"})
    assert Mounting(up, right.forward).turn(bench.about)[2] == 1.0
    assert tried(bench, right) == pytest.approx(pi / 2, abs=0.03)
    if up != "z":
        told = refused(Bench(about=bench.about))
        assert told.code == ("gyro_backwards" if up == "-z" else "gyro_axis")
        assert f"may be {up!r}" in told.detail


@pytest.mark.parametrize(
    ("bench", "code"),
    [
        (Bench(angle_rad=0.0), "gyro_none"),
        (Bench(angle_rad=0.4), "gyro_none"),
        (Bench(bias=(0.0, 0.0, 0.6)), "gyro_shakes"),
        (Bench(shakes_radps=0.2), "gyro_shakes"),
        (Bench(bias=(nan, 0.0, 0.0)), "gyro_shakes"),
        (Bench(says_until_s=50.1), "gyro_silent"),
        (Bench(says_until_s=50.0 + STILL_S), "gyro_silent"),
        (Bench(about=(0.7, 0.0, 0.7)), "gyro_axis"),
    ],
)
def test_each_wrong_gyro_has_its_name(bench: Bench, code: str) -> None:
    assert refused(bench).code == code


def test_the_gyro_of_a_base_is_read_through_the_bridges_own_drive() -> None:
    robot = RobotDescription.model_validate({
        "base": {"wheel_radius_m": 0.04, "wheel_separation_m": 0.172, "radius_m": 0.18},
        "limits": {"max_speed_mps": 0.4, "max_wheel_radps": 15.0},
        "drive": {"kind": "waveshare", "port": "/dev/x"},
    })  # fmt: skip
    stand = Stand(robot)
    for _ in range(300):
        stand.drive.write(None)
        stand.drive.ask()
        stand.drive.read()
        stand.wait()
    source = BaseGyroSource(stand.drive)
    with pytest.raises(TrialRefusal, match="gyro_silent"):
        try_gyro(robot.imu, source, stand, stand)  # its heartbeat was never set: it counts not
    stand = Stand(robot)
    source = BaseGyroSource(stand.drive)
    for _ in range(400):
        stand.command_zero()
        stand.drive.read()
        stand.wait()
    assert len(source.readings()) <= KEPT
    assert try_gyro(robot.imu, source, stand, stand) == pytest.approx(pi / 2, abs=0.1)


def test_a_robot_without_a_gyro_of_its_own_has_no_readings() -> None:
    drive = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 400}
    stand = Stand(RobotDescription.model_validate({"drive": drive}))
    assert BaseGyroSource(stand.drive).readings() == []
    assert isinstance(stand.drive.take_imu(), Imu | None)


CHIP = ImuConfig(kind="mpu6050", bus=1, address=0x68)


@dataclass
class ChipBench(Bench):
    """Turn a chip on an I2C bus; what it says is read as its process reads it."""

    chip: Mpu6050Twin = field(default_factory=Mpu6050Twin)
    unplugged_from_s: float = 1e9

    def __post_init__(self) -> None:
        robot = RobotDescription(imu=CHIP)
        self.source = I2cGyroSource(robot, lambda: self.chip, self.now_s)

    def readings(self) -> list[Timed]:
        self.chip.is_plugged = self.time_s < self.unplugged_from_s
        rate_radps = self.angle_rad / TURN_S if self._left else 0.0
        at = {"boot_id": "b", "seq": 1, "stamp_s": self.time_s}
        moved = {"yaw_rate_radps": rate_radps, "accel_x_mps2": 0.0, "accel_y_mps2": 0.0}
        self.chip.feel(Imu.model_validate(at | moved))
        return self.source.readings()


def test_a_chip_on_i2c_is_tried_as_the_bases_own_is() -> None:
    bench = ChipBench()
    assert tried(bench, CHIP) == pytest.approx(pi / 2, abs=0.1)
    bench.source.close()
    assert bench.chip.closed == 1


def test_a_chip_on_i2c_that_turns_right_is_named() -> None:
    assert refused(ChipBench(angle_rad=-pi / 2), CHIP).code == "gyro_backwards"


def test_a_chip_that_does_not_answer_is_named_with_its_own_code() -> None:
    told = refused(ChipBench(unplugged_from_s=0.0), CHIP)
    assert told.code == "gyro_silent"
    assert "imu_silent" in told.detail
