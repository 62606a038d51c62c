"""Prepare what would hold up the mission loop: how words are read, and the spots of rooms.

A detector says what it knows when it is ready, long after the start. To read words in class names
of its own takes patterns that cost tens of milliseconds, more than the event loop may be held up
for (docs/adr/0026): a thread makes them, and until they are there its classes count as not known.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from planner.language.changes.reader import read_changes
from planner.language.object_names import prepare
from planner.language.sentence import parse
from planner.mission.reducer import looks, looks_widely
from planner.skills.viewpoints import near_spot, spots_in

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from planner.mission.state import MissionState
    from planner.perception.interfaces import Eyes
    from planner.site.site_view import SiteView


class Wording:
    """Make the newest classes readable, beside the loop."""

    def __init__(
        self,
        ready: tuple[str, ...],
        spawn: Callable[[Coroutine[Any, Any, None]], None],
        told: Callable[[], None],
    ) -> None:
        """Begin with classes that are readable already.

        Args:
            ready: those.
            spawn: runs something beside, and keeps hold of it.
            told: called when others have become readable.
        """
        self._ready = self._newest = ready
        self._spawn, self._told = spawn, told

    def of(self, classes: tuple[str, ...]) -> tuple[str, ...]:
        """Return these classes, or none while they are not readable yet."""
        if classes == self._ready:
            return classes
        if classes != self._newest:
            self._newest = classes
            self._spawn(self._prepare(classes))
        return ()

    async def _prepare(self, classes: tuple[str, ...]) -> None:
        await asyncio.to_thread(prepare, classes)
        self._ready = classes
        self._told()


class EyeNeeds:
    """Have the eyes look at their full rate while a step needs them, and widely where it does."""

    def __init__(self) -> None:
        """Begin with nobody who needs them."""
        self._told = (False, False)

    def tell(self, book: MissionState, eyes: Eyes | None) -> None:
        """Tell the eyes what is needed of them now, where that has changed."""
        if eyes is None:
            return
        needs = looks(book), looks_widely(book, eyes.open_classes)
        if needs != self._told:
            self._told = needs
            eyes.attend("mission", needs[0], wide=needs[1])


def warm_up(facts: SiteView, classes: tuple[str, ...] = ()) -> None:
    """Work out the spots of every room, and how to read words: in these classes, and in all.

    From where rooms are looked through follows from their outlines alone and is kept once known.
    Over a home of seven rooms it took 52 ms of a processor in one reduction, more than the event
    loop may take (docs/adr/0026); the patterns by which words are read as things took 54 ms.
    The rows of changes and the site's names took 98 ms with the first short sentence, at the door.
    Takes long: call it off the event loop.
    """
    read_changes(parse("go there").text, facts.names)
    prepare(())
    prepare(classes)
    for target in facts.targets.values():
        if target.room:
            spots_in(target)
            near_spot(target)
