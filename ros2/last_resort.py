"""Send zeros straight to cmd_vel while the relay is silent.

A relay that was killed leaves its last twist with the base, and a base without a dead-man of its
own goes on by it. Nothing but zeros ever goes this way, and nothing while the relay speaks: beside
another publisher it would refuse to be driven by.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2.graph import TWIST_STAMPED
from ros2.operations import Advertise, Publish, Unadvertise, plain_type

if TYPE_CHECKING:
    from ros2.operations import Message, Request

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

    def due(self, kind: str, now_s: float, *, silent: bool) -> list[Request]:
        """Return the operations that are due.

        Args:
            kind: the type of cmd_vel as the graph said it; empty: nobody can be told.
            now_s: the time.
            silent: whether the relay was heard once and is no longer.
        """
        if not silent:
            ended, self._sent_s = self._sent_s is not None, None
            return [Unadvertise(self._topic)] if ended else []
        if not kind or (self._sent_s is not None and now_s - self._sent_s < EVERY_S):
            return []
        first: list[Request] = [] if self._sent_s is not None else [Advertise(self._topic, kind)]
        self._sent_s = now_s
        return [*first, Publish(self._topic, _zeros(kind))]


def _zeros(kind: str) -> Message:
    """Return a twist of zeros; rosbridge writes the time into a header that has none, others 0."""
    twist: Message = {"linear": _STILL, "angular": _STILL}
    if plain_type(kind) == plain_type(TWIST_STAMPED):
        return {"header": {"frame_id": "base_link"}, "twist": twist}
    return twist
