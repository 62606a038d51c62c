"""Stand for a planner that dies: ``python -m tools.bench.planner_stub HOME SITE PLANNER_ID``.

Speaks to the bridge with the planner's own code (``planner.bridge_client``,
``planner.navigation.cut``) and plans nothing: the legs come as one line of JSON on standard
input, before which it only warms up. Small enough to be started a hundred times.
"""

from __future__ import annotations

import gc
import json
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner.bridge_client import STANDING, Course, Identity, OwnerState, WireBus, on_status
from planner.navigation import LegPath, RoutePoint, cut
from wire import fingerprint, load_robot
from wire.keys import Party
from wire.session import open_session
from wire.site_map import read_map_id

if TYPE_CHECKING:
    from wire import RobotDescription, Status

POLL_S = 0.002
ROBOT = Path(__file__).resolve().parents[2] / "robot.toml"


@dataclass
class StubDriver:
    """Follow leg after leg of one mission."""

    mission: str
    legs: list[LegPath]
    number: int = 1
    progress_m: float = 0.0

    def course(self, status: Status) -> Course:
        """Return what to stream on this status."""
        done = status.leg
        mine = done is not None and (done.mission, done.leg) == (self.mission, self.number)
        if mine and done is not None and done.reached and self.number < len(self.legs):
            self.number, self.progress_m = self.number + 1, 0.0
        pose = status.base_in_map
        if pose is None:
            return STANDING
        horizon = cut(self.legs[self.number - 1], pose, self.progress_m)
        self.progress_m = horizon.progress_m
        if not horizon.points:
            return Course(self.mission)
        return Course(self.mission, self.number, horizon.points, horizon.final)


def main(arguments: list[str]) -> int:
    """Drive until killed."""
    home, site, planner_id = Path(arguments[0]), Path(arguments[1]), arguments[2]
    robot = load_robot(ROBOT)
    identity = _identity(robot, site, planner_id)
    gc.collect()
    gc.freeze()
    gc.disable()
    task: dict[str, Any] = json.loads(sys.stdin.readline() or "{}")
    if not task:
        return 0  # never needed
    legs = [LegPath.of([RoutePoint(*point) for point in leg]) for leg in task["legs"]]
    driver = StubDriver(task["mission"], legs)
    with open_session(Party.PLANNER, robot.id, home) as session:
        _speak(WireBus(session), identity, driver)
    return 0


def _identity(robot: RobotDescription, site: Path, planner_id: str) -> Identity:
    fence_hash = fingerprint((site / "fence.json").read_bytes())
    return Identity(planner_id, robot.hash, fence_hash, read_map_id(site))


def _speak(bus: WireBus, identity: Identity, driver: StubDriver) -> None:
    state = OwnerState()
    while True:
        status = bus.status()
        if status is None:
            time.sleep(POLL_S)
            continue
        course = driver.course(status)
        state, messages = on_status(identity, state, status, course, status.seq, time.monotonic())
        for message in messages:
            bus.send(message)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
