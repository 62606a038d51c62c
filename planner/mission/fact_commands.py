"""Keep and forget what a person says in so many words. Only a person's own words come here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import message, say
from planner.language.commands import ForgetFacts, TeachFact
from planner.language.motion_guard.mentioned_names import places_named
from planner.memory import FACT, PERSON, THING, FactRefusal
from planner.mission.outcomes import spot_at
from planner.plan import AnswerPlan, Code, Refuse, say_same

if TYPE_CHECKING:
    from planner.memory import Recollection
    from planner.mission.goal_book import GoalBook
    from planner.mission.memory_lookup import MemoryLookup
    from planner.site.known_places import KnownPlaces

SPOKEN_BY = "sentence"


class FactCommands:
    """Carry out "remember that …" and "forget what I said about …"."""

    def __init__(self, lookup: MemoryLookup | None, places: KnownPlaces, loop: GoalBook) -> None:
        self._lookup, self._places, self._loop = lookup, places, loop

    async def carry_out(self, intent: TeachFact | ForgetFacts) -> AnswerPlan | Refuse:
        """Do it and say how it went."""
        recollection = self._lookup.recollection if self._lookup is not None else None
        if recollection is None:
            return Refuse(code=Code.MEMORY_UNAVAILABLE, reason=message(Code.MEMORY_UNAVAILABLE))
        try:
            if isinstance(intent, TeachFact):
                return await self._teach(recollection, intent)
            return await self._forget(recollection, intent)
        except FactRefusal as refused:
            return Refuse(code=Code.NOT_KEPT, reason=message(Code.NOT_KEPT, why=refused.said))

    async def _teach(self, recollection: Recollection, intent: TeachFact) -> AnswerPlan:
        named = set(places_named(intent.words, self._places.vocabulary))
        room = self._find_room() if intent.here else None
        if room is None and len(named) == 1:
            room = named.pop()
        kept = await recollection.teach(
            intent.words, said_by=SPOKEN_BY, room=room, map_id=self._places.site.map_id
        )
        if intent.here and room is not None:
            where = self._loop.book.facts.targets[room].name
            return AnswerPlan(text=say("memory.kept_here", words=kept.words, room=where))
        return AnswerPlan(text=say("memory.kept", words=kept.words))

    def _find_room(self) -> str | None:
        """Return the room that the robot is in."""
        status = self._loop.book.status
        pose = status.base_in_map if status is not None else None
        return spot_at(self._loop.book.facts, pose).room if pose is not None else None

    async def _forget(self, recollection: Recollection, intent: ForgetFacts) -> AnswerPlan:
        kinds = ((FACT,) if intent.told else ()) + ((THING, PERSON) if intent.seen else ())
        if not intent.about:
            count = await recollection.forget_all(kinds)
            return AnswerPlan(text=say("memory.forgot_all", count=count))
        gone = await recollection.forget_about(intent.about, kinds)
        about = say_same(intent.about)
        if not gone:
            return AnswerPlan(text=say("memory.nothing_about", about=about))
        return AnswerPlan(text=say("memory.forgot", about=about, count=len(gone)))
