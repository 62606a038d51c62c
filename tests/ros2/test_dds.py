"""A robot on a DDS domain is driven without a bridge, and one that is wrong is named and stands.

The peer here is another participant of Cyclone DDS; tests/ros2/test_true_ros.py has true nodes.
"""

from __future__ import annotations

import asyncio
import math
import os
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import pytest

pytest.importorskip("cyclonedds", reason="the extra dds is not installed (x86_64 alone)")

from ros2 import BaseLink, LinkMessages
from ros2.dds import DdsTransport
from tests.ros2.frames import TYPES, command, robot
from tests.ros2.graph_peers import DdsPeer, PeerBase
from wire import Ros2Status

LIMIT_S = 60.0
COMMAND = {"/pons/command": "std_msgs/msg/String"}


@pytest.fixture
def domain() -> int:
    return 100 + os.getpid() % 60


@pytest.fixture
def based(domain: int) -> Iterator[Callable[..., PeerBase]]:
    made: list[PeerBase] = []

    def start(**types: str) -> PeerBase:
        known = TYPES | COMMAND | {f"/{name}": kind for name, kind in types.items()}
        known = {topic: kind for topic, kind in known.items() if kind}
        made.append(PeerBase(DdsPeer(domain, known), known))
        made[-1].start()
        return made[-1]

    yield start
    for base in reversed(made):  # the first holds the domain for this process
        base.end()


class Driver:
    """Run the transport as the node does, and command without end."""

    def __init__(self, domain: int, **ros2: Any) -> None:
        part = {"transport": "dds", "domain": domain, "interface": "lo", "url": None} | ros2
        described = robot(**part)
        assert described.ros2 is not None
        self.link = BaseLink(described, "r")
        self.heard: list[LinkMessages] = []
        self.transport = DdsTransport(described.ros2, self.link, self.heard.append)
        self.seq = 0

    def status(self) -> Ros2Status:
        return self.link.status(1, time.monotonic())

    def until(self, done: Callable[[], bool]) -> None:
        asyncio.run(self._until(done))

    async def _until(self, done: Callable[[], bool]) -> None:
        serving = asyncio.create_task(self.transport.serve())
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, self.status()
            assert not serving.done(), serving.exception()
            now_s = time.monotonic()
            for request in self.link.due(now_s):
                await self.transport.send(request)
            self.seq += 1
            words = self.link.encode(command(self.seq), now_s)
            if words is not None and self.transport.has_room():
                await self.transport.send(words)
            await self.transport.drop_if_silent(now_s)
            await asyncio.sleep(0.005)
        serving.cancel()
        with suppress(asyncio.CancelledError):
            await serving


def test_a_base_is_driven_and_its_lidar_says_what_json_could_not(
    domain: int, based: Callable[..., PeerBase]
) -> None:
    base, driver = based(), Driver(domain)
    driver.until(lambda: len(base.accepted) > 20 and driver.status().code is None)
    states = [one.state for one in driver.heard if one.state is not None]
    assert states[-1].echo_boot == "boot1"
    scans = [one.scan for one in driver.heard if one.scan is not None]
    assert scans[-1].ranges_m == (0.0, None, 1.5)
    assert any(one.imu is not None for one in driver.heard)
    assert driver.status().cmd_vel == TYPES["/cmd_vel"]


def test_nobody_on_a_domain_is_told_with_its_number(domain: int) -> None:
    driver = Driver(domain + 1)
    driver.until(lambda: driver.status().code == "ros2_no_peer")
    assert f"DDS domain {domain + 1} on lo" in driver.status().detail


def test_an_interface_that_this_computer_lacks_is_told() -> None:
    driver = Driver(99, interface="none7")
    driver.until(lambda: driver.status().code == "ros2_no_dds")


@pytest.mark.parametrize(
    ("types", "code", "says"),
    [
        ({"cmd_vel": "std_msgs/msg/String"}, "ros2_cmd_vel_type", "std_msgs/msg/String"),
        ({"pons/state": ""}, "ros2_no_relay", "TwistStamped"),
        ({"odom": "geometry_msgs/msg/Pose"}, "ros2_topic_type", "geometry_msgs/msg/Pose"),
        ({"scan": ""}, "ros2_topic_missing", "/scan"),
    ],
)
def test_a_graph_that_is_wrong_is_named_and_nothing_is_driven(
    domain: int, based: Callable[..., PeerBase], types: dict[str, str], code: str, says: str
) -> None:
    base, driver = based(**types), Driver(domain)
    driver.until(lambda: driver.status().code == code)
    assert says in driver.status().detail
    assert base.accepted == []
    assert all(one.state is None for one in driver.heard)


def test_two_robots_on_one_domain_are_named_and_the_first_stands(
    domain: int, based: Callable[..., PeerBase]
) -> None:
    first, driver = based(), Driver(domain)
    second: list[PeerBase] = []

    def is_second_there() -> bool:
        if not second and len(first.accepted) > 20:
            second.append(based())
        return bool(second) and driver.status().code == "ros2_two_robots" and first.stands()

    driver.until(is_second_there)
    assert "2 publish on /" in driver.status().detail
    assert second[0].accepted == []


@pytest.mark.parametrize(
    ("wrong", "clock_s", "code"),
    [
        ({"pose": {"pose": {"position": {"x": math.nan}}}}, 0.0, "ros2_unreadable"),
        ({}, 3 * 3600.0, "ros2_clock"),
    ],
)
def test_odometry_that_is_no_number_or_of_another_hour_moves_nothing(
    domain: int, based: Callable[..., PeerBase], wrong: dict[str, Any], clock_s: float, code: str
) -> None:
    base, driver = based(), Driver(domain)
    base.odometry_more, base.clock_s = wrong, clock_s
    driver.until(lambda: driver.status().code == code)
    before = len(driver.heard)
    driver_states = [one.state for one in driver.heard[before:]]
    assert driver_states == []


def test_without_cyclonedds_it_says_how_to_get_it(
    domain: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ros2.dds.MISSING", "No module named 'cyclonedds'")
    driver = Driver(domain)
    driver.until(lambda: driver.status().code == "ros2_no_dds")
    assert "pip install 'pons-robot[dds]'" in driver.status().detail
