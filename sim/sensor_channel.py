"""Pass one sensor's messages on, or drop, repeat, spoil or delay them when it is broken.

Knows no sensor: what a message's payload is, and how garbage of it looks, is given. Counts ticks;
owns no clock.
"""

from __future__ import annotations

from collections import deque
from enum import StrEnum
from typing import TYPE_CHECKING, Generic, TypeVar

from wire.base import Record

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

M = TypeVar("M", bound=Record)

DELAY_TICKS = 30
OPEN_TICKS = SHUT_TICKS = 40


class Trouble(StrEnum):
    """Name the troubles of a sensor."""

    OFF = "off"
    STUCK = "stuck"
    GARBAGE = "garbage"
    DELAYED = "delayed"
    INTERMITTENT = "intermittent"


class Channel(Generic[M]):
    """Pass one key's messages, one call per tick."""

    def __init__(self, payload: tuple[str, ...], garbage: Callable[[M], dict[str, Any]]) -> None:
        """Set the sensor's measuring function.

        Args:
            payload: the fields that hold what was measured; a stuck sensor repeats these.
            garbage: makes other values for them, inside what the wire can carry.
        """
        self._payload, self._garbage = payload, garbage
        self._stuck: dict[str, Any] | None = None
        self._late: deque[tuple[int, M]] = deque()
        self._tick = 0

    def through(self, message: M | None, troubles: frozenset[Trouble]) -> M | None:
        """Take this tick's message, if one was due; return the one that arrives now, if any."""
        self._tick += 1
        if not (troubles or self._late):  # nearly always: a channel is asked every tick
            self._stuck = None
            return message
        if Trouble.STUCK not in troubles:
            self._stuck = None
        if message is not None:
            message = self._spoil(message, troubles)
        if Trouble.DELAYED in troubles or self._late:
            message = self._delay(message, wait=Trouble.DELAYED in troubles)
        shut = self._tick % (OPEN_TICKS + SHUT_TICKS) >= OPEN_TICKS
        lost = Trouble.OFF in troubles or (Trouble.INTERMITTENT in troubles and shut)
        return None if lost else message

    def _spoil(self, message: M, troubles: frozenset[Trouble]) -> M:
        if Trouble.STUCK in troubles:
            if self._stuck is None:
                self._stuck = {name: getattr(message, name) for name in self._payload}
            return message.model_copy(update=self._stuck)
        if Trouble.GARBAGE in troubles:
            return message.model_copy(update=self._garbage(message))
        return message

    def _delay(self, message: M | None, *, wait: bool) -> M | None:
        """Queue a message; return one that has waited long enough, or the newest when mended."""
        if message is not None:
            self._late.append((self._tick + DELAY_TICKS, message))
        if not wait:
            _, newest = self._late.pop()
            self._late.clear()
            return newest
        if self._late and self._late[0][0] <= self._tick:
            return self._late.popleft()[1]
        return None
