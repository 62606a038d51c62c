"""Ask the search process from the tracker's loop without ever waiting for it."""

from __future__ import annotations

import logging
from collections import deque
from typing import TYPE_CHECKING

from localization.global_search import Candidate
from localization.worker_thread import WorkerThread
from processes.worker_protocol import FailureCodes, WorkerFailure

if TYPE_CHECKING:
    from pathlib import Path

    from localization.relocation import SearchRequest
    from processes.worker_protocol import Frame
    from wire import LocalizerTrouble
    from wire.lidar_config import LidarConfig

log = logging.getLogger(__name__)

SEARCH_S = 18.0
"""A search takes 0.1 s; the rest is for a process that is still starting, or starved of its
processor: killed for its slowness it would never answer. What it found is carried on by odometry
and judged by another scan, so that a late answer harms nobody."""
RESTS_AFTER_S = 60.0
"""A robot that knows its place searches for it about never, and the process holds 33 MB."""


class SearchFailure(WorkerFailure):
    """Why a search gave no answer."""

    code: LocalizerTrouble
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
        arguments = (str(site.absolute()),)
        self._thread = WorkerThread(
            "search", "localization.search_process", arguments, CODES, RESTS_AFTER_S
        )
        self._answers: deque[tuple[int, tuple[Candidate, ...]]] = deque(maxlen=8)
        self.trouble: LocalizerTrouble | None = None
        """Why the newest request was not answered; None where it was."""

    def start(self) -> None:
        """Start the search process."""
        self._thread.start()

    def ask(self, request: SearchRequest) -> None:
        """Send a request; its answer comes by :meth:`answers`, or never."""
        self._thread.schedule(self._ask(request))

    def answers(self) -> list[tuple[int, tuple[Candidate, ...]]]:
        """Return what was answered since the last call: request number and candidates."""
        found = []
        while self._answers:
            found.append(self._answers.popleft())
        return found

    def close(self) -> None:
        """End the search process."""
        self._thread.close()

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
            found = await self._thread.worker.ask(
                head, (request.points_m.tobytes(),), SEARCH_S, _read_candidates
            )
            self.trouble = None
        except SearchFailure as failure:
            log.warning("%s", failure)
            self.trouble = failure.code
            found = ()  # no place is known: the localizer asks again
        self._answers.append((request.number, found))


def _read_candidates(frame: Frame) -> tuple[Candidate, ...]:
    head, _ = frame
    return tuple(
        Candidate((float(x_m), float(y_m), float(yaw)), float(score))
        for x_m, y_m, yaw, score in head["candidates"]
    )
