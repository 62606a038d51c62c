"""Turn a base's readings into what the wire carries; shared by the protocols."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire.drive_config import DriveConfig

_FASTEST_RADPS = 1000.0


def limit_radps(radps: float) -> float:
    """Return a speed [rad/s] held to what the wire carries; beyond, "far too fast" is all."""
    return min(max(radps, -_FASTEST_RADPS), _FASTEST_RADPS)


def charge_of(volts: float | None, config: DriveConfig) -> float | None:
    """Return the charge as a share, straight between two voltages; None where it isn't known."""
    empty_v, full_v = config.battery_empty_v, config.battery_full_v
    if volts is None or empty_v is None or full_v is None:
        return None
    return min(max((volts - empty_v) / (full_v - empty_v), 0.0), 1.0)
