"""Say what each way to a ROS 2 robot must do, and what it makes for the wire."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from ros2.ros_base import NOTHING_MADE, LinkMessages

if TYPE_CHECKING:
    from ros2.operations import Answer, Request
    from ros2.trouble import Ros2Trouble

__all__ = ["NOTHING_MADE", "GraphListener", "LinkMessages", "Transport"]

MOST_BYTES = 1 << 20
"""A scan of 4 000 beams has 80 kB as JSON; a server that sends more sends something else."""
PERIOD_S = 0.001
"""So often are the readers of DDS and zenoh asked, where a wheel waits for what they read."""


class GraphListener(Protocol):
    """Hear what a transport does: a base's link, or whoever asks for one topic."""

    def open(self, now_s: float) -> None:
        """Begin anew on a connection that was just made."""

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now, and why."""

    def hear(self, said: Answer | None, now_s: float) -> LinkMessages:
        """Take one answer; return what it makes."""


class Transport(Protocol):
    """Carry requests to a ROS 2 graph, and its answers back. Waits for nobody."""

    async def serve(self) -> None:
        """Reach the graph and hear it for as long as the process lives."""

    def has_room(self) -> bool:
        """Return whether what is sent now leaves now."""

    async def send(self, request: Request) -> bool:
        """Carry out a request; False where there is no connection."""

    async def drop_if_silent(self, now_s: float) -> None:
        """End a connection at whose other end nobody is left."""
