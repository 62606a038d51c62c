"""Measure the way to a ROS 2 base: commands delivered, what it adds, what a killed process costs.

The process under test is the shipped one. Line: a rosbridge server, or zenoh's router, with the
twin's relay in this process notes when each command is obeyed; beside it, the same commands as the
simulator would get them. Kills: SIGKILL in mid-drive at 0.3 m/s; the relay's end is when its twist
is zero, the body's is when the simulated robot stands.
"""

from __future__ import annotations

import signal
import subprocess
import threading
import time
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

from pons.robot_processes import free_port
from pons.settings import CHECKOUT
from processes.parent_death import child_command
from sim.twin.ros2 import Ros2Twin
from tools.bench.context import until
from tools.bench.report import ReportRow, row_of
from wire import DriveCommand, DriveState, Pose2, SimControl, SimTruth, keys, load_robot
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tools.bench.context import BenchLab

NAME = "ros2"
TITLE = "ROS 2 base: commands delivered, what the way adds, kills of the process in mid-drive"
LONG_ONLY = True
ROBOTS = {
    "rosbridge": CHECKOUT / "robots" / "ros2_diff_drive.toml",
    "zenoh": CHECKOUT / "robots" / "ros2_zenoh.toml",
}
"""By transport; ``ros2_true`` measures DDS, whose peers are true nodes."""
SITE = CHECKOUT / "sites" / "home"
COMMANDS, KILLS = 1_000, 20
TICK_S = 0.01
DRIVE_MPS = 0.3
STANDS_MPS = 0.01
START_S = 20.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure the line, then kill the process behind a relay alone, then behind a body."""
    rows = [row for way in ROBOTS for row in _measure_way(lab, way)]
    bodies = list(lab.slices("body", lab.count(3, KILLS), lambda _: _kill_before_body(lab)))
    return [
        *rows,
        row_of("rosbridge, killed: body stands", "ms", "", [run["stands_ms"] for run in bodies]),
        row_of("rosbridge, killed: path", "m", "", [run["path_m"] for run in bodies]),
    ]


def _measure_way(lab: BenchLab, way: str) -> list[ReportRow]:
    take_line = partial(_line, lab, way)
    runs = list(lab.slices(f"line.{way}", lab.count(1, 3), lambda _: take_line()))
    within = f"<= {1000 * load_robot(ROBOTS[way]).drive.timeout_s + 50:.0f}"
    relays = {fault: _zeros_ms(lab, way, fault) for fault in ("killed", "frozen", "cut")}
    delivered = ", ".join(f"{run['delivered']} of {run['sent']}" for run in runs)
    to_relay, to_drive, back = (
        _join_samples(runs, name) for name in ("ros2_ms", "wire_ms", "echo_ms")
    )
    return [
        ReportRow(f"{way}: commands that the relay obeyed", "", "all", value=delivered),
        row_of(f"{way}: bridge to relay", "ms", "", to_relay),
        row_of(f"{way}: bridge to the simulator's drive", "ms", "", to_drive),
        row_of(f"{way}: bridge to relay and back, as states say", "ms", "< 100", back),
        *(
            row_of(f"{way}, {fault}: relay at zero", "ms", within, ms)
            for fault, ms in relays.items()
        ),
    ]


def _zeros_ms(lab: BenchLab, way: str, fault: str) -> list[float]:
    take = partial(_break_before_relay, lab, way, fault)
    runs = lab.slices(f"{fault}.{way}", lab.count(3, KILLS), lambda _: take())
    return [run["zero_ms"] for run in runs]


def _join_samples(runs: list[dict[str, Any]], name: str) -> list[float]:
    return [one for run in runs for one in run[name]]


class _RelayWatch(threading.Thread):
    """Run the twin's server and relay without a body, and note when each command counts."""

    def __init__(self, port: int, way: str) -> None:
        super().__init__(daemon=True)
        self.twin = Ros2Twin(load_robot(ROBOTS[way]), port)
        self.obeyed_s: dict[int, float] = {}
        self.zeros_s: list[float] = []
        """When the twist fell to zero."""
        self._moved = False
        self._ending = threading.Event()

    def run(self) -> None:
        ticks = 0
        while not self._ending.wait(0.001):
            now_s = time.monotonic()
            ticks += 1
            self._obey(now_s)
            if ticks % 10 == 0:
                self.twin.report(_make_resting_state(now_s), now_s)
                self.twin.command(now_s)

    def _obey(self, now_s: float) -> None:
        relay = self.twin.relay
        for topic, message in self.twin.server.take():
            if topic == "/pons/command" and relay.hear(message.get("data"), now_s):
                order = relay.order
                if order is not None:
                    self.obeyed_s[order.seq] = now_s
        moves = relay.twist(now_s)[0] != 0.0
        if self._moved and not moves:
            self.zeros_s.append(now_s)
        self._moved = moves

    def end(self) -> None:
        self._ending.set()
        self.join()
        self.twin.close()


def _make_resting_state(now_s: float) -> DriveState:
    return DriveState(
        boot_id="bench", seq=1, stamp_s=now_s, echo_boot=None, echo_seq=0, enabled=True,
        timed_out=False, left_rad=0.0, right_rad=0.0, left_radps=0.0, right_radps=0.0,
    )  # fmt: skip


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


@contextmanager
def _process(home: Path, way: str, *words: str) -> Iterator[subprocess.Popen[bytes]]:
    common = ("--home", str(home), "--robot", str(ROBOTS[way]), "--site", str(SITE))
    with (home / f"{words[0]}.log").open("ab") as log:
        process = subprocess.Popen(
            child_command(words[0], *common, *words[1:]), cwd=CHECKOUT, stdout=log, stderr=log
        )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def _line(lab: BenchLab, way: str) -> dict[str, Any]:
    """Send a thousand commands; note when relay and simulator would have them."""
    port = free_port()
    with lab.folder() as home, ExitStack() as stack:
        watch = _RelayWatch(port, way)
        watch.start()
        stack.callback(watch.end)
        stack.enter_context(_process(home, way, "ros2", "--port", str(port)))
        robot = open_session(Party.ROBOT, "r1", home)
        stack.callback(robot.close)
        heard = robot.subscriber(keys.DRIVE_COMMAND)
        commander = Commander(home)
        stack.callback(commander.session.close)
        commander.until_obeyed()
        commander.echo_ms.clear()
        first, direct_s = len(commander.sent_s) + 1, {}
        ending = threading.Event()

        def listen() -> None:
            while not ending.wait(0.001):
                command = heard.newest()
                if command is not None:
                    direct_s[command.seq] = time.monotonic()

        listener = threading.Thread(target=listen, daemon=True)
        listener.start()
        for _ in range(COMMANDS):
            commander.turn(1.0)
        time.sleep(0.3)
        ending.set()
        listener.join()
    wanted = range(first, first + COMMANDS)
    sent_s, obeyed_s = commander.sent_s, watch.obeyed_s
    return {
        "sent": COMMANDS,
        "delivered": sum(seq in obeyed_s for seq in wanted),
        "ros2_ms": [1000 * (obeyed_s[seq] - sent_s[seq]) for seq in wanted if seq in obeyed_s],
        "wire_ms": [1000 * (direct_s[seq] - sent_s[seq]) for seq in wanted if seq in direct_s],
        "echo_ms": commander.echo_ms,
    }


def _break_before_relay(lab: BenchLab, way: str, fault: str) -> dict[str, float]:
    """Kill or freeze the process, or cut its connection, in mid-drive."""
    port = free_port()
    with lab.folder() as home, ExitStack() as stack:
        watch = _RelayWatch(port, way)
        watch.start()
        stack.callback(watch.end)
        process = stack.enter_context(_process(home, way, "ros2", "--port", str(port)))
        commander = Commander(home)
        stack.callback(commander.session.close)
        commander.until_obeyed()
        for _ in range(100):
            commander.turn(DRIVE_MPS / 0.1)
        watch.zeros_s.clear()
        broken_s = time.monotonic()
        if fault == "cut":
            watch.twin.server.hang_up()
        else:
            process.send_signal(signal.SIGKILL if fault == "killed" else signal.SIGSTOP)
        for _ in range(60):  # the bridge goes on
            commander.turn(DRIVE_MPS / 0.1)
        until(lambda: watch.zeros_s, START_S, "the relay at zero")
        return {"zero_ms": 1000 * (watch.zeros_s[0] - broken_s)}


def _kill_before_body(lab: BenchLab) -> dict[str, float]:
    port = free_port()
    with lab.folder() as home, ExitStack() as stack:
        stack.enter_context(_process(home, "rosbridge", "sim", "--ros2-twin", str(port)))
        process = stack.enter_context(_process(home, "rosbridge", "ros2", "--port", str(port)))
        commander = Commander(home)
        stack.callback(commander.session.close)
        judge = open_session(Party.JUDGE, "r1", home)
        stack.callback(judge.close)
        truths, controls = judge.subscriber(keys.SIM_TRUTH), judge.publisher(keys.SIM_CONTROL)
        commander.until_obeyed()
        start = Pose2(9.3, 6.6, 0.0)
        controls.put(SimControl(id="start", place_robot=start))
        for _ in range(100):
            commander.turn(DRIVE_MPS / 0.1)
        process.send_signal(signal.SIGKILL)
        killed_s = time.monotonic()
        truths.drain_bytes()
        path: list[SimTruth] = []
        while time.monotonic() < killed_s + 1.5:
            commander.turn(DRIVE_MPS / 0.1)
            path += [one for one in truths.drain().items if isinstance(one, SimTruth)]
    return _stop_of(path, killed_s)


def _stop_of(path: list[SimTruth], killed_s: float) -> dict[str, float]:
    moving = [one for one in path if abs(one.twist.v_mps) > STANDS_MPS]
    after = [one for one in path if one.stamp_s > moving[-1].stamp_s] if moving else path
    first, last = path[0].base_in_map, path[-1].base_in_map
    way_m = ((first.x_m - last.x_m) ** 2 + (first.y_m - last.y_m) ** 2) ** 0.5
    return {
        "stands_ms": 1000 * (after[0].stamp_s - killed_s),
        "path_m": way_m,
    }
