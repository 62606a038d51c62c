"""Measure Pons against true ROS 2 nodes, by rosbridge and by DDS: delivery, and kills in mid-drive.

The base is a rclpy node without a dead-man of its own (tests/ros2/ros_graph.py), before it our
relay as it is shipped. Killed and frozen is the process under test; cut is, by rosbridge, its
server (killed) and, by DDS, the cable to the nodes, which are on a network of their own then.
Needs a Python with rclpy, named by PONS_ROS2_PYTHON (docs/ros2.md); the cable needs root's rights.
"""

from __future__ import annotations

import signal
import time
from contextlib import ExitStack
from functools import partial
from typing import TYPE_CHECKING, Any

from tools.bench.context import MeasurementFailure, until
from tools.bench.report import ReportRow, row_of
from tools.bench.ros2_graph import (
    ROBOT,
    START_S,
    WAYS,
    Cable,
    Commander,
    TrueGraph,
    check_for_rclpy,
)
from wire import keys, load_robot

if TYPE_CHECKING:
    import subprocess

    from tools.bench.context import BenchLab

NAME = "ros2_true"
TITLE = "ROS 2 true nodes: commands, scans, kills in mid-drive, by transport"
LONG_ONLY = True
COMMANDS, KILLS, SCANS_S = 1_000, 20, 20.0
FAULTS = ("killed", "frozen", "cut")
STAMPED = "geometry_msgs/msg/TwistStamped"
DRIVE_MPS = 0.3
STEP_MPS = 1e-5
"""Each command of the line has a speed of its own, by which the base's line tells it."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure each way: the line, then kills, freezes and cuts."""
    check_for_rclpy()
    return [row for way in WAYS for row in _measure_way(lab, way)]


def _measure_way(lab: BenchLab, way: str) -> list[ReportRow]:
    take_line = partial(_line, lab, way)
    lines = list(lab.slices(f"line.{way}", lab.count(1, 3), lambda _: take_line()))
    zeros = {fault: _zeros_ms(lab, way, fault) for fault in FAULTS}
    delivered = ", ".join(f"{one['delivered']} of {COMMANDS}" for one in lines)
    scans = ", ".join(f"{one['scans']} of {one['scans_said']}" for one in lines)
    came_ms = [one for line in lines for one in line["came_ms"]]
    within = f"<= {1000 * load_robot(ROBOT).drive.timeout_s + 50:.0f}"
    return [
        ReportRow(f"{way}: commands at the base's node", "", ">= 99 %", value=delivered),
        row_of(f"{way}: bridge to the base's node", "ms", "p99 <= 10", came_ms),
        ReportRow(f"{way}: scans of 10 Hz", "", ">= 99 %", value=scans),
        *(row_of(f"{way}, {fault}: zeros at the base", "ms", within, ms)
          for fault, ms in zeros.items()),
    ]  # fmt: skip


def _zeros_ms(lab: BenchLab, way: str, fault: str) -> list[float]:
    take = partial(_break_line, lab, way, fault)
    runs = lab.slices(f"{fault}.{way}", lab.count(2, KILLS), lambda _: take())
    return [run["zero_ms"] for run in runs]


def _begin_line(stack: ExitStack, graph: TrueGraph) -> tuple[Commander, subprocess.Popen[bytes]]:
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
        graph = TrueGraph(way, home, stack)
        commander, _ = _begin_line(stack, graph)
        radius_m = load_robot(ROBOT).base.wheel_radius_m
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
    """Kill or freeze the process, or cut its server or cable, in mid-drive; wait for zeros."""
    with lab.folder() as home, ExitStack() as stack:
        is_laid = (way, fault) == ("dds", "cut")
        cable = Cable(stack) if is_laid else None
        graph = TrueGraph(way, home, stack, cable)
        commander, process = _begin_line(stack, graph)
        radius_m = load_robot(ROBOT).base.wheel_radius_m
        for _ in range(100):
            commander.turn(DRIVE_MPS / radius_m)
        if not any(speed > 0.9 * DRIVE_MPS for _, speed in graph.twists()):
            raise MeasurementFailure(f"the base does not drive; {commander.state}")
        broken_s = time.monotonic()
        if cable is not None:
            cable.cut()
        elif fault == "cut":
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
