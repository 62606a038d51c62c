"""Write the journal in one thread of its own, so that the event loop is never held by a disk.

Entries that pile up while the disk is busy are written together. An entry that can't be written is
never reported safe, so nothing that waits for it moves; the next write tries it again.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable
from dataclasses import dataclass

import sqlalchemy as sa

from planner.mission.effects import Journal
from planner.mission.journal import GoalKey, MissionJournal

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
