"""Against true ROS 2 nodes: our relay beside a base that has no dead-man, by rosbridge and by DDS.

Run where a Python with rclpy, nav_msgs and websockets is named by PONS_ROS2_PYTHON, or is the
system's own; skipped aloud elsewhere. docs/ros2.md says how to make one.
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from maps import OCCUPIED, UNKNOWN, load_map
from pons import site
from pons.robot_processes import free_port
from pons.settings import LaunchSettings
from sensors.camera.shot import CameraTrouble
from sensors.camera.source import open_source
from tests.ros2.test_process import ROBOT, Bridge
from tests.sensors.camera.test_packed_picture import JPEG, PICTURE
from wire import CameraConfig, Nav2Goal, Nav2State, Pose2, Scan, keys, load_robot
from wire.keys import Party
from wire.session import open_session

NEEDS = "import rclpy, nav_msgs, websockets"
LIMIT_S = 60.0
HAS_DDS = importlib.util.find_spec("cyclonedds") is not None
BY_DDS = pytest.param(
    "dds", marks=pytest.mark.skipif(not HAS_DDS, reason="cyclonedds is not installed (extra dds)")
)
by_each = pytest.mark.parametrize("way", ["rosbridge", BY_DDS])
TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"


def python_with_ros() -> str | None:
    for path in (os.environ.get("PONS_ROS2_PYTHON"), "/usr/bin/python3"):
        if path is None or not Path(path).is_file():
            continue
        with suppress(OSError, subprocess.SubprocessError):
            subprocess.run([path, "-c", NEEDS], check=True, capture_output=True, timeout=LIMIT_S)
            return path
    return None


PYTHON = python_with_ros() or ""
pytestmark = [
    pytest.mark.e2e,
    pytest.mark.timeout(90),
    pytest.mark.skipif(
        not PYTHON, reason="no Python with rclpy and websockets: name one in PONS_ROS2_PYTHON"
    ),
]


class Graph:
    """Hold the processes of one ROS domain."""

    def __init__(self, home: Path, root: Path) -> None:
        self.home, self.root, self.port = home, root, free_port()
        self.domain, self.way = 20 + self.port % 80, "rosbridge"
        self.environment = dict(os.environ, ROS_DOMAIN_ID=str(self.domain))
        self.processes: list[subprocess.Popen[str]] = []
        self.twists: list[dict[str, float]] = []
        self.more = ""
        """More of robot.toml."""

    def start(self, *words: str) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            words, env=self.environment, cwd=self.root, text=True, stdout=subprocess.PIPE
        )
        self.processes.append(process)
        return process

    def base(self, kind: str) -> None:
        process = self.start(PYTHON, "tests/ros2/ros_graph.py", "base", kind)
        threading.Thread(target=self._read, args=(process,), daemon=True).start()

    def reach(self, way: str) -> None:
        """Start what the way needs on the robot: DDS needs nothing."""
        self.way = way
        if way == "rosbridge":
            self.bridge()

    def bridge(self) -> None:
        server = self.start(PYTHON, "tests/ros2/ros_graph.py", "bridge", str(self.port))
        assert server.stdout is not None
        assert server.stdout.readline() == "ready\n"

    def relay(self) -> subprocess.Popen[str]:
        given = ["--ros-args", "-p", "scan:=/scan"]
        return self.start(PYTHON, "examples/ros2_relay/relay.py", *given)

    def process(self, scan: str = "") -> subprocess.Popen[str]:
        words = ("--robot", str(self.describe(scan)), "--home", str(self.home))
        return self.start(sys.executable, "-m", "ros2", *words)

    def describe(self, scan: str = "") -> Path:
        """Write the robot.toml that reaches this graph."""
        path = self.home / "robot.toml"
        text = ROBOT.format(port=self.port)
        if self.way == "dds":
            dds = f'transport = "dds"\ndomain = {self.domain}\ninterface = "lo"'
            text = text.replace(f'url = "ws://127.0.0.1:{self.port}"', dds)
        if scan:
            text = text.replace("[inputs]", f'scan = "{scan}"\n[lidar]\nkind = "ros2"\n[inputs]')
        path.write_text(text + self.more)
        return path

    def close(self) -> None:
        for process in self.processes:
            process.kill()
        for process in self.processes:
            process.communicate(timeout=LIMIT_S)

    def _read(self, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        with suppress(ValueError):  # closed beside us
            for line in process.stdout:
                self.twists.append(json.loads(line))


@pytest.fixture
def graph(tmp_path: Path, repository: Path) -> Iterator[Graph]:
    made = Graph(tmp_path, repository)
    yield made
    made.close()


@pytest.fixture
def bridge(tmp_path: Path) -> Iterator[Bridge]:
    made = Bridge(tmp_path)
    yield made
    made.close()


def is_fast(graph: Graph) -> Callable[[], bool]:
    return lambda: bool(graph.twists) and graph.twists[-1]["v"] > 0.05


@by_each
@pytest.mark.parametrize("kind", [TWIST, STAMPED])
def test_a_base_of_either_twist_is_driven_and_stands_when_the_process_is_killed(
    graph: Graph, bridge: Bridge, kind: str, way: str
) -> None:
    graph.reach(way)
    graph.base(kind)
    process = graph.process()
    bridge.until(lambda: bridge.code() == "ros2_no_relay")
    assert bridge.state is None
    graph.relay()
    bridge.until(lambda: bridge.code() is None)
    assert bridge.status is not None
    assert bridge.status.cmd_vel == kind
    bridge.until(is_fast(graph))
    bridge.until(lambda: bridge.state is not None and bridge.state.left_radps > 0.5)
    process.kill()
    process.wait(LIMIT_S)
    bridge.until(lambda: graph.twists[-1]["v"] == 0.0)
    stood = len(graph.twists)
    time.sleep(0.5)
    assert all(one["v"] == 0.0 for one in graph.twists[stood:])


@pytest.mark.parametrize(
    ("way", "topic"),
    [("rosbridge", "/pons/scan"), pytest.param("dds", "/scan", marks=BY_DDS.marks)],
)
def test_what_is_too_near_for_a_lidar_is_near_and_no_free_floor(
    graph: Graph, bridge: Bridge, way: str, topic: str
) -> None:
    graph.reach(way)
    graph.base(STAMPED)
    graph.start(PYTHON, "tests/ros2/ros_graph.py", "lidar")
    graph.relay()
    graph.process(scan=topic)
    scans = bridge.session.subscriber(keys.SCAN)
    heard: list[Scan] = []

    def has_heard() -> bool:
        scan = scans.newest()
        heard.extend([] if scan is None else [scan])
        return bool(heard)

    bridge.until(has_heard)
    assert heard[0].ranges_m == (0.0, None, 1.5)


@by_each
def test_a_relay_that_is_ended_in_mid_drive_leaves_zeros_behind(
    graph: Graph, bridge: Bridge, way: str
) -> None:
    graph.reach(way)
    graph.base(STAMPED)
    graph.process()
    relay = graph.relay()
    bridge.until(is_fast(graph))
    relay.terminate()
    assert relay.wait(LIMIT_S) == 0
    bridge.until(lambda: graph.twists[-1]["v"] == 0.0)
    bridge.until(lambda: bridge.code() == "ros2_relay_silent")


@by_each
def test_a_base_without_a_dead_man_stands_when_its_relay_is_killed_in_mid_drive(
    graph: Graph, bridge: Bridge, way: str
) -> None:
    graph.reach(way)
    graph.base(STAMPED)
    graph.process()
    relay = graph.relay()
    bridge.until(is_fast(graph))
    relay.kill()
    bridge.until(lambda: graph.twists[-1]["v"] == 0.0)  # by zeros through the server
    bridge.until(lambda: bridge.code() == "ros2_relay_silent")


@by_each
def test_a_relay_that_is_not_alone_on_cmd_vel_is_not_driven(
    graph: Graph, bridge: Bridge, way: str
) -> None:
    graph.reach(way)
    graph.base(TWIST)
    graph.process()
    graph.relay()
    bridge.until(is_fast(graph))
    other = graph.start(
        PYTHON, "-c",
        "import rclpy; from rclpy.node import Node; from geometry_msgs.msg import Twist\n"
        "rclpy.init(); node = Node('nav2'); p = node.create_publisher(Twist, '/cmd_vel', 1)\n"
        "rclpy.spin(node)",
    )  # fmt: skip
    bridge.until(lambda: bridge.code() == "ros2_cmd_vel_shared")
    bridge.until(lambda: graph.twists[-1]["v"] == 0.0)
    other.terminate()  # a killed one stays in the graph for 20 s, the lease of Fast DDS
    bridge.until(is_fast(graph))


@by_each
def test_a_map_that_was_said_before_becomes_a_site(
    graph: Graph, tmp_path: Path, way: str, capsys: pytest.CaptureFixture[str]
) -> None:
    graph.reach(way)
    graph.start(PYTHON, "tests/ros2/ros_graph.py", "map")
    robot = graph.describe()
    settings = LaunchSettings(tmp_path, robot, tmp_path, "127.0.0.1", 1)
    assert site.run(settings, ["import", "ros2:/map", "mapped"]) == 0, capsys.readouterr().err
    made = load_map(tmp_path / "sites" / "mapped" / "map.yaml").grid
    assert (made.width, made.height, made.resolution_m) == (60, 40, 0.1)
    assert made.cells.count(bytes([OCCUPIED])) == 2 * 60 + 2 * 38
    assert made.cells.count(bytes([UNKNOWN])) == 1
    assert site.run(settings, ["import", "ros2:/odom", "other"]) == 3
    refused = capsys.readouterr().err
    assert "ros2_topic_missing" in refused
    assert "请启动发布它的节点" in refused


@by_each
def test_packed_pictures_come_whole_and_what_is_none_is_named(
    graph: Graph, tmp_path: Path, way: str
) -> None:
    graph.reach(way)
    path = tmp_path / "picture.jpg"
    path.write_bytes(JPEG)
    camera = [PYTHON, "tests/ros2/ros_camera.py", str(path), "10"]
    graph.start(*camera, "rgb8; jpeg compressed bgr8")
    robot = load_robot(graph.describe())
    source = open_source(CameraConfig(kind="ros2", topic="/camera/compressed"), robot.ros2)
    shots = [source.read() for _ in range(10)]
    source.close()
    assert all(np.abs(shot.color.astype(int) - PICTURE).mean() < 3 for shot in shots)
    assert len({shot.at_s for shot in shots}) == len(shots)
    graph.start(*camera, "bgr8", "raw")
    for topic, code in (("/camera", "ros2_image_raw"), ("/other", "ros2_topic_missing")):
        source = open_source(CameraConfig(kind="ros2", topic=topic), robot.ros2)
        with pytest.raises(CameraTrouble, match=code):
            source.read()
        source.close()


@by_each
def test_nav2_hears_a_goal_and_its_word_and_twists_come_back(
    graph: Graph, bridge: Bridge, way: str
) -> None:
    """By topics alone, against a stand-in node of rclpy for Nav2; Nav2 itself was not run."""
    graph.reach(way)
    graph.base(STAMPED)
    graph.start(PYTHON, "tests/ros2/ros_graph.py", "nav2", "0", "0", "0")
    graph.relay()
    graph.more = "\n[ros2.nav2]\n"
    graph.process()
    heard: list[Nav2State] = []
    with open_session(Party.PLANNER, "r1", graph.home) as planner:
        says, hears = planner.publisher(keys.NAV2_GOAL), planner.subscriber(keys.NAV2_STATE)
        goal, here = Pose2(2.0, 0.0, 0.0), Pose2(0.0, 0.0, 0.0)

        def is_told(leg: int, done: Callable[[Nav2State], bool]) -> Callable[[], bool]:
            order = Nav2Goal(
                planner_id="p1", seen=1, mission="m1" if leg else None, leg=leg,
                goal=goal if leg else None, here=here,
            )  # fmt: skip

            def look() -> bool:
                says.put(order)
                state = hears.newest()
                heard.extend([] if state is None else [state])
                return bool(heard) and done(heard[-1])

            return look

        bridge.until(is_told(1, lambda s: s.phase == "driving" and s.twist > 3))
        assert (heard[-1].mission, heard[-1].leg, heard[-1].code) == ("m1", 1, None)
        assert heard[-1].v_mps == pytest.approx(0.4)
        bridge.until(is_told(0, lambda s: s.phase == "cancelled"))
        bridge.until(is_told(0, lambda s: s.phase == "idle"))
