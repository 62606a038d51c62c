"""Be memory's one door for missions and API: everything in a thread, on the wall clock.

What the disk refuses is told by ``memory_unavailable``, and never ends a goal or the planner.
"""

from __future__ import annotations

import asyncio
import logging
import time
from dataclasses import replace
from typing import TYPE_CHECKING, Protocol, TypeVar

from planner.memory.fact_check import refuse_fact
from planner.memory.records import KINDS, THING, Memo, MemoryQuery

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Sequence

    from planner.memory.records import KeptPicture, ObjectSighting
    from planner.memory.store import MemoryStore

T = TypeVar("T")
log = logging.getLogger(__name__)

MOST_RELEVANT = 20
"""Memories that a brain is shown."""
MOST_WORDS = 120
"""Characters of an order by which they are chosen."""


class WorkRunner(Protocol):
    """Carry out what blocks on the disk, beside the event loop."""

    async def __call__(self, work: Callable[[], T], /) -> T:
        """Return the result of the work, or raise what it raises."""
        ...


async def _in_thread(work: Callable[[], T], /) -> T:
    return await asyncio.to_thread(work)


class Recollection:
    """Keep, find and forget what was seen and told."""

    def __init__(
        self,
        store: MemoryStore,
        *,
        wall: Callable[[], float] = time.time,
        run: WorkRunner = _in_thread,
    ) -> None:
        """Take the table; ``run`` carries its work out, beside the event loop."""
        self._store, self._wall, self._run = store, wall, run
        self._before: Callable[[], Awaitable[None]] | None = None
        self._forgot: list[Callable[[tuple[str, ...] | None], None]] = []
        self.changes = 0
        """Rises when a memory is taught or forgotten, and when something new was seen."""

    @property
    def limits_days(self) -> dict[str, float]:
        """Return how long each kind is kept [days]."""
        limits = self._store.limits
        return {
            "things": limits.things_days, "people": limits.people_days, "facts": limits.facts_days
        }  # fmt: skip

    def flush_by(self, flush: Callable[[], Awaitable[None]]) -> None:
        """Have what was seen a moment ago written before anything is looked up."""
        self._before = flush

    def listen(self, forgot: Callable[[tuple[str, ...] | None], None]) -> None:
        """Have something called with the ids of tracked things that are forgotten; None: all."""
        self._forgot.append(forgot)

    async def see(self, sightings: Sequence[ObjectSighting]) -> None:
        """Keep sightings; a disk that refuses is logged."""
        try:
            self.changes += await self._run(lambda: self._store.see(sightings))
        except OSError as error:
            log.warning("memory_unwritable: %s; what was seen is not kept", error.strerror)

    async def take_over(self, sightings: Sequence[ObjectSighting]) -> None:
        """Take in, once, what the objects table of an older version holds."""
        try:
            await self._run(lambda: self._store.see_once(sightings))
        except OSError as error:
            log.warning("memory_unwritable: %s; taken over at the next start", error.strerror)

    async def prune(self) -> None:
        """Forget what is older than the owner set."""
        try:
            await self._run(lambda: self._store.prune(self._wall()))
        except OSError as error:
            log.warning("memory_unwritable: %s; nothing old was removed", error.strerror)

    async def find(self, query: MemoryQuery) -> tuple[Memo, ...]:
        """Return what fits, the newest first.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        if self._before is not None:
            await self._before()
        return await self._do(lambda: self._store.find(query, self._wall()))

    async def find_relevant(self, queries: Sequence[MemoryQuery]) -> tuple[Memo, ...]:
        """Return a bounded list for a brain: what the order names first, then the newest.

        A memory that can't be read is none: a brain thinks without it.
        """
        try:
            if self._before is not None:
                await self._before()
            return await self._run(lambda: self._relevant(queries))
        except OSError as error:
            log.warning("memory_unreadable: %s", error.strerror)
            return ()

    def _relevant(self, queries: Sequence[MemoryQuery]) -> tuple[Memo, ...]:
        found: dict[int, Memo] = {}
        now_unix_s = self._wall()
        for query in (*queries, MemoryQuery()):
            cut = replace(query, words=query.words[:MOST_WORDS], limit=MOST_RELEVANT)
            for memo in self._store.find(cut, now_unix_s):
                found.setdefault(memo.id, memo)
        return tuple(found.values())[:MOST_RELEVANT]

    async def counts(self) -> dict[str, int]:
        """Return how many memories of each kind there are.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        return await self._do(self._store.counts)

    async def teach(
        self, text: str, *, said_by: str, room: str | None = None, map_id: str = ""
    ) -> Memo:
        """Keep a fact.

        Raises:
            FactRefusal: with its code.
        """
        now_unix_s = self._wall()
        kept = await self._do(
            lambda: self._store.teach(text, now_unix_s, said_by=said_by, room=room, map_id=map_id)
        )
        self.changes += 1
        return kept

    async def forget(self, memo_id: int) -> Memo | None:
        """Forget one memory; return it, or None where there is none of this id.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        gone = await self._do(lambda: self._store.forget([memo_id]))
        self._tell_memos(gone)
        return gone[0] if gone else None

    async def forget_about(self, words: str, kinds: tuple[str, ...] = KINDS) -> tuple[Memo, ...]:
        """Forget all that words name; return it.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        if self._before is not None:
            await self._before()
        gone = await self._do(lambda: self._store.forget_about(words, kinds))
        self._tell_memos(gone)
        return gone

    async def forget_all(self, kinds: tuple[str, ...] = KINDS) -> int:
        """Forget everything of these kinds; return how many memories there were.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        if self._before is not None:
            await self._before()
        gone = await self._do(lambda: self._store.forget_all(kinds))
        self.changes += 1
        if THING in kinds:
            self._tell(None)
        return gone

    async def forget_things(self, thing_ids: Sequence[str]) -> None:
        """Forget what was seen of things that the eyes were told to forget.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        if self._before is not None:
            await self._before()
        self.changes += len(await self._do(lambda: self._store.forget_things(thing_ids)))

    async def keep_picture(self, picture: KeptPicture, data: bytes) -> None:
        """Keep what a patrol saw at a stop; a disk that refuses is logged."""
        taken = replace(picture, taken_unix_s=self._wall())
        try:
            kept = await self._run(lambda: self._store.pictures.keep(taken, data))
        except OSError as error:
            log.warning("memory_unwritable: %s; a picture is not kept", error.strerror)
            return
        self.changes += kept

    async def list_pictures(self, goal: str | None = None) -> tuple[KeptPicture, ...]:
        """Return the pictures that are kept, of one goal or of all, the newest patrol first.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        return await self._do(lambda: self._store.pictures.list(self._wall(), goal))

    async def picture(self, picture_id: int) -> tuple[KeptPicture, bytes] | None:
        """Return one picture with its bytes, or None.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        return await self._do(lambda: self._store.pictures.get(picture_id, self._wall()))

    async def forget_picture(self, picture_id: int) -> bool:
        """Forget one picture; return whether there was one.

        Raises:
            FactRefusal: ``memory_unavailable``.
        """
        gone = await self._do(lambda: self._store.pictures.forget(picture_id))
        self.changes += gone
        return gone

    def _tell_memos(self, gone: tuple[Memo, ...]) -> None:
        if gone:
            self.changes += 1
            self._tell(tuple(memo.thing_id for memo in gone if memo.thing_id))

    def _tell(self, things: tuple[str, ...] | None) -> None:
        for told in self._forgot:
            told(things)

    async def _do(self, work: Callable[[], T]) -> T:
        try:
            return await self._run(work)
        except OSError as error:
            detail = f"{error.filename}: {error.strerror}"
            raise refuse_fact("memory_unavailable", detail) from None
