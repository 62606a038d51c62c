"""Speak Pons' wire over zenoh: the one socket of this package.

Listens where Pons dials; scouts nobody and relays nothing. Access control lets commands and orders
in and what the robot says out, and no other key either way. What can't be sent at once is dropped.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import zenoh

if TYPE_CHECKING:
    from collections.abc import Callable

PREFIX = "pons/ros2"
HEARS = ("command", "nav2/goal", "plan")
SAYS = ("state", "odom", "scan", "imu", "frames", "map", "picture", "depth", "nav2/state")
MOST_HEARD_BYTES = 65_536
DEFAULT_PORT = 7448


class OpenToAll(Exception):
    """Refuse to listen beyond this computer where anybody's command would move the base."""


class PlannerLink:
    """Listen for Pons. Thread-safe, as zenoh is."""

    def __init__(self, listen: str, *, has_key: bool) -> None:
        """Listen at a locator such as tcp/127.0.0.1:7448.

        Raises:
            OpenToAll: it is no loopback, and there is no key.
            zenoh.ZError: somebody else listens there.
        """
        if not has_key and not is_loopback(listen):
            raise OpenToAll(f"{listen} is open to all on its network, and no key is set")
        self._session = zenoh.open(_config(listen))
        self._says = {
            name: self._session.declare_publisher(
                f"{PREFIX}/{name}",
                congestion_control=zenoh.CongestionControl.DROP,
                express=True,
            )
            for name in SAYS
        }
        self._heard: list[Any] = []

    def hear(self, name: str, take: Callable[[str], None]) -> None:
        """Have each message of a key taken as text, on a thread of zenoh's."""

        def decode(sample: Any) -> None:
            raw = sample.payload.to_bytes()
            if len(raw) <= MOST_HEARD_BYTES:
                take(raw.decode("utf-8", "replace"))

        key = f"{PREFIX}/{name}"
        self._heard.append(self._session.declare_subscriber(key, decode))

    def has_listener(self, name: str) -> bool:
        """Return whether anybody hears a key now."""
        return bool(self._says[name].matching_status.matching)  # type: ignore[attr-defined]  # its stub says bool

    def say(self, name: str, words: object) -> None:
        """Send words as JSON; text goes as it is."""
        text = words if isinstance(words, str) else json.dumps(words, allow_nan=False)
        self._says[name].put(text.encode())

    def say_bytes(self, name: str, head: dict[str, Any], data: bytes) -> None:
        """Send bytes, with what they are beside them."""
        self._says[name].put(data, attachment=json.dumps(head, allow_nan=False).encode())

    def close(self) -> None:
        """Leave."""
        self._session.close()  # type: ignore[no-untyped-call]  # its stub has no annotation


def is_loopback(locator: str) -> bool:
    """Return whether only this computer reaches an address."""
    host = locator.partition("/")[2].rpartition(":")[0].strip("[]")
    return host in ("localhost", "::1") or host.startswith("127.")


def _config(listen: str) -> Any:
    settings = {
        "mode": "peer",
        "listen/endpoints": [listen],
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/link/tx/queue/congestion_control/drop/wait_before_drop": 0,
        "transport/link/tx/queue/size/data": 16,
        "transport/link/rx/max_message_size": MOST_HEARD_BYTES,
        "transport/shared_memory/enabled": False,
        "access_control": access_control(HEARS, SAYS),
    }
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return config


def access_control(hears: tuple[str, ...], says: tuple[str, ...]) -> dict[str, Any]:
    """Return zenoh's access control: messages of these keys each way, nothing else of any kind."""
    rules = [
        {
            "id": f"{flow}_{message}",
            "permission": "allow",
            "flows": [flow],
            "messages": [message],
            "key_exprs": [f"{PREFIX}/{name}" for name in names],
        }
        for flow, message, names in (
            ("ingress", "put", hears),
            ("egress", "declare_subscriber", hears),
            ("egress", "put", says),
            ("ingress", "declare_subscriber", says),
        )
    ]
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": rules,
        "subjects": [{"id": "anybody"}],
        "policies": [{"rules": [rule["id"] for rule in rules], "subjects": ["anybody"]}],
    }
