"""Keep a graph's publishers and subscriptions, and answer what type a topic has. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2.operations import TopicType

if TYPE_CHECKING:
    from collections.abc import Iterable


@dataclass(frozen=True, slots=True)
class GraphEndpoint:
    """Hold one publisher or subscription of another process."""

    topic: str
    kind: str
    publishes: bool
    type_hash: str = ""
    """Of its type, where the transport's keys carry it."""


class GraphEndpoints:
    """Hold the graph as it was discovered, and which topics have changed since they were told."""

    def __init__(self) -> None:
        self._each: dict[str, GraphEndpoint] = {}
        self._asked: set[str] = set()
        self._changed: set[str] = set()
        self.was_reached = False
        """Whether anybody else was ever there."""

    def add(self, key: str, endpoint: GraphEndpoint) -> None:
        """Take one that was discovered."""
        self.was_reached = True
        self._each[key] = endpoint
        self._changed.add(endpoint.topic)

    def remove(self, key: str) -> None:
        """Forget one that went."""
        gone = self._each.pop(key, None)
        if gone is not None:
            self._changed.add(gone.topic)

    def ask(self, topic: str) -> None:
        """Have a topic told now, and anew whenever it changes."""
        self._asked.add(topic)
        self._changed.add(topic)

    def news(self) -> list[TopicType]:
        """Return what is to be told: nothing before anybody was found, who might have it."""
        if not self.was_reached:
            return []
        due, self._changed = self._changed & self._asked, set()
        return [self._judge(topic) for topic in sorted(due)]

    def type_hashes(self, topic: str, kind: str) -> list[str]:
        """Return the hashes that a topic's endpoints of one type have said, without doubles."""
        return sorted(
            {one.type_hash for one in self._of(topic) if one.kind == kind and one.type_hash}
        )

    def topics(self) -> list[str]:
        """Return the topics that there are."""
        return sorted({one.topic for one in self._each.values()})

    def _judge(self, topic: str) -> TopicType:
        kinds = sorted({one.kind for one in self._of(topic)})
        publishers = sum(one.publishes for one in self._of(topic))
        return TopicType(topic, " and ".join(kinds), publishers)

    def _of(self, topic: str) -> Iterable[GraphEndpoint]:
        return [one for one in self._each.values() if one.topic == topic]
