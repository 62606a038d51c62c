"""Start, kill and freeze planner stubs, and give them legs to drive on a site."""

from __future__ import annotations

import json
import signal
import subprocess
from math import inf
from typing import TYPE_CHECKING

from planner.navigation import RouteLimits, RouteRequest
from planner.navigation.router import Router
from planner.site import Site
from processes.parent_death import child_command
from tools.bench.context import MeasurementFailure
from wire import load_robot

if TYPE_CHECKING:
    from tools.bench.robot import BenchRobot
    from wire import Pose2

Leg = list[tuple[float, float, float]]
ROUNDS = 12


class Stub:
    """Hold one stub process, bound to this one."""

    def __init__(self, robot: BenchRobot, planner_id: str) -> None:
        """Start it; it warms up and waits for ``go``."""
        settings = robot.settings
        words = ["tools.bench.planner_stub", str(settings.home), str(settings.site), planner_id]
        command = child_command(*words)
        with (settings.home / "logs" / "stub.log").open("ab") as log:
            self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=log, stdout=log)

    def go(self, mission: str, legs: list[Leg]) -> None:
        """Let it own the robot and drive.

        Raises:
            Missed: it is gone.
        """
        if self._process.stdin is None or self._process.poll() is not None:
            raise MeasurementFailure("the stub ended before it was asked for anything")
        self._process.stdin.write(json.dumps({"mission": mission, "legs": legs}).encode() + b"\n")
        self._process.stdin.flush()

    def kill(self) -> None:
        """End it at once."""
        self._process.send_signal(signal.SIGKILL)

    def freeze(self) -> None:
        """Hold it where it is."""
        self._process.send_signal(signal.SIGSTOP)

    def thaw(self) -> None:
        """Let it go on."""
        self._process.send_signal(signal.SIGCONT)

    def end(self) -> None:
        """Leave nothing of it."""
        self._process.kill()
        if self._process.stdin is not None:
            self._process.stdin.close()
        self._process.wait()


class Legs:
    """Make legs between two places of a site, over and over."""

    def __init__(self, robot: BenchRobot, fastest_mps: float = inf) -> None:
        self._fastest_mps = fastest_mps
        self._site = Site.load(robot.settings.site)
        self._router = Router(self._site, RouteLimits.of(load_robot(robot.settings.robot)))

    def between(self, start: Pose2, first: str, second: str) -> list[Leg]:
        """Return legs from a pose to the farther place and on, to and fro."""
        ends = [self._place(first), self._place(second)]
        ends.sort(key=lambda end: -abs(end.x_m - start.x_m) - abs(end.y_m - start.y_m))
        legs = [self._leg(start, ends[0])]
        rounds = (self._leg(ends[n % 2], ends[1 - n % 2]) for n in range(ROUNDS))
        return [*legs, *rounds]

    def _leg(self, start: Pose2, goal: Pose2) -> Leg:
        found = self._router.route(RouteRequest(start, goal))
        return [(p.x_m, p.y_m, min(p.speed_mps, self._fastest_mps)) for p in found.points]

    def _place(self, place_id: str) -> Pose2:
        place = self._site.place(place_id)
        if place is None:
            raise MeasurementFailure(f"no place {place_id!r} in {self._site.folder}")
        return place.pose
