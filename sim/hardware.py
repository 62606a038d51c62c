"""State what the simulated robot is really like, beyond what robot.toml believes of it.

The bridge must cope with these numbers without being told them; calibration has to find them.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Hardware:
    """Hold the simulated truth. Errors are one standard deviation."""

    mass_kg: float = 20.0
    motor_lag_s: float = 0.06  # first order: wheel speed reaches 63 % of a step after this long
    motor_torque_nm: float = 6.0  # per wheel, also the brake's: 3.6 m/s2 with the rotors' inertia
    motor_max_radps: float = 15.0  # 1.5 m/s, whatever is asked
    dead_zone_radps: float = 0.05  # swallowed from every command: 5 mm/s; below it nothing turns
    timeout_ramp_radps2: float = 25.0  # how the drive itself stops: 2.5 m/s2
    encoder_counts: int = 16_384  # per turn of the wheel: 0.04 mm, and 4 mm/s at 100 Hz
    battery_idle_s: float = 8 * 3600.0  # from full to empty, standing
    battery_driving_s: float = 3 * 3600.0
    gyro_noise_radps: float = 0.003
    gyro_bias_radps: float = 0.002  # drawn once at start
    accel_noise_mps2: float = 0.05
    lidar_height_m: float = 0.20
    lidar_beams: int = 360
    lidar_noise_m: float = 0.01
    lidar_dropout: float = 0.002  # share of beams that do not come back though something is there


@dataclass(frozen=True, slots=True)
class Periods:
    """Fix the simulated rates. All are whole multiples of the physics step."""

    step_s: float = 0.002
    tick_s: float = 0.01  # drive/state and imu
    truth_ticks: int = 2  # 50 Hz


PERIODS = Periods()
