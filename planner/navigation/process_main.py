"""Run the route process: ``planner.navigation.process_main SITE LIMITS``.

Started by :class:`planner.navigation.RouteWorker` alone. While nobody asks, it works out
the exact costs to the places that people name.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

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
from planner.navigation.router import Router
from planner.site import Site, SiteError
from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import Frame


def main(parent: ParentPipes, folder: str, limits: str) -> int:
    """Load the site named by path, say ready, and answer until the input ends."""
    try:
        site = Site.load(Path(folder))
    except SiteError as error:
        return parent.refuse(CODES.down, str(error))
    router = Router(site, read_limits(limits))
    parent.write({"ready": site.map_id})
    return parent.serve(partial(_answer, router, router.new_memory()), router.warm())


def _answer(router: Router, memory: ObstacleMemory, asked: Frame) -> Frame:
    if is_observation(asked):
        return report_frame(router.observe(memory, read_observation(asked)))
    return result_frame(router.route(read_request(asked), memory=memory))


if __name__ == "__main__":
    run_worker(main)
