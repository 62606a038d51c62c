"""Find routes in another process. Knows what the process is told and its codes; no maps, no pipes.

A long search would hold the interpreter and with it the heartbeat, so it never runs in the
planner. Whatever becomes of the process, a caller gets a route or a typed failure in bounded time.
"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

from planner.navigation.ipc import limits_text, read_report, read_result
from planner.navigation.route import (
    ObstacleReport,
    RouteFailure,
    RouteLimits,
    RouteRequest,
    RouteResult,
    ScanObservation,
)
from processes.worker import SupervisedWorker
from processes.worker_protocol import FailureCodes

READY_S = 30.0
"""To start Python, numpy and OpenCV on a busy board and load a site."""
ROUTE_S = 5.0
LONGEST_PAUSE_S = 5.0
CODES = FailureCodes(
    RouteFailure,
    down="route_worker_unavailable",
    died="route_worker_died",
    timed_out="route_timed_out",
)


class RouteWorker(SupervisedWorker):
    """Find routes on one site, in another process."""

    def __init__(
        self, folder: Path, map_id: str, limits: RouteLimits, marks: Path | None = None
    ) -> None:
        """Take the site by path, and marks: no map is ever copied between processes."""
        drawn = () if marks is None else (str(marks.absolute()),)
        arguments = (str(folder.absolute()), limits_text(limits), *drawn)
        super().__init__(
            *("planner.navigation.process_main", arguments, CODES),
            one_at_a_time=False,
            first_word_s=READY_S,
            longest_pause_s=LONGEST_PAUSE_S,
        )
        self._map_id = map_id

    async def start(self, timeout_s: float = READY_S) -> None:
        """Start the process and wait until it can answer. Ends by itself, with :meth:`close`.

        Raises:
            RouteFailure: ``route_worker_unavailable``; nothing is left running.
        """
        try:
            await super().start(timeout_s)
        except RouteFailure:
            await self.close()
            raise

    async def route(self, request: RouteRequest, timeout_s: float = ROUTE_S) -> RouteResult:
        """Find the way.

        Raises:
            RouteFailure: there is none, or the process failed or was too slow; the code says which.
        """
        try:
            return await self.ask(asdict(request), (), timeout_s, read_result)
        except (TypeError, ValueError) as error:
            raise RouteFailure("route_request_malformed", str(error)) from error

    async def observe(self, seen: ScanObservation, timeout_s: float = ROUTE_S) -> ObstacleReport:
        """Show the search one scan; return what its obstacle layer holds then.

        Raises:
            RouteFailure: the process failed or was too slow; the code says which.
        """
        return await self.ask(asdict(seen), (), timeout_s, read_report)

    def _check_greeting(self, said: object) -> None:
        if said != self._map_id:
            raise RouteFailure(CODES.down, f"it loaded map {said}, not {self._map_id}")
