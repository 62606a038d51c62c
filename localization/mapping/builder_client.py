"""Hand keyframes to the builder's process and take back where loops moved them, without waiting."""

from __future__ import annotations

import asyncio
import json
import logging
import time
from collections import deque
from typing import TYPE_CHECKING

import numpy as np

from localization.global_search import Candidate
from localization.mapping.builder_process import BuilderFailure
from localization.worker_thread import WorkerThread
from processes.worker_protocol import FailureCodes, WorkerFailure

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from localization.mapping.scan_tracker import KeyframeLink
    from processes.worker_protocol import Frame
    from wire.lidar_config import LidarConfig

    Floats = NDArray[np.float64]

log = logging.getLogger(__name__)

CODES = FailureCodes(
    BuilderFailure,
    down="map_builder_unavailable",
    died="map_builder_died",
    timed_out="map_builder_timed_out",
)
ANSWER_S = 30.0
"""A loop of a large map takes seconds to settle."""
SAVE_S = 2.0
LOOK_S = 0.1
RETRY_S = 1.0


class BuilderClient:
    """Keep the builder's process in step with the tracker."""

    def __init__(self, folder: Path, lidar: LidarConfig, known: int = 0) -> None:
        """Describe the process.

        Args:
            folder: of the canvas, where the map is kept.
            lidar: where it is on the robot.
            known: keyframes that the folder holds already.
        """
        arguments = (str(folder.absolute()), json.dumps([lidar.x_m, lidar.y_m]))
        module = "localization.mapping.builder_process"
        self._thread = WorkerThread("map", module, arguments, CODES)
        self._first = known
        self._links: list[KeyframeLink] = []
        self._have = known
        self._poses: deque[Floats] = deque(maxlen=1)
        self._found: deque[tuple[Candidate, ...]] = deque(maxlen=1)
        self._saved, self._saved_s = known, float("-inf")

    def start(self) -> None:
        """Start the process, and what brings it keyframes."""
        self._thread.start()
        self._thread.schedule(self._work())

    def close(self) -> None:
        """End the process. What was not saved in the last seconds is lost."""
        self._thread.close()

    def add(self, link: KeyframeLink) -> None:
        """Bring a keyframe to the builder in its turn."""
        self._links.append(link)

    def poses(self) -> Floats | None:
        """Return where keyframes are now, shape (n, 3), if a loop moved them since last time."""
        return self._poses.popleft() if self._poses else None

    def find(self, points_m: Floats) -> None:
        """Look for the pose from which a scan was taken; :meth:`found` has the answer later."""
        self._thread.schedule(self._find(points_m))

    def found(self) -> tuple[Candidate, ...] | None:
        """Return a search's candidates, best first, once there is an answer."""
        return self._found.popleft() if self._found else None

    async def _work(self) -> None:
        while True:
            try:
                await self._bring()
            except WorkerFailure as failure:
                log.warning("%s", failure)
                await asyncio.sleep(RETRY_S)
            await asyncio.sleep(LOOK_S)

    async def _bring(self) -> None:
        while self._have < self._first + len(self._links):
            link = self._links[self._have - self._first]
            keyframe, relation = link.keyframe, link.relation
            head = {
                "index": self._have,
                "pose": keyframe.pose.tolist(),
                "relation": None if relation is None else relation.tolist(),
                "stamp_s": keyframe.stamp_s,
                "sigma_m": link.sigma_m,
                "sigma_rad": link.sigma_rad,
            }
            points_m = np.ascontiguousarray(keyframe.points_m)
            await self._tell(head, points_m.tobytes())
        now_s = time.monotonic()
        if self._have != self._saved and now_s - self._saved_s >= SAVE_S:
            count, self._saved_s = self._have, now_s
            await self._tell({"save": True}, b"")
            self._saved = count

    async def _tell(self, head: dict[str, object], body: bytes) -> None:
        told, poses = await self._thread.worker.ask(head, (body,), ANSWER_S, _read_told)
        if not told >= self._first:
            text = f"it holds {told} keyframes of the {self._first} that were there at the start"
            raise BuilderFailure(CODES.down, text)
        self._have = told  # a builder that was killed has what it had saved, and is told the rest
        if poses is not None:
            self._poses.append(poses)

    async def _find(self, points_m: Floats) -> None:
        try:
            body = np.ascontiguousarray(points_m).tobytes()
            found = await self._thread.worker.ask({"find": True}, (body,), ANSWER_S, _read_found)
        except WorkerFailure as failure:
            log.warning("%s", failure)
            found = ()
        self._found.append(found)


def _read_told(frame: Frame) -> tuple[int, Floats | None]:
    head, body = frame
    poses = np.frombuffer(body, np.float64).reshape(-1, 3) if head["moved"] else None
    return int(head["have"]), poses


def _read_found(frame: Frame) -> tuple[Candidate, ...]:
    head, _ = frame
    return tuple(
        Candidate((float(x_m), float(y_m), float(yaw)), float(score))
        for x_m, y_m, yaw, score in head["candidates"]
    )
