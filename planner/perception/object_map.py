"""Hold the map of objects, tell it to listeners, count its changes, and bring it to the disk.

It is saved now and then, in a thread, never two at a time. Looks at nothing.
"""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

from planner.perception.frame_update import saw
from planner.perception.object_tracker import ObjectMemory, aged, forget, recall
from planner.perception.snapshot import Sight

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from planner.perception.frame_update import Scenery
    from planner.perception.interfaces import Picture
    from planner.perception.object_store import ThingStore
    from planner.perception.pose_buffer import Stance
    from planner.perception.snapshot import LookResult, LookSnapshot, Thing

    Things = tuple[Thing, ...]


class Changes:
    """Compare the things known before with those of now."""

    def __init__(self) -> None:
        self.version = 0
        """Rises when a thing comes, goes, or gets another colour or room."""
        self.changed_s: dict[str, float] = {}
        """When each thing was last seen or doubted."""

    def note(self, old: Things, new: Things, now_s: float) -> None:
        """Take the things known now in place of the former ones."""
        before = {thing.id: thing for thing in old}
        for thing in new:
            if before.get(thing.id) is not thing:
                self.changed_s[thing.id] = now_s
        if _marks(new) != _marks(old):
            self.version += 1
            self.changed_s = {thing.id: self.changed_s[thing.id] for thing in new}


def _marks(things: Things) -> set[tuple[str, str | None, str | None]]:
    return {(thing.id, thing.color, thing.room) for thing in things}


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


AGING_S = 0.5


class ObjectMap:
    """Hold the objects and build the sight anew when one of them has changed."""

    def __init__(self, scenery: Scenery, store: ThingStore | None, blind: str | None) -> None:
        """Begin with nothing; ``blind``: why nothing is seen now, if so."""
        self._scenery, self._keeper = scenery, Keeper(store)
        self._memory = ObjectMemory()
        self._look: LookSnapshot | None = None
        self._changes = Changes()
        self._listeners: list[Callable[[Sight], None]] = []
        self._aged_s = float("-inf")
        self.sight = Sight(blind=blind)
        """The newest look and all that is remembered."""

    @property
    def version(self) -> int:
        """Return a number that rises when a thing comes, goes, or gets another colour or room."""
        return self._changes.version

    @property
    def changed_s(self) -> Mapping[str, float]:
        """Return when each thing was last seen or doubted."""
        return self._changes.changed_s

    def listen(self, told: Callable[[Sight], None]) -> None:
        """Have something called with each new sight. It must be quick."""
        self._listeners.append(told)

    async def load(self, now_s: float) -> None:
        """Take up an earlier process's objects; they are told with the next sight."""
        self._memory = recall(await self._keeper.load(now_s), now_s)

    async def close(self, now_s: float) -> None:
        """Save the objects."""
        await self._keeper.close(self.sight.things, now_s)

    def mark_saved(self) -> None:
        """Mark the current objects as saved."""
        self._keeper.mark_saved(self.sight.things, self.version)

    def keep(self, now_s: float) -> None:
        """Bring it to the disk, where it is time."""
        self._keeper.keep(self.sight.things, self.version, now_s)

    def take(
        self,
        picture: Picture,
        result: LookResult,
        stance: Stance | None,
        passed_over: frozenset[str] = frozenset(),
    ) -> None:
        """Take in a look's findings, none of ``passed_over``; they are told with the next sight."""
        self._memory, self._look = saw(
            self._scenery, self._memory, picture, result.detections, stance, passed_over
        )

    def age(self, now_s: float) -> bool:
        """Forget the objects that time alone takes; return whether any went."""
        if now_s - self._aged_s < AGING_S:
            return False
        self._aged_s, before = now_s, self._memory
        self._memory = aged(before, now_s)
        return self._memory is not before

    def forget(self, thing_id: str | None) -> tuple[Thing, ...]:
        """Forget one thing, or all; return the forgotten ones."""
        before = self._memory
        self._memory = forget(before, thing_id)
        left = {thing.id for thing in self._memory.things}
        return tuple(thing for thing in before.things if thing.id not in left)

    def tell(self, blind: str | None, now_s: float) -> None:
        """Make the new sight, and tell it."""
        told_of, things = self.sight.things, self._memory.things
        things = told_of if things == told_of else things
        self._changes.note(told_of, things, now_s)
        self.sight = Sight(self._look, things, blind)
        for told in self._listeners:
            told(self.sight)
