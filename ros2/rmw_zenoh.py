"""Speak rmw_zenoh's keys to a ROS 2 graph, through its router. Untried with a true rmw_zenoh.

A client of the router, which hands on what peers say: one link, and its loss is the graph's. Types
are named with hashes there, which differ by distribution; each is learnt from the tokens of those
who wait for the topic, and nothing is said before.
"""

from __future__ import annotations

import asyncio
import json
import secrets
import time
from typing import TYPE_CHECKING, Any

import zenoh
import zenoh.ext

from ros2 import rmw_keys
from ros2.endpoints import GraphEndpoint
from ros2.polled_transport import PolledTransport, Unreachable
from ros2.transport import MOST_BYTES, PERIOD_S

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ros2.operations import Subscribe
    from ros2.transport import GraphListener, LinkMessages
    from wire.ros2_config import Ros2Config

DIAL_S = 3.0
NODE = "pons"
_RING = 4
_TOKENS = 4096


class ZenohTransport(PolledTransport):
    """Be one node of a domain."""

    def __init__(
        self,
        ros2: Ros2Config,
        listener: GraphListener,
        publish: Callable[[LinkMessages], None],
        most_bytes: int = MOST_BYTES,
        period_s: float = PERIOD_S,
    ) -> None:
        super().__init__(ros2, listener, publish, most_bytes, period_s)
        self._session: zenoh.Session | None = None
        self._node = rmw_keys.OwnNode(ros2.domain, "", NODE)
        self._discovered: Any = None
        self._held: list[Any] = []
        """Tokens and subscribers: each lives as long as it is held."""
        self._subscribers: dict[str, Any] = {}
        self._publishers: dict[str, HashedPublisher] = {}

    async def _join(self) -> None:
        try:
            session = await asyncio.to_thread(zenoh.open, _config(self._ros2.router))
        except zenoh.ZError as error:
            found = f"{self._ros2.router}: {str(error).splitlines()[0][:200]}"
            raise Unreachable("ros2_no_router", found) from None
        self._session = session
        self._node = rmw_keys.OwnNode(self._ros2.domain, str(session.zid()), NODE)
        self._say_alive(self._node.node_token())
        self._discovered = session.liveliness().declare_subscriber(
            rmw_keys.all_tokens(self._ros2.domain),
            zenoh.handlers.RingChannel(_TOKENS),
            history=True,
        )

    def _leave(self) -> None:
        self._held.clear()
        self._subscribers.clear()
        self._publishers.clear()
        self._discovered = None
        session, self._session = self._session, None
        if session is not None:
            session.close()  # type: ignore[no-untyped-call]  # its stub has no annotation

    def _discover(self) -> None:
        session = self._session
        if session is None or not session.info.routers_zid():
            raise Unreachable("ros2_no_router", f"{self._ros2.router} ended the connection")
        while (sample := self._discovered.try_recv()) is not None:
            key = str(sample.key_expr)
            read = rmw_keys.read_token(key)
            if read is None or read[0] == self._node.session:
                continue
            if sample.kind == zenoh.SampleKind.DELETE:
                self._graph.remove(key)
            elif read[1] is None:
                self._graph.was_reached = True
            else:
                self._graph.add(key, read[1])

    def _take(self) -> Iterator[tuple[str, bytes]]:
        for topic, subscriber in self._subscribers.items():
            while (sample := subscriber.try_recv()) is not None:
                yield topic, sample.payload.to_bytes()

    def _advertise(self, topic: str, kind: str) -> None:
        self._publishers[topic] = HashedPublisher(topic, kind)

    def _unadvertise(self, topic: str) -> None:
        self._publishers.pop(topic).close()

    def _subscribe(self, request: Subscribe) -> None:
        session = self._session
        if session is None:
            return
        key = rmw_keys.topic_key(self._ros2.domain, request.topic, request.kind)
        ring: Any = zenoh.handlers.RingChannel(_RING)
        if request.keeps:
            history = zenoh.ext.HistoryConfig(detect_late_publishers=True)
            made: Any = zenoh.ext.declare_advanced_subscriber(session, key, ring, history=history)
        else:
            made = session.declare_subscriber(key, ring)
        self._subscribers[request.topic] = made
        hashes = self._graph.type_hashes(request.topic, request.kind)
        first = hashes[0] if hashes else ""
        endpoint = GraphEndpoint(request.topic, request.kind, publishes=False, type_hash=first)
        self._say_alive(self._node.endpoint_token(len(self._held), endpoint, keeps=request.keeps))

    def _write(self, topic: str, payload: bytes) -> bool:
        session, publisher = self._session, self._publishers[topic]
        hashes = self._graph.type_hashes(topic, publisher.kind)
        if session is None or not hashes:
            return False  # nobody waits for it
        publisher.declare(session, self._node, hashes)
        publisher.put(payload)
        return True

    def _say_alive(self, token: str) -> None:
        if self._session is not None:
            self._held.append(self._session.liveliness().declare_token(token))


class HashedPublisher:
    """Publish one topic under each hash that those who wait for it have named."""

    def __init__(self, topic: str, kind: str) -> None:
        self.kind = kind
        self._topic = topic
        self._hashes: list[str] = []
        self._publishers: list[Any] = []
        self._tokens: list[Any] = []
        self._gid, self._seq = secrets.token_bytes(rmw_keys.GID_BYTES), 0

    def declare(self, session: zenoh.Session, node: rmw_keys.OwnNode, hashes: list[str]) -> None:
        """Publish under these hashes from now on."""
        if hashes == self._hashes:
            return
        self.close()
        self._hashes = hashes
        for type_hash in hashes:
            key = rmw_keys.topic_key(node.domain, self._topic, self.kind, type_hash)
            self._publishers.append(
                session.declare_publisher(
                    key, congestion_control=zenoh.CongestionControl.DROP, express=True
                )
            )
            endpoint = GraphEndpoint(self._topic, self.kind, publishes=True, type_hash=type_hash)
            number = 1000 + int.from_bytes(self._gid[:2], "little")
            token = node.endpoint_token(number, endpoint)
            self._tokens.append(session.liveliness().declare_token(token))

    def put(self, payload: bytes) -> None:
        """Send and forget."""
        self._seq += 1
        beside = rmw_keys.attachment(self._seq, time.time_ns(), self._gid)
        for publisher in self._publishers:
            publisher.put(payload, attachment=beside)

    def close(self) -> None:
        """Be a publisher no longer."""
        for one in (*self._tokens, *self._publishers):
            one.undeclare()
        self._tokens, self._publishers, self._hashes = [], [], []


def _config(router: str) -> zenoh.Config:
    settings: dict[str, object] = {
        "mode": "client",
        "connect/endpoints": [router],
        "connect/timeout_ms": round(1000 * DIAL_S),
        "scouting/multicast/enabled": False,
        "transport/link/tx/queue/congestion_control/drop/wait_before_drop": 0,
        "transport/link/tx/queue/size/data": 16,  # as in wire/session.py, which says why
        "transport/shared_memory/enabled": False,
    }
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return config
