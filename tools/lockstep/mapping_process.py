"""Be localization's process while a map is made: the real node, its builder beside it in this one.

The builder writes the growing map into the canvas' folder as often as it does on a robot, and a
keyframe takes a fixed time to be built in.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from localization.mapping.builder_client import LOOK_S, SAVE_S
from localization.mapping.builder_process import save
from localization.mapping.map_builder import MapBuilder
from localization.mapping.mapping_node import MappingNode

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from localization.global_search import Candidate
    from localization.mapping.scan_tracker import KeyframeLink
    from lockstep.bus import Port
    from lockstep.scene import LockstepScene
    from wire.session import Session


class PacedBuilder:
    """Build in this process, a look of the real client later; save as seldom as it does."""

    def __init__(self, scene: LockstepScene) -> None:
        lidar = scene.robot.lidar
        self.builder = MapBuilder((lidar.x_m, lidar.y_m))
        self.now_s = 0.0
        self._folder = scene.folder
        self._links: list[tuple[float, KeyframeLink]] = []
        self._moved = False
        self._saved, self._saved_s = 0, float("-inf")

    def add(self, link: KeyframeLink) -> None:
        """Take a keyframe; it is built in when its time has come."""
        self._links.append((self.now_s + LOOK_S, link))

    def poses(self) -> NDArray[np.float64] | None:
        """Return where keyframes are now, if a loop moved them since the last call."""
        moved, self._moved = self._moved, False
        return self.builder.poses if moved else None

    def find(self, points_m: NDArray[np.float64]) -> None:
        """Nothing: each map here begins with the robot's own first keyframe."""

    def found(self) -> tuple[Candidate, ...] | None:
        """Return None: nothing was looked for."""
        return None

    def turn(self) -> None:
        """Build in what is due, and save."""
        while self._links and self._links[0][0] <= self.now_s:
            self._moved = self.builder.add(self._links.pop(0)[1]) or self._moved
        count = len(self.builder.keyframes)
        if count != self._saved and self.now_s - self._saved_s >= SAVE_S:
            self._saved, self._saved_s = count, self.now_s
            save(self.builder, self._folder)


class MappingProcess:
    """Compose the mapper's node on the bus, in the localizer's place."""

    def __init__(self, scene: LockstepScene, port: Port) -> None:
        self.paced = PacedBuilder(scene)
        self._node = MappingNode(
            scene.robot.lidar, scene.site.map_id, self.paced, cast("Session", port), "map-1"
        )

    def turn(self, now_s: float) -> None:
        """Let builder and node turn."""
        self.paced.now_s = now_s
        self.paced.turn()
        self._node.turn(now_s)
