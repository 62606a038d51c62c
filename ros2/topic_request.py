"""Ask a ROS 2 graph for a few messages, over whichever transport robot.toml names, and leave.

For people's commands: a map that becomes a site, the frames that a lidar hangs in. The type of each
topic is asked first; what is missing, wrong or silent is told by the codes of ``ros2.trouble``.
"""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2.operations import (
    AskType,
    NoAnswer,
    Subscribe,
    TopicMessage,
    TopicType,
    UnreadableMessage,
    plain_type,
)
from ros2.transport import NOTHING_MADE
from ros2.transport_choice import open_transport
from ros2.trouble import STARTING, Ros2Trouble, TopicFailure

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ros2.operations import Answer, Message, Request
    from ros2.transport import LinkMessages
    from wire.ros2_config import Ros2Config

PERIOD_S = 0.01
ASK_S = 1.0
ANSWER_S = 4.0
SILENT = "ros2_topic_silent"
MOST_BYTES = 256 << 20
"""A map of 64 million cells as JSON."""


@dataclass(frozen=True, slots=True)
class WantedTopic:
    """Name a topic, the type that it must have, and whether its publisher keeps what it said."""

    topic: str
    kind: str
    keeps: bool = False
    every_ms: int = 0
    """At most one message in so long; 0: each."""


class TopicRequest:
    """Hear the answers of one transport until there are enough. Told the time; knows no socket."""

    def __init__(self, ros2: Ros2Config, wanted: Sequence[WantedTopic]) -> None:
        self._ros2, self._wanted = ros2, {one.topic: one for one in wanted}
        self._subscribed: set[str] = set()
        self._kinds: dict[str, str] = {}
        self._wrong: dict[str, Ros2Trouble] = {}
        self._closed: Ros2Trouble | None = Ros2Trouble(STARTING, f"{ros2.peer}: not reached yet")
        self._asked_s = float("-inf")
        self.messages: dict[str, list[Message]] = {topic: [] for topic in self._wanted}

    def open(self, now_s: float) -> None:
        """Begin anew."""
        self._closed, self._asked_s = None, float("-inf")
        for known in (self._subscribed, self._kinds, self._wrong):
            known.clear()

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now, and why."""
        self._closed = trouble

    def hear(self, said: Answer | None, _now_s: float) -> LinkMessages:
        """Take one answer; nothing of the wire comes of it."""
        if isinstance(said, TopicMessage) and said.topic in self._wanted:
            self.messages[said.topic].append(said.message)
        elif isinstance(said, TopicType | NoAnswer) and said.topic in self._wanted:
            self._judge(said)
        elif isinstance(said, UnreadableMessage):
            self._wrong[said.topic] = Ros2Trouble("ros2_unreadable", f"{said.topic}: {said.reason}")
        return NOTHING_MADE

    def due(self, now_s: float) -> list[Request]:
        """Return what is to be asked now."""
        if self._closed is not None:
            return []
        right = [topic for topic in self._kinds if topic not in self._wrong]
        wanted = [self._wanted[topic] for topic in right if topic not in self._subscribed]
        self._subscribed.update(right)
        requests: list[Request] = [
            Subscribe(one.topic, one.kind, one.every_ms, keeps=one.keeps) for one in wanted
        ]
        if now_s - self._asked_s >= ASK_S:
            self._asked_s = now_s
            requests += [AskType(topic) for topic in self._wanted if topic not in right]
        return requests

    def trouble(self) -> Ros2Trouble | None:
        """Return what keeps messages away, so far as is known."""
        if self._closed is not None:
            return self._closed
        for topic in self._wanted:
            if topic in self._wrong:
                return self._wrong[topic]
            if topic not in self._kinds:
                code = "ros2_no_rosapi" if self._ros2.transport == "rosbridge" else "ros2_no_peer"
                return Ros2Trouble(code, f"{self._ros2.peer}: nobody told the type of {topic}")
            if not self.messages[topic]:
                return Ros2Trouble(SILENT, f"{topic} said nothing")
        return None

    def kind_of(self, topic: str) -> str:
        """Return a topic's type as the graph told it; empty where it has none, or none was told."""
        return self._kinds.get(topic, "")

    def _judge(self, said: TopicType | NoAnswer) -> None:
        wanted = self._wanted[said.topic]
        self._wrong.pop(said.topic, None)
        if isinstance(said, NoAnswer):
            found = f"{self._ros2.peer}: type of {said.topic}: {said.reason}"
            self._wrong[said.topic] = Ros2Trouble("ros2_no_rosapi", found)
        elif not said.kind:
            found = f"the graph has no {said.topic}"
            self._wrong[said.topic] = Ros2Trouble("ros2_topic_missing", found)
        elif plain_type(said.kind) != plain_type(wanted.kind):
            found = f"{said.topic} is {said.kind}, expected {wanted.kind}"
            self._wrong[said.topic] = Ros2Trouble("ros2_topic_type", found)
        if not isinstance(said, NoAnswer):
            self._kinds[said.topic] = said.kind


async def collect(
    ros2: Ros2Config,
    wanted: Sequence[WantedTopic],
    is_enough: Callable[[dict[str, list[Message]]], bool],
    limit_s: float,
) -> dict[str, list[Message]]:
    """Return what each topic said until it was enough.

    Raises:
        TopicFailure: it was not enough within ``limit_s``; says why.
    """
    request = TopicRequest(ros2, wanted)
    transport = open_transport(ros2, request, lambda _: None, MOST_BYTES)
    serving = asyncio.create_task(transport.serve())
    began_s = time.monotonic()
    try:
        while not is_enough(request.messages):
            now_s = time.monotonic()
            trouble = request.trouble()
            is_late = now_s - began_s > limit_s
            if is_late or (now_s - began_s > ANSWER_S and trouble and trouble.code != SILENT):
                topics = ", ".join(request.messages)
                raise TopicFailure(trouble or Ros2Trouble(SILENT, f"{topics} said not enough"))
            if serving.done():
                serving.result()
            for one in request.due(now_s):
                await transport.send(one)
            await asyncio.sleep(PERIOD_S)
    finally:
        serving.cancel()
        await asyncio.gather(serving, return_exceptions=True)
    return request.messages
