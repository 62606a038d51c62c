"""Tell every listener what changed, in order, without waiting for any of them.

Each listener has a bounded queue; one that falls behind gets a marker ``{"type": "gap"}`` in place
of what it missed, and should ask for a snapshot.
"""

from __future__ import annotations

import asyncio
from collections import deque
from typing import Any, Protocol

MAX_WAITING = 256

Message = tuple[int, dict[str, Any]]


class HubListener(Protocol):
    """Take events one by one, at once and without waiting."""

    def offer(self, message: Message) -> None:
        """Take the newest event."""

    def close(self) -> None:
        """Hear no more."""


class Subscription:
    """Iterate over (seq, event). Close it, or use it in ``async with``."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self._waiting: deque[Message] = deque()
        self._news = asyncio.Event()
        self._closed = False

    def __aiter__(self) -> Subscription:
        return self

    async def __anext__(self) -> Message:
        while not self._waiting:
            if self._closed:
                raise StopAsyncIteration
            self._news.clear()
            await self._news.wait()
        return self._waiting.popleft()

    async def __aenter__(self) -> Subscription:
        return self

    async def __aexit__(self, *exc: object) -> None:
        self.close()

    def close(self) -> None:
        """Hear no more; a waiting iterator ends."""
        self._closed = True
        self._hub.forget(self)
        self._news.set()

    def offer(self, message: Message) -> None:
        """Queue a message, or replace all that waits by one marker."""
        if len(self._waiting) >= MAX_WAITING:
            missed = len(self._waiting)
            self._waiting.clear()
            self._waiting.append((message[0], {"type": "gap", "missed": missed}))
        self._waiting.append(message)
        self._news.set()


class Hub:
    """Number the events and hand them to all who listen."""

    def __init__(self) -> None:
        self.seq = 0
        self._listeners: set[HubListener] = set()

    def subscribe(self) -> Subscription:
        """Listen from now on."""
        subscription = Subscription(self)
        self.join(subscription)
        return subscription

    def join(self, listener: HubListener) -> None:
        """Tell a listener from now on, the very moment that something is published."""
        self._listeners.add(listener)

    def forget(self, listener: HubListener) -> None:
        """Stop telling one listener."""
        self._listeners.discard(listener)

    def publish(self, event: dict[str, Any]) -> None:
        """Tell everyone."""
        self.seq += 1
        for listener in tuple(self._listeners):
            listener.offer((self.seq, event))

    def close(self) -> None:
        """Let every listener go."""
        for listener in tuple(self._listeners):
            listener.close()
