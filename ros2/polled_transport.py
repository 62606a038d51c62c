"""Serve a graph whose readers are asked, up to a thousand times a second: what DDS and zenoh share.

Asked, so that no thread of a library calls into ours, and one sample deep, so that nobody waits:
what was not taken when the next came is lost. Messages cross as plain CDR.
"""

from __future__ import annotations

import asyncio
import time
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

from ros2 import cdr
from ros2.endpoints import GraphEndpoints
from ros2.operations import (
    Advertise,
    AskType,
    Publish,
    Subscribe,
    TopicMessage,
    UnreadableMessage,
)
from ros2.robot_words import Unreadable
from ros2.trouble import Ros2Trouble

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from ros2.operations import Request
    from ros2.transport import GraphListener, LinkMessages
    from wire.ros2_config import Ros2Config

LOOK_S = 0.1
RETRY_S = 1.0


class Unreachable(Exception):
    """Raised where a graph can't be joined, or was lost; carries what people are told."""

    def __init__(self, code: str, found: str) -> None:
        super().__init__(found)
        self.trouble = Ros2Trouble(code, found)


class PolledTransport(ABC):
    """Join a graph, take what comes, and join it anew when it was lost."""

    def __init__(
        self,
        ros2: Ros2Config,
        listener: GraphListener,
        publish: Callable[[LinkMessages], None],
        most_bytes: int,
        period_s: float,
    ) -> None:
        self._most_bytes, self._period_s = most_bytes, period_s
        self._ros2, self._listener, self._publish = ros2, listener, publish
        self._graph = GraphEndpoints()
        self._wanted: dict[str, Subscribe] = {}
        self._kinds: dict[str, str] = {}
        self._heard_s: dict[str, float] = {}
        self._looked_s = float("-inf")
        self._has_joined = False

    async def serve(self) -> None:
        """Take what comes for ever."""
        while True:
            try:
                await self._join()
                self._has_joined = True
                self._listener.open(time.monotonic())
                while True:
                    self._turn(time.monotonic())
                    await asyncio.sleep(self._period_s)
            except Unreachable as error:
                self._listener.close(error.trouble)
            finally:
                self._has_joined = False
                self._graph = GraphEndpoints()
                for known in (self._wanted, self._kinds, self._heard_s):
                    known.clear()
                self._leave()
            await asyncio.sleep(RETRY_S)

    def has_room(self) -> bool:
        """Return whether the graph is joined; writers of one sample never wait."""
        return self._has_joined

    async def send(self, request: Request) -> bool:
        """Carry out a request; False where it can't be."""
        if not self._has_joined:
            return False
        topic = request.topic
        if isinstance(request, Publish):
            kind = self._kinds.get(topic)
            return kind is not None and self._write(topic, cdr.encode(kind, request.message))
        if isinstance(request, AskType):
            self._graph.ask(topic)
            self._tell(time.monotonic())
        elif isinstance(request, Advertise):
            self._kinds[topic] = request.kind
            self._advertise(topic, request.kind)
        elif isinstance(request, Subscribe):
            self._wanted[topic] = request
            self._subscribe(request)
        elif self._kinds.pop(topic, None) is not None:
            self._unadvertise(topic)
        return True

    async def drop_if_silent(self, now_s: float) -> None:  # noqa: B027  # nothing to override
        """Do nothing: the graph itself forgets who is silent, and tells it."""

    @abstractmethod
    async def _join(self) -> None:
        """Join the graph.

        Raises:
            Unreachable: it can't be joined.
        """

    @abstractmethod
    def _leave(self) -> None:
        """Leave it; also where it was never joined."""

    @abstractmethod
    def _discover(self) -> None:
        """Put what was discovered since into ``_graph``.

        Raises:
            Unreachable: the graph was lost.
        """

    @abstractmethod
    def _take(self) -> Iterable[tuple[str, bytes]]:
        """Return what came since, by topic."""

    @abstractmethod
    def _advertise(self, topic: str, kind: str) -> None: ...

    @abstractmethod
    def _unadvertise(self, topic: str) -> None: ...

    @abstractmethod
    def _subscribe(self, request: Subscribe) -> None: ...

    @abstractmethod
    def _write(self, topic: str, payload: bytes) -> bool: ...

    def _turn(self, now_s: float) -> None:
        if now_s - self._looked_s >= LOOK_S:
            self._looked_s = now_s
            self._discover()
            self._tell(now_s)
        for topic, payload in self._take():
            wanted = self._wanted[topic]
            if 1000.0 * (now_s - self._heard_s.get(topic, float("-inf"))) >= wanted.every_ms:
                self._heard_s[topic] = now_s
                self._publish(self._listener.hear(self._read(wanted, payload), now_s))

    def _tell(self, now_s: float) -> None:
        for answer in self._graph.news():
            self._publish(self._listener.hear(answer, now_s))

    def _read(self, wanted: Subscribe, payload: bytes) -> TopicMessage | UnreadableMessage:
        if not len(payload) <= self._most_bytes:
            found = f"a message of {len(payload)} bytes, expected at most {self._most_bytes}"
            return UnreadableMessage(wanted.topic, found)
        try:
            return TopicMessage(wanted.topic, cdr.decode(wanted.kind, payload))
        except Unreadable as why:
            return UnreadableMessage(wanted.topic, str(why))
