"""Read what a smart home sends: a topic's last word and bytes become an order or a refusal.

Pure. Knows no socket and no planner. Whatever may mean stop is a stop; a message that an earlier
time left behind (retained) is never another order.
"""

from __future__ import annotations

import json
from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from planner.language.stop import StopReading, read_stop

if TYPE_CHECKING:
    from collections.abc import Iterable

COMMAND, SENTENCE, SEGMENTS, STOP = "command", "sentence", "segments", "stop"
TOPICS = (STOP, COMMAND, SENTENCE, SEGMENTS)
"""The last words of the topics on which orders come."""
MAX_BYTES = 2_000
MAX_ROOMS = 20
"""As many as one patrol takes."""
SETTLE_S = 0.3
"""So long an order waits for others that came with it; a stop waits for nothing."""
MOST_AT_ONCE = 3
"""A person's hand gives no more within ``SETTLE_S``: what does was kept back by a broker."""
QUIET_S = 3.0
"""After such a burst nothing is obeyed until it has been quiet for so long."""

Kind = Literal["stop", "start", "pause", "home", "locate", "sentence", "rooms"]
_COMMANDS: dict[str, Kind] = {
    "stop": "stop", "start": "start", "pause": "pause", "return_to_base": "home",
    "locate": "locate",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class HomeOrder:
    """Hold one order of a smart home."""

    kind: Kind
    text: str = ""
    rooms: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class MessageRefusal:
    """Hold why a message is no order: a stable code, and what came."""

    code: str
    detail: str


def read_order(
    topic: str, payload: bytes, *, retained: bool, rooms: Iterable[str]
) -> HomeOrder | MessageRefusal:
    """Return what a message asks for.

    Args:
        topic: the last word of its topic.
        payload: as it came; anything at all on the topic of the stop is a stop.
        retained: whether the broker keeps it for those who come later.
        rooms: the ids of the rooms that are known.
    """
    if topic == STOP:
        return HomeOrder("stop")
    text = _text(payload)
    if text is None:
        return MessageRefusal("mqtt_unreadable", f"{len(payload)} bytes on {topic}, no short UTF-8")
    order = _order(topic, text, frozenset(rooms))
    if retained and isinstance(order, HomeOrder) and order.kind != "stop":
        return MessageRefusal("mqtt_retained", f"{topic} came retained; send it without retain")
    return order


def _text(payload: bytes) -> str | None:
    try:
        text = payload.decode("utf-8").strip() if len(payload) <= MAX_BYTES else ""
    except UnicodeDecodeError:
        return None
    return text if text and text.isprintable() else None


def _order(topic: str, text: str, rooms: frozenset[str]) -> HomeOrder | MessageRefusal:
    if topic == COMMAND:
        kind = _COMMANDS.get(text)
        if kind is not None:
            return HomeOrder(kind)
        known = ", ".join(_COMMANDS)
        return MessageRefusal("mqtt_unknown_command", f"{text[:80]!r}; known: {known}")
    if topic == SEGMENTS:
        return _rooms(text, rooms)
    return _sentence(text)


def _rooms(text: str, rooms: frozenset[str]) -> HomeOrder | MessageRefusal:
    given = _json(text)
    if not isinstance(given, list) or not 1 <= len(given) <= MAX_ROOMS:
        detail = f"expected a JSON list of 1 to {MAX_ROOMS} room ids, got {text[:80]!r}"
        return MessageRefusal("mqtt_bad_rooms", detail)
    strange = [str(one)[:40] for one in given if not isinstance(one, str) or one not in rooms]
    if strange:
        known = ", ".join(sorted(rooms))
        return MessageRefusal("mqtt_unknown_room", f"{', '.join(strange)}; known: {known}")
    return HomeOrder("rooms", rooms=tuple(dict.fromkeys(given)))


def _sentence(text: str) -> HomeOrder | MessageRefusal:
    """Return a sentence; Home Assistant sends ``{"command": …}`` where parameters come with it."""
    if text.startswith("{"):
        given = _json(text)
        said = given.get("command") if isinstance(given, dict) and len(given) == 1 else None
        if not isinstance(said, str) or not said.strip():
            detail = f'expected a sentence or {{"command": sentence}}, got {text[:80]!r}'
            return MessageRefusal("mqtt_bad_sentence", detail)
        text = said.strip()
    if read_stop(text) is StopReading.ORDER:
        return HomeOrder("stop")
    return HomeOrder("sentence", text=text)


def _json(text: str) -> object:
    try:
        found: object = json.loads(text)
    except (ValueError, RecursionError):
        return None
    return found


@dataclass(slots=True)
class OrderGate:
    """Let an order through once it is clear that it came alone, and none of a burst.

    A broker that was cut off may hand over an hour of orders at once. None of them is wanted any
    more, and which was the last can't be told from the first. Told the time; reads no clock.
    """

    _waiting: deque[tuple[float, HomeOrder]] = field(default_factory=deque)
    _deaf_until_s: float = float("-inf")
    dropped: int = 0
    """Orders of bursts, of all time."""

    def offer(self, order: HomeOrder, now_s: float) -> bool:
        """Take an order that would move the robot; return whether it may still be obeyed."""
        if now_s < self._deaf_until_s:
            self._deaf_until_s = now_s + QUIET_S
            self.dropped += 1
            return False
        self._waiting.append((now_s, order))
        if len(self._waiting) <= MOST_AT_ONCE:
            return True
        self.dropped += len(self._waiting)
        self._waiting.clear()
        self._deaf_until_s = now_s + QUIET_S
        return False

    def forget(self) -> None:
        """Drop what waits: a stop came after it."""
        self._waiting.clear()

    def due(self, now_s: float) -> list[HomeOrder]:
        """Return the orders that have waited long enough, oldest first."""
        found = []
        while self._waiting and now_s - self._waiting[0][0] >= SETTLE_S:
            found.append(self._waiting.popleft()[1])
        return found
