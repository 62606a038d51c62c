"""Measure Pons against true ROS 2 nodes, by rosbridge and by DDS: delivery, kills, the home tour.

The base is a rclpy node without a dead-man of its own (tests/ros2/ros_graph.py), before it our
relay as it is shipped. On the tour its wheels, lidar and gyro are the simulator's, and `pons up`
runs as on metal. Needs a Python with rclpy, named by PONS_ROS2_PYTHON (docs/ros2.md).
"""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from pons.robot_processes import free_port
from pons.settings import CHECKOUT
from processes.parent_death import child_command
from tools.bench.context import MeasurementFailure, until
from tools.bench.measure.ros2_base import DRIVE_MPS, ROBOTS, SITE, START_S, Commander
from tools.bench.report import ReportRow, row_of
from wire import SimTruth, keys, load_robot
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tools.bench.context import BenchLab

NAME = "ros2_true"
TITLE = "ROS 2 true nodes: commands, scans, kills in mid-drive and the home tour, by transport"
LONG_ONLY = True
WAYS = ("dds", "rosbridge")
COMMANDS, KILLS, SCANS_S = 1_000, 20, 20.0
GRAPH = CHECKOUT / "tests" / "ros2" / "ros_graph.py"
RELAY = CHECKOUT / "examples" / "ros2_relay" / "relay.py"
STAMPED = "geometry_msgs/msg/TwistStamped"
ROOMS = ("kitchen", "bedroom", "bathroom", "study", "living room", "hallway", "entrance")
GOAL_S = 180.0
MOST_RESUMES = 3
"""A busy machine lets scans go stale; the bridge then holds until a person resumes."""
STEP_MPS = 1e-5
"""Each command of the line has a speed of its own, by which the base's line tells it."""


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
    """Measure each way: the line, then the tour, then kills and freezes."""
    if not os.environ.get("PONS_ROS2_PYTHON"):
        raise MeasurementFailure("PONS_ROS2_PYTHON names no Python with rclpy (docs/ros2.md)")
    return [row for way in WAYS for row in _measure_way(lab, way)]


def _measure_way(lab: BenchLab, way: str) -> list[ReportRow]:
    take_line = partial(_line, lab, way)
    lines = list(lab.slices(f"line.{way}", lab.count(1, 3), lambda _: take_line()))
    tours = list(lab.slices(f"tour.{way}", 1, lambda _: _tour(lab, way, PONS)))
    by_nav2 = list(lab.slices(f"nav2.{way}", 1, lambda _: _tour(lab, way, NAV2)))
    faults = ("killed", "frozen", "cut") if way == "rosbridge" else ("killed", "frozen")
    zeros = {fault: _zeros_ms(lab, way, fault) for fault in faults}
    delivered = ", ".join(f"{one['delivered']} of {COMMANDS}" for one in lines)
    scans = ", ".join(f"{one['scans']} of {one['scans_said']}" for one in lines)
    came_ms = [one for line in lines for one in line["came_ms"]]
    within = f"<= {1000 * load_robot(ROBOTS['rosbridge']).drive.timeout_s + 50:.0f}"
    rooms = ", ".join(f"{len(one['reached'])} of {len(ROOMS)}" for one in tours)
    note = "; ".join(
        f"contacts {one['contacts']}, resumes {one['resumes']}, lost {one['lost'] or '-'}"
        for one in tours
    )
    return [
        ReportRow(f"{way}: commands at the base's node", "", ">= 99 %", value=delivered),
        row_of(f"{way}: bridge to the base's node", "ms", "p99 <= 10", came_ms),
        ReportRow(f"{way}: scans of 10 Hz", "", ">= 99 %", value=scans),
        *(row_of(f"{way}, {fault}: zeros at the base", "ms", within, ms)
          for fault, ms in zeros.items()),
        ReportRow(f"{way}: rooms of the home", "", "7 of 7", value=rooms, note=note),
        *_rows_of_nav2(way, by_nav2),
        row_of(f"{way}: a room", "s", "", [s for one in tours for s in one["reached"].values()]),
    ]  # fmt: skip


def _rows_of_nav2(way: str, tours: list[dict[str, Any]]) -> list[ReportRow]:
    reached = ", ".join(f"{len(one['reached'])} of 3" for one in tours)
    note = "; ".join(f"contacts {one['contacts']}, lost {one['lost'] or '-'}" for one in tours)
    return [
        ReportRow(f"{way}: places by a stand-in for Nav2", "", "3 of 3", value=reached, note=note),
        row_of(f"{way}: a place by it", "s", "", [s for t in tours for s in t["reached"].values()]),
    ]


def _zeros_ms(lab: BenchLab, way: str, fault: str) -> list[float]:
    take = partial(_break_line, lab, way, fault)
    runs = lab.slices(f"{fault}.{way}", lab.count(2, KILLS), lambda _: take())
    return [run["zero_ms"] for run in runs]


class _TrueGraph:
    """Hold the processes of one ROS domain on this computer's loopback."""

    def __init__(self, way: str, home: Path, stack: ExitStack) -> None:
        self.port = free_port()
        self.domain = 20 + self.port % 80
        self.way, self.home, self._stack = way, home, stack
        self.lines: dict[str, list[tuple[float, str]]] = {}
        self.servers: list[subprocess.Popen[str]] = []
        self._environment = dict(os.environ, ROS_DOMAIN_ID=str(self.domain))

    def start_node(self, name: str, *words: str) -> subprocess.Popen[str]:
        python = os.environ["PONS_ROS2_PYTHON"]
        process = subprocess.Popen(
            [python, *words], env=self._environment, cwd=CHECKOUT, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self._stack.callback(_end, process)
        heard = self.lines.setdefault(name, [])
        threading.Thread(target=_read, args=(process, heard), daemon=True).start()
        return process

    def start(self, *nodes: tuple[str, ...]) -> None:
        """Start relay, nodes and, where the way needs one, a rosbridge server."""
        if self.way == "rosbridge":
            self.servers.append(self.start_node("bridge", str(GRAPH), "bridge", str(self.port)))
            until(lambda: self.lines["bridge"], START_S, "the rosbridge server")
        for words in nodes:
            self.start_node(words[0], str(GRAPH), *words)
        self.start_node("relay", str(RELAY))

    def describe(self, *, imu: bool, more: str = "") -> Path:
        """Write robot.toml for this graph."""
        text = ROBOTS["rosbridge"].read_text("utf-8")
        reached = f'transport = "dds"\ndomain = {self.domain}\ninterface = "lo"'
        if self.way == "rosbridge":
            reached = f'url = "ws://127.0.0.1:{self.port}"'
        text = re.sub(r"(?m)^url = .*$", reached, text)
        if not imu:
            text = re.sub(r"(?m)^imu = .*$", "", text) + "\n[inputs]\nimu = false\n"
        made = self.home / "robot.toml"
        made.write_text(text + more, "utf-8")
        return made

    def start_process(self) -> subprocess.Popen[bytes]:
        """Start the process under test, as it is shipped."""
        words = ("--home", str(self.home), "--robot", str(self.describe(imu=False)))
        with (self.home / "ros2.log").open("ab") as log:
            process = subprocess.Popen(
                child_command("ros2", *words), cwd=CHECKOUT, stdout=log, stderr=log
            )
        self._stack.callback(_end, process)
        return process

    def twists(self) -> Iterator[tuple[float, float]]:
        """Yield when each twist came to the base, and its speed [m/s]."""
        for _, line in tuple(self.lines["base"]):
            said = json.loads(line)
            yield said["at_s"], said["v"]


def _read(process: subprocess.Popen[str], heard: list[tuple[float, str]]) -> None:
    with suppress(ValueError):  # closed beside us
        heard.extend((time.monotonic(), line) for line in process.stdout or ())


def _end(process: subprocess.Popen[Any]) -> None:
    process.kill()
    process.wait()
    if process.stdout is not None:
        process.stdout.close()


def _begin_line(stack: ExitStack, graph: _TrueGraph) -> tuple[Commander, subprocess.Popen[bytes]]:
    """Return a bridge whose commands the relay obeys, and the process between."""
    graph.start(("base", STAMPED), ("lidar",))
    process = graph.start_process()
    commander = Commander(graph.home)
    stack.callback(commander.session.close)
    commander.until_obeyed()
    return commander, process


def _line(lab: BenchLab, way: str) -> dict[str, Any]:
    """Send a thousand commands, each of another speed; then count scans for a while."""
    with lab.folder() as home, ExitStack() as stack:
        graph = _TrueGraph(way, home, stack)
        commander, _ = _begin_line(stack, graph)
        radius_m = load_robot(ROBOTS["rosbridge"]).base.wheel_radius_m
        sent_s = {}
        for number in range(COMMANDS):
            speed_mps = round(0.1 + STEP_MPS * number, 6)
            commander.turn(speed_mps / radius_m)
            sent_s[speed_mps] = commander.sent_s[len(commander.sent_s)]
        time.sleep(0.5)
        came_s: dict[float, float] = {}
        for at_s, speed_mps in graph.twists():
            came_s.setdefault(round(speed_mps, 6), at_s)
        scans = commander.session.subscriber(keys.SCAN)
        first = len(graph.lines["lidar"])
        end_s, heard = time.monotonic() + SCANS_S, 0
        while time.monotonic() < end_s:
            commander.turn(0.0)
            heard += len(scans.drain_bytes())
        said = len(graph.lines["lidar"]) - first
    came = [speed for speed in sent_s if speed in came_s]
    return {
        "delivered": len(came),
        "came_ms": [1000 * (came_s[speed] - sent_s[speed]) for speed in came],
        "scans": heard,
        "scans_said": said,
    }


def _break_line(lab: BenchLab, way: str, fault: str) -> dict[str, float]:
    """Kill or freeze the process, or cut its server off, in mid-drive; wait for zeros."""
    with lab.folder() as home, ExitStack() as stack:
        graph = _TrueGraph(way, home, stack)
        commander, process = _begin_line(stack, graph)
        radius_m = load_robot(ROBOTS["rosbridge"]).base.wheel_radius_m
        for _ in range(100):
            commander.turn(DRIVE_MPS / radius_m)
        if not any(speed > 0.9 * DRIVE_MPS for _, speed in graph.twists()):
            raise MeasurementFailure(f"the base does not drive; {commander.state}")
        broken_s = time.monotonic()
        if fault == "cut":
            graph.servers[0].send_signal(signal.SIGKILL)
        else:
            process.send_signal(signal.SIGKILL if fault == "killed" else signal.SIGSTOP)

        def zero_s() -> float | None:
            after = (at_s for at_s, speed in graph.twists() if at_s > broken_s and speed == 0.0)
            return next(after, None)

        for _ in range(60):  # the bridge goes on
            commander.turn(DRIVE_MPS / radius_m)
        until(lambda: zero_s() is not None, START_S, "zeros at the base")
        return {"zero_ms": 1000 * ((zero_s() or 0.0) - broken_s)}


def _tour(lab: BenchLab, way: str, by: _Driver) -> dict[str, Any]:
    """Have `pons up` drive a rclpy base with a simulated body from place to place."""
    with lab.folder() as home, lab.folder() as body_home, ExitStack() as stack:
        graph, port = _TrueGraph(way, home, stack), free_port()
        words = ("--home", str(body_home), "--robot", str(ROBOTS["rosbridge"]))
        body = subprocess.Popen(
            child_command("sim", *words, "--site", str(by.site), "--ros2-twin", str(port)),
            cwd=CHECKOUT, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        stack.callback(_end, body)
        until(partial(_is_open, port), START_S, "the simulator's server")
        graph.start(("body", str(port)), *by.nodes)
        judge = stack.enter_context(open_session(Party.JUDGE, "r1", body_home))
        truths, contacts = judge.subscriber(keys.SIM_TRUTH), 0
        pons = _PonsUp(home, graph.describe(imu=True, more=by.robot), by.site, stack)
        pons.until_armed()
        reached: dict[str, float] = {}
        lost, resumes = "", 0
        for room in by.places:
            began_s = time.monotonic()
            said, resumed = pons.drive_to(room)
            resumes += resumed
            for truth in truths.drain().items:
                contacts = truth.contacts_total if isinstance(truth, SimTruth) else contacts
            if said.returncode == 0:
                reached[room] = time.monotonic() - began_s
            else:
                lost += f"{room}: {said.stdout[-300:]}{said.stderr[-300:]} "
            lab.say(f"{way}: {room} {'reached' if said.returncode == 0 else 'lost'}")
    return {"reached": reached, "contacts": contacts, "lost": lost, "resumes": resumes}


def _is_open(port: int) -> bool:
    with suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1.0):
        return True
    return False


class _PonsUp:
    """Be a person at a terminal with a robot of metal."""

    def __init__(self, home: Path, robot: Path, site: Path, stack: ExitStack) -> None:
        self._environment = dict(
            os.environ, PONS_HOME=str(home), PONS_ROBOT=str(robot), PONS_SITE=str(site),
            PONS_PORT=str(free_port()),
        )  # fmt: skip
        self.run("key", "new")
        self._log = home / "up.log"
        with self._log.open("ab") as log:
            up = subprocess.Popen(
                [sys.executable, "-m", "pons", "up"], cwd=CHECKOUT, env=self._environment,
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
