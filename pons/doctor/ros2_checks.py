"""Check a ROS 2 base: what its process says, or, where none runs, what the robot's node says."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from pons.doctor.running_process import hear_state, says_nothing
from ros2.pons_ros2.pons_ros2.link import is_loopback
from ros2.robot_link import RobotLink
from ros2.ros_base import RosBase
from ros2.trouble import CODES, Ros2Trouble
from wire import keys
from wire.doors import ROS2_COPY_DOOR
from wire.sockets import Endpoints, is_listening

if TYPE_CHECKING:
    from pathlib import Path

    from wire import RobotDescription
    from wire.ros2_config import Ros2Config

ASK_S = 6.0
PERIOD_S = 0.01


def ros2(home: Path, robot: RobotDescription) -> HealthFinding:
    """Look how well the base is heard; asks and subscribes, and publishes nothing."""
    config = robot.ros2
    if config is None:
        return ok("ros2", "not used", "未使用")
    if is_listening(Endpoints(home).socket(ROS2_COPY_DOOR)):
        return _hear_process(home, robot, config)
    trouble = _ask_node(robot, config.node)
    return _describe(config, trouble.code if trouble else None, trouble.found if trouble else "")


def _hear_process(home: Path, robot: RobotDescription, config: Ros2Config) -> HealthFinding:
    """Report what the running process says."""
    status = hear_state(home, robot, keys.ROS2_STATE)
    if status is None:
        return says_nothing("ros2")
    if status.code is None and config.nav2 is not None:
        nav2 = hear_state(home, robot, keys.NAV2_STATE)
        if nav2 is None:
            return says_nothing("ros2")
        return _describe(config, nav2.code, nav2.detail)
    return _describe(config, status.code, status.detail)


def _ask_node(robot: RobotDescription, locator: str) -> Ros2Trouble | None:
    """Dial the node as the process would, and listen for some seconds."""
    base = RosBase(robot, "doctor")
    end_s = time.monotonic() + ASK_S
    trouble: Ros2Trouble | None = Ros2Trouble("ros2_no_node", f"nobody answers at {locator}")
    with RobotLink(locator, base.names) as link:
        while trouble is not None and time.monotonic() < end_s:
            time.sleep(PERIOD_S)
            now_s = time.monotonic()
            if link.is_joined and not base.reached:
                base.open(now_s)
            for name in base.names:
                for payload in link.take(name):
                    base.hear(name, payload, now_s)
            if base.reached:
                trouble = base.judge(now_s)
    return trouble


def _describe(config: Ros2Config, code: str | None, found: str) -> HealthFinding:
    if code is None:
        if not is_loopback(config.node):
            return warn(
                "ros2",
                BilingualWords(
                    f"{config.node} and its base are heard, and by all on that network",
                    f"{config.node}：底盘正常，但该网络中的所有人都可访问",
                ),
                BilingualWords(
                    "commands take its key; `ssh -L` or a VPN hides the rest (docs/ros2.md)",
                    "命令需用密钥签名；如需隐藏其余内容请使用 `ssh -L` 或 VPN（docs/ros2.md）",
                ),
            )
        return ok("ros2", f"{config.node} and its base are heard", f"{config.node}：底盘正常")
    words = f"{code}: {found.split(';', 1)[0]}"
    english, chinese = CODES.get(code, ("see docs/ros2.md", "请查看 docs/ros2.md"))
    return fail("ros2", BilingualWords(words, words), BilingualWords(english, chinese))
