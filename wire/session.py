"""Carry messages between processes. The only file that knows zenoh.

Every producer listens and nobody relays: bridge, robot and localization listen, the others dial
them. Multicast and gossip are off. Dialling is retried for ever; a missing peer is no error. Every
subscriber has a ring that drops the oldest, because the default handler blocks the whole session
when nobody drains it. Publishing never waits: a frozen peer loses messages, the sender no time.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Generic, TypeVar

import zenoh

from wire.base import Record
from wire.codec import decode, encode
from wire.errors import Misconfigured
from wire.keys import Key
from wire.sockets import Endpoints

if TYPE_CHECKING:
    from types import TracebackType

    from wire.errors import Rejected

M = TypeVar("M", bound=Record)

_PARSED_PER_DRAIN = 4
"""At most so many newest messages of a key are worth parsing in one tick."""


class Publisher(Generic[M]):
    """Send one kind of message. Never blocks, never raises for an absent or frozen peer."""

    def __init__(self, session: zenoh.Session, key: Key[M], robot_id: str) -> None:
        self._publisher = session.declare_publisher(
            key.expression(robot_id),
            congestion_control=zenoh.CongestionControl.DROP,
            express=True,
        )

    def put(self, message: M) -> None:
        """Send and forget."""
        self._publisher.put(encode(message))


class Subscriber(Generic[M]):
    """Hold the newest messages of one key until somebody drains them."""

    def __init__(self, session: zenoh.Session, key: Key[M], robot_id: str) -> None:
        self._key = key
        self._subscriber = session.declare_subscriber(
            key.expression(robot_id), zenoh.handlers.RingChannel(key.ring)
        )

    def drain_bytes(self) -> list[bytes]:
        """Take all that is waiting, oldest first, unparsed."""
        payloads: list[bytes] = []
        while (sample := self._try_recv()) is not None:
            payloads.append(sample.payload.to_bytes())
        return payloads

    def drain(self) -> Drained[M]:
        """Take all that is waiting, parse at most the 4 newest, in order of arrival."""
        payloads = self.drain_bytes()
        return Drained(
            tuple(decode(self._key, raw) for raw in payloads[-_PARSED_PER_DRAIN:]), len(payloads)
        )

    def newest(self) -> M | None:
        """Take all that is waiting and return the newest that is a message."""
        for item in reversed(self.drain().items):
            if isinstance(item, self._key.message):
                return item
        return None

    def _try_recv(self) -> zenoh.Sample | None:
        try:
            return self._subscriber.try_recv()
        except zenoh.ZError:  # the session is closed: nothing will ever come
            return None


class Drained(Generic[M]):
    """Give what one drain took from a key: parsed items and how many arrived."""

    __slots__ = ("arrived", "items")

    def __init__(self, items: tuple[M | Rejected, ...], arrived: int) -> None:
        self.items = items
        self.arrived = arrived
