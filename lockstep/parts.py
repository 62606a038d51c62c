"""Say what a world may be given in place of its plain parts: lines of metal, a localizer, eyes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from planner.perception.interfaces import Eyes

if TYPE_CHECKING:
    from bridge.drive import Drive
    from sim import SimRobot
    from sim.twin import DriveTwin
    from wire import Localization, Odometry


class Turning(Protocol):
    """Take a turn in each tick."""

    def turn(self, now_s: float) -> object: ...


class LineBase(Protocol):
    """Be a base of metal on a line: its firmware, and the drive that speaks to it."""

    @property
    def twin(self) -> DriveTwin: ...

    @property
    def drive(self) -> Drive: ...


class WorldEyes(Eyes, Protocol):
    """See in a world, on its clock."""

    def odometry(self, odometry: Odometry) -> None: ...

    def localization(self, localization: Localization) -> None: ...

    def turn(self, sim: SimRobot, tick: int, now_s: float) -> None: ...
