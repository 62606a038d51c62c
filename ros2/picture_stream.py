"""Follow a topic of packed pictures on a thread of its own, and hold the newest alone.

For the camera's process, with a connection of its own: no picture passes where wheels are driven.
The one door of this package for sensors (.importlinter, docs/adr/0055).
"""

from __future__ import annotations

import asyncio
import threading
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from devices.clock import SensorClock
from ros2.compressed_image import (
    COMPRESSED_IMAGE,
    MOST_MESSAGE_BYTES,
    RAW_IMAGE,
    CompressedPicture,
    read_compressed_image,
)
from ros2.operations import AskType, TopicMessage, UnreadableMessage, plain_type
from ros2.topic_request import SILENT, TopicRequest, WantedTopic
from ros2.transport import NOTHING_MADE
from ros2.transport_choice import open_transport
from ros2.trouble import Ros2Trouble, TopicFailure

if TYPE_CHECKING:
    from collections.abc import Callable

    from ros2.operations import Answer, Request
    from ros2.transport import LinkMessages
    from wire.ros2_config import Ros2Config

__all__ = [
    "CompressedPicture",
    "PictureListener",
    "PictureStream",
    "StreamedPicture",
    "TopicFailure",
]

PERIOD_S = 0.005
"""Five times as long as where a wheel waits; a picture takes longer to be unpacked."""
ASK_S = 2.0
"""A topic that says nothing is asked about so often: whether it is still there."""
CLOCK_S = 0.5
"""Pictures that come in a burst are dated by the least delayed of so long. Not longer: a simulation
that runs at half speed would make them look old."""
END_S = 4.0
"""A dial that hangs ends by the transport's own limits."""


@dataclass(frozen=True, slots=True)
class StreamedPicture:
    """Hold a packed picture and when it came, on our clock."""

    packed: CompressedPicture
    at_s: float
    """Never later than its arrival; earlier where it was held up on its way."""


class PictureListener:
    """Hear one topic of pictures. Told the time; knows no socket and no thread."""

    def __init__(self, ros2: Ros2Config, topic: str, every_ms: int = 0) -> None:
        """Want a topic; of its pictures at most one in ``every_ms``."""
        self._topic = topic
        self._request = TopicRequest(
            ros2, [WantedTopic(topic, COMPRESSED_IMAGE, every_ms=every_ms)]
        )
        self._clock = SensorClock(CLOCK_S)
        self._stamp_s = self._heard_s = self._asked_s = float("-inf")
        self._refusal: Ros2Trouble | None = None
        """Why the newest message was no picture."""
        self.newest: StreamedPicture | None = None

    def open(self, now_s: float) -> None:
        """Begin anew on a connection that was just made."""
        self._request.open(now_s)
        self._clock.reset()
        self._stamp_s, self._asked_s = float("-inf"), now_s

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now, and why."""
        self._request.close(trouble)
        if trouble.code == "ros2_message_too_large":
            self._refusal = trouble  # dialled anew, it would come again

    def hear(self, said: Answer | None, now_s: float) -> LinkMessages:
        """Take one answer; nothing of the wire comes of it."""
        if isinstance(said, TopicMessage) and said.topic == self._topic:
            self._heard_s = now_s
            self._note(said, now_s)
        elif isinstance(said, UnreadableMessage):
            self._heard_s = now_s
            self._refusal = Ros2Trouble("ros2_unreadable", f"{self._topic}: {said.reason}")
        else:
            self._request.hear(said, now_s)
        return NOTHING_MADE

    def due(self, now_s: float) -> list[Request]:
        """Return what is to be asked now."""
        requests = self._request.due(now_s)
        if not requests and now_s - max(self._heard_s, self._asked_s) >= ASK_S:
            self._asked_s = now_s
            requests.append(AskType(self._topic))
        return requests

    def trouble(self) -> Ros2Trouble:
        """Return what keeps pictures away, so far as is known."""
        wrong = self._request.trouble() or Ros2Trouble(SILENT, f"{self._topic} said nothing")
        if wrong.code == "ros2_topic_type":
            kind = self._request.kind_of(self._topic)
            if plain_type(kind) == plain_type(RAW_IMAGE):
                return Ros2Trouble("ros2_image_raw", wrong.found)
        elif self._refusal is not None:
            return self._refusal
        return wrong

    def _note(self, said: TopicMessage, now_s: float) -> None:
        try:
            packed = read_compressed_image(said.message, self._topic)
        except TopicFailure as why:
            self._refusal = why.trouble
            return
        self._refusal = None
        self.newest = StreamedPicture(packed, self._date(packed.stamp_s, now_s))

    def _date(self, stamp_s: float | None, now_s: float) -> float:
        """Return when a picture came, less what it was later than those just before it."""
        if stamp_s is None:
            return now_s
        if not stamp_s > self._stamp_s:  # a clock that stands or was set back
            self._clock.reset()
        self._stamp_s = stamp_s
        return max(0.0, self._clock.note(stamp_s, now_s))


class PictureStream:
    """Keep one topic subscribed until it is closed."""

    def __init__(self, ros2: Ros2Config, topic: str, every_ms: int = 0) -> None:
        """Begin to reach it; see ``PictureListener``."""
        self._ros2, self._listener = ros2, PictureListener(ros2, topic, every_ms)
        self._came = threading.Condition()
        self._ending = threading.Event()
        self._fault: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="ros2-pictures", daemon=True)
        self._thread.start()

    def take(self, limit_s: float) -> StreamedPicture:
        """Wait for the newest picture and return it, each once.

        Raises:
            TopicFailure: none came within ``limit_s``; says why.
        """
        listener = self._listener
        with self._came:
            self._came.wait_for(lambda: listener.newest or self._fault, max(0.0, limit_s))
            newest, listener.newest = listener.newest, None
        if self._fault is not None:
            raise self._fault
        if newest is None:
            raise TopicFailure(listener.trouble())
        return newest

    def close(self) -> None:
        """Leave the graph."""
        self._ending.set()
        self._thread.join(END_S)

    def _run(self) -> None:
        try:
            asyncio.run(self._serve(time.monotonic))
        except Exception as fault:  # noqa: BLE001  # raised anew by whoever takes
            self._fault = fault
            self._tell()

    async def _serve(self, clock: Callable[[], float]) -> None:
        transport = open_transport(
            self._ros2, self._listener, lambda _: self._tell(), MOST_MESSAGE_BYTES, PERIOD_S
        )
        serving = asyncio.create_task(transport.serve())
        try:
            while not self._ending.is_set():
                if serving.done():
                    serving.result()
                now_s = clock()
                for request in self._listener.due(now_s):
                    await transport.send(request)
                await transport.drop_if_silent(now_s)
                await asyncio.sleep(PERIOD_S)
        finally:
            serving.cancel()
            await asyncio.gather(serving, return_exceptions=True)

    def _tell(self) -> None:
        with self._came:
            self._came.notify_all()
