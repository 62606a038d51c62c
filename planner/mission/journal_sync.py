"""Write the journal in one thread, and join that thread to the event loop.

The event loop is never held by a disk: an entry is handed over without waiting, and what must be
safe is waited for. Entries that pile up while the disk is busy are written together. An entry that
can't be written is never reported safe, so nothing that waits for it moves; the next write tries it
again. :class:`Disk` is what the mission loop asks of a disk; :class:`JournalSync` is the real one.
The lockstep harness has another, on its own clock.
"""

from __future__ import annotations

import asyncio
import logging
import queue
import sqlite3
import threading
from collections.abc import Callable
from typing import Protocol

from planner.mission.effects import Journal
from planner.mission.errors import JournalDown
from planner.mission.journal import JournalContents, MissionJournal
from planner.mission.state import GoalKey

RETRY_S = 0.5
_Pending = tuple[Journal, GoalKey | None]
"""An entry to write, and the key of the request that caused it, if there was one."""


log = logging.getLogger(__name__)

SAFE_WITHIN_S = 3.0


class Disk(Protocol):
    """Keep what the missions must not forget."""

    @property
    def trouble(self) -> str | None:
        """Return why nothing can be written, or None."""

    async def open(self, on_safe: Callable[[int], None]) -> JournalContents:
        """Return what was kept, and call ``on_safe`` from now on with each entry that is on disk.

        Raises:
            ConfigError: a record is not one of ours.
        """

    def write(self, entry: Journal, key: GoalKey | None = None) -> None:
        """Have an entry written, with the key of the request that caused it; returns at once."""

    async def wait(self, entry: int) -> None:
        """Wait until an entry is on disk.

        Raises:
            JournalDown: it was not within 3 s.
        """

    async def close(self) -> None:
        """Write what waits, and end."""


class JournalSync:
    """Be the disk of a real planner: a journal that one thread writes."""

    def __init__(self, journal: MissionJournal) -> None:
        self._journal = journal
        self._safe = 0
        self._waiting: list[tuple[int, asyncio.Future[None]]] = []
        self._wanted: queue.SimpleQueue[_Pending | None] = queue.SimpleQueue()
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        self.trouble: str | None = "not started"

    async def open(self, on_safe: Callable[[int], None]) -> JournalContents:
        """Read the journal in a thread, and begin to write."""
        kept = await asyncio.to_thread(self._journal.load)
        self._loop, self._on_safe = asyncio.get_running_loop(), on_safe
        self.trouble = None
        self._thread = threading.Thread(target=self._run, name="journal", daemon=True)
        self._thread.start()
        return kept

    def write(self, entry: Journal, key: GoalKey | None = None) -> None:
        """Have an entry written; returns at once."""
        self._wanted.put((entry, key))

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
            if self._safe >= entry:  # both came in one turn of a late loop; its goal may move
                return
            raise JournalDown(self.trouble) from None

    async def close(self) -> None:
        """Write what waits and end the thread, without holding the loop."""
        if self._thread is not None:
            await asyncio.to_thread(self._end, self._thread)

    def _end(self, thread: threading.Thread) -> None:
        """Write what waits, then end. A disk that still refuses is not waited for."""
        self._closing.set()
        self._wanted.put(None)
        thread.join(timeout=5.0)
        if not thread.is_alive():
            self._journal.close()

    # The thread ---------------------------------------------------------------------------------

    def _run(self) -> None:
        waiting: list[_Pending] = []
        while True:
            ending = self._take(waiting)
            if waiting and self._try(waiting):
                waiting.clear()
            elif waiting:
                ending = self._closing.wait(RETRY_S) or ending
            if ending and (not waiting or self._closing.is_set()):
                return

    def _take(self, waiting: list[_Pending]) -> bool:
        """Add all that waits; block only when there is nothing to do. Say whether to end."""
        try:
            item = self._wanted.get(block=not waiting)
            while True:
                if item is None:
                    return True
                waiting.append(item)
                item = self._wanted.get_nowait()
        except queue.Empty:
            return False

    def _try(self, waiting: list[_Pending]) -> bool:
        entries = tuple(entry for entry, _ in waiting)
        keys = tuple(key for _, key in waiting if key is not None)
        try:
            self._journal.write(entries, keys)
        except sqlite3.Error as error:
            self._loop.call_soon_threadsafe(self._complain, str(error)[:200])
            return False
        self._loop.call_soon_threadsafe(self._note, entries[-1].entry)
        return True

    # The event loop -----------------------------------------------------------------------------

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
