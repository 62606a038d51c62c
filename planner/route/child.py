"""Be the route process: ``planner.route.child SITE LIMITS``, begun by ``planner.kept.begin``.

Started by :class:`planner.route.RouteWorker` and by nobody else. While nobody asks, it works out
the exact costs to the places that people name.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from planner.kept import Frame, Parent, run
from planner.route.frames import read_limits, read_request, result_frame
from planner.route.router import Router
from planner.route.worker import CODES
from planner.world import Site, SiteError


def main(parent: Parent, folder: str, limits: str) -> int:
    """Load the site named by path, say ready, and answer until the input ends."""
    try:
        site = Site.load(Path(folder))
    except SiteError as error:
        return parent.refuse(CODES.down, str(error))
    router = Router(site, read_limits(limits))
    parent.write({"ready": site.map_id})
    return parent.serve(partial(_answer, router), router.warm())


def _answer(router: Router, asked: Frame) -> Frame:
    return result_frame(router.route(read_request(asked)))


if __name__ == "__main__":
    run(main)
