"""Try the link against a fake bridge: echoes, silence, proofs, ages."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from math import pi

import pytest

from planner.bridge_client import BridgeSilent, Link
from planner.bridge_client.scan_to_map import points_in_map
from tests.planner.mission.fakes import FakeBridge
from wire import Localization, Odometry, OpRequest, Pose2, RobotDescription, Scan, Stop, Twist2
from wire.lidar_config import LidarConfig

ROBOT, ORIGIN = RobotDescription(), Pose2(0.0, 0.0, 0.0)


class Clock:
    """Tell a time that tests move."""

    def __init__(self, per_call_s: float = 0.0) -> None:
        self.now_s, self.per_call_s = 10.0, per_call_s

    def __call__(self) -> float:
        self.now_s += self.per_call_s
        return self.now_s


@asynccontextmanager
async def polled(bridge: FakeBridge, link: Link) -> AsyncIterator[None]:
    """Let a bridge go on and the link be polled meanwhile."""

    async def polls() -> None:
        while True:
            bridge.step()
            link.poll()
            await asyncio.sleep(0)

    task = asyncio.create_task(polls())
    yield
    task.cancel()


async def test_stop_is_repeated_until_echoed() -> None:
    bridge = FakeBridge()
    link = Link(bridge, ROBOT, clock=Clock())
    async with polled(bridge, link):
        result = await link.stop("test")
    assert result.is_echoed
    assert bridge.held is not None
    assert bridge.held.id == result.id


async def test_stop_gives_up_aloud_after_two_seconds() -> None:
    bridge, clock = FakeBridge(deaf=True), Clock(per_call_s=0.5)
    sent: list[object] = []
    bridge.send = sent.append  # type: ignore[method-assign,assignment]  # a bridge that hears nothing
    result = await Link(bridge, ROBOT, clock=clock).stop("test")
    assert not result.is_echoed
    assert result.waited_s >= 2.0
    assert len(sent) >= 2
    assert all(isinstance(m, Stop) and m.id == result.id for m in sent)


async def test_operate_returns_the_verdict_or_raises() -> None:
    bridge = FakeBridge()
    link = Link(bridge, ROBOT, clock=Clock())
    request = OpRequest(id="r-1", source="test")
    async with polled(bridge, link):
        answer = await link.operate("disarm", request)
    assert (answer.id, answer.kind, answer.accepted) == ("r-1", "disarm", True)
    silent = Link(FakeBridge(deaf=True), ROBOT, clock=Clock(per_call_s=0.5))
    with pytest.raises(BridgeSilent) as error:
        await silent.operate("disarm", request)
    assert error.value.code == "bridge_silent"
    assert error.value.message["zh"]


def test_ages_run_on_our_own_clock() -> None:
    bridge, clock = FakeBridge(), Clock()
    link = Link(bridge, ROBOT, clock=clock)
    assert link.status is None
    assert (link.localization, link.odometry, link.scan) == (None, None, None)
    bridge.step()
    assert link.poll() is not None
    assert link.poll() is None
    clock.now_s += 0.75
    assert link.status is not None
    assert link.status.age_s == pytest.approx(0.75)


class Followed:
    """Keep what a link tells of how the robot moves."""

    def __init__(self) -> None:
        self.heard: list[str] = []

    def odometry(self, odometry: Odometry) -> None:
        self.heard.append(f"odometry {odometry.seq}")

    def localization(self, localization: Localization) -> None:
        self.heard.append(f"localization {localization.seq}")


class Moving(FakeBridge):
    """Be a bridge whose robot is heard to move."""

    def odometry(self) -> Odometry | None:
        self.odom_m += 1.0
        return Odometry(odom_id="o", seq=int(self.odom_m), stamp_s=1.0, base_in_odom=ORIGIN,
                        twist=Twist2(0.0, 0.0), yaw_rate_radps=None)  # fmt: skip

    def localization(self) -> Localization | None:
        if self.odom_m != 1.0:
            return None
        return Localization(odom_id="o", seq=7, stamp_s=1.0, odom_in_map=ORIGIN, quality=0.9,
                            map_id="0" * 16)  # fmt: skip


def test_whoever_follows_is_told_every_move_once() -> None:
    link, before, after = Link(Moving(), ROBOT, clock=Clock()), Followed(), Followed()
    link.tell(before)
    link.poll()
    link.poll()
    link.tell(after)
    link.poll()
    assert before.heard == ["odometry 1", "localization 7", "odometry 2", "odometry 3"]
    assert after.heard == ["odometry 3"]


def scan(*ranges_m: float | None) -> Scan:
    return Scan(boot_id="b", seq=1, stamp_s=0.0, angle_min_rad=0.0, angle_increment_rad=0.5,
                range_min_m=0.1, range_max_m=8.0, ranges_m=ranges_m)  # fmt: skip


def test_obstacles_need_a_fresh_scan_and_a_pose() -> None:
    bridge, clock = FakeBridge(), Clock()
    link = Link(bridge, ROBOT, clock=clock)
    scans = [scan(1.0)]
    bridge.scan = lambda: scans.pop() if scans else None  # type: ignore[method-assign]  # one scan
    assert link.obstacles() == ()
    bridge.step()
    link.poll()
    assert link.obstacles() == ((1.0, 0.0),)
    clock.now_s += 0.6
    assert link.obstacles() == ()


def test_returns_become_points_in_map_and_the_rest_nothing() -> None:
    robot = Pose2(1.0, 2.0, pi / 2)
    points = points_in_map(scan(2.0, None, 0.05, 5.0), LidarConfig(x_m=0.5), robot)
    assert len(points) == 1
    assert points[0] == pytest.approx((1.0, 4.5))
