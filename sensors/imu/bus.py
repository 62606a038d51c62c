"""Speak to chips on an I2C bus. smbus2 does it, an extra that is loaded when a bus is opened.

A transfer may wait: a chip may hold the clock (BNO085), and a Raspberry Pi's controller up to model
4 handles that badly. So it happens in a process of its own, never in the bridge.
"""

from __future__ import annotations

import errno
import importlib
from typing import Any, Final, Protocol

LIBRARY: Final = "smbus2"


class ImuTrouble(Exception):
    """A gyro can't be read at present. The code is stable; ``detail`` says what came."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code, self.detail = code, detail


class I2cBus(Protocol):
    """Be an I2C bus. What a chip does not answer raises OSError."""

    def write(self, address: int, data: bytes) -> None:
        """Write bytes to a chip."""

    def read(self, address: int, count: int) -> bytes:
        """Read bytes from a chip."""

    def ask(self, address: int, register: int, count: int) -> bytes:
        """Write a register's number and read from there, without a stop between the two."""

    def close(self) -> None:
        """Give the bus back."""


class SmBus:
    """Be a bus of the kernel."""

    def __init__(self, number: int) -> None:
        """Open /dev/i2c-NUMBER.

        Raises:
            ImuTrouble: ``imu_library_missing``, ``i2c_missing`` or ``i2c_forbidden``.
        """
        library = load_library()
        self._message = library.i2c_msg
        try:
            self._bus = library.SMBus(number)
        except OSError as error:
            forbidden = error.errno in (errno.EACCES, errno.EPERM)
            code = "i2c_forbidden" if forbidden else "i2c_missing"
            raise ImuTrouble(code, f"/dev/i2c-{number}: {error.strerror}") from None

    def write(self, address: int, data: bytes) -> None:
        """Write bytes to a chip."""
        self._bus.i2c_rdwr(self._message.write(address, data))

    def read(self, address: int, count: int) -> bytes:
        """Read bytes from a chip."""
        asked = self._message.read(address, count)
        self._bus.i2c_rdwr(asked)
        return bytes(asked)

    def ask(self, address: int, register: int, count: int) -> bytes:
        """Write a register's number and read from there, without a stop between the two."""
        asked = self._message.read(address, count)
        self._bus.i2c_rdwr(self._message.write(address, [register]), asked)
        return bytes(asked)

    def close(self) -> None:
        """Give the bus back."""
        self._bus.close()


def load_library() -> Any:
    """Return smbus2.

    Raises:
        ImuTrouble: ``imu_library_missing``.
    """
    try:
        return importlib.import_module(LIBRARY)
    except ImportError:
        text = "smbus2 is not installed; pip install 'pons-robot[imu]'"
        raise ImuTrouble("imu_library_missing", text) from None
