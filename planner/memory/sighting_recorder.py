"""Bring what the eyes see into memory: listens to sights, writes now and then, in a thread.

Law: only what was seen anew is written. What was forgotten comes back when it is seen again, and
not because it is still tracked; what an older program saw comes in once, with its old time.
"""

from __future__ import annotations

import asyncio
import logging
import time
from typing import TYPE_CHECKING

from planner.loops import keep_going
from planner.memory.records import ObjectSighting

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.memory.recollection import Recollection
    from planner.perception.snapshot import Sight, Thing

    Support = Callable[[Thing, tuple[Thing, ...]], str | None]

log = logging.getLogger(__name__)

PERIOD_S = 5.0
"""New things are on disk within this."""
AGES_S = 60.0
"""Times of things that stand where they stood are written so often: a card wears out."""
PRUNE_S = 3600.0
SURE, SIGHTINGS = 0.6, 2
"""As for what is told of: one picture may err, two that agree seldom do."""


class SightingRecorder:
    """Write what is seen while it runs."""

    def __init__(
        self,
        recollection: Recollection,
        map_id: str,
        *,
        support: Support,
        step: Callable[[], str],
        clock: Callable[[], float] = time.monotonic,
        wall: Callable[[], float] = time.time,
    ) -> None:
        """Take what it needs to know of the robot.

        Args:
            recollection: where it writes.
            map_id: of the map that points are on.
            support: names the class of what a thing stands on.
            step: names the kind of the step that is under way.
            clock: the sights' own [s].
            wall: the time of day [s].
        """
        self._recollection, self._map_id = recollection, map_id
        self._support, self._step = support, step
        self._clock, self._wall = clock, wall
        self._began_s = clock()
        self._things: tuple[Thing, ...] = ()
        self._written: dict[str, tuple[float, str | None]] = {}
        self._pending: dict[str, ObjectSighting] = {}
        self._urgent = False
        self._wrote_s = self._pruned_s = float("-inf")
        self._task: asyncio.Task[None] | None = None

    def take(self, sight: Sight) -> None:
        """Note what was seen anew. Quick: it is called with each look."""
        if sight.things is self._things:
            return
        self._things = sight.things
        offset_s = self._wall() - self._clock()
        for thing in sight.things:
            if not (thing.confidence >= SURE and thing.sightings >= SIGHTINGS):
                continue
            seen_s, room = self._written.get(thing.id, (self._began_s, None))
            if thing.seen_s > seen_s:
                new = thing.id not in self._written or room != thing.room
                self._urgent = self._urgent or new
                self._pending[thing.id] = self._sighting(thing, offset_s)
        tracked = {thing.id for thing in sight.things}
        self._written = {id_: kept for id_, kept in self._written.items() if id_ in tracked}

    def drop(self, thing_ids: tuple[str, ...] | None = None) -> None:
        """Forget what was seen of these things, or of all, and is not written yet."""
        now_s = self._clock()
        for thing in self._things:
            if thing_ids is None or thing.id in thing_ids:
                self._written[thing.id] = (now_s, thing.room)
                self._pending.pop(thing.id, None)

    async def start(self, before: tuple[Thing, ...] = ()) -> None:
        """Begin to write; ``before``: things that an older program remembered, taken in once."""
        offset_s = self._wall() - self._clock()
        await self._recollection.take_over([self._sighting(thing, offset_s) for thing in before])
        work = keep_going("remember sightings", self._run)
        self._task = asyncio.create_task(work, name="remember sightings")

    async def close(self) -> None:
        """Write the last of it."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        await self.flush()

    async def flush(self) -> None:
        """Write all that was seen anew."""
        pending, self._pending, self._urgent = self._pending, {}, False
        if not pending:
            return
        self._wrote_s = self._clock()
        offset_s = self._wall() - self._clock()
        for id_, seen in pending.items():
            self._written[id_] = (seen.seen_unix_s - offset_s, seen.room)
        await self._recollection.see(tuple(pending.values()))

    async def _run(self) -> None:
        while True:
            now_s = self._clock()
            if self._urgent or now_s - self._wrote_s >= AGES_S:
                await self.flush()
            if now_s - self._pruned_s >= PRUNE_S:
                self._pruned_s = now_s
                await self._recollection.prune()
            await asyncio.sleep(PERIOD_S)

    def _sighting(self, thing: Thing, offset_s: float) -> ObjectSighting:
        return ObjectSighting(
            label=thing.label,
            color=thing.color,
            map_id=self._map_id,
            room=thing.room,
            x_m=thing.x_m,
            y_m=thing.y_m,
            confidence=thing.confidence,
            seen_unix_s=thing.seen_s + offset_s,
            first_unix_s=max(thing.first_s, self._began_s) + offset_s
            if thing.seen_s > self._began_s
            else thing.first_s + offset_s,
            thing_id=thing.id,
            support=self._support(thing, self._things),
            step=self._step(),
        )
