"""Answer from memory and from the goals before, and choose what a brain is shown of it.

Law: nothing that a model wrote or read comes out of here: sightings are figures, facts a person's
words, and of a goal for which a picture was read its state alone is told (ADR 0023).
"""

from __future__ import annotations

import logging
from datetime import datetime
from math import hypot
from typing import TYPE_CHECKING

from planner.brain.situation import RememberedItem
from planner.language.catalogue import message
from planner.language.motion_guard.mentioned_names import places_named
from planner.language.object_names import name_object
from planner.language.recall import read_recall
from planner.memory import FACT, KINDS, PERSON, THING, FactRefusal, MemoryQuery
from planner.mission.deeds import bounds_of, find_deeds, tell_deeds
from planner.mission.events import Recalled
from planner.mission.outcomes import spot_at
from planner.mission.recall_text import tell_memos
from planner.mission.tasks import recall_nothing
from planner.plan import Code

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.memory import Memo, Recollection
    from planner.mission.effects import AskBrain, AskMemory
    from planner.mission.loop import Loop
    from planner.mission.state import MissionState
    from planner.plan import Vocabulary

log = logging.getLogger(__name__)

AT_PLACE_M = 1.6
"""What lies so near to where one stands at a place is at that place."""
MOST_SHOWN = 80
"""Characters of a fact that a brain is shown."""
_MARKS = str.maketrans(dict.fromkeys("<>{}[]`\\|", " "))


class MemoryLookup:
    """Ask memory for the missions."""

    def __init__(self, loop: Loop, wall: Callable[[], float]) -> None:
        self._loop, self._wall = loop, wall
        self.recollection: Recollection | None = None
        """Where it looks; None: nothing is remembered."""

    def remember_by(self, recollection: Recollection) -> None:
        """Look there from now on, and keep the pictures of patrols there."""
        self.recollection = recollection
        self._loop.door.keep_in(recollection.keep_picture)

    async def answer(self, ask: AskMemory) -> Recalled:
        """Return what is remembered, in words."""
        now = datetime.fromtimestamp(self._wall()).astimezone()
        book = self._loop.book
        if ask.deeds:
            deeds = find_deeds(book, ask.id, bounds_of(ask.when, now), ask.place)
            code = Code.RECALLED if deeds else Code.NOT_REMEMBERED
            place = book.facts.targets[ask.place].name if ask.place in book.facts.targets else None
            return Recalled(ask.id, ask.ticket, code, tell_deeds(deeds, ask.when, now, place))
        if self.recollection is None:
            return await recall_nothing(ask)
        try:
            found = await self.recollection.find(self._query(ask, now))
        except FactRefusal as refused:
            log.warning("goal %s: %s", ask.id, refused)
            code = Code.MEMORY_UNAVAILABLE
            return Recalled(ask.id, ask.ticket, code, message(code))
        there = tuple(memo for memo in found if self._is_at(memo, ask.place))
        named = not ask.label or any(memo.fits for memo in there)
        code = Code.RECALLED if there and named else Code.NOT_REMEMBERED
        return Recalled(ask.id, ask.ticket, code, tell_memos(book.facts, there, ask, now))

    def _query(self, ask: AskMemory, now: datetime) -> MemoryQuery:
        since_unix_s, until_unix_s = bounds_of(ask.when, now)
        kinds: tuple[str, ...] = KINDS
        if ask.label == PERSON:
            kinds = (PERSON,)
        elif ask.witnessed or (ask.label is None and (ask.place or ask.when)):
            kinds = (THING, PERSON)
        return MemoryQuery(
            words=ask.label or "",
            place=self._room_of(ask.place),
            since_unix_s=since_unix_s,
            until_unix_s=until_unix_s,
            kinds=kinds,
            limit=60,
        )

    def _room_of(self, place: str | None) -> str | None:
        """Return the room in which a place is; a room is its own."""
        target = self._loop.book.facts.targets.get(place or "")
        if target is None or target.room:
            return place
        return spot_at(self._loop.book.facts, target.pose).room or place

    def _is_at(self, memo: Memo, place: str | None) -> bool:
        """Tell whether a memory is of a place that is no room."""
        target = self._loop.book.facts.targets.get(place or "")
        if target is None or target.room or memo.kind == FACT:
            return True
        if memo.x_m is None or memo.y_m is None:
            return False
        return hypot(memo.x_m - target.pose.x_m, memo.y_m - target.pose.y_m) <= AT_PLACE_M

    async def find_relevant(
        self, ask: AskBrain, vocabulary: Vocabulary
    ) -> tuple[RememberedItem, ...]:
        """Return what a brain is shown: what the order names first, then the newest."""
        if self.recollection is None or ask.situation is None:
            return ()
        words = ask.order or ask.text
        question = read_recall(words, vocabulary, ask.room)
        named = question.step.object if question is not None else None
        places = dict.fromkeys(places_named(words, vocabulary))
        queries = [MemoryQuery(words=named or words)]
        queries += [MemoryQuery(place=place, limit=5) for place in tuple(places)[:3]]
        found = await self.recollection.find_relevant(queries)
        now_unix_s = self._wall()
        return tuple(_item(memo, now_unix_s) for memo in found)


def step_kind(book: MissionState) -> str:
    """Return the kind of the step that is under way; empty where none is."""
    running = book.missions.get(book.running or "")
    step = running.current_step if running is not None else None
    return step.kind if step is not None else ""


def _item(memo: Memo, now_unix_s: float) -> RememberedItem:
    said = memo.kind == FACT
    shown = memo.words.translate(_MARKS) if said else name_object(memo.label, memo.color).en
    return RememberedItem(
        what=" ".join(shown.split())[:MOST_SHOWN],
        place=memo.room,
        minutes=max(0, int((now_unix_s - memo.last_unix_s) / 60.0)),
        said=said,
        fits=memo.fits,
    )
