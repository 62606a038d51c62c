"""Act as a Waveshare UGV base with ugv_base_ros 0.96, as its source was read.

It starts with words and a heartbeat of 3 s, keeps no setting, obeys wheel speeds only as numbers of
which neither is beyond 2 m/s, prints a line back only if told to, and stops once after its
heartbeat without telling anybody.
"""

from __future__ import annotations

import json
from math import degrees, trunc
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from wire import DriveState, Imu, RobotDescription

START_S = 1.5
"""The real one needs about eight; it says nothing of its wheels meanwhile, and hears nothing."""
_WORDS = b"Device connected!\r\nDMP enabled!\r\nInitialize LittleFS for Flash files ctrl.\r\n"
_STARTED = b"UGV started.\r\n"
_REPORT_S = 0.05
_DEFAULT_HEARTBEAT_MS = 3000
_FASTEST_MPS = 2.0
_LONGEST = 1024
_G_MPS2 = 9.80665
_GYRO_OFFSET = 30
"""Steps that its gyro says standing: 1.8 degrees a second."""
_EMPTY_V, _FULL_V = 9.6, 12.6
"""Three lithium cells, where robot.toml names no voltages."""


class WaveshareFirmware:
    """Obey JSON lines, count centimetres, and stop by itself."""

    def __init__(self, robot: RobotDescription) -> None:
        self._radius_m = robot.base.wheel_radius_m
        self._empty_v = robot.drive.battery_empty_v or _EMPTY_V
        self._full_v = robot.drive.battery_full_v or _FULL_V
        self._rest = b""
        self._said = b""
        self._left_mps = self._right_mps = 0.0
        self._heartbeat_ms = _DEFAULT_HEARTBEAT_MS
        self._prints, self._echoes, self._reports = True, False, True
        self._delay_s = 0.0
        self._heard_s = 0.0
        self._stopped = True
        self._began_s: float | None = None
        self._started = False
        self._reported_s = 0.0
        self._zero: tuple[float, float] | None = None
        self._felt: Imu | None = None

    def hear(self, data: bytes, now_s: float) -> None:
        """Take the bytes that arrived; while it starts, none."""
        if self._begin(now_s):
            return
        *lines, self._rest = (self._rest + data).split(b"\n")
        self._rest = self._rest[-_LONGEST:]
        for line in lines:
            self._obey(line, now_s)

    def motors(self, now_s: float) -> tuple[float, float, bool]:
        """Return left and right [rad/s] and whether there is torque; speed 0 is a short brake."""
        if not self._stopped and (now_s - self._heard_s) * 1000.0 > self._heartbeat_ms:
            self._stopped = True
            self._left_mps = self._right_mps = 0.0
        left_radps, right_radps = self._left_mps / self._radius_m, self._right_mps / self._radius_m
        return left_radps, right_radps, left_radps != 0.0 or right_radps != 0.0

    def feel(self, imu: Imu) -> None:
        """Take what the body's gyro reads now."""
        self._felt = imu

    def say(self, body: DriveState, now_s: float) -> bytes:
        """Return what it printed back, and every 50 ms its report."""
        if self._zero is None:
            self._zero = body.left_rad, body.right_rad
        said, self._said = self._said, b""
        due_s = _REPORT_S + self._delay_s
        if self._started and self._reports and now_s - self._reported_s >= due_s - 1e-6:
            self._reported_s = now_s
            said += json.dumps(self._report(body, *self._zero), separators=(",", ":")).encode()
            said += b"\r\n"
        return said

    def _begin(self, now_s: float) -> bool:
        """Tell whether it is still starting."""
        if self._began_s is None:
            self._began_s, self._said = now_s, _WORDS
        if not self._started and now_s - self._began_s >= START_S:
            self._started = True
            self._said += _STARTED
        return not self._started

    def _obey(self, line: bytes, now_s: float) -> None:
        try:
            said = json.loads(line)
        except (ValueError, RecursionError):
            return
        if not isinstance(said, dict):
            return
        if self._prints and self._echoes:
            self._said += line + b"\n"
        kind, value = said.get("T"), said.get("cmd")
        if kind == 1:
            self._drive(said.get("L"), said.get("R"), now_s)
        elif isinstance(value, int):
            self._set(kind, value)

    def _drive(self, left: Any, right: Any, now_s: float) -> None:
        if not (isinstance(left, int | float) and isinstance(right, int | float)):
            return
        self._stopped, self._heard_s = False, now_s
        if abs(left) <= _FASTEST_MPS and abs(right) <= _FASTEST_MPS:
            self._left_mps, self._right_mps = float(left), float(right)

    def _set(self, kind: Any, value: int) -> None:
        if kind == 136:
            self._heartbeat_ms = value
        elif kind == 605:
            self._prints = value == 1
        elif kind == 143:
            self._echoes = bool(value)
        elif kind == 131:
            self._reports = bool(value)
        elif kind == 142:
            self._delay_s = abs(value) / 1000.0

    def _report(self, body: DriveState, left_rad: float, right_rad: float) -> dict[str, Any]:
        felt = self._felt
        yaw_radps, ax_mps2, ay_mps2 = (
            (felt.yaw_rate_radps, felt.accel_x_mps2, felt.accel_y_mps2) if felt else (0.0,) * 3
        )
        charge = 1.0 if body.battery is None else body.battery
        volts = self._empty_v + charge * (self._full_v - self._empty_v)
        return {
            "T": 1001,
            "L": round(body.left_radps * self._radius_m, 5),
            "R": round(body.right_radps * self._radius_m, 5),
            "ax": _raw(ax_mps2 / _G_MPS2 * 8192), "ay": _raw(ay_mps2 / _G_MPS2 * 8192), "az": 8192,
            "gx": 0, "gy": 0, "gz": _raw(degrees(yaw_radps) * 16.4) + _GYRO_OFFSET,
            "mx": 100, "my": -20, "mz": 7,
            "odl": trunc((body.left_rad - left_rad) * self._radius_m * 100.0),
            "odr": trunc((body.right_rad - right_rad) * self._radius_m * 100.0),
            "v": round(volts * 100.0),
        }  # fmt: skip


def _raw(steps: float) -> int:
    """Return what 16 bits hold of it."""
    return min(max(round(steps), -32_768), 32_767)
