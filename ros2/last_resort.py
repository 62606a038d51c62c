"""Send zeros straight to cmd_vel while the relay is silent.

A relay that was killed leaves its last twist with the base, and a base without a dead-man of its
own goes on by it. Nothing but zeros ever goes this way, and nothing while the relay speaks: beside
another publisher it would refuse to be driven by.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2 import rosbridge
from ros2.graph import TWIST_STAMPED

if TYPE_CHECKING:
    from ros2.rosbridge import Message

EVERY_S = 0.1
_STILL = dict.fromkeys("xyz", 0.0)


class LastResort:
    """Remember whether zeros are being sent, on one connection."""

    def __init__(self, topic: str) -> None:
        self._topic = topic
        self._sent_s: float | None = None

    def begin(self) -> None:
        """Forget what was advertised: the connection is new."""
        self._sent_s = None

    def due(self, kind: str, now_s: float, *, silent: bool) -> list[str]:
        """Return the operations that are due.

        Args:
            kind: the type of cmd_vel as the graph said it; empty: nobody can be told.
            now_s: the time.
            silent: whether the relay was heard once and is no longer.
        """
        if not silent:
            ended, self._sent_s = self._sent_s is not None, None
            return [rosbridge.unadvertise(self._topic)] if ended else []
        if not kind or (self._sent_s is not None and now_s - self._sent_s < EVERY_S):
            return []
        frames = [] if self._sent_s is not None else [rosbridge.advertise(self._topic, kind)]
        self._sent_s = now_s
        return [*frames, rosbridge.publish(self._topic, _zeros(kind))]


def _zeros(kind: str) -> Message:
    """Return a twist of zeros; rosbridge itself writes the time into a header that has none."""
    twist: Message = {"linear": _STILL, "angular": _STILL}
    if rosbridge.plain_type(kind) == rosbridge.plain_type(TWIST_STAMPED):
        return {"header": {"frame_id": "base_link"}, "twist": twist}
    return twist
