"""Act as gyro chips on an I2C bus, register by register and packet by packet.

What they read is handed in; what a chip says standing, its noise and its faults are its own.
"""

from __future__ import annotations

import errno
import struct
from math import degrees
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire import Imu

_G_MPS2 = 9.80665
_NOTHING = OSError(errno.EREMOTEIO, "Remote I/O error")
"""What Linux says where no chip acknowledges."""


class Mpu6050Twin:
    """Be a bus with an MPU-6050 on it."""

    def __init__(self, address: int = 0x68, who: int = 0x68, offset_radps: float = 0.05) -> None:
        self.address, self.who, self.offset_radps = address, who, offset_radps
        self.is_plugged = True
        self.is_frozen = False
        self.spoilt = 0
        """So many of the next transfers fail."""
        self._registers = bytearray(128)
        self._noise = 0
        self._yaw_radps = self._ax_mps2 = self._ay_mps2 = 0.0
        self.closed = 0
        self.dip()

    def dip(self) -> None:
        """Come up anew, as after a dip of the supply: asleep, and without settings."""
        self._registers = bytearray(128)
        self._registers[0x6B] = 0x40
        self._registers[0x75] = self.who

    def feel(self, imu: Imu) -> None:
        """Take what the body does."""
        self._yaw_radps = imu.yaw_rate_radps
        self._ax_mps2, self._ay_mps2 = imu.accel_x_mps2, imu.accel_y_mps2

    def write(self, address: int, data: bytes) -> None:
        """Take a register's number and its value."""
        self._answer(address)
        register, value = data
        if register == 0x6B and value & 0x80:
            self.dip()
        elif register == 0x6B or not self._registers[0x6B] & 0x40:  # asleep it takes nothing else
            self._registers[register] = value

    def read(self, address: int, count: int) -> bytes:
        """Read without a register: it answers from the last one, which nobody here uses."""
        self._answer(address)
        return bytes(count)

    def ask(self, address: int, register: int, count: int) -> bytes:
        """Return registers."""
        self._answer(address)
        if register == 0x3B and not self._registers[0x6B] & 0x40 and not self.is_frozen:
            self._measure()
        return bytes(self._registers[register : register + count])

    def close(self) -> None:
        """Count it."""
        self.closed += 1

    def _answer(self, address: int) -> None:
        if self.spoilt:
            self.spoilt -= 1
            raise _NOTHING
        if not self.is_plugged or address != self.address:
            raise _NOTHING

    def _measure(self) -> None:
        steps = 65.5 * 2.0 ** (1 - (self._registers[0x1B] >> 3 & 3))  # 131, 65.5, 32.8, 16.4
        counts = 8192 * 2.0 ** (1 - (self._registers[0x1C] >> 3 & 3))
        self._noise = (self._noise * 1103515245 + 12345) % 2**31
        noise = self._noise // 65536 % 7 - 3
        yaw = degrees(self._yaw_radps + self.offset_radps) * steps + noise
        accel = [value / _G_MPS2 * counts for value in (self._ax_mps2, self._ay_mps2, _G_MPS2)]
        values = [*accel, 0.0, float(noise), float(-noise), yaw]
        held = [min(max(round(value), -32_768), 32_767) for value in values]
        struct.pack_into(">7h", self._registers, 0x3B, *held)


class Bno085Twin:
    """Be a bus with a BNO085 on it: it speaks in packets, and takes its own bias away."""

    def __init__(self, address: int = 0x4A) -> None:
        self.address = address
        self.is_plugged = True
        self.wanted: dict[int, int] = {}
        """Reports that were asked for, with their interval [us]."""
        self.closed = 0
        self._packets: list[bytes] = [self._packet(0, bytes(300))]  # its list of channels
        self._half_read = False
        self._feels = (0.0, 0.0, 0.0)

    def feel(self, imu: Imu) -> None:
        """Take what the body does; a packet of reports is made of it where these were asked for."""
        self._feels = imu.yaw_rate_radps, imu.accel_x_mps2, imu.accel_y_mps2
        cargo = b"\xfb" + bytes(4)
        if 0x01 in self.wanted:
            accel = [round(256 * value) for value in (*self._feels[1:], _G_MPS2)]
            cargo += b"\x01\x00\x03\x00" + struct.pack("<hhh", *accel)
        if 0x02 in self.wanted:
            cargo += b"\x02\x00\x03\x00" + struct.pack("<hhh", 0, 0, round(512 * self._feels[0]))
            self._packets.append(self._packet(3, cargo))

    def write(self, address: int, data: bytes) -> None:
        """Take a packet."""
        self._answer(address)
        length, channel, _ = struct.unpack_from("<HBB", data)
        cargo = data[4:]
        if length != len(data) or channel != 2:
            return
        if cargo[0] == 0xF9:
            self._packets.append(self._packet(2, b"\xf8" + bytes(15)))
        elif cargo[0] == 0xFD and len(cargo) == 17:
            self.wanted[cargo[1]] = struct.unpack_from("<I", cargo, 5)[0]

    def read(self, address: int, count: int) -> bytes:
        """Return the waiting packet's head, and read once more the whole of it."""
        self._answer(address)
        if not self._packets:
            return bytes(count)
        packet = self._packets[0]
        if count > 4:
            self._packets.pop(0)
        return (packet + bytes(count))[:count]

    def ask(self, address: int, register: int, count: int) -> bytes:
        """Refuse: it has no registers."""
        raise _NOTHING

    def close(self) -> None:
        """Count it."""
        self.closed += 1

    def _answer(self, address: int) -> None:
        if not self.is_plugged or address != self.address:
            raise _NOTHING

    def _packet(self, channel: int, cargo: bytes) -> bytes:
        return struct.pack("<HBB", len(cargo) + 4, channel, 0) + cargo
