"""Run the route process: ``planner.navigation.process_main SITE LIMITS``.

Started by :class:`planner.navigation.RouteWorker` alone. While nobody asks, it works out
the exact costs to the places that people name. Where a map grows in the site's folder, routes are
searched on what is known so far.
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
from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import Frame

log = logging.getLogger(__name__)


def main(parent: ParentPipes, folder: str, limits: str) -> int:
    """Load the site named by path, say ready, and answer until the input ends."""
    try:
        site = Site.load(Path(folder))
    except SiteError as error:
        return parent.refuse(CODES.down, str(error))
    found = GrowingRouter(site, read_limits(limits))
    parent.write({"ready": site.map_id})
    memories = found.router.new_memory(), FrontierMemory()
    return parent.serve(partial(_answer, found, *memories), found.router.warm())


class GrowingRouter:
    """Hold the router of the map as it is known; of a map that grows, of its newest file."""

    def __init__(self, site: Site, limits: RouteLimits) -> None:
        self._site, self._limits = site, limits
        self._read_ns = 0
        self._newest = Router(site, limits)

    @property
    def router(self) -> Router:
        """Return the router of the newest map. All have cells of one shape and place."""
        folder = self._site.folder
        try:
            written_ns = (folder / GROWING_MAP).stat().st_mtime_ns
            if written_ns != self._read_ns and (grown := read_growing_map(folder)) is not None:
                site = replace(self._site, grid=fill_beam_gaps(grown.paint_on(self._site.grid)))
                self._newest, self._read_ns = Router(site, self._limits), written_ns
        except FileNotFoundError:
            return self._newest
        except (OSError, GrowingMapError) as unreadable:
            log.warning("%s", unreadable)
        return self._newest


def _answer(
    found: GrowingRouter, memory: ObstacleMemory, frontiers: FrontierMemory, asked: Frame
) -> Frame:
    if is_observation(asked):
        return report_frame(found.router.observe(memory, read_observation(asked)))
    return result_frame(found.router.route(read_request(asked), memory=memory, frontiers=frontiers))


if __name__ == "__main__":
    run_worker(main)
