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
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import sqlalchemy as sa

from planner.mission.effects import Journal
from planner.mission.errors import JournalDown
from planner.mission.journal import JournalContents, MissionJournal
from planner.mission.state import GoalKey

RETRY_S = 0.5


@dataclass(frozen=True, slots=True)
class PendingEntry:
    """Hold one entry to write, and the key of the request that caused it, if there was one."""

    entry: Journal
    key: GoalKey | None = None


class JournalWriter:
    """Own the thread. ``done`` and ``failed`` are called in it: hand them over to your loop."""

    def __init__(
        self,
        journal: MissionJournal,
        done: Callable[[int], None],
        failed: Callable[[str], None],
    ) -> None:
        self._journal = journal
        self._done = done
        self._failed = failed
        self._wanted: queue.SimpleQueue[PendingEntry | None] = queue.SimpleQueue()
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="journal", daemon=True)
        self._thread.start()

    def write(self, wanted: PendingEntry) -> None:
        """Have an entry written; returns at once."""
        self._wanted.put(wanted)

    def close(self) -> None:
        """Write what waits, then end. A disk that still refuses is not waited for."""
        self._closing.set()
        self._wanted.put(None)
        self._thread.join(timeout=5.0)
        if not self._thread.is_alive():
            self._journal.close()

    def _run(self) -> None:
        waiting: list[PendingEntry] = []
        while True:
            ending = self._take(waiting)
            if waiting and self._try(waiting):
                waiting.clear()
            elif waiting:
                ending = self._closing.wait(RETRY_S) or ending
            if ending and (not waiting or self._closing.is_set()):
                return

    def _take(self, waiting: list[PendingEntry]) -> bool:
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

    def _try(self, waiting: list[PendingEntry]) -> bool:
        entries = tuple(item.entry for item in waiting)
        keys = tuple(item.key for item in waiting if item.key is not None)
        try:
            self._journal.write(entries, keys)
        except sa.exc.SQLAlchemyError as error:
            self._failed(str(error).splitlines()[0][:200])
            return False
        self._done(entries[-1].entry)
        return True


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
        self._writer: JournalWriter | None = None
        self.trouble: str | None = "not started"

    async def open(self, on_safe: Callable[[int], None]) -> JournalContents:
        """Read the journal in a thread, and begin to write."""
        kept = await asyncio.to_thread(self._journal.load)
        self._loop, self._on_safe = asyncio.get_running_loop(), on_safe
        self.trouble = None
        self._writer = JournalWriter(self._journal, self._from_thread, self._failed_from_thread)
        return kept

    def write(self, entry: Journal, key: GoalKey | None = None) -> None:
        """Have an entry written; returns at once."""
        if self._writer is not None:
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
            if self._safe >= entry:  # both came in one turn of a late loop; its goal may move
                return
            raise JournalDown(self.trouble) from None

    async def close(self) -> None:
        """Write what waits and end the thread, without holding the loop."""
        if self._writer is not None:
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
