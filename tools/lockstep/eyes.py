"""Be the planner's eyes on the simulated clock: a finder's detections onto the map, and memory.

Projection, poses and memory are the planner's own. The memory outlives a planner that is killed, as
the one on disk does.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lockstep.latencies import TICK_S
from planner.perception.frame_update import Scenery, saw
from planner.perception.interfaces import MapPoint, Picture, PointRefusal
from planner.perception.object_tracker import ObjectMemory, aged
from planner.perception.pose_buffer import Poses
from planner.perception.projection import View, point_on_map
from planner.perception.snapshot import LookSnapshot, Sight
from tools.lockstep.truth_detector import NAMES, Finder, header_of
from wire import Image, Localization, Odometry

if TYPE_CHECKING:
    from collections.abc import Callable

    from lockstep.scene import LockstepScene
    from planner.perception.snapshot import Detection
    from sim import SimRobot

PERIOD_TICKS, LATE_TICKS = 20, 12
"""5 Hz, and 0.12 s from the picture to the sight."""


@dataclass(frozen=True, slots=True)
class PendingLook:
    """Hold one picture that is being thought upon."""

    due: int
    picture: Picture
    detections: tuple[Detection, ...]


class PerceptionProcess:
    """See for one planner after the other."""

    def __init__(self, scene: LockstepScene, finder: Finder) -> None:
        self._scene, self._finder = scene, finder
        self._scenery = Scenery(scene.site, scene.robot.camera)
        self._poses = Poses(scene.site.map_id)
        self._memory = ObjectMemory()
        self._taken: list[PendingLook] = []
        self.picture: Picture | None = None
        self.looked_picture: Picture | None = None
        self._seq = 0
        self.classes = NAMES
        self.open_classes: tuple[str, ...] = ()
        self.blind: str | None = None
        """Why nothing is seen; a test sets it."""
        self._told_blind: str | None = None
        self.look: LookSnapshot | None = None
        self._told: Callable[[Sight], None] | None = None

    @property
    def sight(self) -> Sight:
        """Return what is known by eye now."""
        return Sight(self.look, self._memory.things, self.blind)

    def odometry(self, odometry: Odometry) -> None:
        """Take how the robot moves."""
        self._poses.odometry(odometry)

    def localization(self, localization: Localization) -> None:
        """Take where the robot is."""
        self._poses.localization(localization)

    def listen(self, told: Callable[[Sight], None]) -> None:
        """Tell one planner what is seen; those before it are gone."""
        self._told = told

    def attend(self, who: str, wanted: bool, *, wide: bool = False) -> None:
        """Look at the full rate always."""

    async def fresh(self) -> Picture | None:
        """Return the newest picture."""
        return self.picture

    async def spot(self, picture: Picture, x: float, y: float) -> MapPoint:
        """Return what lies at a point of a picture, by the floor alone.

        Raises:
            PointRefusal: nothing there can be driven up to.
        """
        await asyncio.sleep(TICK_S)
        stance = self._poses.at(picture.taken_s)
        if stance is None:
            raise PointRefusal("point_no_pose")
        view = View(picture.color.header, self._scenery.camera, stance)
        return point_on_map(view, self._scene.site, x, y, None)

    def turn(self, sim: SimRobot, tick: int, now_s: float) -> None:
        """Take a picture where one is due, finish one that was; tell of a new sight."""
        sight = self._see(sim, tick, now_s)
        if sight is not None and self._told is not None:
            self._told(sight)

    def _see(self, sim: SimRobot, tick: int, now_s: float) -> Sight | None:
        if self.blind is not None:
            self._taken.clear()
            changed, self._told_blind = self.blind != self._told_blind, self.blind
            return self.sight if changed else None
        changed, self._told_blind = self._told_blind is not None, None
        if tick % PERIOD_TICKS == 0:
            self._take(sim, tick, now_s)
        if not (self._taken and self._taken[0].due <= tick):
            return self.sight if changed else None
        taken = self._taken.pop(0)
        stance = self._poses.at(taken.picture.taken_s)
        self._memory, self.look = saw(
            self._scenery, aged(self._memory, now_s), taken.picture, taken.detections, stance
        )
        self.looked_picture = taken.picture
        return self.sight

    def look_with(self, finder: Finder) -> None:
        """See with another finder from now on."""
        self._finder = finder

    def _take(self, sim: SimRobot, tick: int, now_s: float) -> None:
        self._seq += 1
        header = header_of(self._scenery.camera, self._seq, now_s)
        picture = Picture(Image(header=header, data=b"\0"), None, now_s)
        found = self._finder.find(sim, header)
        self.picture = picture
        self._taken.append(PendingLook(tick + LATE_TICKS, picture, found))
