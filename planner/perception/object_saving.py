"""Save the objects now and then, in a thread, never two at a time."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.perception.object_store import ThingStore
    from planner.perception.snapshot import Thing

log = logging.getLogger(__name__)

NEW_S = 5.0
"""At most so often, where a thing is new or gone."""
AGES_S = 120.0
"""And so often for positions and ages alone: a card wears out by writing."""


class Keeper:
    """Write when it is due; without a store, do nothing."""

    def __init__(self, store: ThingStore | None) -> None:
        self._store = store
        self._task: asyncio.Task[bool] | None = None
        self._saved_s = float("-inf")
        self._version = 0
        self._things: tuple[Thing, ...] = ()

    async def load(self, now_s: float) -> tuple[Thing, ...]:
        """Return the objects that an earlier process remembered."""
        if self._store is None:
            return ()
        return await asyncio.to_thread(self._store.load, now_s)

    def mark_saved(self, things: tuple[Thing, ...], version: int) -> None:
        """Note the objects that the disk holds."""
        self._things, self._version = things, version

    def keep(self, things: tuple[Thing, ...], version: int, now_s: float) -> None:
        """Write these if they are worth it and it is time."""
        wait_s = NEW_S if version != self._version else AGES_S
        due = now_s - self._saved_s >= wait_s and things is not self._things
        if self._store is None or self._task is not None or not due:
            return
        self._saved_s = now_s
        self.mark_saved(things, version)
        write = asyncio.to_thread(self._store.save, things, now_s)
        self._task = asyncio.get_running_loop().create_task(write, name="keep things")
        self._task.add_done_callback(self._note_end)

    async def close(self, things: tuple[Thing, ...], now_s: float) -> None:
        """Write the last of it."""
        if self._task is not None:
            await asyncio.wait({self._task})
        if self._store is not None and things is not self._things:
            await asyncio.to_thread(self._store.save, things, now_s)

    def _note_end(self, task: asyncio.Task[bool]) -> None:
        self._task = None
        if not task.cancelled() and (error := task.exception()) is not None:
            log.error("what was seen could not be kept", exc_info=error)
