"""Give a world the lines of metal that its robot's description names, and what localizes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lockstep.driven_world import DrivenWorld
from tools.lockstep.drive_process import DriveProcess
from tools.lockstep.lidar_process import LidarProcess
from tools.lockstep.localizer_process import LocalizerProcess
from tools.lockstep.mapping_process import MappingProcess
from wire.keys import Party

if TYPE_CHECKING:
    from lockstep.parts import Turning
    from sim.twin.twin import Boot


class MetalWorld(DrivenWorld):
    """Be a world with twins of metal where the robot's description says so."""

    base: DriveProcess | None
    lidar: LidarProcess | None
    """A lidar of metal's twin, where the robot's description names one."""
    mapping: MappingProcess | None = None
    """What makes the map, where one is made."""
    localizer: LocalizerProcess | None = None
    """What finds the robot by scans on a known map, where that is done."""

    def __init__(self, *, firmware: Boot | None = None, **parts: Any) -> None:
        """Put the parts together.

        Args:
            firmware: of a base of metal, in place of its kind's model.
            parts: as :class:`lockstep.driven_world.DrivenWorld` takes them.
        """
        self._firmware = firmware
        super().__init__(**parts)

    def _base(self) -> DriveProcess | None:
        if self.scene.robot.drive.virtual:
            return None
        boot = self._config(self.seed).boot
        return DriveProcess(self.sim, boot, self.seed, self._clock, self._firmware)

    def _lidar(self) -> LidarProcess | None:
        if not self.scene.robot.lidar.has_line:
            return None
        return LidarProcess(self.sim, self.bus.port(Party.LIDAR), self.seed)

    def _localize(self, seed: int) -> Turning:
        port = self.bus.port(Party.LOCALIZATION)
        if self.scene.grows:
            self.mapping = MappingProcess(self.scene, port)
            return self.mapping
        if self.scene.robot.localization.kind == "scans":
            self.localizer = LocalizerProcess(self.scene, port)
            return self.localizer
        return super()._localize(seed)
