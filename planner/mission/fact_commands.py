"""Keep and forget what a person says in so many words. Only a person's own words come here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import message, say
from planner.language.commands import (
    ForgetFacts,
    HereCommand,
    Replace,
    TeachFact,
    name_subject,
    read_fact_correction,
)
from planner.language.motion_guard.mentioned_names import places_named
from planner.language.sentence import parse
from planner.memory import FACT, PERSON, THING, FactRefusal, MemoryQuery
from planner.mission.outcomes import spot_at
from planner.plan import AnswerPlan, Code, GoalState, Refuse, say_same

if TYPE_CHECKING:
    from planner.language.commands import Intent
    from planner.memory import Memo, Recollection
    from planner.mission.goal_book import GoalBook
    from planner.mission.memory_lookup import MemoryLookup
    from planner.mission.state import GivenOrder, Mission
    from planner.site.known_places import KnownPlaces

SPOKEN_BY = "sentence"
MOST_FACTS = 20
"""Older facts about one thing that are looked through."""


class FactCommands:
    """Carry out "remember that …" and "forget what I said about …"."""

    def __init__(self, lookup: MemoryLookup | None, places: KnownPlaces, loop: GoalBook) -> None:
        self._lookup, self._places, self._loop = lookup, places, loop

    def read_correction(self, given: Mission, intent: Intent | None) -> TeachFact | None:
        """Return the fact that a sentence puts in place of an older one; None where it does not.

        Args:
            given: the goal that it is.
            intent: its reading by itself: what takes an order back may correct a fact as well.
        """
        before = self._said_before(given)
        told = None
        if before is not None and before.state is GoalState.SUCCEEDED and not before.steps:
            said = parse(before.text)
            fact = said.intent or said.statement
            told = fact.words if isinstance(fact, TeachFact) else None
        if isinstance(intent, Replace | HereCommand) and told is None:
            return None
        return read_fact_correction(given.text, told)

    def answers_question(self, given: Mission) -> bool:
        """Tell whether something that was said just before is still asked about."""
        before = self._said_before(given)
        if before is None:
            return False
        asked = before.plan is not None and before.plan.code == Code.INCOMPLETE.value
        open_ = before.state in (GoalState.NEEDS_CLARIFICATION, GoalState.CANCELLED)
        return asked and open_

    def _said_before(self, given: GivenOrder) -> Mission | None:
        others = (m for m in self._loop.book.missions.values() if m.order < given.order)
        return max(others, key=lambda m: m.order, default=None)

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
        gone = await self._forget_older(recollection, intent.instead_of, kept)
        if gone:
            return AnswerPlan(text=say("memory.kept_instead", words=kept.words, old=gone[0].words))
        if intent.here and room is not None:
            where = self._loop.book.facts.targets[room].name
            return AnswerPlan(text=say("memory.kept_here", words=kept.words, room=where))
        return AnswerPlan(text=say("memory.kept", words=kept.words))

    async def _forget_older(
        self, recollection: Recollection, thing: str, kept: Memo
    ) -> tuple[Memo, ...]:
        """Forget the older facts of where this very thing is; return them, the newest first."""
        if not thing:
            return ()
        query = MemoryQuery(words=thing, kinds=(FACT,), limit=MOST_FACTS)
        found = await recollection.find(query)
        older = tuple(m for m in found if m.id != kept.id and name_subject(m.words) == thing)
        for memo in older:
            await recollection.forget(memo.id)
        return older

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
