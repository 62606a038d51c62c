"""Dial the node that runs on a robot of ROS 2 (the package pons_ros2), over zenoh.

Dialling is retried for ever; nobody is scouted and nothing relayed. What comes lies in rings that
drop the oldest until it is taken, so that no thread of a library calls into ours.
"""

from __future__ import annotations

import json
import os
import time
from typing import TYPE_CHECKING, Any

import zenoh

from ros2.pons_ros2.pons_ros2.link import HEARS, PREFIX, SAYS, access_control
from ros2.trouble import Ros2Trouble, TopicFailure

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType
    from typing import Self

RINGS = {"state": 8, "odom": 8, "scan": 2}
"""Of what is numbered or adds up; of all else the newest alone counts."""
MOST_BYTES = 1 << 20
"""A scan of 2 048 beams has 20 kB."""
MOST_PICTURE_BYTES = 17 << 20
MOST_MAP_BYTES = 65 << 20
PERIOD_S, DIAL_S = 0.02, 4.0
_RUNTIME = "(net: (handover: rx), acc: (handover: rx))"


class RobotLink:
    """Hear some keys of one robot, and say commands and goals to it."""

    def __init__(self, locator: str, names: tuple[str, ...], most_bytes: int = MOST_BYTES) -> None:
        """Begin to dial.

        Args:
            locator: where the node listens, such as tcp/127.0.0.1:7448.
            names: the keys to hear.
            most_bytes: of one message; a robot that sends more is cut off.
        """
        os.environ.setdefault("ZENOH_RUNTIME", _RUNTIME)  # read once, at the first session
        self._session = zenoh.open(_config(locator, most_bytes))
        self._heard = {
            name: self._session.declare_subscriber(
                f"{PREFIX}/{name}", zenoh.handlers.RingChannel(RINGS.get(name, 1))
            )
            for name in names
        }
        self._says = {
            name: self._session.declare_publisher(
                f"{PREFIX}/{name}",
                congestion_control=zenoh.CongestionControl.DROP,
                express=True,
            )
            for name in HEARS
        }

    @property
    def is_joined(self) -> bool:
        """Return whether somebody answers there."""
        return bool(self._session.info.peers_zid())

    def take(self, name: str) -> list[bytes]:
        """Return what waits on a key, oldest first."""
        return [payload for _, payload in self.take_headed(name)]

    def take_headed(self, name: str) -> list[tuple[bytes, bytes]]:
        """Return what waits on a key with the head beside each, oldest first."""
        taken = []
        for _ in range(RINGS.get(name, 1)):
            sample = self._heard[name].try_recv()
            if sample is None:
                break
            head = sample.attachment
            taken.append((head.to_bytes() if head is not None else b"", sample.payload.to_bytes()))
        return taken

    def say(self, name: str, payload: bytes) -> None:
        """Send and forget; never waits."""
        self._says[name].put(payload)

    def close(self) -> None:
        """Leave."""
        self._session.close()  # type: ignore[no-untyped-call]  # its stub has no annotation

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def fetch(
    locator: str, name: str, limit_s: float, is_enough: Callable[[bytes, bytes], bool]
) -> tuple[bytes, bytes]:
    """Dial, return the first message of a key that is enough, and leave: its head and its bytes.

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


def _config(locator: str, most_bytes: int) -> Any:
    settings: dict[str, object] = {
        "mode": "peer",
        "connect/endpoints": [locator],
        "connect/timeout_ms": -1,  # never give up
        "connect/exit_on_failure": False,
        "connect/retry": {
            "period_init_ms": 100, "period_max_ms": 1000, "period_increase_factor": 2
        },
        "listen/endpoints": [],
        "open/return_conditions/connect_scouted": False,
        "scouting/delay": 0,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/link/tx/queue/congestion_control/drop/wait_before_drop": 0,
        "transport/link/tx/queue/size/data": 16,
        "transport/link/rx/max_message_size": most_bytes,
        "transport/shared_memory/enabled": False,
        "access_control": access_control(SAYS, HEARS),
    }  # fmt: skip
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return config
