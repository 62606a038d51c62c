"""The process finds its server, says what is wrong with the graph, and lets nothing old through."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from pons.robot_processes import free_port
from ros2.__main__ import main
from sim.twin.ros2_relay import RelayFirmware
from sim.twin.rosbridge_server import RosbridgeServer
from tests.ros2.frames import TYPES, odometry, relay_state
from wire import DriveCommand, DriveState, Ros2Status, keys
from wire.keys import Party
from wire.session import Session, open_session

LIMIT_S = 60.0
ROBOT = """
[drive]
kind = "ros2"
[ros2]
url = "ws://127.0.0.1:{port}"
[inputs]
imu = false
"""


class Base(threading.Thread):
    """Be a base with its relay behind a server, in real time."""

    def __init__(self, port: int, types: dict[str, str]) -> None:
        super().__init__(daemon=True)
        self.server = RosbridgeServer(port, types)
        self.relay = RelayFirmware(TYPES["/cmd_vel"])
        self.accepted: list[tuple[float, float]] = []
        self._ending = threading.Event()

    def run(self) -> None:
        ros_s = relay_state(0.0, 1)["data"]
        epoch_s = json.loads(ros_s)["ros"]
        ticks = 0
        while not self._ending.wait(0.01):
            now_s = time.monotonic()
            for topic, message in self.server.take():
                if topic == "/pons/command" and self.relay.hear(message["data"], now_s):
                    self.accepted.append((now_s, self.relay.twist(now_s)[0]))
                self.hear_other(topic, message, now_s)
            self.say_more(now_s)
            state = self.relay.state(now_s, now_s + epoch_s)
            self.server.publish("/pons/state", {"data": state})
            ticks += 1
            if ticks % 2 == 0:
                self.server.publish("/odom", odometry(now_s))

    def hear_other(self, topic: str, message: dict[str, Any], now_s: float) -> None:
        """Hear what is no relay's."""

    def say_more(self, now_s: float) -> None:
        """Say what another node of this robot says."""

    def stands(self) -> bool:
        return self.relay.twist(time.monotonic()) == (0.0, 0.0, False)

    def end(self) -> None:
        self._ending.set()
        self.join()
        self.server.close()


class Bridge:
    """Command as a bridge does and hear what comes back, until something holds."""

    def __init__(self, home: Path) -> None:
        self.home = home
        self.session: Session = open_session(Party.BRIDGE, "r1", home)
        self.judge = open_session(Party.JUDGE, "r1", home)
        self._commands = self.session.publisher(keys.DRIVE_COMMAND)
        self._states = self.session.subscriber(keys.DRIVE_STATE)
        self._status = self.judge.subscriber(keys.ROS2_STATE)
        self.state: DriveState | None = None
        self.status: Ros2Status | None = None
        self.seq = 0

    def until(self, done: Callable[[], bool]) -> None:
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, f"nothing came of it: {self.status}, {self.state}"
            self.seq += 1
            self._commands.put(
                DriveCommand(
                    boot="boot1", seq=self.seq, left_radps=1.0, right_radps=1.0, enable=True
                )
            )
            time.sleep(0.01)
            self.state = self._states.newest() or self.state
            self.status = self._status.newest() or self.status

    def code(self) -> str | None:
        return self.status.code if self.status else "nothing"

    def close(self) -> None:
        self.session.close()
        self.judge.close()


@pytest.fixture
def bridge(tmp_path: Path) -> Iterator[Bridge]:
    made = Bridge(tmp_path)
    yield made
    made.close()


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def process(tmp_path: Path, port: int) -> Iterator[subprocess.Popen[str]]:
    path = tmp_path / "robot.toml"
    path.write_text(ROBOT.format(port=port))
    words = ["--robot", str(path), "--home", str(tmp_path)]
    started = subprocess.Popen(
        [sys.executable, "-m", "ros2", *words], stderr=subprocess.PIPE, text=True
    )
    yield started
    started.kill()
    started.communicate(timeout=LIMIT_S)


@pytest.fixture
def based(port: int) -> Iterator[Callable[..., Base]]:
    made: list[Base] = []

    def start(**types: str) -> Base:
        known = {topic: kind for topic, kind in TYPES.items() if topic not in ("/scan", "/imu")}
        known |= {f"/{name}": kind for name, kind in types.items()}
        made.append(Base(port, {topic: kind for topic, kind in known.items() if kind}))
        made[-1].start()
        return made[-1]

    yield start
    for base in made:
        base.end()


@pytest.mark.e2e
def test_a_server_that_comes_late_vanishes_and_comes_back_is_driven_and_the_base_stands_between(
    bridge: Bridge, process: subprocess.Popen[str], based: Callable[..., Base]
) -> None:
    bridge.until(lambda: bridge.code() == "ros2_no_server")
    base = based()
    bridge.until(lambda: bridge.code() is None)
    bridge.until(lambda: bridge.state is not None and bridge.state.echo_boot == "boot1")
    assert bridge.state is not None
    assert bridge.state.enabled
    bridge.until(lambda: base.relay.twist(time.monotonic())[0] > 0.0)
    base.server.hang_up()
    bridge.until(lambda: bridge.code() not in (None, "ros2_starting"))
    assert bridge.code() == "ros2_server_gone"
    bridge.until(lambda: bridge.code() is None)  # it dialled anew, and is driven again
    echoed = bridge.state.echo_seq
    bridge.until(lambda: bridge.state is not None and bridge.state.echo_seq > echoed)
    process.send_signal(signal.SIGTERM)
    assert process.wait(LIMIT_S) == 0


@pytest.mark.e2e
@pytest.mark.parametrize(
    ("types", "code"),
    [
        ({"pons/state": ""}, "ros2_no_relay"),
        ({"cmd_vel": ""}, "ros2_no_base"),
        ({"cmd_vel": "std_msgs/msg/String"}, "ros2_cmd_vel_type"),
        ({"odom": "geometry_msgs/msg/Pose"}, "ros2_topic_type"),
    ],
)
def test_a_graph_that_is_wrong_is_named_and_nothing_is_driven(
    bridge: Bridge,
    process: subprocess.Popen[str],
    based: Callable[..., Base],
    types: dict[str, str],
    code: str,
) -> None:
    base = based(**types)
    bridge.until(lambda: bridge.code() == code)
    assert bridge.state is None
    assert base.accepted == []
    assert base.stands()
    assert process.poll() is None, "it waits for a graph that is right"


@pytest.mark.e2e
def test_the_base_stands_by_its_dead_man_when_the_process_is_killed_in_mid_drive(
    bridge: Bridge, process: subprocess.Popen[str], based: Callable[..., Base]
) -> None:
    base = based()
    bridge.until(lambda: base.relay.twist(time.monotonic())[0] > 0.0)
    process.kill()
    process.wait(LIMIT_S)
    bridge.until(base.stands)
    newest = base.accepted[-1][0]
    time.sleep(0.3)
    assert base.accepted[-1][0] - newest < 0.2
    assert base.stands()


@pytest.mark.e2e
def test_a_process_that_was_frozen_lets_nothing_old_through(
    bridge: Bridge, process: subprocess.Popen[str], based: Callable[..., Base]
) -> None:
    base = based()
    bridge.until(lambda: base.relay.twist(time.monotonic())[0] > 0.0)
    process.send_signal(signal.SIGSTOP)
    bridge.until(base.stands)
    time.sleep(0.5)  # the bridge says nothing any more, what it said lies in the sockets
    before = len(base.accepted)
    process.send_signal(signal.SIGCONT)
    time.sleep(1.0)
    assert len(base.accepted) == before
    assert base.stands()
    bridge.until(lambda: not base.stands())


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "ros2_not_configured"),
        ('[drive]\nkind = "ros2"\n', "robot_toml_invalid"),
        ('[ros2]\nurl = "http://x"\n', "robot_toml_invalid"),
    ],
)
def test_a_wrong_file_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, code: str
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(text)
    assert main(["--robot", str(path), "--home", str(tmp_path)]) == 2
    assert code in capsys.readouterr().err
