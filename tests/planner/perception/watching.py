"""Be a robot that stands and looks: its camera, its detector, its clock, as a test tells them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from planner.perception import Detection, LookResult, Sight, VisionFailure
from planner.perception.frame_update import Scenery
from planner.perception.object_store import FILE, ThingStore
from planner.perception.perception_loop import PerceptionParts, Sightseer
from planner.perception.pose_buffer import Poses
from planner.state_database import StateDatabase
from tests.planner.perception.scenes import CAMERA, box_of, image, two_room, view
from wire import DecodeFailure, Image, Localization, Odometry, Pose2, Twist2

MAP_ID = two_room().map_id
BOX, DEPTH_M = box_of(view(1.0, 1.5), 2.5, 1.5, 0.3, 0.1)
CUP = Detection("Cup", 0.9, BOX, "red", DEPTH_M, 0.01)


@dataclass
class FakeCamera:
    """Hand out what a test put in."""

    colors: list[Image | DecodeFailure] = field(default_factory=list)
    depths: list[Image | DecodeFailure] = field(default_factory=list)
    heard: bool = False

    def listen(self, wanted: bool) -> None:
        self.heard, self.colors, self.depths = wanted, [], []

    def color(self) -> Image | DecodeFailure | None:
        newest, self.colors = self.colors[-1:], []
        return newest[0] if newest else None

    def depth(self) -> Image | DecodeFailure | None:
        newest, self.depths = self.depths[-1:], []
        return newest[0] if newest else None


@dataclass
class FakeDetector:
    """Find what a test says, when it says so."""

    classes: tuple[str, ...] = ("Cup", "tvmonitor", "")
    found: tuple[Detection, ...] = (CUP,)
    failure: VisionFailure | None = None
    skipped: str | None = None
    depth_lost: str | None = None
    slow: asyncio.Event | None = None
    looks: list[tuple[int, bool]] = field(default_factory=list)
    depth_m: float | None = 1.0

    open_classes: tuple[str, ...] = ()
    wide: list[bool] = field(default_factory=list)

    async def look(self, color: Image, depth: Image | None, *, wide: bool = False) -> LookResult:
        self.looks.append((color.header.seq, depth is not None))
        self.wide.append(wide)
        if self.slow is not None:
            await self.slow.wait()
        if self.failure is not None:
            raise self.failure
        return LookResult(self.found, 320, 240, 0.03, self.skipped, self.depth_lost, wide)

    async def depth_at(self, depth: Image, u_px: float, v_px: float) -> float | None:
        if self.failure is not None:
            raise self.failure
        return self.depth_m


def store_in(home: Path, wall: Callable[[], float], map_id: str = MAP_ID) -> ThingStore:
    """Return the store of a home folder with a wall clock of its own."""
    return ThingStore(StateDatabase(home), home / FILE, map_id, wall=wall)


class World:
    """Be a robot that stands at (1.0, 1.5), its camera, its clock."""

    def __init__(self, home: Path | None = None, **camera: Any) -> None:
        self.now_s = 1_000.0
        self.camera, self.detector, self.seq = FakeCamera(), FakeDetector(), 0
        self.poses = Poses(MAP_ID)
        store = None if home is None else store_in(home, lambda: self.now_s)
        self.means = PerceptionParts(
            Scenery(two_room(), CAMERA.model_copy(update=camera)), self.camera, self.detector,
            self.poses, store, rate_hz=10.0,
        )  # fmt: skip
        self.eyes = Sightseer(self.means, clock=lambda: self.now_s)
        self.drawn, self.speed_mps = 0, 0.0
        """As odometry says; where it is never changes."""
        self.told: list[Sight] = []
        self.eyes.listen(self.told.append)
        self.eyes.turn()  # from now on it listens to its camera

    def blindfold(self) -> Sightseer:
        """Return other eyes of this robot, which have no model."""
        self.detector.failure = VisionFailure("no_detector")
        self.camera.heard = False
        bare = replace(self.means, has_model=False)
        self.eyes = Sightseer(bare, clock=lambda: self.now_s)
        return self.eyes

    def shoot(self, age_s: float = 0.05, data: bytes | None = None, *, depth: bool = True) -> None:
        """Let a picture arrive that was taken a while ago."""
        self.seq += 1
        stamp_s = self.now_s - age_s
        if self.camera.heard:  # it draws for its hearers only
            self.drawn += 1
            self.camera.colors.append(image(self.seq, stamp_s, data))
        if self.camera.heard and depth:
            self.camera.depths.append(image(self.seq, stamp_s, b"\x89PNG"))
        here = Pose2(1.0, 1.5, 0.0)
        self.poses.odometry(Odometry(odom_id="o", seq=self.seq, stamp_s=self.now_s,
                                     base_in_odom=here, twist=Twist2(self.speed_mps, 0.0),
                                     yaw_rate_radps=None))  # fmt: skip
        self.poses.localization(Localization(odom_id="o", seq=self.seq, stamp_s=self.now_s,
                                             odom_in_map=Pose2(0.0, 0.0, 0.0), quality=0.9,
                                             map_id=MAP_ID))  # fmt: skip

    async def turn(self, step_s: float = 0.1) -> None:
        self.eyes.turn()
        for _ in range(4):  # a look, its end, what follows from it
            await asyncio.sleep(0)
        self.now_s += step_s

    async def film(self, seconds: float, hz: float = 10.0, **shot: Any) -> None:
        for _ in range(round(seconds * hz)):
            self.shoot(**shot)
            await self.turn(1.0 / hz)
