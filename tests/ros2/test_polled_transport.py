"""A reader's bytes are a message, or are refused with their size before they are read."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any

from ros2.operations import Subscribe, UnreadableMessage
from ros2.polled_transport import PolledTransport
from ros2.transport import NOTHING_MADE, LinkMessages
from ros2.trouble import Ros2Trouble
from tests.ros2.test_connection import until
from wire.ros2_config import Ros2Config

MOST = 64


class Heard:
    """Hear what a transport says."""

    def __init__(self) -> None:
        self.said: list[Any] = []

    def open(self, now_s: float) -> None: ...

    def close(self, trouble: Ros2Trouble) -> None: ...

    def hear(self, said: object, _now_s: float) -> LinkMessages:
        self.said.append(said)
        return NOTHING_MADE


class Pile(PolledTransport):
    """Hand over what lies there."""

    pile: tuple[tuple[str, bytes], ...] = ()

    async def _join(self) -> None: ...

    def _leave(self) -> None: ...

    def _discover(self) -> None: ...

    def _take(self) -> Iterator[tuple[str, bytes]]:
        yield from self.pile
        self.pile = ()

    def _advertise(self, topic: str, kind: str) -> None: ...

    def _unadvertise(self, topic: str) -> None: ...

    def _subscribe(self, request: Subscribe) -> None: ...

    def _write(self, topic: str, payload: bytes) -> bool:
        return bool(topic and payload)


def test_a_message_longer_than_is_wanted_is_not_read() -> None:
    heard = Heard()
    made = Pile(Ros2Config(transport="dds"), heard, lambda _: None, MOST, 0.001)
    text = b"\x00\x01\x00\x00\x02\x00\x00\x00a\x00"

    async def play() -> None:
        serving = asyncio.create_task(made.serve())
        await until(made.has_room)
        assert await made.send(Subscribe("/a", "std_msgs/msg/String"))
        made.pile = (("/a", text), ("/a", bytes(MOST + 1)), ("/a", text[:5]))
        await until(lambda: len(heard.said) == 3)
        serving.cancel()

    asyncio.run(play())
    assert heard.said[0].message == {"data": "a"}
    assert heard.said[1] == UnreadableMessage(
        "/a", f"a message of {MOST + 1} bytes, expected at most {MOST}"
    )
    assert "end within" in heard.said[2].reason
