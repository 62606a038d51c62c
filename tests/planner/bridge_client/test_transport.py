"""Carry the planner's words over the real transport, to a bridge's ends of the wire."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from planner.bridge_client import WireBus
from tests.planner.mission.fakes import HASH, status
from wire import (
    PROTOCOL,
    Event,
    FenceRequest,
    Grant,
    Heartbeat,
    Hello,
    Localization,
    Mode,
    Odometry,
    OpRequest,
    Pose2,
    Record,
    Scan,
    Stop,
    Twist2,
    Velocity,
    Waypoints,
)
from wire import keys as k
from wire.keys import Party
from wire.session import Session, open_session

WITHIN_S = 10.0
SAID: tuple[Record, ...] = (
    Hello(planner_id="p1", kind="planner", seen=1, protocol=PROTOCOL, robot_hash=HASH,
          fence_hash=HASH, map_id=HASH),
    Heartbeat(planner_id="p1", epoch="b-1", seen=1, used=1),
    Grant(planner_id="p1", epoch="b-1", seen=1, mission="g", metres=1.0, seconds=1.0),
    Waypoints(planner_id="p1", epoch="b-1", seq=1, seen=1, mission="g", leg=1, map_id=HASH,
              ttl_s=0.5, points=(), final=False),
    Stop(id="s1", source="test"),
    FenceRequest(id="f1", source="test", fence="{}"),
)  # fmt: skip
HEARD: tuple[tuple[k.Key[Record], Record], ...] = (
    (k.STATUS, status()),
    (k.ODOM, Odometry(odom_id="b", seq=1, stamp_s=0.0, base_in_odom=Pose2(0.0, 0.0, 0.0),
                      twist=Twist2(0.0, 0.0), yaw_rate_radps=None)),
    (k.EVENT, Event(boot="b", seq=1, tick=1, at_s=0.0, code="x", mode=Mode.HOLD, detail="")),
    (k.SCAN, Scan(boot_id="b", seq=1, stamp_s=0.0, angle_min_rad=0.0, angle_increment_rad=0.5,
                  range_min_m=0.1, range_max_m=8.0, ranges_m=(1.0, None))),
    (k.LOCALIZATION, Localization(odom_id="b", seq=1, stamp_s=0.0, quality=1.0, map_id=HASH,
                                  odom_in_map=Pose2(0.0, 0.0, 0.0))),
)  # type: ignore[assignment]  # a Key only ever produces its message  # fmt: skip


@pytest.fixture(scope="module")
def home() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="pons-") as folder:
        yield Path(folder)


@pytest.fixture(scope="module")
def ends(home: Path) -> Iterator[tuple[Session, WireBus]]:
    """Return the bridge's session and the planner's bus of one home."""
    with (
        open_session(Party.BRIDGE, "r1", home) as bridge,
        open_session(Party.PLANNER, "r1", home) as session,
    ):
        yield bridge, WireBus(session, nav2=True)


@pytest.fixture(scope="module")
def senders(home: Path, ends: tuple[Session, WireBus]) -> Iterator[dict[Party, Session]]:
    """Return the sessions of all whom the planner hears."""
    with (
        open_session(Party.ROBOT, "r1", home) as robot,
        open_session(Party.LOCALIZATION, "r1", home) as localization,
        open_session(Party.LIDAR, "r1", home) as lidar,
        open_session(Party.ROS2, "r1", home) as ros2,
        open_session(Party.IMU, "r1", home) as imu,
    ):
        yield {
            Party.BRIDGE: ends[0],
            Party.ROBOT: robot,
            Party.LOCALIZATION: localization,
            Party.LIDAR: lidar,
            Party.ROS2: ros2,
            Party.IMU: imu,
        }


def until(say: Callable[[], None], heard: Callable[[], bool]) -> None:
    """Repeat until heard: a message sent while two ends find each other may be lost."""
    end_s = time.monotonic() + WITHIN_S
    while True:
        say()
        time.sleep(0.01)
        if heard():
            return
        assert time.monotonic() < end_s, "never heard"


@pytest.mark.parametrize("message", SAID, ids=lambda m: type(m).__name__)
def test_each_command_reaches_the_bridge(ends: tuple[Session, WireBus], message: Record) -> None:
    bridge, bus = ends
    key: k.Key[Record] = next(key for key in k.KEYS if key.message is type(message))
    subscriber = bridge.subscriber(key)
    until(lambda: bus.send(message), lambda: message in subscriber.drain().items)


def test_requests_and_velocities_go_to_their_own_keys(ends: tuple[Session, WireBus]) -> None:
    bridge, bus = ends
    request = OpRequest(id="r1", source="test")
    for key in k.OPS:
        subscriber = bridge.subscriber(key)
        kind = key.path.removeprefix("op/")
        until(
            lambda kind=kind: bus.ask(kind, request),  # type: ignore[misc]  # bound per key
            lambda subscriber=subscriber: request in subscriber.drain().items,  # type: ignore[misc]  # bound per key
        )
    steering = bridge.subscriber(k.TELEOP)
    velocity = Velocity(source_id="s", epoch="b-1", seq=1, seen=1, v_mps=0.1, w_radps=0.0,
                        dead_man=True)  # fmt: skip
    until(lambda: bus.steer(velocity), lambda: velocity in steering.drain().items)


def test_what_is_no_command_is_refused(ends: tuple[Session, WireBus]) -> None:
    with pytest.raises(TypeError, match="Status"):
        ends[1].send(status())


@pytest.mark.parametrize(("key", "message"), HEARD, ids=lambda x: getattr(x, "path", ""))
def test_each_word_reaches_the_planner(
    ends: tuple[Session, WireBus],
    senders: dict[Party, Session],
    key: k.Key[Record],
    message: Record,
) -> None:
    bus = ends[1]
    publishers = [senders[sender].publisher(key) for sender in key.senders]
    reads: dict[str, Callable[[], object]] = {
        "bridge/status": bus.status,
        "bridge/odom": bus.odometry,
        "bridge/event": bus.events,
        "scan": bus.scan,
        "localization": bus.localization,
    }
    read = reads[key.path]
    for publisher in publishers:
        until(
            lambda publisher=publisher: publisher.put(message),  # type: ignore[misc]  # bound per sender
            lambda: read() in (message, (message,)),
        )
