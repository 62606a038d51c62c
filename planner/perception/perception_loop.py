"""Run perception: newest picture to the detector, its detections to map and memory.

One look at a time, on the event loop, which it never holds for long: thinking is the detector's
process, the disk a thread's. Whatever becomes of camera or detector, this says why it is blind, and
goes on.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import Counter
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from planner.language.object_names import canonical
from planner.perception.failure import REFUSALS, VisionFailure
from planner.perception.frame_source import POLL_S, Attention, Pictures
from planner.perception.interfaces import PointRefusal
from planner.perception.object_map import ObjectMap
from planner.perception.pose_buffer import PendingPoses
from planner.perception.projection import View, pixel, point_on_map
from processes.backoff import Backoff

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from planner.perception.frame_source import Camera
    from planner.perception.frame_update import Scenery
    from planner.perception.interfaces import Detector, MapPoint, Picture
    from planner.perception.object_store import ThingStore
    from planner.perception.pose_buffer import Poses
    from planner.perception.snapshot import LookResult, Sight, Thing


@dataclass(frozen=True, slots=True)
class PerceptionParts:
    """Hold what eyes are made of."""

    scenery: Scenery
    camera: Camera
    detector: Detector | None
    poses: Poses
    store: ThingStore | None = None
    has_model: bool = True
    """The detector has something to detect with, as far as is known before it starts."""
    rate_hz: float = 10.0
    """Of looks, while somebody needs eyes."""


log = logging.getLogger(__name__)

NO_MODEL = frozenset({"no_detector", *REFUSALS})
"""While one of these is why nothing is seen, no picture is looked at: a person must act."""
UNUSABLE_AFTER = 5
"""Looks in a row that were skipped: a lens that is covered, a camera or a model that is broken."""
FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.1, 10.0
"""Before eyes that ended by an error of ours are opened again; doubled until one sees."""


class Sightseer:
    """Be the planner's eyes."""

    def __init__(
        self, means: PerceptionParts, *, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._means, self._clock = means, clock
        camera = means.scenery.camera
        self._there = camera.kind != "none"
        self._pictures = Pictures(means.camera, camera.rate_hz)
        self._looked: Picture | None = None
        self._unusable = 0
        there = means.detector is not None and means.has_model
        self._down: str | None = None if there else "no_detector"
        blind = self._down if self._there else "no_camera"
        self._known = ObjectMap(means.scenery, means.store, blind)
        self._attention = Attention(means.rate_hz, camera.rate_hz)
        self._handed = PendingPoses()
        self._thinking: asyncio.Task[None] | None = None
        self._task: asyncio.Task[None] | None = None
        self._backoff = Backoff(FIRST_PAUSE_S, LONGEST_PAUSE_S)
        self.counts: Counter[str] = Counter()
        """Looks, and what became of them."""
        self.lag_s = self.took_s = 0.0
        """Of the newest look: from the picture to the map, and in the detector."""

    # What is asked -----------------------------------------------------------------------------

    @property
    def sight(self) -> Sight:
        """Return the newest look and all that is remembered."""
        return self._known.sight

    @property
    def version(self) -> int:
        """Return a number that rises when a thing comes, goes, or gets another colour or room."""
        return self._known.version

    @property
    def changed_s(self) -> Mapping[str, float]:
        """Return when each thing was last seen or doubted."""
        return self._known.changed_s

    @property
    def classes(self) -> tuple[str, ...]:
        """Return the class ids that can be seen now; none where nothing can be."""
        detector = self._means.detector
        if detector is None or not self._there:
            return ()
        return _ids(detector.classes)

    @property
    def open_classes(self) -> tuple[str, ...]:
        """Return those of these that a wide look alone finds."""
        detector = self._means.detector
        return _ids(detector.open_classes) if detector is not None and self._there else ()

    @property
    def picture(self) -> Picture | None:
        """Return the newest picture, or None; where it was taken is known from then on."""
        newest = self._pictures.newest
        if newest is not None:
            self._handed.note(newest)
        return newest

    @property
    def looked_picture(self) -> Picture | None:
        """Return the picture that the newest look was made of, as ``picture`` does."""
        if self._looked is not None:
            self._handed.note(self._looked)
        return self._looked

    @property
    def now_s(self) -> float:
        """Return the time on the clock of all ages here."""
        return self._clock()

    @property
    def skip_counts(self) -> Counter[str]:
        """Return how many pictures were not thought upon, by reason."""
        return self._pictures.skipped

    def listen(self, told: Callable[[Sight], None]) -> None:
        """Have something called after each look and when ``blind`` changes. It must be quick."""
        self._known.listen(told)

    def attend(self, who: str, wanted: bool, *, wide: bool = False) -> None:
        """Say that somebody needs eyes now, or no longer; ``wide``: for all that can be seen."""
        self._attention.attend(who, wanted, wide=wide)

    async def show(self) -> Picture | None:
        """Return the newest picture to a page, which is then taken to look on; no point of it."""
        self._attention.note_shown(self._clock())
        await self._first_picture()
        return self._pictures.newest  # noted for nobody: a page fetches three a second

    async def fresh(self) -> Picture | None:
        """Return the newest picture; where nobody wanted any so far, wait a moment for one."""
        await self._first_picture()
        return self.picture

    async def _first_picture(self) -> None:
        with self._attention.waiting():
            self._listen(self._clock())
            while not self._pictures.is_settled(self._clock()):  # noqa: ASYNC110  # a round tells
                await asyncio.sleep(POLL_S)

    async def spot(self, picture: Picture, x: float, y: float) -> MapPoint:
        """Return the point of the map at a point of a picture (x right, y down, each 0 to 1000).

        Raises:
            PointRefusal: nothing there can be driven up to.
        """
        means = self._means
        stance = self._handed.stance(picture, means.poses)
        if stance is None:
            raise PointRefusal("point_no_pose", "where the robot was then is not known any more")
        view = View(picture.color.header, means.scenery.camera, stance)
        depth_m = None
        if picture.depth is not None and means.detector is not None:
            try:
                depth_m = await means.detector.depth_at(picture.depth, *pixel(view, x, y))
            except VisionFailure as failure:
                raise PointRefusal("point_no_depth", str(failure)) from None
        return point_on_map(view, means.scenery.site, x, y, depth_m)

    def forget(self, thing_id: str | None = None) -> tuple[Thing, ...]:
        """Forget one thing, or all; return the forgotten ones."""
        forgotten = self._known.forget(thing_id)
        self._tell()
        return forgotten

    # Life --------------------------------------------------------------------------------------

    async def start(self) -> None:
        """Take up the saved objects, and begin to look."""
        await self._known.load(self._clock())
        self._tell()
        self._known.mark_saved()
        if self._there:
            self._open(0.0)

    async def close(self) -> None:
        """End all looking, and save the objects."""
        running, self._task = self._task, None
        tasks = [t for t in (running, self._thinking) if t is not None]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        if running is not None:
            await self._known.close(self._clock())

    def _open(self, after_s: float) -> None:
        self._task = asyncio.get_running_loop().create_task(self._run(after_s), name="eyes")
        self._task.add_done_callback(self._note_end)

    async def _run(self, after_s: float) -> None:
        await asyncio.sleep(after_s)
        while True:
            self.turn()
            await asyncio.sleep(self._attention.poll_s(self._clock()))

    def turn(self) -> None:
        """Do one round: take pictures in, judge them, begin a look where one is due."""
        now_s, busy = self._clock(), self._thinking is not None
        self._listen(now_s)
        self._pictures.poll(now_s, busy=busy)
        self._handed.settle(self._means.poses, now_s)
        if self._known.age(now_s) or self._blind(now_s) != self.sight.blind:
            self._tell()
        if not busy and self._due(now_s):
            picture = self._pictures.ready(now_s)
            if picture is not None and self._means.detector is not None:
                self._attention.began(now_s)
                self._thinking = asyncio.get_running_loop().create_task(
                    self._think(self._means.detector, picture), name="look"
                )
                self._thinking.add_done_callback(self._finish_look)
        self._known.keep(now_s)

    def _listen(self, now_s: float) -> None:
        """Listen to the camera while anybody wants pictures: a detector, a page, a question.

        While nobody asks, it is listened to for a glance at a time: until the next look begins.
        """
        glance = self._down not in NO_MODEL and self._due(now_s)
        self._pictures.listen(self._there and self._attention.listens(now_s, glance=glance), now_s)

    def _due(self, now_s: float) -> bool:
        return self._attention.due(now_s, moving=self._means.poses.moving)

    # Looks -------------------------------------------------------------------------------------

    async def _think(self, detector: Detector, picture: Picture) -> None:
        try:
            wide = self._attention.wide and bool(detector.open_classes)
            result = await detector.look(picture.color, picture.depth, wide=wide)
        except VisionFailure as failure:
            self._note_failure(failure)
            return
        if result.skipped is not None:
            self._skip(result.skipped)
            return
        self._down, self._unusable = None, 0
        self._backoff.reset()
        self._saw(picture, result)

    def _skip(self, code: str) -> None:
        """Count a picture that could not be thought upon; several in a row are said."""
        self._pictures.skipped[code] += 1
        self._unusable += 1
        enough = self._unusable >= UNUSABLE_AFTER
        why = "detector_down" if code == "detector_failed" else "camera_unusable"
        self._down = why if enough else None

    def _note_failure(self, failure: VisionFailure) -> None:
        """Say why there are no looks, once, and try again later."""
        told = failure.code == "no_detector" or failure.code in REFUSALS
        code = failure.code if told else "detector_down"
        if self._down != code:
            log.warning("eyes: %s", failure)
        self.counts[failure.code] += 1
        self._down = code
        self._attention.rest(self._clock())

    def _saw(self, picture: Picture, result: LookResult) -> None:
        stance = self._means.poses.at(picture.taken_s)
        passed_over = frozenset() if result.wide else frozenset(self.open_classes)
        self._known.take(picture, result, stance, passed_over)
        self._looked = picture
        self.counts["looks"] += 1
        if result.depth_lost is not None:
            self._pictures.skipped[result.depth_lost] += 1
        self.counts["without_pose"] += stance is None
        self.took_s, self.lag_s = result.took_s, self._clock() - picture.taken_s
        self._tell()

    def _finish_look(self, task: asyncio.Task[None]) -> None:
        """Free the place for the next look; log an unforeseen error."""
        self._thinking = None
        if not task.cancelled() and (error := task.exception()) is not None:
            self.counts["look_broken"] += 1
            self._attention.rest(self._clock())
            log.error("a look failed", exc_info=error)

    def _note_end(self, task: asyncio.Task[None]) -> None:
        if task is self._task and not task.cancelled() and (error := task.exception()) is not None:
            pause_s = self._backoff.pause_after()
            log.critical("the eyes ended; again in %g s", pause_s, exc_info=error)
            self.counts["eyes_ended"] += 1
            self._open(pause_s)
            self._down = self._down or "detector_down"  # until the next look
            self._tell()

    def _blind(self, now_s: float) -> str | None:
        """Return why nothing is seen now, or None."""
        return (self._pictures.blind(now_s) or self._down) if self._there else "no_camera"

    def _tell(self) -> None:
        now_s = self._clock()
        self._known.tell(self._blind(now_s), now_s)


@lru_cache(maxsize=4)
def _ids(classes: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(canonical(name) for name in classes if name))
