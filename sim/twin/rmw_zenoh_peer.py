"""Act as a ROS 2 robot under rmw_zenoh: its router, and one node with the topics of a base.

A second implementation, written from rmw_zenoh's design page and sources. The node says its tokens,
publishes with attachments, and takes a command only under its own type's hash and with 33 bytes
of attachment, as a true one does.
"""

from __future__ import annotations

import hashlib
import json
import struct
import time
from typing import TYPE_CHECKING, Any

import zenoh

from sim.twin.cdr_writer import WRITERS, read_string
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Collection

Message = dict[str, Any]
ATTACHMENT = struct.Struct("<qqB16s")
_NODE = "twin"


class RmwZenohPeer:
    """Serve topics of known types; hold what others publish until it is taken."""

    def __init__(
        self, port: int, types: dict[str, str], heard: Collection[str], domain: int = 0
    ) -> None:
        """Listen on the loopback.

        Args:
            port: of the router.
            types: of the node's topics.
            heard: those that it subscribes; it publishes the others.
            domain: the ROS_DOMAIN_ID.

        Raises:
            ConfigError: ``twin_port``, where the port is another's.
        """
        self.types, self.port, self._domain = types, port, domain
        address = f"tcp/127.0.0.1:{port}"
        try:
            self._router = _open("router", listen=address)
        except zenoh.ZError as error:
            raise ConfigError("twin_port", f"{address}: {error}") from None
        self._session = _open("peer", connect=address)
        zid = str(self._session.zid())
        tokens = [f"@ros2_lv/{domain}/{zid}/0/0/NN/%/%/{_NODE}"]
        self._sequence = 0
        self._gid = hashlib.md5(zid.encode(), usedforsecurity=False).digest()
        self._publishers: dict[str, zenoh.Publisher] = {}
        self._subscribers: dict[str, Any] = {}
        for number, (topic, kind) in enumerate(types.items(), 1):
            key, name = self._key(topic, kind), topic.replace("/", "%")
            entity = "MS" if topic in heard else "MP"
            end = f"{name}/{_dds_name(kind)}/{hash_of(kind)}/1:2:1,10:,:,:,,"
            tokens.append(f"@ros2_lv/{domain}/{zid}/0/{number}/{entity}/%/%/{_NODE}/{end}")
            if topic in heard:
                ring: Any = zenoh.handlers.RingChannel(64)
                self._subscribers[topic] = self._session.declare_subscriber(key, ring)
            else:
                self._publishers[topic] = self._session.declare_publisher(key)
        self._tokens = [self._session.liveliness().declare_token(one) for one in tokens]
        self.refused = 0
        """What came without a proper attachment."""

    def take(self) -> list[tuple[str, Message]]:
        """Return what others have published since the last call, oldest first."""
        found = []
        for topic, subscriber in self._subscribers.items():
            while (sample := subscriber.try_recv()) is not None:
                beside = sample.attachment
                if beside is None or not _is_proper(beside.to_bytes()):
                    self.refused += 1
                else:
                    found.append((topic, {"data": read_string(sample.payload.to_bytes())}))
        return found

    def publish(self, topic: str, message: Message) -> None:
        """Send a message to all who subscribed."""
        self._sequence += 1
        beside = ATTACHMENT.pack(self._sequence, time.time_ns(), 16, self._gid)
        payload = WRITERS[self.types[topic]](message)
        self._publishers[topic].put(payload, attachment=beside)

    def hang_up(self) -> None:
        """End the router without a word, and start it anew."""
        self._router.close()  # type: ignore[no-untyped-call]  # its stub has no annotation
        self._router = _open("router", listen=f"tcp/127.0.0.1:{self.port}")

    def close(self) -> None:
        """Stop serving."""
        for session in (self._session, self._router):
            session.close()  # type: ignore[no-untyped-call]  # its stub has no annotation

    def _key(self, topic: str, kind: str) -> str:
        return f"{self._domain}{topic}/{_dds_name(kind)}/{hash_of(kind)}"


def hash_of(kind: str) -> str:
    """Return a hash in the form of a type's: a twin's own, for Pons is to learn it."""
    return f"RIHS01_{hashlib.sha256(kind.encode()).hexdigest()}"


def _dds_name(kind: str) -> str:
    package, _, name = kind.split("/")
    return f"{package}::msg::dds_::{name}_"


def _is_proper(beside: bytes) -> bool:
    return len(beside) == ATTACHMENT.size and ATTACHMENT.unpack(beside)[2] == 16


def _open(mode: str, listen: str = "", connect: str = "") -> zenoh.Session:
    config = zenoh.Config()
    settings: dict[str, object] = {
        "mode": mode,
        "listen/endpoints": [listen] if listen else [],
        "connect/endpoints": [connect] if connect else [],
        "timestamping": {"enabled": True},
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return zenoh.open(config)
