"""Ask the search process from the tracker's loop without ever waiting for it.

The worker's supervision is asyncio's, in a thread of its own, which must be started before the
tracker takes real-time priority: what it starts inherits its rank.
"""

from __future__ import annotations

import asyncio
import logging
import threading
from collections import deque
from typing import TYPE_CHECKING, Any

from localization.global_search import Candidate
from processes.worker import SupervisedWorker
from processes.worker_protocol import FailureCodes, WorkerFailure

if TYPE_CHECKING:
    from collections.abc import Coroutine
    from pathlib import Path

    from localization.relocation import SearchRequest
    from processes.worker_protocol import Frame
    from wire.lidar_config import LidarConfig

log = logging.getLogger(__name__)

READY_S = 60.0
"""To start Python, numpy and OpenCV on a busy board and load a map."""
SEARCH_S = 18.0
"""A search takes 0.1 s; the rest is for a process that is still starting, or starved of its
processor: killed for its slowness it would never answer. What it found is carried on by odometry
and judged by another scan, so that a late answer harms nobody."""
LONGEST_PAUSE_S = 5.0


class SearchFailure(WorkerFailure):
    """Why a search gave no answer."""

    reasons = {  # noqa: RUF012  # ClassVar in its base
        "search_unavailable": ("the search process does not run", "搜索进程没有运行"),
        "search_died": ("the search process ended during a search", "搜索进程在搜索中退出"),
        "search_timed_out": ("the search took too long", "搜索超时"),
    }


CODES = FailureCodes(
    SearchFailure,
    down="search_unavailable",
    died="search_died",
    timed_out="search_timed_out",
)


class SearchClient:
    """Hand requests to the search process and collect its answers."""

    def __init__(self, site: Path, lidar: LidarConfig) -> None:
        self._lidar_m = [lidar.x_m, lidar.y_m]
        self._worker = SupervisedWorker(
            *("localization.search_process", (str(site.absolute()),), CODES),
            one_at_a_time=True,
            first_word_s=READY_S,
            longest_pause_s=LONGEST_PAUSE_S,
        )
        self._answers: deque[tuple[int, tuple[Candidate, ...]]] = deque(maxlen=8)
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._serve, name="search", daemon=True)
        self._tasks: set[asyncio.Task[None]] = set()

    def start(self) -> None:
        """Start the thread and, in it, the process."""
        self._thread.start()
        self._schedule(self._start())

    def ask(self, request: SearchRequest) -> None:
        """Send a request; its answer comes by :meth:`answers`, or never."""
        self._schedule(self._ask(request))

    def answers(self) -> list[tuple[int, tuple[Candidate, ...]]]:
        """Return what was answered since the last call: request number and candidates."""
        found = []
        while self._answers:
            found.append(self._answers.popleft())
        return found

    def close(self) -> None:
        """End the process and the thread."""
        asyncio.run_coroutine_threadsafe(self._worker.close(), self._loop).result()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def _serve(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._loop.run_forever()

    def _schedule(self, work: Coroutine[Any, Any, None]) -> None:
        self._loop.call_soon_threadsafe(self._begin, work)

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _start(self) -> None:
        try:
            await self._worker.start(READY_S)
        except WorkerFailure as failure:
            log.error("%s", failure)

    async def _ask(self, request: SearchRequest) -> None:
        near = request.around
        head = {
            "lidar_m": self._lidar_m,
            "around": None if near is None else [near.x_m, near.y_m, near.yaw_rad],
            "radius_m": request.radius_m,
            "any_heading": request.any_heading,
            "outline": request.outline,
        }
        try:
            found = await self._worker.ask(
                head, (request.points_m.tobytes(),), SEARCH_S, _read_candidates
            )
        except WorkerFailure as failure:
            log.warning("%s", failure)
            found = ()  # no place is known: the localizer asks again
        self._answers.append((request.number, found))


def _read_candidates(frame: Frame) -> tuple[Candidate, ...]:
    head, _ = frame
    return tuple(
        Candidate((float(x_m), float(y_m), float(yaw)), float(score))
        for x_m, y_m, yaw, score in head["candidates"]
    )
