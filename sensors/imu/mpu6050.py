"""Read an MPU-6050, or one of its kin with the same registers (MPU-6500, MPU-9250).

Registers by InvenSense' "MPU-6000 and MPU-6050 Register Map", revision 4.2. Not tried on a chip.
"""

from __future__ import annotations

import time
from math import radians
from struct import Struct
from typing import TYPE_CHECKING, Final

from devices.inertial import InertialReading, mps2_of
from sensors.imu.bus import ImuTrouble

if TYPE_CHECKING:
    from collections.abc import Callable

    from sensors.imu.bus import I2cBus

RATE_DIVIDER, CONFIG, GYRO_CONFIG, ACCEL_CONFIG = 0x19, 0x1A, 0x1B, 0x1C
READINGS, POWER, WHO_AM_I = 0x3B, 0x6B, 0x75
KNOWN: Final = {0x68: "MPU-6050", 0x70: "MPU-6500", 0x71: "MPU-9250", 0x98: "MPU-6050 (copy)"}
RESET, AWAKE = 0x80, 0x01
"""Awake, and by the gyro's own clock, which is steadier than the chip's."""
SETTINGS: Final = {
    RATE_DIVIDER: 9,  # 1 kHz by 10
    CONFIG: 3,  # filtered at 42 Hz: nothing that turns 100 times a second is wanted
    GYRO_CONFIG: 1 << 3,  # 500 degrees a second; a robot turns by at most 230
    ACCEL_CONFIG: 1 << 3,  # 4 g
    POWER: AWAKE,
}
RADPS_A_STEP: Final = radians(1.0 / 65.5)
MPS2_A_STEP: Final = mps2_of(1.0 / 8192.0)
RESET_S: Final = 0.1
CHECK_EACH: Final = 50
"""Readings between two looks whether it still has its settings: a dip of its supply resets it."""
_SAMPLE: Final = Struct(">hhhhhhh")


class Mpu6050:
    """Hold one chip."""

    name = "mpu6050"
    takes_bias = False
    """It says what it measures, its own standstill included."""

    def __init__(
        self, bus: I2cBus, address: int | None, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        """Reset and set it.

        Raises:
            ImuTrouble: ``imu_other_chip`` or ``imu_deaf``.
            OSError: nothing answers.
        """
        self._bus, self._address = bus, address or 0x68
        self._count = 0
        said = self._bus.ask(self._address, WHO_AM_I, 1)[0]
        if said not in KNOWN:
            names = ", ".join(f"0x{number:02x} ({name})" for number, name in KNOWN.items())
            text = f"WHO_AM_I is 0x{said:02x} at 0x{self._address:02x}; expected {names}"
            raise ImuTrouble("imu_other_chip", text)
        self._set(POWER, RESET)
        sleep(RESET_S)
        for register, value in reversed(SETTINGS.items()):  # awake first: asleep it takes nothing
            self._set(register, value)
        self._check()

    def read(self) -> InertialReading | None:
        """Return a reading, in the chip's axes.

        Raises:
            ImuTrouble: ``imu_reset``: it lost its settings.
            OSError: it does not answer.
        """
        self._count += 1
        if self._count % CHECK_EACH == 0:
            self._check()
        ax, ay, az, _, gx, gy, gz = _SAMPLE.unpack(
            self._bus.ask(self._address, READINGS, _SAMPLE.size)
        )
        return InertialReading(
            (gx * RADPS_A_STEP, gy * RADPS_A_STEP, gz * RADPS_A_STEP),
            (ax * MPS2_A_STEP, ay * MPS2_A_STEP, az * MPS2_A_STEP),
        )

    def _check(self) -> None:
        for register, value in SETTINGS.items():
            said = self._bus.ask(self._address, register, 1)[0]
            if said != value:
                text = f"register 0x{register:02x} says 0x{said:02x}, 0x{value:02x} was written"
                raise ImuTrouble("imu_reset", text)

    def _set(self, register: int, value: int) -> None:
        self._bus.write(self._address, bytes([register, value]))
