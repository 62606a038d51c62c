"""A robot under rmw_zenoh is driven through its router; its twin is a second implementation.

No true rmw_zenoh was ever at the other end: what is held here is its documented form.
"""

from __future__ import annotations

import asyncio
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import zenoh
import zenoh.ext

from pons.robot_processes import free_port
from ros2.topic_request import WantedTopic, collect
from sim.twin.rmw_zenoh_peer import RmwZenohPeer
from tests.ros2.frames import TYPES
from tests.ros2.graph_peers import HEARD, PeerBase
from tests.ros2.test_cdr import GOLDEN
from tests.ros2.test_process import LIMIT_S, Bridge
from wire import Scan, keys
from wire.ros2_config import Ros2Config

pytestmark = pytest.mark.e2e

ROBOT = """
[drive]
kind = "ros2"
[ros2]
transport = "zenoh"
router = "tcp/127.0.0.1:{port}"
domain = {domain}
scan = "/scan"
[lidar]
kind = "ros2"
[inputs]
imu = false
"""
KNOWN = TYPES | {"/pons/command": "std_msgs/msg/String"}
DOMAIN = 7


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
    path.write_text(ROBOT.format(port=port, domain=DOMAIN))
    words = ["--robot", str(path), "--home", str(tmp_path)]
    started = subprocess.Popen(
        [sys.executable, "-m", "ros2", *words], stderr=subprocess.PIPE, text=True
    )
    yield started
    started.kill()
    started.communicate(timeout=LIMIT_S)


@pytest.fixture
def based(port: int) -> Iterator[Callable[..., PeerBase]]:
    made: list[PeerBase] = []

    def start(domain: int = DOMAIN, **types: str) -> PeerBase:
        known = KNOWN | {f"/{name}": kind for name, kind in types.items()}
        known = {topic: kind for topic, kind in known.items() if kind}
        made.append(PeerBase(RmwZenohPeer(port, known, HEARD, domain), known))
        made[-1].start()
        return made[-1]

    yield start
    for base in made:
        base.end()


@pytest.mark.usefixtures("process")
def test_a_router_that_comes_late_is_reached_and_its_base_driven_with_scans(
    bridge: Bridge, based: Callable[..., PeerBase]
) -> None:
    bridge.until(lambda: bridge.code() == "ros2_no_router")
    base = based()
    bridge.until(lambda: bridge.code() is None)
    assert base.server.refused == 0, "each message had its 33 bytes"
    scans = bridge.session.subscriber(keys.SCAN)
    heard: list[Scan] = []

    def has_heard() -> bool:
        heard.extend([one for one in [scans.newest()] if one is not None])
        return bool(heard)

    bridge.until(has_heard)
    assert heard[0].ranges_m == (0.0, None, 1.5)
    bridge.until(lambda: base.relay.twist(time.monotonic())[0] > 0.0)
    base.server.hang_up()
    bridge.until(base.stands)
    bridge.until(lambda: not base.stands())  # it dialled anew, and is driven again


@pytest.mark.parametrize(
    ("types", "code"),
    [
        ({"pons/state": ""}, "ros2_no_relay"),
        ({"cmd_vel": ""}, "ros2_no_base"),
        ({"odom": "sensor_msgs/msg/Imu"}, "ros2_topic_type"),
    ],
)
@pytest.mark.usefixtures("process")
def test_a_graph_that_is_wrong_is_named_and_nothing_is_driven(
    bridge: Bridge, based: Callable[..., PeerBase], types: dict[str, str], code: str
) -> None:
    base = based(**types)
    if "odom" in types:
        base.types = {"/pons/state": base.types["/pons/state"]}
    bridge.until(lambda: bridge.code() == code)
    assert bridge.state is None
    assert base.accepted == []


@pytest.mark.usefixtures("process")
def test_a_robot_on_another_domain_is_nobody(
    bridge: Bridge, based: Callable[..., PeerBase]
) -> None:
    base = based(domain=DOMAIN + 1)
    bridge.until(lambda: bridge.code() == "ros2_no_peer")
    assert bridge.status is not None
    assert f"domain {DOMAIN}" in bridge.status.detail
    assert base.accepted == []


def test_the_base_stands_by_its_dead_man_when_the_process_is_killed_in_mid_drive(
    bridge: Bridge, process: subprocess.Popen[str], based: Callable[..., PeerBase]
) -> None:
    base = based()
    bridge.until(lambda: base.relay.twist(time.monotonic())[0] > 0.0)
    process.kill()
    process.wait(LIMIT_S)
    bridge.until(base.stands)
    time.sleep(0.3)
    assert base.stands()


def test_a_map_that_was_said_before_anybody_listened_is_heard(port: int) -> None:
    kind = "nav_msgs/msg/OccupancyGrid"
    peer = RmwZenohPeer(port, {"/map": kind}, ["/map"], DOMAIN)
    keeper = zenoh.ext.declare_advanced_publisher(
        peer._session, peer._key("/map", kind), cache=zenoh.ext.CacheConfig(max_samples=1)
    )
    keeper.put(bytes.fromhex(GOLDEN[kind]["hex"]))
    ros2 = Ros2Config.model_validate(
        {"transport": "zenoh", "router": f"tcp/127.0.0.1:{port}", "domain": DOMAIN}
    )
    wanted = WantedTopic("/map", kind, keeps=True)
    heard = asyncio.run(collect(ros2, [wanted], lambda each: bool(each["/map"]), LIMIT_S))
    peer.close()
    assert list(heard["/map"][0]["data"]) == GOLDEN[kind]["message"]["data"]
