"""Turn the readings of a base's own gyro into the ``imu`` that the bridge judges by.

Its bias is learnt while the wheels stand; until then nothing is passed on, and the row
YAW_DISAGREE is up. What goes beyond the wire's bounds stays "far too fast", of the same sign.
"""

from __future__ import annotations

from collections import deque
from math import isfinite
from typing import TYPE_CHECKING

from devices.inertial import Mounting, StandingBias
from wire import Imu
from wire.geometry import MAX_TURN_RADPS

if TYPE_CHECKING:
    from devices.inertial import InertialReading
    from wire import DriveState, RobotDescription

STANDING_RADPS = 0.02
"""Of both wheels: less than any base's step of speed."""
KEPT = 16
_MOST_MPS2 = 1_000.0


class BaseGyro:
    """Hold the newest reading of one base's gyro."""

    def __init__(self, robot: RobotDescription) -> None:
        imu = robot.imu
        self._wanted = robot.inputs.imu and not imu.is_on_i2c
        self._mounting = Mounting(imu.up, imu.forward)
        self._bias = StandingBias(is_sure_of_standing=True)
        self._boot_id: str | None = None
        self._seq = 0
        self._newest: Imu | None = None
        self.heard: deque[tuple[float, InertialReading]] = deque(maxlen=KEPT)
        """The last readings as they came, with their stamps, for `pons robot try`."""

    def note(self, reading: InertialReading | None, state: DriveState) -> None:
        """Take the reading that came with a state; None where the base told none that can be."""
        if reading is None or not self._wanted:
            return
        self.heard.append((state.stamp_s, reading))
        if state.boot_id != self._boot_id:
            self._boot_id, self._bias = state.boot_id, StandingBias(is_sure_of_standing=True)
        stands = max(abs(state.left_radps), abs(state.right_radps)) <= STANDING_RADPS
        forward_mps2, left_mps2, _ = self._mounting.turn(reading.accel_mps2)
        yaw_radps = self._mounting.turn(reading.gyro_radps)[2]
        rate_radps = self._bias.correct(yaw_radps, state.stamp_s, stands=stands)
        if rate_radps is None or not (isfinite(forward_mps2) and isfinite(left_mps2)):
            return
        self._seq += 1
        self._newest = Imu(
            boot_id=state.boot_id,
            seq=self._seq,
            stamp_s=state.stamp_s,
            yaw_rate_radps=_hold(rate_radps, MAX_TURN_RADPS),
            accel_x_mps2=_hold(forward_mps2, _MOST_MPS2),
            accel_y_mps2=_hold(left_mps2, _MOST_MPS2),
        )

    def take(self) -> Imu | None:
        """Return the newest reading, once."""
        newest, self._newest = self._newest, None
        return newest


def _hold(value: float, most: float) -> float:
    return min(max(value, -most), most)
