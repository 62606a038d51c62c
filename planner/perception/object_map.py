"""Hold the map of objects, tell it to listeners, and bring it to the disk. Looks at nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.perception.frame_update import saw
from planner.perception.object_saving import Keeper
from planner.perception.object_tracker import ObjectMemory, aged, forget, recall
from planner.perception.object_versions import Changes
from planner.perception.snapshot import Sight

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from planner.perception.frame_update import Scenery
    from planner.perception.interfaces import Picture
    from planner.perception.object_store import ThingStore
    from planner.perception.pose_buffer import Stance
    from planner.perception.result import LookResult
    from planner.perception.snapshot import LookSnapshot, Thing

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
