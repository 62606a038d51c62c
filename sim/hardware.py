"""Define the simulated robot's true hardware, beyond what robot.toml believes of it.

The bridge must cope with these numbers without being told them; calibration has to find them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

from pydantic import ConfigDict, Field

_Gain = Annotated[float, Field(ge=0.2, le=2.0)]


@dataclass(frozen=True, slots=True)
class Hardware:
    """Hold the simulated truth. Errors are one standard deviation."""

    mass_kg: Annotated[float, Field(ge=1.0, le=500.0)] = 20.0
    wheel_radius_m: Annotated[float, Field(ge=0.01, le=1.0)] | None = None
    """None: as robot.toml believes."""
    wheel_separation_m: Annotated[float, Field(ge=0.05, le=3.0)] | None = None
    motor_lag_s: Annotated[float, Field(ge=0.01, le=0.5)] = 0.06
    """First order: wheel speed reaches 63 % of a step after this long."""
    motor_torque_nm: Annotated[float, Field(ge=0.1, le=500.0)] = 6.0
    """Per wheel, also the brake's: 3.6 m/s2 with the rotors' inertia."""
    motor_max_radps: Annotated[float, Field(ge=0.5, le=200.0)] = 15.0
    """1.5 m/s, whatever is asked."""
    dead_zone_radps: Annotated[float, Field(ge=0.0, le=2.0)] = 0.05
    """Swallowed from every command: 5 mm/s; below it nothing turns."""
    left_gain: _Gain = 1.0
    """Share of what is asked, past the dead zone, that this wheel turns at."""
    right_gain: _Gain = 1.0
    timeout_ramp_radps2: Annotated[float, Field(ge=0.5, le=500.0)] = 25.0
    """How the drive itself stops: 2.5 m/s2."""
    encoder_counts: Annotated[int, Field(ge=16, le=1_000_000)] = 16_384
    """Per turn of the wheel: 0.04 mm, and 4 mm/s at 100 Hz."""
    battery_idle_s: Annotated[float, Field(ge=60.0, le=1e6)] = 8 * 3600.0
    """From full to empty, standing."""
    battery_driving_s: Annotated[float, Field(ge=60.0, le=1e6)] = 3 * 3600.0
    gyro_noise_radps: Annotated[float, Field(ge=0.0, le=0.2)] = 0.003
    gyro_bias_radps: Annotated[float, Field(ge=0.0, le=0.2)] = 0.002
    """Drawn once at start."""
    accel_noise_mps2: Annotated[float, Field(ge=0.0, le=5.0)] = 0.05
    lidar_height_m: Annotated[float, Field(ge=0.05, le=2.0)] = 0.20
    lidar_beams: Annotated[int, Field(ge=36, le=1440)] = 360
    lidar_noise_m: Annotated[float, Field(ge=0.0, le=0.2)] = 0.01
    lidar_dropout: Annotated[float, Field(ge=0.0, le=0.9)] = 0.002
    """Share of beams that do not come back though something is there."""
    lidar_sweep_s: Annotated[float, Field(ge=0.0, le=0.2)] = 0.0
    """From a scan's first beam to its last; a real one turns for a whole period. 0: all at once."""
    lidar_range_scale: Annotated[float, Field(ge=0.9, le=1.1)] = 1.0
    """Range read over true range."""
    lidar_x_error_m: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0
    """How much further forward the lidar sits than robot.toml says."""
    lidar_yaw_error_rad: Annotated[float, Field(ge=-0.5, le=0.5)] = 0.0
    """How far the lidar is turned to the left of what robot.toml says."""
    lidar_sector_rad: Annotated[float, Field(ge=0.0, le=6.3)] = 1.5708
    """Width of the sector that the fault ``lidar_sector`` hides."""
    lidar_sector_at_rad: Annotated[float, Field(ge=-3.2, le=3.2)] = 0.0
    """Its middle, in ``base``."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(
        extra="forbid", allow_inf_nan=False, strict=True
    )


@dataclass(frozen=True, slots=True)
class Periods:
    """Fix the simulated rates. All are whole multiples of the physics step."""

    step_s: float = 0.002
    tick_s: float = 0.01  # drive/state and imu
    truth_ticks: int = 2  # 50 Hz
    scene_ticks: int = 4  # 25 Hz: what a camera draws is at most 40 ms old


PERIODS = Periods()
