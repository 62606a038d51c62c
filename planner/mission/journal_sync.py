"""Join the event loop and the journal's thread: write without waiting, wait for what is safe."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable

from planner.mission.effects import Journal
from planner.mission.errors import JournalDown
from planner.mission.journal import GoalKey, MissionJournal
from planner.mission.journal_thread import JournalWriter, PendingEntry

log = logging.getLogger(__name__)

SAFE_WITHIN_S = 3.0


class JournalSync:
    """Own the writer; ``on_safe`` is called in the loop with each entry that is on disk."""

    def __init__(self, journal: MissionJournal, on_safe: Callable[[int], None]) -> None:
        self._loop = asyncio.get_running_loop()
        self._on_safe = on_safe
        self._safe = 0
        self._waiting: list[tuple[int, asyncio.Future[None]]] = []
        self.trouble: str | None = None
        self._writer = JournalWriter(journal, self._from_thread, self._failed_from_thread)

    def write(self, entry: Journal, key: GoalKey | None = None) -> None:
        """Have an entry written; returns at once."""
        self._writer.write(PendingEntry(entry, key))

    async def wait(self, entry: int) -> None:
        """Wait until an entry is on disk.

        Raises:
            JournalDown: it was not within 3 s.
        """
        if self._safe >= entry:
            return
        future: asyncio.Future[None] = self._loop.create_future()
        self._waiting.append((entry, future))
        try:
            async with asyncio.timeout(SAFE_WITHIN_S):
                await future
        except TimeoutError:
            raise JournalDown(self.trouble or "the disk is slow") from None

    async def close(self) -> None:
        """Write what waits and end the thread, without holding the loop."""
        await asyncio.to_thread(self._writer.close)

    def _from_thread(self, entry: int) -> None:
        self._loop.call_soon_threadsafe(self._note, entry)

    def _failed_from_thread(self, why: str) -> None:
        self._loop.call_soon_threadsafe(self._complain, why)

    def _note(self, entry: int) -> None:
        self._safe, self.trouble = entry, None
        for wanted, future in self._waiting:
            if wanted <= entry and not future.done():
                future.set_result(None)
        self._waiting = [(w, f) for w, f in self._waiting if not f.done()]
        self._on_safe(entry)

    def _complain(self, why: str) -> None:
        if self.trouble is None:
            log.error("the journal cannot be written: %s", why)
        self.trouble = why
