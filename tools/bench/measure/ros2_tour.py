"""Measure tours of a whole home through ROS 2: `pons up`, a base of ROS 2, sentences of a person.

By rosbridge and by rmw_zenoh the simulator's twin plays server, relay and base. By DDS and by
rosbridge true nodes do: our relay as it is shipped, and a rclpy base whose wheels, lidar and gyro
are the simulator's. "Nav2" is a small stand-in for it, another rclpy node (docs/ros2.md). True
nodes need a Python with rclpy, named by PONS_ROS2_PYTHON.
"""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
import time
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from pons.robot_processes import free_port
from pons.settings import CHECKOUT
from processes.parent_death import child_command
from tools.bench.context import MeasurementFailure, until
from tools.bench.measure.ros2_base import ROBOTS, SITE, START_S
from tools.bench.report import ReportRow, row_of
from tools.bench.ros2_graph import WAYS, TrueGraph, check_for_rclpy, end_process
from wire import SimTruth, keys
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tools.bench.context import BenchLab
    from wire.session import Session

NAME = "ros2_tour"
TITLE = "ROS 2: tours of the home by `pons up`, by transport"
LONG_ONLY = True
ROOMS = ("kitchen", "bedroom", "bathroom", "study", "living room", "hallway", "entrance")
GOAL_S = 180.0
MOST_RESUMES = 3
"""A busy machine lets scans go stale; the bridge then holds until a person resumes."""
_FRESH_PORTS = {
    "rosbridge": (r"(?m)^url = .*$", 'url = "ws://127.0.0.1:{port}"'),
    "zenoh": (r"(?m)^router = .*$", 'router = "tcp/127.0.0.1:{port}"'),
}


@dataclass(frozen=True, slots=True)
class _Driver:
    """Name who finds the ways, and where."""

    site: Path
    places: tuple[str, ...]
    nodes: tuple[tuple[str, ...], ...] = ()
    robot: str = ""


PONS = _Driver(SITE, ROOMS)
NAV2 = _Driver(
    CHECKOUT / "sites" / "two_room",
    ("living room", "kitchen", "sofa", "kitchen"),
    (("nav2", "0.9", "0.8", "0", "1.5", "2.0", "1.5", "3.5"),),
    "\n[ros2.nav2]\n",
)
"""A small stand-in for Nav2, which begins at the dock and knows the two sides of the one door."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Tour with the twins, then, where there is rclpy, with true nodes."""
    rows = []
    for way in ROBOTS:
        rows += _rows(f"twin, {way}", ROOMS, _tours(lab, f"twin.{way}", _tour_with_twin, way))
    check_for_rclpy()
    for way in WAYS:
        take = partial(_tour_with_nodes, by=PONS)
        rows += _rows(f"true nodes, {way}", ROOMS, _tours(lab, f"true.{way}", take, way))
        take = partial(_tour_with_nodes, by=NAV2)
        found = _tours(lab, f"nav2.{way}", take, way)
        rows += _rows(f"a stand-in for Nav2, {way}", NAV2.places, found)
    return rows


def _tours(
    lab: BenchLab, name: str, take: Callable[[BenchLab, str], dict[str, Any]], way: str
) -> list[dict[str, Any]]:
    return list(lab.slices(name, 1, lambda _: take(lab, way)))


def _rows(what: str, places: tuple[str, ...], tours: list[dict[str, Any]]) -> list[ReportRow]:
    count = len(places)
    reached = ", ".join(f"{one['reached']} of {count}" for one in tours)
    note = "; ".join(
        f"contacts {one['contacts']}, resumes {one['resumes']}, lost {one['lost'] or '-'}"
        for one in tours
    )
    took_s = [seconds for one in tours for seconds in one["took_s"]]
    goal = f"{count} of {count}, contacts 0"
    return [
        ReportRow(f"{what}: places reached", "", goal, value=reached, note=note),
        row_of(f"{what}: a place", "s", "", took_s),
    ]


def _tour_with_twin(lab: BenchLab, way: str) -> dict[str, Any]:
    """Have `pons up --twin` drive from room to room, all in one home folder."""
    with lab.folder() as home, ExitStack() as stack:
        robot = home / "robot.toml"
        pattern, made = _FRESH_PORTS[way]
        text = ROBOTS[way].read_text("utf-8")
        robot.write_text(re.sub(pattern, made.format(port=free_port()), text), "utf-8")
        pons = _PonsUp(home, robot, SITE, stack, "--twin")
        pons.until_armed()
        judge = stack.enter_context(open_session(Party.JUDGE, "r1", home))
        return _visit(lab, f"twin, {way}", pons, judge, ROOMS)


def _tour_with_nodes(lab: BenchLab, way: str, by: _Driver) -> dict[str, Any]:
    """Have `pons up` drive a rclpy base with a simulated body from place to place."""
    with lab.folder() as home, lab.folder() as body_home, ExitStack() as stack:
        graph, port = TrueGraph(way, home, stack), free_port()
        words = ("--home", str(body_home), "--robot", str(ROBOTS["rosbridge"]))
        body = subprocess.Popen(
            child_command("sim", *words, "--site", str(by.site), "--ros2-twin", str(port)),
            cwd=CHECKOUT, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        stack.callback(end_process, body)
        until(partial(_is_open, port), START_S, "the simulator's server")
        graph.start(("body", str(port)), *by.nodes)
        judge = stack.enter_context(open_session(Party.JUDGE, "r1", body_home))
        pons = _PonsUp(home, graph.describe(imu=True, more=by.robot), by.site, stack)
        pons.until_armed()
        return _visit(lab, f"true nodes, {way}", pons, judge, by.places)


def _visit(
    lab: BenchLab, what: str, pons: _PonsUp, judge: Session, places: tuple[str, ...]
) -> dict[str, Any]:
    """Say each place in turn; count those reached, and the contacts that the simulator saw."""
    truths, contacts, seen = judge.subscriber(keys.SIM_TRUTH), 0, 0
    took_s: list[float] = []
    lost, resumes = "", 0
    for place in places:
        began_s = time.monotonic()
        said, resumed = pons.drive_to(place)
        resumes += resumed
        for truth in truths.drain().items:
            if isinstance(truth, SimTruth):
                contacts, seen = truth.contacts_total, seen + 1
        if said.returncode == 0:
            took_s.append(time.monotonic() - began_s)
        else:
            lost += f"{place}: {said.stdout[-300:]}{said.stderr[-300:]} "
        lab.say(f"{what}: {place} {'reached' if said.returncode == 0 else 'lost'}")
    if not seen:
        raise MeasurementFailure("the simulator told no truth: nobody counted contacts")
    return {
        "reached": len(took_s), "took_s": took_s, "contacts": contacts, "lost": lost,
        "resumes": resumes,
    }  # fmt: skip


def _is_open(port: int) -> bool:
    with suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1.0):
        return True
    return False


class _PonsUp:
    """Be a person at a terminal with a robot of metal."""

    def __init__(self, home: Path, robot: Path, site: Path, stack: ExitStack, *words: str) -> None:
        """Make a key and start it, with such words behind ``up``."""
        self._environment = dict(
            os.environ, PONS_HOME=str(home), PONS_ROBOT=str(robot), PONS_SITE=str(site),
            PONS_PORT=str(free_port()),
        )  # fmt: skip
        self.run("key", "new")
        self._log = home / "up.log"
        with self._log.open("ab") as log:
            up = subprocess.Popen(
                [sys.executable, "-m", "pons", "up", *words], cwd=CHECKOUT, env=self._environment,
                stdout=log, stderr=log,
            )  # fmt: skip

        def end() -> None:
            up.terminate()
            up.wait(30.0)

        stack.callback(end)

    def run(self, *words: str, limit_s: float = 30.0) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "pons", *words], cwd=CHECKOUT, env=self._environment,
            capture_output=True, text=True, timeout=limit_s, check=False,
        )  # fmt: skip

    def drive_to(self, room: str) -> tuple[subprocess.CompletedProcess[str], int]:
        """Say it, and where the bridge held on the way, resume as a person would; say how often."""
        said = self.run("say", f"go to the {room}", limit_s=GOAL_S)
        for resumed in range(MOST_RESUMES):
            if said.returncode == 0:
                return said, resumed
            self.run("stop")
            self.run("arm")  # after a fault that took the torque
            self.run("resume")
            said = self.run("say", f"go to the {room}", limit_s=GOAL_S)
        return said, MOST_RESUMES

    def until_armed(self) -> None:
        until(lambda: "ready after" in self._log.read_text("utf-8"), 120.0, "pons up")
        end_s = time.monotonic() + 90.0
        while (said := self.run("arm")).returncode != 0:
            if time.monotonic() > end_s:
                raise MeasurementFailure(f"it does not arm: {said.stdout}{said.stderr}")
            time.sleep(1.0)
