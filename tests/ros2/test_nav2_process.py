"""The ROS 2 process carries goals to Nav2 and its answers back, beside a base, by rosbridge."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from pons.robot_processes import free_port
from ros2.nav2_goals import STATUS_ARRAY
from tests.ros2.frames import TYPES
from tests.ros2.small_nav2 import SmallNav2
from tests.ros2.test_process import LIMIT_S, ROBOT, Base, Bridge
from wire import Nav2Goal, Nav2State, Pose2, keys
from wire.keys import Party
from wire.ros2_config import Nav2Config
from wire.session import open_session

NAV2 = Nav2Config()
GOAL, HERE = Pose2(2.0, 0.0, 0.0), Pose2(0.0, 0.0, 0.0)


class BaseWithNav2(Base):
    """Serve Nav2's topics beside a base's; the stand-in believes to be at the origin."""

    def __init__(self, port: int) -> None:
        known = {topic: kind for topic, kind in TYPES.items() if topic not in ("/scan", "/imu")}
        twist = "geometry_msgs/msg/TwistStamped"
        super().__init__(port, {**known, NAV2.cmd_vel: twist, NAV2.status: STATUS_ARRAY})
        self.nav2, self.told = SmallNav2(), list[tuple[int, int, int]]()

    def hear_other(self, topic: str, message: dict[str, Any], now_s: float) -> None:
        if topic == NAV2.goal_pose:
            self.nav2.hear(message, now_s, (0.0, 0.0))

    def say_more(self, now_s: float) -> None:
        twist = self.nav2.turn(now_s, 0.0, 0.0, 0.0)
        if self.nav2.statuses != self.told:
            self.told = list(self.nav2.statuses)
            self.server.publish(NAV2.status, self.nav2.status_array())
        if twist is not None:
            inner = {"linear": {"x": twist[0], "y": 0.0}, "angular": {"z": twist[1]}}
            stamp = {"sec": 0, "nanosec": 0}
            self.server.publish(NAV2.cmd_vel, {"header": {"stamp": stamp}, "twist": inner})


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def base(port: int) -> Iterator[BaseWithNav2]:
    made = BaseWithNav2(port)
    made.start()
    yield made
    made.end()


@pytest.fixture
def bridge(tmp_path: Path) -> Iterator[Bridge]:
    made = Bridge(tmp_path)
    yield made
    made.close()


@pytest.fixture
def process(tmp_path: Path, port: int) -> Iterator[subprocess.Popen[bytes]]:
    path = tmp_path / "robot.toml"
    path.write_text(ROBOT.format(port=port) + "[ros2.nav2]\n")
    words = ["--robot", str(path), "--home", str(tmp_path)]
    started = subprocess.Popen([sys.executable, "-m", "ros2", *words])
    yield started
    started.kill()
    started.wait(LIMIT_S)


@pytest.mark.e2e
def test_a_goal_goes_out_its_fate_and_twists_come_back_and_a_silent_planner_calls_it_off(
    tmp_path: Path, base: BaseWithNav2, bridge: Bridge, process: subprocess.Popen[bytes]
) -> None:
    heard: list[Nav2State] = []
    with open_session(Party.PLANNER, "r1", tmp_path) as planner:
        says, hears = planner.publisher(keys.NAV2_GOAL), planner.subscriber(keys.NAV2_STATE)
        order = Nav2Goal(planner_id="p1", seen=1, mission="m1", leg=1, goal=GOAL, here=HERE)

        def shows(done: Callable[[Nav2State], bool], *, speaking: bool) -> Callable[[], bool]:
            def look() -> bool:
                if speaking:
                    says.put(order)
                state = hears.newest()
                heard.extend([] if state is None else [state])
                return bool(heard) and done(heard[-1])

            return look

        bridge.until(shows(lambda s: s.phase == "driving" and s.twist > 2, speaking=True))
        assert (heard[-1].v_mps, heard[-1].code) == (0.4, None)
        assert base.nav2.goals == [(2.0, 0.0, 0.0)]
        bridge.until(shows(lambda s: s.phase == "idle", speaking=False))
        assert base.nav2.goals[1:] == [(0.0, 0.0, 0.0)], "where it stood"
    assert process.poll() is None
