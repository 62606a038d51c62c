"""Measure Pons against true ROS 2 nodes: delivery, and kills in mid-drive.

The base is a rclpy node without a dead-man of its own (tests/ros2/ros_graph.py), before it the node
of pons_ros2 as it is shipped. Killed and frozen is Pons' process; cut is the cable between the two,
with base and node on a network of their own. Needs a Python with rclpy and zenoh, named by
PONS_ROS2_PYTHON (docs/ros2.md); the cable needs root's rights.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import threading
import time
from contextlib import ExitStack, suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from pons.robot_processes import free_port
from pons.settings import CHECKOUT
from processes.parent_death import child_command
from tools.bench.context import MeasurementFailure, until
from tools.bench.report import ReportRow, row_of
from wire import DriveCommand, DriveState, keys, load_robot
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tools.bench.context import BenchLab

NAME = "ros2_true"
TITLE = "ROS 2 true nodes: commands, scans, kills in mid-drive"
LONG_ONLY = True
ROBOT = CHECKOUT / "robots" / "ros2_diff_drive.toml"
GRAPH = CHECKOUT / "tests" / "ros2" / "ros_graph.py"
PACKAGE = CHECKOUT / "ros2" / "pons_ros2"
COMMANDS, KILLS, SCANS_S = 1_000, 20, 20.0
FAULTS = ("killed", "frozen", "cut")
STAMPED = "geometry_msgs/msg/TwistStamped"
DRIVE_MPS = 0.3
STEP_MPS = 1e-5
"""Each command of the line has a speed of its own, by which the base's line tells it."""
START_S, TICK_S = 20.0, 0.01
HERE, THERE = "10.213.77.1", "10.213.77.2"
KEY = b"a key for a network of their own"


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure the line, then kills, freezes and cuts."""
    if not os.environ.get("PONS_ROS2_PYTHON"):
        raise MeasurementFailure("PONS_ROS2_PYTHON names no Python with rclpy (docs/ros2.md)")
    lines = list(lab.slices("line", lab.count(1, 3), lambda _: _line(lab)))
    zeros = {fault: _zeros_ms(lab, fault) for fault in FAULTS}
    delivered = ", ".join(f"{one['delivered']} of {COMMANDS}" for one in lines)
    scans = ", ".join(f"{one['scans']} of {one['scans_said']}" for one in lines)
    came_ms = [one for line in lines for one in line["came_ms"]]
    within = f"<= {1000 * load_robot(ROBOT).drive.timeout_s + 50:.0f}"
    return [
        ReportRow("commands at the base's node", "", ">= 99 %", value=delivered),
        row_of("bridge to the base's node", "ms", "p99 <= 10", came_ms),
        ReportRow("scans of 10 Hz", "", ">= 99 %", value=scans),
        *(row_of(f"{fault}: zeros at the base", "ms", within, ms) for fault, ms in zeros.items()),
    ]


def _zeros_ms(lab: BenchLab, fault: str) -> list[float]:
    take = partial(_break_line, lab, fault)
    runs = lab.slices(fault, lab.count(2, KILLS), lambda _: take())
    return [run["zero_ms"] for run in runs]


class Cable:
    """Lead to a network of its own, as from one computer to another; it can be cut.

    The kernel's: a pair of virtual adapters, of which one is in a namespace. Takes root's rights.
    """

    def __init__(self, stack: ExitStack) -> None:
        """Lay it.

        Raises:
            MeasurementFailure: this user may not, or there is no ``ip``.
        """
        number = os.getpid()
        space, self._near, far = f"pb{number}", f"pb{number}a", f"pb{number}b"
        self.words = ("ip", "netns", "exec", space)
        _ip("netns", "add", space)
        stack.callback(_ip, "netns", "del", space)
        _ip("link", "add", self._near, "type", "veth", "peer", "name", far, "netns", space)
        stack.callback(_ip, "link", "del", self._near)
        for where, name, address in (((), self._near, HERE), (("-n", space), far, THERE)):
            _ip(*where, "address", "add", f"{address}/30", "dev", name)
            _ip(*where, "link", "set", name, "up")
        _ip("-n", space, "link", "set", "lo", "up")

    def cut(self) -> None:
        """Let nothing through from now on; it says so to neither end's sockets."""
        _ip("link", "set", self._near, "down")


def _ip(*words: str) -> None:
    if shutil.which("ip") is None:
        raise MeasurementFailure("no `ip` here (iproute2): no cable to cut")
    done = subprocess.run(["ip", *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise MeasurementFailure(f"ip {' '.join(words)}: {done.stderr.strip()}")


class TrueGraph:
    """Hold base, lidar and node of one ROS domain, and the process of Pons that dials them."""

    def __init__(self, home: Path, stack: ExitStack, cable: Cable | None) -> None:
        """Describe it.

        Args:
            home: becomes the process's ``$PONS_HOME``.
            stack: ends what was started.
            cable: leads from that process to the nodes; without one all are on the loopback.
        """
        self._home, self._stack, self._cable = home, stack, cable
        port = free_port()
        self.locator = f"tcp/{THERE if cable else '127.0.0.1'}:{port}"
        self.lines: dict[str, list[str]] = {}
        domain = str(20 + port % 80)
        self._environment = dict(os.environ, ROS_DOMAIN_ID=domain, PYTHONPATH=str(PACKAGE))

    def start_nodes(self) -> None:
        """Start what runs on the robot."""
        self._start("base", str(GRAPH), "base", STAMPED)
        self._start("lidar", str(GRAPH), "lidar")
        key = self._home / "relay.key"
        key.write_bytes(KEY)
        key.chmod(0o600)
        given = {"listen": f'"{self.locator}"', "key": f'"{key}"', "imu": '""', "map": '""'}
        words = [word for name, one in given.items() for word in ("-p", f"{name}:={one}")]
        self._start("node", "-m", "pons_ros2.node", "--ros-args", *words)

    def start_process(self) -> subprocess.Popen[bytes]:
        """Start Pons' process, as it is shipped."""
        text = ROBOT.read_text("utf-8").replace("tcp/127.0.0.1:7448", self.locator)
        made = self._home / "robot.toml"
        made.write_text(text + "\n[inputs]\nimu = false\n", "utf-8")
        words = ("--home", str(self._home), "--robot", str(made))
        with (self._home / "ros2.log").open("ab") as log:
            process = subprocess.Popen(
                child_command("ros2", *words), cwd=CHECKOUT, stdout=log, stderr=log
            )
        self._stack.callback(_end, process)
        return process

    def twists(self) -> Iterator[tuple[float, float]]:
        """Yield when each twist came to the base, and its speed [m/s]."""
        for line in tuple(self.lines["base"]):
            said = json.loads(line)
            yield said["at_s"], said["v"]

    def _start(self, name: str, *words: str) -> None:
        away = self._cable.words if self._cable else ()
        process = subprocess.Popen(
            [*away, os.environ["PONS_ROS2_PYTHON"], *words], env=self._environment, cwd=CHECKOUT,
            text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self._stack.callback(_end, process)
        heard = self.lines.setdefault(name, [])
        threading.Thread(target=_read, args=(process, heard), daemon=True).start()


def _read(process: subprocess.Popen[str], heard: list[str]) -> None:
    with suppress(ValueError):  # closed beside us
        heard.extend(process.stdout or ())


def _end(process: subprocess.Popen[Any]) -> None:
    process.kill()
    process.wait()
    if process.stdout is not None:
        process.stdout.close()


class Commander:
    """Say commands as the bridge does, at 100 Hz, and hear the states."""

    def __init__(self, home: Path) -> None:
        self.session = open_session(Party.BRIDGE, "r1", home)
        self._commands = self.session.publisher(keys.DRIVE_COMMAND)
        self._states = self.session.subscriber(keys.DRIVE_STATE)
        self._next_s = time.monotonic()
        self.sent_s: dict[int, float] = {}
        self.state: DriveState | None = None

    def turn(self, wheel_radps: float = 0.0) -> float:
        """Say one command in its time; return when."""
        self._next_s = max(self._next_s + TICK_S, time.monotonic() - TICK_S)
        time.sleep(max(0.0, self._next_s - time.monotonic()))
        seq = len(self.sent_s) + 1
        command = DriveCommand(
            boot="bench", seq=seq, left_radps=wheel_radps, right_radps=wheel_radps, enable=True
        )
        self.sent_s[seq] = time.monotonic()
        self._commands.put(command)
        self.state = self._states.newest() or self.state
        return self.sent_s[seq]

    def until_obeyed(self) -> None:
        """Turn until the echo says that commands arrive."""
        end_s = time.monotonic() + START_S
        while self.state is None or self.state.timed_out or self.state.echo_boot != "bench":
            if time.monotonic() > end_s:
                raise MeasurementFailure(f"no command was obeyed in {START_S:.0f} s: {self.state}")
            self.turn()


def _begin(
    stack: ExitStack, home: Path, cable: Cable | None = None
) -> tuple[TrueGraph, Commander, subprocess.Popen[bytes]]:
    """Return a graph whose base obeys a bridge, and the process between."""
    graph = TrueGraph(home, stack, cable)
    graph.start_nodes()
    process = graph.start_process()
    commander = Commander(home)
    stack.callback(commander.session.close)
    commander.until_obeyed()
    return graph, commander, process


def _line(lab: BenchLab) -> dict[str, Any]:
    """Send a thousand commands, each of another speed; then count scans for a while."""
    with lab.folder() as home, ExitStack() as stack:
        graph, commander, _ = _begin(stack, home)
        radius_m = load_robot(ROBOT).base.wheel_radius_m
        sent_s = {}
        for number in range(COMMANDS):
            speed_mps = round(0.1 + STEP_MPS * number, 6)
            sent_s[speed_mps] = commander.turn(speed_mps / radius_m)
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


def _break_line(lab: BenchLab, fault: str) -> dict[str, float]:
    """Kill or freeze the process, or cut its cable, in mid-drive; wait for zeros."""
    with lab.folder() as home, ExitStack() as stack:
        cable = Cable(stack) if fault == "cut" else None
        graph, commander, process = _begin(stack, home, cable)
        radius_m = load_robot(ROBOT).base.wheel_radius_m
        for _ in range(100):
            commander.turn(DRIVE_MPS / radius_m)
        if not any(speed > 0.9 * DRIVE_MPS for _, speed in graph.twists()):
            raise MeasurementFailure(f"the base does not drive; {commander.state}")
        broken_s = time.monotonic()
        if cable is not None:
            cable.cut()
        else:
            process.send_signal(signal.SIGKILL if fault == "killed" else signal.SIGSTOP)

        def zero_s() -> float | None:
            after = (at_s for at_s, speed in graph.twists() if at_s > broken_s and speed == 0.0)
            return next(after, None)

        for _ in range(60):  # the bridge goes on
            commander.turn(DRIVE_MPS / radius_m)
        until(lambda: zero_s() is not None, START_S, "zeros at the base")
        return {"zero_ms": 1000 * ((zero_s() or 0.0) - broken_s)}
