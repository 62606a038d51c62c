"""Measure what each kind of drive does to the bridge's tick, and how long bytes take through a pty.

Tick: the bridge with a stopwatch at its edges stands by, after a self test in which its drive has
spoken; the simulator plays the drive, at a pseudo-terminal or as a ROS 2 graph. Each round takes
all drives one after another, so that what the host does to one it does to the others. Bytes: each
drive's own command, written through the shipped port, until the far end has the whole of it.
"""

from __future__ import annotations

import os
import pty
import threading
import time
from functools import partial
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from bridge.operator_key import FILE as KEY_FILE
from devices import SerialPort, pons_mcu, ros_arduino, turtlebot3, waveshare
from pons.robot_processes import PATIENCE_S, RobotProcesses, free_port
from pons.settings import CHECKOUT, LaunchSettings
from tools.bench.context import until
from tools.bench.figures import percentile
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import TAPPED, read_tap
from wire import Mode, load_robot
from wire.keys import STATUS, Party
from wire.session import open_session

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "drive_lateness"
TITLE = "drives of metal: lateness of the tick beside each, and bytes through a pseudo-terminal"
LONG_ONLY = True
SIMULATED = "simulated"
SITE = CHECKOUT / "sites" / "two_room"
ROBOTS = {
    SIMULATED: CHECKOUT / "robot.toml",
    "pons_mcu": CHECKOUT / "robots" / "pons_mcu.toml",
    "waveshare": CHECKOUT / "robots" / "waveshare_ugv_rover.toml",
    "arduino": CHECKOUT / "robots" / "arduino.toml",
    "turtlebot3": CHECKOUT / "robots" / "turtlebot3_burger.toml",
    "ros2": CHECKOUT / "robots" / "ros2_diff_drive.toml",
}
ROUNDS, SLICE_S, SETTLE_S = 10, 3.0, 0.5
START_S = 30.0
TICKS_A_S = 100
COMMANDS = 2_000
BAUD = 115_200
"""A pseudo-terminal keeps no speed: what is measured is this computer."""
MESSAGES = {
    "pons_mcu": pons_mcu.encode_command(
        pons_mcu.McuCommand(1, 1, 5_000, 5_000, 4096, 200, pons_mcu.ENABLE)
    ),
    "waveshare": waveshare.encode_speed(0.2, 0.2, "ab12-345678-1"),
    "arduino": ros_arduino.encode_move(20, 20),
    "turtlebot3": turtlebot3.encode_command(20, 10) + turtlebot3.encode_heartbeat(1),
}
"""One tick's command of each drive with a line."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take rounds of all drives; then send each one's commands through a pseudo-terminal."""
    count = lab.count(2, ROUNDS)
    rounds = list(lab.slices("round", count, lambda index: take_round(lab, index)))
    rows = tick_rows(rounds)
    for kind in MESSAGES:
        runs = lab.slices(f"bytes.{kind}", 1, partial(_bytes_slice, kind))
        taken_ms = [one for run in runs for one in run]
        rows.append(row_of(f"{kind}: write to the far end", "ms", "p99 <= 1", taken_ms))
    return rows


# The tick beside each drive -----------------------------------------------------------------------


def take_round(lab: BenchLab, index: int) -> dict[str, list[float]]:
    """Return how late each tick of a slice began [us], by drive; each round begins with another."""
    kinds = list(ROBOTS)
    first = index % len(kinds)
    return {kind: _late_us(lab, kind) for kind in kinds[first:] + kinds[:first]}


def _late_us(lab: BenchLab, kind: str) -> list[float]:
    with lab.folder() as home:
        (home / KEY_FILE).write_bytes(os.urandom(32))
        (home / KEY_FILE).chmod(0o600)
        processes = _processes(home, kind)
        with processes, open_session(Party.JUDGE, load_robot(ROBOTS[kind]).id, home) as judge:
            statuses = judge.subscriber(STATUS)

            def has_spoken() -> bool:
                status = statuses.newest()
                return status is not None and status.mode is Mode.DISARMED

            until(has_spoken, START_S, f"the self test with {kind}", 0.02)
            time.sleep(SETTLE_S + SLICE_S)
            processes.children["bridge"].stop(PATIENCE_S)
            late_us: list[float] = read_tap(home)["late_us"]
    return late_us[-round(SLICE_S * TICKS_A_S) :]


def _processes(home: Path, kind: str) -> RobotProcesses:
    """Return the simulator, who speaks to a ROS 2 base where there is one, and the bridge."""
    settings = LaunchSettings(home, ROBOTS[kind], SITE, "127.0.0.1", free_port())
    names, more = ["sim", "bridge"], dict[str, list[str]]()
    if kind == "ros2":
        names.insert(1, "ros2")
        port = str(free_port())
        more = {"sim": ["--ros2-twin", port], "ros2": ["--port", port]}
    elif kind != SIMULATED:
        line = str(home / "twin" / "drive")
        more = {"sim": ["--twin", line], "bridge": ["--drive-port", line]}
    return RobotProcesses(settings, names, modules={"bridge": TAPPED}, arguments=more)


def tick_rows(rounds: list[dict[str, list[float]]]) -> list[ReportRow]:
    """Set each drive beside the simulated one of the same round.

    A drive may be later by no more than the simulated one differs from slice to slice.
    """
    rows = []
    for label, share in (("median", 0.5), ("p99", 0.99)):
        simulated = [percentile(one[SIMULATED], share) for one in rounds]
        spread_us = max(simulated, default=0.0) - min(simulated, default=0.0)
        for kind in ROBOTS:
            found = [percentile(one[kind], share) for one in rounds]
            more = [mine - its for mine, its in zip(found, simulated, strict=True)]
            note = "" if not more else f"above the simulated one, median: {median(more):.0f}"
            goal = "" if kind == SIMULATED else f"above it <= {spread_us:.0f}, its spread"
            rows.append(row_of(f"{kind}: {label} of a slice", "us", goal, found, note))
    return rows


# Bytes through a pseudo-terminal ------------------------------------------------------------------


def _bytes_slice(kind: str, _index: int) -> Any:
    return write_ms(kind)


def write_ms(kind: str, count: int = COMMANDS) -> list[float]:
    """Return how long each command took from the port's write until the far end had it all."""
    near, far = pty.openpty()
    try:
        with SerialPort(Path(os.ttyname(far)), BAUD) as port:
            return _send(port, near, MESSAGES[kind], count)
    finally:
        os.close(near)
        os.close(far)


def _send(port: SerialPort, near: int, message: bytes, count: int) -> list[float]:
    """Write a message at 100 Hz; a thread stands at the far end."""
    came_s: list[float] = []

    def hear() -> None:
        for _ in range(count):
            left = len(message)
            while left > 0:
                left -= len(os.read(near, left))
            came_s.append(time.monotonic())

    ears = threading.Thread(target=hear, daemon=True)
    ears.start()
    sent_s: list[float] = []
    for _ in range(count):
        time.sleep(1.0 / TICKS_A_S)
        sent_s.append(time.monotonic())
        port.write(message)
    ears.join(1.0)
    return [1000.0 * (came - went) for went, came in zip(sent_s, came_s, strict=True)]
