"""Be a robot without a body: the true planner over a bridge that drives in thought.

Replaced are the way to the bridge (tests' bridge, which moves along the waypoints that it is sent)
and the route search (straight lines); it hears no sound, and looks at its bridge less often than a
planner does, so that thirty fit on two cores. Journal, keys, missions and API are the planner's.
"""

from __future__ import annotations

import os
import sys
import time
from functools import partial
from typing import TYPE_CHECKING, Any

import uvicorn

import planner.app
from planner.api import Access
from planner.app import Planner, PlannerPaths, application
from planner.bridge_client import Link
from planner.language.semantic_parser.parser import load_network
from planner.mission import Clocks, Missions
from planner.navigation import RouteResult
from planner.voice_factory import VoiceParts
from tests.planner.mission.fakes import FakeBridge, straight
from wire import Pose2

if TYPE_CHECKING:
    from pathlib import Path

    from planner.navigation import RouteRequest
    from wire import Status

load_network()  # before robots are forked: they share it
POLL_S = 0.05
STATUS_S = 0.15
STEPS = 12
"""Of 25 mm each, in one status: four times as fast as a robot, so that a drive takes 1 to 3 s."""


class ThoughtBridge(FakeBridge):
    """Tell a status now and then, and at once after an answer; keep no record of what was heard."""

    _told_s, _told_answers = 0.0, 0

    def status(self) -> Status | None:
        """Go on, where it is time."""
        now_s = time.monotonic()
        if now_s - self._told_s < STATUS_S and len(self.answers) == self._told_answers:
            return None
        self._told_s, self._told_answers = now_s, len(self.answers)
        for kept in (self.heard, self.moved_epochs, self.dropped):
            kept.clear()
        for _ in range(STEPS - 1):
            self.step()
        told = self.step()
        self.pending = None
        return told


class StraightRouter:
    """Find straight ways, in no time."""

    def __init__(self, *_: Any) -> None:
        pass

    async def start(self) -> None:
        """Need nothing."""

    async def close(self) -> None:
        """Hold nothing."""

    async def route(self, request: RouteRequest) -> RouteResult:
        """Return the straight way."""
        return RouteResult(straight(request.start, request.goal), 1.0, 0.0, False, 0.0)


class DeafParts(VoiceParts):
    """Start no recogniser."""

    def start(self) -> None:
        """Need nothing."""


class LinkPlanner(Planner):
    """Be the planner whose bridge is thought of."""

    def _open_link(self) -> Link:
        return Link(ThoughtBridge(pose=Pose2(1.0, 4.2, 0.0)), self.description)


def run_robot(home: Path, site: Path, port: int) -> None:
    """Serve on the loopback until killed; robot.toml lies in the home."""
    log = (home / "log").open("a", buffering=1)
    os.dup2(log.fileno(), sys.stdout.fileno())
    os.dup2(log.fileno(), sys.stderr.fileno())
    slower = partial(Missions, clocks=Clocks(poll_s=POLL_S))
    for name, own in (("RouteWorker", StraightRouter), ("VoiceParts", DeafParts),
                      ("Missions", slower)):  # fmt: skip
        setattr(planner.app, name, own)
    made = LinkPlanner(PlannerPaths(home, home / "robot.toml", site))
    uvicorn.run(
        application(made, Access("127.0.0.1", find_person=made.people.find)), host="127.0.0.1",
        port=port, log_level="warning", access_log=False, timeout_graceful_shutdown=1,
    )  # fmt: skip
