"""Keep a gyro read: open bus and chip, turn readings into ``imu``, open again what failed.

Told the time by its caller. A chip that does not take its standstill away has it learnt from
readings that do not change, so the robot must stand for a second when this begins.
"""

from __future__ import annotations

import logging
from math import isfinite
from typing import TYPE_CHECKING, Protocol

from devices.inertial import Mounting, StandingBias
from sensors.imu.bno085 import Bno085
from sensors.imu.bus import ImuTrouble
from sensors.imu.mpu6050 import Mpu6050
from wire import Imu, ImuStatus
from wire.geometry import MAX_TURN_RADPS

if TYPE_CHECKING:
    from collections.abc import Callable

    from devices.inertial import InertialReading
    from sensors.imu.bus import I2cBus
    from wire.imu_config import ImuConfig

log = logging.getLogger("imu")

RETRY_S = 1.0
ERRORS = 5
"""Transfers in a row that fail: one is noise, five are a cable."""
FROZEN = 100
"""Equal readings in a row, of all six axes: a chip that lives has noise in each."""
SILENT_S = 0.25
"""As row YAW_DISAGREE has it."""
UNSETTLED_S = 4.0
WINDOW_S = 2.0
_MOST_MPS2 = 1_000.0

CODES: dict[str, tuple[str, str]] = {
    "imu_starting": ("it was just opened: wait, and let the robot stand", "刚刚打开：请保持静止"),
    "imu_unsettled": (
        "let the robot stand still for two seconds; is the chip fixed to it?",
        "请让机器人静止两秒，并检查传感器固定",
    ),
    "i2c_missing": (
        "switch I2C on (raspi-config), or another imu.bus: ls /dev/i2c-*",
        "请启用 I2C（raspi-config），或修改 imu.bus：ls /dev/i2c-*",
    ),
    "i2c_forbidden": (
        "add your user to the group i2c, and log in anew",
        "请将用户加入 i2c 组，然后重新登录",
    ),
    "imu_silent": (
        "SDA, SCL, 3.3 V and ground; i2cdetect -y BUS shows its address",
        "请检查 SDA、SCL、3.3 V 和地线；i2cdetect -y BUS 应显示其地址",
    ),
    "imu_other_chip": (
        "another imu.kind, or another imu.address",
        "请修改 imu.kind 或 imu.address",
    ),
    "imu_reset": (
        "its supply dips: 3.3 V that hold, short wires",
        "供电跌落：请保证 3.3 V，缩短线缆",
    ),
    "imu_frozen": ("take its supply away and give it back", "请断电后重新上电"),
    "imu_library_missing": ("pip install 'pons-robot[imu]'", "pip install 'pons-robot[imu]'"),
}
"""What cures each, in English and Chinese."""


class ImuChip(Protocol):
    """Be one chip that is set and read."""

    name: str
    takes_bias: bool
    """It takes away itself what it says standing."""

    def read(self) -> InertialReading | None:
        """Return a reading in the chip's axes; None where none is new."""


def open_chip(bus: I2cBus, config: ImuConfig) -> ImuChip:
    """Set the chip of robot.toml.

    Raises:
        ImuTrouble: it is another.
        OSError: nothing answers.
    """
    if config.kind == "bno085":
        return Bno085(bus, config.address)
    return Mpu6050(bus, config.address)


class ImuReader:
    """Hold one gyro."""

    def __init__(
        self, config: ImuConfig, open_bus: Callable[[], I2cBus], boot_id: str, now_s: float
    ) -> None:
        self._config, self._open_bus, self._boot_id = config, open_bus, boot_id
        self._mounting = Mounting(config.up, config.forward)
        self._bus: I2cBus | None = None
        self._chip: ImuChip | None = None
        self._bias = StandingBias(is_sure_of_standing=False)
        self._retry_s = self._opened_s = now_s
        self._heard_s: float | None = None
        self._last: InertialReading | None = None
        self._equal = self._failed = 0
        self._trouble: ImuTrouble | None = None
        self.reading: tuple[float, InertialReading] | None = None
        """The newest, as the chip said it, with its time."""
        self.readings = self.errors = self.opened = 0
        self._seq = 0
        self._counted: tuple[float, int] = (now_s, 0)
        self._rate_hz = 0.0

    def turn(self, now_s: float) -> Imu | None:
        """Read once; return what may be passed on."""
        self.reading = None
        if self._chip is None and not self._open(now_s):
            return None
        try:
            reading = self._chip.read() if self._chip else None
        except OSError as error:
            self.errors += 1
            self._failed += 1
            if self._failed >= ERRORS:
                self._lose(ImuTrouble("imu_silent", f"it does not answer: {error}"), now_s)
            return None
        except ImuTrouble as trouble:
            self._lose(trouble, now_s)
            return None
        self._failed = 0
        return None if reading is None else self._take(reading, now_s)

    def judge(self, now_s: float) -> ImuTrouble | None:
        """Return what is wrong now; None where nothing is."""
        if self._trouble is not None:
            return self._trouble
        since_s = now_s - self._opened_s
        if self._heard_s is None or now_s - self._heard_s > SILENT_S:
            if since_s <= 1.0:
                return ImuTrouble("imu_starting", f"{since_s:.1f} s ago")
            return ImuTrouble("imu_silent", "no reading")
        if self._equal >= FROZEN:
            return ImuTrouble("imu_frozen", f"{self._equal} readings are equal in all axes")
        if self._needs_bias and self._bias.bias_radps is None:
            code = "imu_starting" if since_s <= UNSETTLED_S else "imu_unsettled"
            return ImuTrouble(code, "what it says standing is not known yet")
        return None

    def status(self, seq: int, now_s: float) -> ImuStatus:
        """Return what the gyro's process tells people."""
        trouble = self.judge(now_s)
        since_s, before = self._counted
        if now_s - since_s >= WINDOW_S:
            self._rate_hz = (self.readings - before) / (now_s - since_s)
            self._counted = (now_s, self.readings)
        return ImuStatus(
            boot_id=self._boot_id,
            seq=seq,
            stamp_s=now_s,
            model=self._config.kind,
            code=trouble.code if trouble else None,
            detail=trouble.detail[:400] if trouble else "",
            rate_hz=round(self._rate_hz, 1),
            bias_radps=None if self._bias.bias_radps is None else round(self._bias.bias_radps, 5),
            readings=self.readings,
            errors=self.errors,
            opened=self.opened,
        )

    def close(self) -> None:
        """Give the bus back."""
        if self._bus is not None:
            self._bus.close()
        self._bus = self._chip = None

    @property
    def _needs_bias(self) -> bool:
        return self._chip is None or not self._chip.takes_bias

    def _open(self, now_s: float) -> bool:
        if now_s < self._retry_s:
            return False
        self._retry_s = now_s + RETRY_S
        try:
            self._bus = self._open_bus()
            self._chip = open_chip(self._bus, self._config)
        except ImuTrouble as trouble:
            self._lose(trouble, now_s)
            return False
        except OSError as error:
            self.errors += 1
            self._lose(ImuTrouble("imu_silent", f"nothing answers: {error}"), now_s)
            return False
        self.opened += 1
        self._opened_s, self._trouble, self._failed = now_s, None, 0
        self._bias = StandingBias(is_sure_of_standing=False)
        return True

    def _lose(self, trouble: ImuTrouble, now_s: float) -> None:
        self.close()
        self._trouble, self._retry_s = trouble, now_s + RETRY_S

    def _take(self, reading: InertialReading, now_s: float) -> Imu | None:
        self.readings += 1
        self._heard_s, self.reading = now_s, (now_s, reading)
        self._equal = self._equal + 1 if reading == self._last else 0
        self._last = reading
        forward_mps2, left_mps2, _ = self._mounting.turn(reading.accel_mps2)
        rate_radps: float | None = self._mounting.turn(reading.gyro_radps)[2]
        if self._needs_bias and rate_radps is not None:
            rate_radps = self._bias.correct(rate_radps, now_s, stands=True)
        if rate_radps is None or self._equal >= FROZEN:
            return None
        if not all(map(isfinite, (rate_radps, forward_mps2, left_mps2))):
            return None
        self._seq += 1
        return Imu(
            boot_id=self._boot_id,
            seq=self._seq,
            stamp_s=now_s,
            yaw_rate_radps=min(max(rate_radps, -MAX_TURN_RADPS), MAX_TURN_RADPS),
            accel_x_mps2=min(max(forward_mps2, -_MOST_MPS2), _MOST_MPS2),
            accel_y_mps2=min(max(left_mps2, -_MOST_MPS2), _MOST_MPS2),
        )
