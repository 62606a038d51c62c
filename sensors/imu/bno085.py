"""Read a BNO085 (BNO080, BNO086): reports of its sensor hub, in packets of SHTP over I2C.

By CEVA's "Sensor Hub Transport Protocol" 1.7 and "SH-2 Reference Manual" 1.2. It fuses and takes
its bias away itself. It holds the bus's clock now and then, which a Raspberry Pi up to model 4 does
not bear well: 400 kHz helps (docs/sensors.md). Not tried on a chip.
"""

from __future__ import annotations

import time
from struct import Struct
from typing import TYPE_CHECKING, Final

from devices.inertial import InertialReading
from sensors.imu.bus import ImuTrouble

if TYPE_CHECKING:
    from collections.abc import Callable

    from devices.inertial import Vector
    from sensors.imu.bus import I2cBus

CONTROL, INPUTS = 2, 3
"""Channels of SHTP."""
PRODUCT_REQUEST, PRODUCT, SET_FEATURE, TIMEBASE = 0xF9, 0xF8, 0xFD, 0xFB
ACCELEROMETER, GYROSCOPE = 0x01, 0x02
"""Calibrated: m/s2 by 256 and rad/s by 512."""
SIZES: Final = {ACCELEROMETER: 10, GYROSCOPE: 10, TIMEBASE: 5, 0xFA: 5}
INTERVAL_US: Final = 10_000
LONGEST: Final = 512
MOST_PACKETS: Final = 8
ANSWER_S: Final = 1.0
PAUSE_S: Final = 0.01
CONTINUED: Final = 0x8000
_HEAD: Final = Struct("<HBB")
_FEATURE: Final = Struct("<BBBHIII")
_VECTOR: Final = Struct("<hhh")


class Bno085:
    """Hold one chip."""

    name = "bno085"
    takes_bias = True

    def __init__(
        self, bus: I2cBus, address: int | None, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        """Ask what it is, and for its reports.

        Raises:
            ImuTrouble: ``imu_other_chip``: it does not answer as a sensor hub does.
            OSError: nothing answers.
        """
        self._bus, self._address = bus, address or 0x4A
        self._sequences = [0] * 6
        self._accel: Vector = (0.0, 0.0, 0.0)
        self._send(CONTROL, bytes([PRODUCT_REQUEST, 0]))
        for _ in range(round(ANSWER_S / PAUSE_S)):
            if any(channel == CONTROL and cargo[:1] == bytes([PRODUCT])
                   for channel, cargo in self._receive()):  # fmt: skip
                break
            sleep(PAUSE_S)
        else:
            text = f"at 0x{self._address:02x} nothing answers as a BNO085 within {ANSWER_S:g} s"
            raise ImuTrouble("imu_other_chip", text)
        for report in (ACCELEROMETER, GYROSCOPE):
            told = _FEATURE.pack(SET_FEATURE, report, 0, 0, INTERVAL_US, 0, 0)
            self._send(CONTROL, told)

    def read(self) -> InertialReading | None:
        """Return the newest reading in the chip's axes; None where no turn was reported since.

        Raises:
            OSError: it does not answer.
        """
        newest: Vector | None = None
        for channel, cargo in self._receive():
            if channel == INPUTS:
                for report, vector in reports_in(cargo):
                    x, y, z = vector
                    if report == ACCELEROMETER:
                        self._accel = (x / 256.0, y / 256.0, z / 256.0)
                    else:
                        newest = (x / 512.0, y / 512.0, z / 512.0)
        return None if newest is None else InertialReading(newest, self._accel)

    def _receive(self) -> list[tuple[int, bytes]]:
        """Return the packets that wait."""
        found = []
        for _ in range(MOST_PACKETS):
            length, channel, _ = _HEAD.unpack(self._bus.read(self._address, _HEAD.size))
            length &= ~CONTINUED
            if length <= _HEAD.size or length == CONTINUED - 1:
                break
            packet = self._bus.read(self._address, min(length, LONGEST))
            if length <= LONGEST:  # its list of channels is longer, and nothing that is wanted
                found.append((channel, packet[_HEAD.size :]))
        return found

    def _send(self, channel: int, cargo: bytes) -> None:
        head = _HEAD.pack(len(cargo) + _HEAD.size, channel, self._sequences[channel])
        self._sequences[channel] = (self._sequences[channel] + 1) % 256
        self._bus.write(self._address, head + cargo)


def reports_in(cargo: bytes) -> list[tuple[int, tuple[int, int, int]]]:
    """Return a packet's reports of turn and acceleration; what follows an unknown one is lost."""
    found, at = [], 0
    while at < len(cargo):
        report = cargo[at]
        size = SIZES.get(report)
        if size is None or at + size > len(cargo):
            break
        if report in (ACCELEROMETER, GYROSCOPE):
            x, y, z = _VECTOR.unpack_from(cargo, at + 4)
            found.append((report, (x, y, z)))
        at += size
    return found
