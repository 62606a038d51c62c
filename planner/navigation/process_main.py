"""Run the route process: ``planner.navigation.process_main SITE LIMITS [MARKS]``.

Started by :class:`planner.navigation.RouteWorker` alone. While nobody asks, it works out
the exact costs to the places that people name. Where a map grows in the site's folder, routes are
searched on what is known so far; where people drew on the map, less what they drew.
"""

from __future__ import annotations

import logging
from dataclasses import replace
from functools import partial
from pathlib import Path

from maps.beam_gaps import fill_beam_gaps
from maps.growing_map import GROWING_MAP, GrowingMapError, read_growing_map
from planner.navigation.frontier import FrontierMemory
from planner.navigation.ipc import (
    is_observation,
    read_limits,
    read_observation,
    read_request,
    report_frame,
    result_frame,
)
from planner.navigation.obstacle_memory import ObstacleMemory
from planner.navigation.process_client import CODES
from planner.navigation.route import RouteLimits
from planner.navigation.router import Router
from planner.site import Site, SiteError
from planner.site.marks import read_marks
from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import Frame

log = logging.getLogger(__name__)


def main(parent: ParentPipes, folder: str, limits: str, marks: str = "") -> int:
    """Load the site named by path, say ready, and answer until the input ends."""
    try:
        site = Site.load(Path(folder))
    except SiteError as error:
        return parent.refuse(CODES.down, str(error))
    found = GrowingRouter(site, read_limits(limits), Path(marks) if marks else None)
    parent.write({"ready": site.map_id})
    memories = found.router.new_memory(), FrontierMemory()
    return parent.serve(partial(_answer, found, *memories), found.router.warm())


class GrowingRouter:
    """Hold the router of the map as it is known; of a map that grows, of its newest file.

    Likewise of what people drew on it: its file is read whenever it was written.
    """

    def __init__(self, site: Site, limits: RouteLimits, marks: Path | None = None) -> None:
        self._site, self._limits, self._marks = site, limits, marks
        self._read_ns = self._marks_ns = 0
        self._grown, self._drawn = site.grid, site.fence
        self._newest = self._make()

    @property
    def router(self) -> Router:
        """Return the router of the newest map. All have cells of one shape and place."""
        drawn, grown = self._read_marks(), self._read_map()
        if drawn or grown:
            self._newest = Router(self._site_now(), self._limits)
        return self._newest

    def _make(self) -> Router:
        self._read_marks()
        return Router(self._site_now(), self._limits)

    def _site_now(self) -> Site:
        return replace(self._site, grid=self._grown, fence=self._drawn)

    def _read_marks(self) -> bool:
        """Read what was drawn, where that has changed; say whether it has."""
        if self._marks is None:
            return False
        try:
            written_ns = self._marks.stat().st_mtime_ns
        except OSError:
            return False
        if written_ns == self._marks_ns:
            return False
        marks = read_marks(self._marks, self._site.map_id)
        self._drawn, self._marks_ns = self._site.fence.with_marks(marks), written_ns
        return True

    def _read_map(self) -> bool:
        """Read the map that grows, where that has changed; say whether it has."""
        folder = self._site.folder
        try:
            written_ns = (folder / GROWING_MAP).stat().st_mtime_ns
            if written_ns != self._read_ns and (grown := read_growing_map(folder)) is not None:
                self._grown = fill_beam_gaps(grown.paint_on(self._site.grid))
                self._read_ns = written_ns
                return True
        except FileNotFoundError:
            return False
        except (OSError, GrowingMapError) as unreadable:
            log.warning("%s", unreadable)
        return False


def _answer(
    found: GrowingRouter, memory: ObstacleMemory, frontiers: FrontierMemory, asked: Frame
) -> Frame:
    if is_observation(asked):
        return report_frame(found.router.observe(memory, read_observation(asked)))
    return result_frame(found.router.route(read_request(asked), memory=memory, frontiers=frontiers))


if __name__ == "__main__":
    run_worker(main)
