"""Speak DDS to a ROS 2 graph, by Cyclone DDS: neither a bridge nor ROS on this side.

Readers are best effort, which fits every publisher; what Pons says is reliable, which fits every
subscription.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2.endpoints import GraphEndpoint
from ros2.layouts import ros_name
from ros2.polled_transport import PolledTransport, Unreachable
from ros2.transport import MOST_BYTES, PERIOD_S

try:
    from ros2 import dds_entities as entities
except ImportError as missing:  # an extra, for x86_64 alone
    MISSING = str(missing)
else:
    MISSING = ""

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ros2.dds_entities import DdsDomain, RawReader, RawWriter
    from ros2.operations import Subscribe
    from ros2.transport import GraphListener, LinkMessages
    from wire.ros2_config import Ros2Config

_PREFIX = "rt"
"""Of topics; services and actions have others."""


class DdsTransport(PolledTransport):
    """Be one participant of a domain."""

    def __init__(
        self,
        ros2: Ros2Config,
        listener: GraphListener,
        publish: Callable[[LinkMessages], None],
        most_bytes: int = MOST_BYTES,
        period_s: float = PERIOD_S,
    ) -> None:
        super().__init__(ros2, listener, publish, most_bytes, period_s)
        self._domain: DdsDomain | None = None
        self._readers: dict[str, RawReader] = {}
        self._writers: dict[str, RawWriter] = {}

    async def _join(self) -> None:
        if MISSING:
            raise Unreachable("ros2_no_dds", f"ros2.transport 'dds' needs cyclonedds: {MISSING}")
        try:
            self._domain = entities.DdsDomain(self._ros2.domain, self._ros2.interface)
        except entities.DDSException as error:
            raise Unreachable("ros2_no_dds", f"{self._ros2.peer}: {error.msg}") from None

    def _leave(self) -> None:
        self._readers.clear()
        self._writers.clear()
        domain, self._domain = self._domain, None
        if domain is not None:
            domain.close()

    def _discover(self) -> None:
        for found in self._domain.changes() if self._domain else ():
            topic = found.topic.removeprefix(f"{_PREFIX}/")
            if found.is_gone:
                self._graph.remove(found.key)
            elif topic != found.topic:
                endpoint = GraphEndpoint(f"/{topic}", ros_name(found.kind), found.publishes)
                self._graph.add(found.key, endpoint)

    def _take(self) -> Iterator[tuple[str, bytes]]:
        for topic, reader in self._readers.items():
            for payload in reader.take():
                yield topic, payload

    def _advertise(self, topic: str, kind: str) -> None:
        if self._domain is not None:
            self._writers[topic] = self._domain.writer(_PREFIX + topic, kind)

    def _unadvertise(self, topic: str) -> None:
        writer = self._writers.pop(topic, None)
        if writer is not None:
            writer.close()

    def _subscribe(self, request: Subscribe) -> None:
        if self._domain is not None:
            self._readers[request.topic] = self._domain.reader(
                _PREFIX + request.topic, request.kind, keeps=request.keeps
            )

    def _write(self, topic: str, payload: bytes) -> bool:
        return self._writers[topic].write(payload)
