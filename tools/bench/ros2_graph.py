"""Run a true ROS 2 graph beside a measurement: nodes of rclpy, our relay, a process of Pons.

The nodes' Python is named by PONS_ROS2_PYTHON (docs/ros2.md).
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import threading
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from pons.robot_processes import free_port
from pons.settings import CHECKOUT
from processes.parent_death import child_command
from tools.bench.context import MeasurementFailure, until
from wire import DriveCommand, DriveState, keys
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import ExitStack
    from pathlib import Path

WAYS = ("dds", "rosbridge")
ROBOT = CHECKOUT / "robots" / "ros2_diff_drive.toml"
START_S = 20.0
TICK_S = 0.01
GRAPH = CHECKOUT / "tests" / "ros2" / "ros_graph.py"
CAMERA = CHECKOUT / "tests" / "ros2" / "ros_camera.py"
RELAY = CHECKOUT / "examples" / "ros2_relay" / "relay.py"


def check_for_rclpy() -> None:
    """Hold that there is a Python with rclpy.

    Raises:
        MeasurementFailure: PONS_ROS2_PYTHON names none.
    """
    if not os.environ.get("PONS_ROS2_PYTHON"):
        raise MeasurementFailure("PONS_ROS2_PYTHON names no Python with rclpy (docs/ros2.md)")


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
        self._space, self.here = f"pb{number}", f"pb{number}a"
        there = f"pb{number}b"
        self.words = ("ip", "netns", "exec", self._space)
        _ip("netns", "add", self._space)
        stack.callback(_ip, "netns", "del", self._space)  # which takes its time
        _ip("link", "add", self.here, "type", "veth", "peer", "name", there, "netns", self._space)
        stack.callback(_ip, "link", "del", self.here)
        for where, name, address in (
            ((), self.here, "10.213.77.1/30"),
            (("-n", self._space), there, "10.213.77.2/30"),
        ):
            _ip(*where, "address", "add", address, "dev", name)
            _ip(*where, "link", "set", name, "up")
        _ip("-n", self._space, "link", "set", "lo", "up")

    def cut(self) -> None:
        """Let nothing through from now on; it says so to neither end's sockets."""
        _ip("link", "set", self.here, "down")


def _ip(*words: str) -> None:
    if shutil.which("ip") is None:
        raise MeasurementFailure("no `ip` here (iproute2): no cable to cut")
    done = subprocess.run(["ip", *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise MeasurementFailure(f"ip {' '.join(words)}: {done.stderr.strip()}")


class TrueGraph:
    """Hold the processes of one ROS domain on this computer's loopback."""

    def __init__(self, way: str, home: Path, stack: ExitStack, cable: Cable | None = None) -> None:
        """Describe it.

        Args:
            way: the transport to the process under test.
            home: becomes that process's ``$PONS_HOME``.
            stack: ends what was started.
            cable: leads from that process to the nodes; without one all are on the loopback.
        """
        self._cable = cable
        self.port = free_port()
        self.domain = 20 + self.port % 80
        self.way, self.home, self._stack = way, home, stack
        self.lines: dict[str, list[tuple[float, str]]] = {}
        self.servers: list[subprocess.Popen[str]] = []
        self._environment = dict(os.environ, ROS_DOMAIN_ID=str(self.domain))

    def start_node(self, name: str, *words: str) -> subprocess.Popen[str]:
        python = os.environ["PONS_ROS2_PYTHON"]
        """Start a node, and keep the lines that it says."""
        away = self._cable.words if self._cable else ()
        process = subprocess.Popen(
            [*away, python, *words], env=self._environment, cwd=CHECKOUT, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self._stack.callback(end_process, process)
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
        text = ROBOT.read_text("utf-8")
        interface = self._cable.here if self._cable else "lo"
        reached = f'transport = "dds"\ndomain = {self.domain}\ninterface = "{interface}"'
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
        self._stack.callback(end_process, process)
        return process

    def twists(self) -> Iterator[tuple[float, float]]:
        """Yield when each twist came to the base, and its speed [m/s]."""
        for _, line in tuple(self.lines["base"]):
            said = json.loads(line)
            yield said["at_s"], said["v"]


def _read(process: subprocess.Popen[str], heard: list[tuple[float, str]]) -> None:
    with suppress(ValueError):  # closed beside us
        heard.extend((time.monotonic(), line) for line in process.stdout or ())


def end_process(process: subprocess.Popen[Any]) -> None:
    """Kill a process and reap it."""
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
        self.echo_ms: list[float] = []
        self.state: DriveState | None = None

    def turn(self, wheel_radps: float = 0.0) -> None:
        self._next_s = max(self._next_s + TICK_S, time.monotonic() - TICK_S)
        time.sleep(max(0.0, self._next_s - time.monotonic()))
        seq = len(self.sent_s) + 1
        command = DriveCommand(
            boot="bench", seq=seq, left_radps=wheel_radps, right_radps=wheel_radps, enable=True
        )
        self.sent_s[seq] = time.monotonic()
        self._commands.put(command)
        for state in self._states.drain().items:
            if isinstance(state, DriveState):
                self.state = state
                if state.echo_boot == "bench":
                    self.echo_ms.append(1000 * (time.monotonic() - self.sent_s[state.echo_seq]))

    def until_obeyed(self) -> None:
        """Turn until the echo says that commands arrive."""
        end_s = time.monotonic() + START_S
        while self.state is None or self.state.timed_out or self.state.echo_boot != "bench":
            if time.monotonic() > end_s:
                raise TimeoutError(f"no command was obeyed within {START_S:.0f} s: {self.state}")
            self.turn()
