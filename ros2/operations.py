"""Say what a base's link asks of its transport, and what the transport hears. Pure.

The one seam between what Pons knows of a ROS 2 robot and the way there: rosbridge, DDS or zenoh.
Messages are dictionaries by ROS's field names, whatever carries them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

Message = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Advertise:
    """Ask to be known as a publisher of a topic."""

    topic: str
    kind: str


@dataclass(frozen=True, slots=True)
class Unadvertise:
    """Ask to be known as a publisher of a topic no longer."""

    topic: str


@dataclass(frozen=True, slots=True)
class Publish:
    """Ask to send one message on a topic that was advertised."""

    topic: str
    message: Message


@dataclass(frozen=True, slots=True)
class Subscribe:
    """Ask for what comes on a topic."""

    topic: str
    kind: str
    every_ms: int = 0
    """At most one message in so long; 0: each."""
    keeps: bool = False
    """Its publisher keeps what it said for those who come late (transient local)."""


@dataclass(frozen=True, slots=True)
class AskType:
    """Ask the graph for a topic's type."""

    topic: str


Request = Advertise | Unadvertise | Publish | Subscribe | AskType


@dataclass(frozen=True, slots=True)
class TopicMessage:
    """Hold what came on a topic."""

    topic: str
    message: Message


@dataclass(frozen=True, slots=True)
class TopicType:
    """Hold the graph's answer about one topic: its type, empty where nobody has it."""

    topic: str
    kind: str
    """Several that disagree are joined by " and ", which is no type that anybody expects."""
    publishers: int | None = None
    """Ours left out; None where the transport can't tell."""


@dataclass(frozen=True, slots=True)
class NoAnswer:
    """Hold why the graph could not be asked about a topic."""

    topic: str
    reason: str


@dataclass(frozen=True, slots=True)
class UnreadableMessage:
    """Hold why bytes that came on a topic are no message of its type."""

    topic: str
    reason: str


@dataclass(frozen=True, slots=True)
class ServerWords:
    """Hold what the server says about an operation of ours."""

    level: str
    text: str


Answer = TopicMessage | TopicType | NoAnswer | UnreadableMessage | ServerWords


def plain_type(kind: str) -> str:
    """Return a type's name without the ``/msg/`` that some versions leave out."""
    return kind.replace("/msg/", "/")
