"""Hold the simulated robot's faults: a set of names, read in every tick, empty by default.

A fault changes what hardware does or says, never what the simulator knows: truth stays true.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from sim.messages import Buttons
from sim.sensor_channel import Trouble
from wire import SimFault

if TYPE_CHECKING:
    from collections.abc import Iterable

RUNAWAY_RADPS: Final = 12.0
"""What a runaway motor turns at: 1.2 m/s, far faster than anybody asks."""
LOW_CHARGE, SAGGING_CHARGE = 0.15, 0.05


class Faults:
    """Hold the faults that are in force now."""

    def __init__(self, standing: Iterable[SimFault] = ()) -> None:
        self._standing = frozenset(standing)
        self._in_order = tuple(fault for fault in SimFault if fault in self._standing)
        self._sensors = {sensor: self._troubles(sensor) for sensor in ("encoder", "lidar", "gyro")}
        self.buttons = self._buttons()
        """Which of the drive's inputs are pressed."""

    @property
    def standing(self) -> tuple[SimFault, ...]:
        """Return the faults in force, in the order in which the names are defined."""
        return self._in_order

    def __contains__(self, fault: SimFault) -> bool:
        """Return whether a fault is in force."""
        # Nearly always nothing is: the hash of a member is a call, asked for ten times in a tick.
        return bool(self._standing) and fault in self._standing

    def of_sensor(self, sensor: str) -> frozenset[Trouble]:
        """Return the troubles of a sensor: ``encoder``, ``lidar`` or ``gyro``."""
        return self._sensors[sensor]

    def _troubles(self, sensor: str) -> frozenset[Trouble]:
        named = {trouble for trouble in Trouble if f"{sensor}_{trouble}" in self._standing}
        if sensor == "encoder" and SimFault.DRIVE_OFF in self._standing:
            named.add(Trouble.OFF)  # one message holds all that the drive says
        return frozenset(named)

    def wheels_radps(self, left: float, right: float, *, torque: bool) -> tuple[float, float]:
        """Return the motors' speeds for two targets; a runaway needs torque."""
        if SimFault.RUNAWAY in self and torque:
            return RUNAWAY_RADPS, RUNAWAY_RADPS
        return (-left, -right) if SimFault.REVERSED in self else (left, right)

    def _buttons(self) -> Buttons:
        return Buttons(
            estop=SimFault.ESTOP_PRESSED in self,
            bumper_front=SimFault.BUMPER_FRONT in self,
            bumper_rear=SimFault.BUMPER_REAR in self,
            cliff=SimFault.CLIFF in self,
        )

    def charge(self, charge: float, *, turning: bool) -> float:
        """Return the battery gauge's reading of a charge, in steps of a thousandth."""
        charge = round(charge, 3)
        if SimFault.BATTERY_SAG in self and turning:
            return min(charge, SAGGING_CHARGE)
        return min(charge, LOW_CHARGE) if SimFault.BATTERY_LOW in self else charge
