"""Turn a base's readings into what the wire carries; shared by the protocols."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire.drive_config import DriveConfig

SPEED_S = 0.05
"""Speeds are taken over so long: of two counts 20 ms apart the jitter of a tick is half."""
_FASTEST_RADPS = 1000.0
_COUNTS = 1 << 32


def limit_radps(radps: float) -> float:
    """Return a speed [rad/s] held to what the wire carries; beyond, "far too fast" is all."""
    return min(max(radps, -_FASTEST_RADPS), _FASTEST_RADPS)


def charge_of(volts: float | None, config: DriveConfig) -> float | None:
    """Return the charge as a share, straight between two voltages; None where it isn't known."""
    empty_v, full_v = config.battery_empty_v, config.battery_full_v
    if volts is None or empty_v is None or full_v is None:
        return None
    return min(max((volts - empty_v) / (full_v - empty_v), 0.0), 1.0)


class WheelCount:
    """Follow one wheel's count past its wrap, and tell how fast it went lately."""

    def __init__(self) -> None:
        self._last: int | None = None
        self.whole = 0
        self._trail: deque[tuple[float, int]] = deque()

    def step(self, count: int) -> int:
        """Return by how much the wheel has turned since the last count; nothing is added yet."""
        last = self._last
        self._last = count
        return 0 if last is None else (count - last + _COUNTS // 2) % _COUNTS - _COUNTS // 2

    def add(self, ticks: int, at_s: float) -> None:
        """Add a step."""
        self.whole += ticks
        self._trail.append((at_s, self.whole))
        while len(self._trail) > 2 and at_s - self._trail[1][0] >= SPEED_S:
            self._trail.popleft()

    def ticks_a_s(self) -> float:
        """Return the speed over the last counts; 0 before there are two."""
        (first_s, first), (last_s, last) = self._trail[0], self._trail[-1]
        return (last - first) / (last_s - first_s) if last_s > first_s else 0.0
