"""The process finds its robot, says what is wrong with it, and lets nothing old through."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pons.robot_processes import free_port
from ros2.pons_ros2.pons_ros2.dead_man import CmdVelDeadMan
from ros2.pons_ros2.pons_ros2.goals import Nav2Dialogue, read_order
from ros2.pons_ros2.pons_ros2.link import PlannerLink
from tests.ros2.bridge import LIMIT_S, Bridge
from tests.ros2.words import ROS_S, STAMPED, odometry
from wire import Nav2Goal, Nav2State, Pose2, keys
from wire.keys import Party
from wire.session import open_session

ROBOT = """
[drive]
kind = "ros2"
[ros2]
node = "tcp/127.0.0.1:{port}"
[inputs]
imu = false
"""
KEY = b"a key of both ends"


class Robot(threading.Thread):
    """Be a base behind its node, in real time."""

    def __init__(self, port: int, key: bytes = b"", **graph: object) -> None:
        super().__init__(daemon=True)
        self.link = PlannerLink(f"tcp/127.0.0.1:{port}", has_key=bool(key))
        self.dead_man, self.goals = CmdVelDeadMan("relay-1", key), Nav2Dialogue(time.monotonic())
        self.goals.trouble = None
        self.graph = {"cmd_vel": STAMPED, "others": 0, "code": None, "found": ""} | graph
        self.accepted_s: list[float] = []
        self.published: list[object] = []
        self._ending = threading.Event()
        self.link.hear("command", self.hear)
        self.link.hear(
            "nav2/goal", lambda text: self.goals.take(read_order(text), time.monotonic())
        )

    def hear(self, text: str) -> None:
        now_s = time.monotonic()
        if self.dead_man.hear(text, now_s):
            self.accepted_s.append(now_s)

    def run(self) -> None:
        while not self._ending.wait(0.01):
            now_s = time.monotonic()
            self.link.say("state", self.dead_man.state(now_s, now_s + ROS_S, **self.graph))
            self.link.say("odom", odometry(now_s).decode())
            pose = self.goals.due(now_s)
            self.published += [pose] if pose else []
            self.link.say("nav2/state", self.goals.state("relay-1", now_s))

    def moves(self) -> bool:
        return self.dead_man.twist(time.monotonic())[0] > 0.0

    def stands(self) -> bool:
        return not self.moves()

    def end(self) -> None:
        self._ending.set()
        self.join()
        self.link.close()


@pytest.fixture
def bridge(tmp_path: Path) -> Iterator[Bridge]:
    made = Bridge(tmp_path)
    yield made
    made.close()


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def start(tmp_path: Path, port: int) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    made: list[subprocess.Popen[str]] = []

    def begin(more: str = "") -> subprocess.Popen[str]:
        path = tmp_path / "robot.toml"
        path.write_text(ROBOT.format(port=port) + more)
        words = ["--robot", str(path), "--home", str(tmp_path)]
        made.append(
            subprocess.Popen(
                [sys.executable, "-m", "ros2", *words], stderr=subprocess.PIPE, text=True
            )
        )
        return made[-1]

    yield begin
    for one in made:
        one.kill()
        one.communicate(timeout=LIMIT_S)


@pytest.fixture
def robot(port: int) -> Iterator[Callable[..., Robot]]:
    made: list[Robot] = []

    def begin(**given: object) -> Robot:
        made.append(Robot(port, **given))  # type: ignore[arg-type]  # as each test has it
        made[-1].start()
        return made[-1]

    yield begin
    for one in made:
        if one.is_alive():
            one.end()


Start = Callable[..., subprocess.Popen[str]]
Make = Callable[..., Robot]


@pytest.mark.e2e
def test_a_robot_that_comes_late_goes_and_comes_back_is_driven_and_stands_between(
    bridge: Bridge, start: Start, robot: Make
) -> None:
    process = start()
    bridge.until(lambda: bridge.code() == "ros2_no_node")
    first = robot()
    bridge.until(lambda: bridge.code() is None)
    bridge.until(lambda: bridge.state is not None and bridge.state.echo_boot == "boot1")
    bridge.until(first.moves)
    first.end()
    bridge.until(lambda: bridge.code() == "ros2_node_gone")
    second = robot()
    bridge.until(second.moves)
    process.send_signal(signal.SIGTERM)
    assert process.wait(LIMIT_S) == 0


@pytest.mark.e2e
@pytest.mark.parametrize(
    ("graph", "code"),
    [
        ({"code": "ros2_topic_type", "found": "odom is a Pose"}, "ros2_topic_type"),
        ({"others": 1}, "ros2_cmd_vel_shared"),
        ({"cmd_vel": ""}, "ros2_no_base"),
        ({"key": KEY}, "ros2_relay_key"),
    ],
)
def test_a_robot_that_may_not_be_driven_is_named_and_nothing_moves(
    bridge: Bridge, start: Start, robot: Make, graph: dict[str, object], code: str
) -> None:
    made = robot(**graph)
    process = start()
    bridge.until(lambda: bridge.code() == code)
    assert bridge.state is None
    assert made.accepted_s == []
    assert made.stands()
    assert process.poll() is None, "it waits for a graph that is right"


@pytest.mark.e2e
def test_with_the_key_of_both_ends_it_is_driven(
    bridge: Bridge, start: Start, robot: Make, tmp_path: Path
) -> None:
    path = tmp_path / "relay.key"
    path.write_bytes(KEY)
    path.chmod(0o600)
    made = robot(key=KEY)
    start()
    bridge.until(made.moves)


@pytest.mark.nightly
@pytest.mark.e2e
def test_the_base_stands_by_its_dead_man_when_the_process_is_killed_in_mid_drive(
    bridge: Bridge, start: Start, robot: Make
) -> None:
    made, process = robot(), start()
    bridge.until(made.moves)
    process.kill()
    process.wait(LIMIT_S)
    time.sleep(0.3)
    newest = len(made.accepted_s)
    assert made.stands()
    time.sleep(0.3)
    assert len(made.accepted_s) == newest
    assert made.stands()


@pytest.mark.nightly
@pytest.mark.e2e
def test_a_process_that_was_frozen_lets_nothing_old_through(
    bridge: Bridge, start: Start, robot: Make
) -> None:
    made, process = robot(), start()
    bridge.until(made.moves)
    process.send_signal(signal.SIGSTOP)
    bridge.until(made.stands)
    time.sleep(0.5)  # the bridge says nothing any more, what it said lies in the sockets
    before = len(made.accepted_s)
    process.send_signal(signal.SIGCONT)
    time.sleep(1.0)
    assert len(made.accepted_s) == before
    assert made.stands()
    bridge.until(made.moves)


@pytest.mark.nightly
@pytest.mark.e2e
def test_goals_go_to_nav2_and_its_word_comes_back(
    bridge: Bridge, start: Start, robot: Make, tmp_path: Path
) -> None:
    made = robot()
    start("[ros2.nav2]\n")
    heard: list[Nav2State] = []
    with open_session(Party.PLANNER, "r1", tmp_path) as planner:
        says, hears = planner.publisher(keys.NAV2_GOAL), planner.subscriber(keys.NAV2_STATE)
        goal = Pose2(2.0, 1.0, 0.5)
        order = Nav2Goal(planner_id="p", seen=1, mission="m", leg=1, goal=goal, here=None)

        def is_sent() -> bool:
            says.put(order)
            state = hears.newest()
            heard.extend([] if state is None else [state])
            return bool(heard) and heard[-1].phase == "sent"

        bridge.until(is_sent)
    assert (heard[-1].mission, heard[-1].leg) == ("m", 1)
    assert made.published[0] == (2.0, 1.0, 0.5)
