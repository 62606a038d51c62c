"""Ask the node on a robot of ROS 2 for one message, and leave. For people's commands."""

from __future__ import annotations

import json
import time
from typing import TYPE_CHECKING, Any

from ros2.robot_link import MOST_MAP_BYTES, RobotLink
from ros2.trouble import Ros2Trouble, TopicFailure

if TYPE_CHECKING:
    from collections.abc import Callable

PERIOD_S = 0.02
DIAL_S = 4.0


def fetch(
    locator: str, name: str, limit_s: float, is_enough: Callable[[bytes, bytes], bool]
) -> tuple[bytes, bytes]:
    """Return the first message of a key that is enough: its head and its bytes.

    Raises:
        TopicFailure: it did not come within ``limit_s``; says why.
    """
    began_s = time.monotonic()
    with RobotLink(locator, (name,), MOST_MAP_BYTES) as link:
        while (passed_s := time.monotonic() - began_s) <= limit_s:
            for head, payload in link.take_headed(name):
                if is_enough(head, payload):
                    return head, payload
            if passed_s > DIAL_S and not link.is_joined:
                break
            time.sleep(PERIOD_S)
        if not link.is_joined:
            found = f"nobody answers at {locator}"
            raise TopicFailure(Ros2Trouble("ros2_no_node", found))
    found = f"the node at {locator} said no {name}; its parameters name the topics"
    raise TopicFailure(Ros2Trouble("ros2_topic_missing", found))


def read_json(text: bytes) -> Any:
    """Return what JSON says; None where it is none."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return None
