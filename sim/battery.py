"""Count the battery's charge under two loads: standing and driving."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sim.hardware import Hardware


class Battery:
    """Start full and run down in a straight line."""

    def __init__(self, hardware: Hardware, period_s: float) -> None:
        self._idle = period_s / hardware.battery_idle_s
        self._driving = period_s / hardware.battery_driving_s
        self.charge = 1.0

    def tick(self, *, turning: bool) -> None:
        """Use one period."""
        self.charge = max(0.0, self.charge - (self._driving if turning else self._idle))
