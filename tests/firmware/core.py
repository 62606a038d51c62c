"""Call the firmware's core, built for this computer (firmware/simulated/host.c)."""

from __future__ import annotations

import ctypes
from ctypes import Structure, byref, c_bool, c_int16, c_int32, c_uint8, c_uint16, c_uint32
from pathlib import Path

from devices.pons_mcu import NOT_MEASURED, McuReader, McuState

STATE_BYTES = 47


class Encoder(Structure):
    """What an encoder's interrupt has counted, and when [us]."""

    _fields_ = [("ticks", c_int32), ("edge_us", c_uint32)]


class Motor(Structure):
    """What config.h says of the motors."""

    _fields_ = [
        ("free_radps", c_uint16),
        ("start_duty", c_uint16),
        ("kp", c_uint16),
        ("ki", c_uint16),
        ("trip_ms", c_uint16),
    ]


class Inputs(Structure):
    """What the pins say."""

    _fields_ = [
        ("stop_pressed", c_bool),
        ("bumper_front", c_bool),
        ("bumper_rear", c_bool),
        ("cliff", c_bool),
        ("current_ma", c_uint16),
        ("battery_mv", c_uint16),
    ]


class Outputs(Structure):
    """What the motors are to do."""

    _fields_ = [("torque", c_bool), ("left_duty", c_int16), ("right_duty", c_int16)]


MOTOR = Motor(20, 60, 30, 150, 500)


def inputs(**given: int) -> Inputs:
    """Return inputs of which nothing is pressed or measured, but for those given."""
    fresh = Inputs(current_ma=NOT_MEASURED, battery_mv=NOT_MEASURED)
    for name, value in given.items():
        setattr(fresh, name, value)
    return fresh


class Core:
    """One controller; the library holds a single one, so begin it anew for each test."""

    def __init__(self, library: Path, boot: int = 0xF0, most_ma: int = 0) -> None:
        self._library = ctypes.CDLL(str(library))
        self._library.host_is_silent.restype = c_bool
        self._library.host_begin(c_uint32(boot), byref(MOTOR), c_uint16(most_ma))

    def hear(self, data: bytes, now_us: int) -> None:
        """Take the bytes that arrived."""
        self._library.host_hear(data, c_uint32(len(data)), c_uint32(now_us))

    def is_silent(self, now_us: int) -> bool:
        """Return whether the time of the newest command is over."""
        return bool(self._library.host_is_silent(c_uint32(now_us)))

    def control(
        self, now_us: int, left: Encoder | None = None, right: Encoder | None = None, **pins: int
    ) -> Outputs:
        """Measure and regulate."""
        outputs = Outputs()
        self._library.host_control(
            left or Encoder(),
            right or Encoder(),
            byref(inputs(**pins)),
            c_uint32(now_us),
            byref(outputs),
        )
        return outputs

    def report(
        self, now_us: int, left: Encoder | None = None, right: Encoder | None = None, **pins: int
    ) -> McuState:
        """Return the state that the controller reports, read by the host's own reader."""
        data = (c_uint8 * STATE_BYTES)()
        self._library.host_report(
            left or Encoder(),
            right or Encoder(),
            byref(inputs(**pins)),
            c_uint32(now_us),
            data,
        )
        (state,) = McuReader().read(bytes(data))
        assert isinstance(state, McuState)
        return state
