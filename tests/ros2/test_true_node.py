"""Against true ROS 2 nodes: the package pons_ros2 beside a base that has no dead-man.

Run where a Python with rclpy, its messages and zenoh is named by PONS_ROS2_PYTHON, or is the
system's own; skipped aloud elsewhere. docs/ros2.md says how to make one.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from maps import OCCUPIED, UNKNOWN, load_map
from pons import site
from pons.robot_processes import free_port
from pons.settings import LaunchSettings
from ros2.robot_link import RobotLink
from sensors.camera.shot import CameraTrouble
from sensors.camera.source import open_source
from tests.known import known
from tests.ros2.bridge import Bridge
from tests.sensors.camera.test_packed_picture import JPEG, PICTURE
from tests.wire.examples import EXAMPLES
from wire import CameraConfig, Nav2Goal, Nav2State, PlanView, Pose2, Scan, keys, load_robot
from wire.keys import Party
from wire.session import open_session

NEEDS = "import rclpy, nav_msgs, diagnostic_msgs, visualization_msgs, zenoh"
PACKAGE = "ros2/pons_ros2"
LIMIT_S = 60.0
ROBOT = """
id = "r1"
[drive]
kind = "ros2"
[inputs]
imu = false
[ros2]
node = "tcp/127.0.0.1:{port}"
"""
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
    pytest.mark.timeout(300),
    pytest.mark.skipif(
        not PYTHON, reason="no Python with rclpy and zenoh: name one in PONS_ROS2_PYTHON"
    ),
    pytest.mark.nightly(keep=3),
]


class Graph:
    """Hold the processes of one ROS domain."""

    def __init__(self, home: Path, root: Path) -> None:
        self.home, self.root, self.port = home, root, free_port()
        self.domain = 20 + self.port % 80
        self.environment = dict(os.environ, ROS_DOMAIN_ID=str(self.domain), PYTHONPATH=PACKAGE)
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

    def node(self, **parameters: object) -> subprocess.Popen[str]:
        """Start the package's node; topics that a test does not name are not there."""
        given = {"scan": "", "imu": "", "map": "", "listen": f"tcp/127.0.0.1:{self.port}"}
        words = [f"{name}:={json.dumps(one)}" for name, one in (given | parameters).items()]
        flat = [word for one in words for word in ("-p", one)]
        return self.start(PYTHON, "-m", "pons_ros2.node", "--ros-args", *flat)

    def ready(self) -> None:
        """Wait until the node answers; it takes seconds to start on a busy machine."""
        end_s = time.monotonic() + LIMIT_S
        with RobotLink(f"tcp/127.0.0.1:{self.port}", ()) as link:
            while not link.is_joined:
                assert time.monotonic() < end_s
                time.sleep(0.05)

    def guard(self) -> subprocess.Popen[str]:
        return self.start(PYTHON, "-m", "pons_ros2.guard")

    def process(self, scan: str = "") -> subprocess.Popen[str]:
        words = ("--robot", str(self.describe(scan)), "--home", str(self.home))
        return self.start(sys.executable, "-m", "ros2", *words)

    def describe(self, scan: str = "") -> Path:
        """Write the robot.toml that reaches this graph."""
        path = self.home / "robot.toml"
        lidar = '[lidar]\nkind = "ros2"\n' if scan else ""
        path.write_text(ROBOT.format(port=self.port) + lidar + self.more)
        return path

    def close(self) -> None:
        for process in self.processes:
            process.kill()
        for process in self.processes:
            process.communicate(timeout=LIMIT_S)

    def _read(self, process: subprocess.Popen[str]) -> None:
        with suppress(ValueError):  # closed beside us
            for line in known(process.stdout):
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


@pytest.mark.parametrize("kind", [TWIST, STAMPED])
def test_a_base_of_either_twist_is_driven_and_stands_when_the_process_is_killed(
    graph: Graph, bridge: Bridge, kind: str
) -> None:
    graph.base(kind)
    process = graph.process()
    bridge.until(lambda: bridge.code() == "ros2_no_node")
    assert bridge.state is None
    graph.node()
    bridge.until(lambda: bridge.code() is None)
    assert known(bridge.status).cmd_vel == kind
    bridge.until(is_fast(graph))
    bridge.until(lambda: bridge.state is not None and bridge.state.left_radps > 0.5)
    process.kill()
    process.wait(LIMIT_S)
    time.sleep(0.3)  # what it said last may move for a dead-man's time
    bridge.until(lambda: graph.twists[-1]["v"] == 0.0)
    stood = len(graph.twists)
    time.sleep(0.5)
    assert all(one["v"] == 0.0 for one in graph.twists[stood:])


def test_what_is_too_near_for_a_lidar_is_near_and_no_free_floor(
    graph: Graph, bridge: Bridge
) -> None:
    graph.base(STAMPED)
    graph.start(PYTHON, "tests/ros2/ros_graph.py", "lidar")
    graph.node(scan="/scan")
    graph.process(scan="/scan")
    scans = bridge.session.subscriber(keys.SCAN)
    heard: list[Scan] = []

    def has_heard() -> bool:
        scan = scans.newest()
        heard.extend([] if scan is None else [scan])
        return bool(heard)

    bridge.until(has_heard)
    assert heard[0].ranges_m == (0.0, None, 1.5)


def test_a_node_that_is_ended_in_mid_drive_leaves_zeros_behind(
    graph: Graph, bridge: Bridge
) -> None:
    graph.base(STAMPED)
    graph.process()
    relay = graph.node(rank=1)  # where this user may not have it, it drives without
    bridge.until(is_fast(graph))
    relay.terminate()
    assert relay.wait(LIMIT_S) == 0
    bridge.until(lambda: graph.twists[-1]["v"] == 0.0)
    bridge.until(lambda: bridge.code() == "ros2_node_gone")


def test_a_base_without_a_dead_man_stands_when_its_node_is_killed_in_mid_drive(
    graph: Graph, bridge: Bridge
) -> None:
    graph.base(STAMPED)
    graph.process()
    relay = graph.node()
    graph.guard()
    bridge.until(is_fast(graph))
    relay.kill()
    bridge.until(lambda: graph.twists[-1]["v"] == 0.0)  # by the guard's zeros
    bridge.until(lambda: bridge.code() == "ros2_node_gone")


def test_a_node_that_is_not_alone_on_cmd_vel_is_not_driven(graph: Graph, bridge: Bridge) -> None:
    graph.base(TWIST)
    graph.process()
    graph.node()
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


def test_a_map_that_was_said_before_becomes_a_site(
    graph: Graph, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    graph.start(PYTHON, "tests/ros2/ros_graph.py", "map")
    graph.node(map="/map")
    graph.ready()
    robot = graph.describe()
    settings = LaunchSettings(tmp_path, robot, tmp_path, "127.0.0.1", 1)
    assert site.run(settings, ["import", "ros2:/map", "mapped"]) == 0, capsys.readouterr().err
    made = load_map(tmp_path / "sites" / "mapped" / "map.yaml").grid
    assert (made.width, made.height, made.resolution_m) == (60, 40, 0.1)
    assert made.cells.count(bytes([OCCUPIED])) == 2 * 60 + 2 * 38
    assert made.cells.count(bytes([UNKNOWN])) == 1
    assert site.run(settings, ["import", "ros2:/other", "other"]) == 3
    assert "ros2_topic_missing" in capsys.readouterr().err


@pytest.mark.parametrize("raw", [False, True], ids=["packed", "raw"])
def test_pictures_come_whole(graph: Graph, tmp_path: Path, *, raw: bool) -> None:
    path = tmp_path / "picture.jpg"
    path.write_bytes(JPEG)
    camera = [PYTHON, "tests/ros2/ros_camera.py", str(path), "10"]
    graph.start(*camera, "mono8" if raw else "rgb8; jpeg compressed bgr8", *["raw"] * raw)
    graph.node(picture="/camera" if raw else "/camera/compressed")
    graph.ready()
    robot = load_robot(graph.describe())
    source = open_source(CameraConfig(kind="ros2"), robot.ros2)
    shots = [source.read() for _ in range(10)]
    source.close()
    if raw:
        assert all(shot.color[0, :, 1].tobytes() == JPEG for shot in shots)
    else:
        assert all(np.abs(shot.color.astype(int) - PICTURE).mean() < 3 for shot in shots)
    assert len({shot.at_s for shot in shots}) == len(shots)


def test_a_topic_of_pictures_that_is_missing_is_named(graph: Graph) -> None:
    graph.node(picture="/other")
    graph.ready()
    robot = load_robot(graph.describe())
    source = open_source(CameraConfig(kind="ros2"), robot.ros2)
    with pytest.raises(CameraTrouble, match="ros2_topic_missing"):
        source.read()
    source.close()


def test_rviz_is_shown_the_way_the_places_and_how_the_bridge_stands(
    graph: Graph, bridge: Bridge
) -> None:
    graph.base(STAMPED)
    graph.node()
    graph.process()
    lines: list[dict[str, Any]] = []
    with open_session(Party.PLANNER, "r1", graph.home) as planner:
        says = planner.publisher(keys.PLAN_VIEW)
        said: list[subprocess.Popen[str]] = []
        shown = EXAMPLES[PlanView]
        assert isinstance(shown, PlanView)

        def is_seen(name: str, wanted: object) -> Callable[[], bool]:
            def look() -> bool:
                says.put(shown)
                if not said and bridge.state is not None:  # it comes late: all is kept for it
                    said.append(graph.start(PYTHON, "tests/ros2/ros_graph.py", "viewer"))
                    threading.Thread(target=keep, args=(said[0],), daemon=True).start()
                return any(line.get(name) == wanted for line in lines)

            return look

        def keep(viewer: subprocess.Popen[str]) -> None:
            with suppress(ValueError):
                lines.extend(map(json.loads, known(viewer.stdout)))

        bridge.until(is_seen("path", [[0.0, 1.0], [2.0, 1.0]]))
        bridge.until(is_seen("markers", ["kitchen"]))
        bridge.until(is_seen("status", '{"mode": "active", "held": ""}'))
        told = {"pons_ros2: base": "the base is heard", "pons_ros2: planner": "active"}
        bridge.until(is_seen("diagnostics", told))
        assert {line["frame"] for line in lines if "path" in line} == {"map"}


def test_nav2_hears_a_goal_and_its_word_and_twists_come_back(graph: Graph, bridge: Bridge) -> None:
    """By topics alone, against a stand-in node of rclpy for Nav2; Nav2 itself was not run."""
    graph.base(STAMPED)
    graph.start(PYTHON, "tests/ros2/ros_graph.py", "nav2", "0", "0", "0")
    graph.node(nav2=True)
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
