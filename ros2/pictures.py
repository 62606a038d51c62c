"""Follow a robot's pictures, for the camera's process, with a connection of its own.

No picture passes where wheels are driven. The newest alone is kept. The one door of this package
for sensors (.importlinter, docs/adr/0055).
"""

from __future__ import annotations

import time
from dataclasses import dataclass

from devices.clock import SensorClock
from ros2.robot_link import MOST_PICTURE_BYTES, RobotLink
from ros2.robot_words import PictureHead, Unreadable, read_words
from ros2.trouble import Ros2Trouble, TopicFailure, known_code

__all__ = ["PictureHead", "RosPicture", "RosPictureStream", "TopicFailure"]

PERIOD_S = 0.005
CLOCK_S = 0.5
"""Pictures that come in a burst are dated by the least delayed of so long. Not longer: a simulation
that runs at half speed would make them look old."""
PAIR_S = 0.1
"""So far apart may a picture and its depth be taken."""


@dataclass(frozen=True, slots=True)
class RosPicture:
    """Hold a picture, the depth that belongs to it, and when it came, on our clock."""

    head: PictureHead
    data: bytes
    at_s: float
    """Never later than its arrival; earlier where it was held up on its way."""
    depth: tuple[PictureHead, bytes] | None = None


class RosPictureListener:
    """Read pictures as they came, and date them. Told the time; knows no socket."""

    def __init__(self, peer: str) -> None:
        """Begin with nothing heard."""
        self._peer = peer
        self._clock, self._stamp_s = SensorClock(CLOCK_S), float("-inf")
        self._depth: tuple[PictureHead, bytes] | None = None
        self._wrong = Ros2Trouble("ros2_topic_silent", f"{peer} said no picture")

    def hear(self, head: bytes, data: bytes, now_s: float) -> RosPicture | None:
        """Take what came as a picture; None where it is none."""
        read = self._read(head, data)
        if read is None:
            return None
        depth, stamp_s = self._depth, read.stamp_s
        if depth is not None and abs((depth[0].stamp_s or 0.0) - (stamp_s or 0.0)) > PAIR_S:
            depth = None
        return RosPicture(read, data, self._date(stamp_s, now_s), depth)

    def hear_depth(self, head: bytes, data: bytes) -> None:
        """Take what came as depth."""
        read = self._read(head, data)
        if read is not None:
            self._depth = read, data

    def trouble(self, *, joined: bool) -> Ros2Trouble:
        """Return what keeps pictures away, so far as is known."""
        if not joined:
            return Ros2Trouble("ros2_no_node", f"nobody answers at {self._peer}")
        return self._wrong

    def _read(self, head: bytes, data: bytes) -> PictureHead | None:
        try:
            read = read_words(PictureHead, head)
        except Unreadable as why:
            self._wrong = Ros2Trouble("ros2_unreadable", f"{self._peer}: {why}")
            return None
        if read.code is not None or not data:
            code = known_code(read.code or "ros2_unreadable")
            self._wrong = Ros2Trouble(code, read.found or f"{self._peer}: an empty picture")
            return None
        return read

    def _date(self, stamp_s: float | None, now_s: float) -> float:
        """Return when a picture came, less what it was later than those just before it."""
        if not stamp_s:  # 0: its driver writes none
            return now_s
        if not stamp_s > self._stamp_s:  # a clock that stands or was set back
            self._clock.reset()
        self._stamp_s = stamp_s
        return max(0.0, self._clock.note(stamp_s, now_s))


class RosPictureStream:
    """Hear a robot's pictures until it is closed; the robot sends them while somebody hears."""

    def __init__(self, locator: str) -> None:
        """Begin to dial."""
        self._listener = RosPictureListener(locator)
        self._link = RobotLink(locator, ("picture", "depth"), MOST_PICTURE_BYTES)

    def take(self, limit_s: float) -> RosPicture:
        """Wait for the newest picture and return it, each once.

        Raises:
            TopicFailure: none came within ``limit_s``; says why.
        """
        end_s = time.monotonic() + limit_s
        while True:
            now_s = time.monotonic()
            for head, data in self._link.take_headed("depth"):
                self._listener.hear_depth(head, data)
            for head, data in self._link.take_headed("picture"):
                picture = self._listener.hear(head, data, now_s)
                if picture is not None:
                    return picture
            if now_s >= end_s:
                raise TopicFailure(self._listener.trouble(joined=self._link.is_joined))
            time.sleep(PERIOD_S)

    def close(self) -> None:
        """Leave."""
        self._link.close()
