"""Be the planner's eyes on the simulated clock: a finder's detections onto the map, and memory.

Projection, poses and memory are the planner's own. The memory outlives a planner that is killed, as
the one on disk does.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.mission.skills import Answer
from planner.perception.frame_update import Scenery, saw
from planner.perception.interfaces import Picture, PointRefused
from planner.perception.object_tracker import Remembered, aged
from planner.perception.pixel_to_map import point_on_map
from planner.perception.pose_buffer import Poses
from planner.perception.projection import View
from planner.perception.snapshot import Look, Sight
from tools.lockstep.truth_detector import NAMES, Finder, header_of
from wire import Image, Localization, Odometry

if TYPE_CHECKING:
    from planner.mission.effects import AskEyes
    from planner.perception.snapshot import Detection
    from sim import SimRobot
    from tools.lockstep.scene import Scene

PERIOD_TICKS, LATE_TICKS = 20, 12
"""5 Hz, and 0.12 s from the picture to the sight."""


@dataclass(frozen=True, slots=True)
class Taken:
    """Hold one picture that is being thought upon."""

    due: int
    picture: Picture
    detections: tuple[Detection, ...]


class PerceptionProcess:
    """See for one planner after the other."""

    def __init__(self, scene: Scene, finder: Finder) -> None:
        self._scene, self._finder = scene, finder
        self._scenery = Scenery(scene.site, scene.robot.camera)
        self._poses = Poses(scene.site.map_id)
        self._memory = Remembered()
        self._taken: list[Taken] = []
        self._newest: Picture | None = None
        self._seq = 0
        self.classes = NAMES
        self.blind: str | None = None
        """Why nothing is seen; a test sets it."""
        self._told_blind: str | None = None
        self.look: Look | None = None

    @property
    def sight(self) -> Sight:
        """Return what is known by eye now."""
        return Sight(self.look, self._memory.things, self.blind)

    def hear(self, odometry: Odometry | None, localization: Localization | None) -> None:
        """Take what says how the robot moves and where it is."""
        if odometry is not None:
            self._poses.odometry(odometry)
        if localization is not None:
            self._poses.localization(localization)

    def turn(self, sim: SimRobot, tick: int, now_s: float) -> Sight | None:
        """Take a picture where one is due, finish one that was; return a new sight, if there is."""
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
        return self.sight

    def answer(self, ask: AskEyes) -> Answer:
        """Say what a pixel of the newest picture shows, by the floor alone; no model answers."""
        picture, look = self._newest, self.look
        if ask.x is None or ask.y is None:
            return Answer(failure="no_vision_model")
        stance = self._poses.at(picture.taken_s) if picture is not None else None
        if picture is None or look is None or stance is None:
            return Answer(failure="point_no_pose")
        view = View(picture.color.header, self._scenery.camera, stance)
        try:
            spot = point_on_map(view, self._scene.site, ask.x, ask.y, None)
        except PointRefused as refused:
            return Answer(failure=refused.code)
        return Answer(at=(spot.x_m, spot.y_m, spot.z_m))

    def look_with(self, finder: Finder) -> None:
        """See with another finder from now on."""
        self._finder = finder

    def _take(self, sim: SimRobot, tick: int, now_s: float) -> None:
        self._seq += 1
        header = header_of(self._scenery.camera, self._seq, now_s)
        picture = Picture(Image(header=header, data=b"\0"), None, now_s)
        found = self._finder.find(sim, header)
        self._newest = picture
        self._taken.append(Taken(tick + LATE_TICKS, picture, found))
