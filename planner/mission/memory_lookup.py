"""Answer from memory and from the goals before, choose what a brain is shown of it, keep facts.

Laws: nothing that a model wrote or read comes out of here: sightings are figures, facts a person's
words, and of a goal for which a picture was read its state alone is told (ADR 0023). Only a
person's own words are kept.
"""

from __future__ import annotations

import logging
from datetime import datetime
from math import hypot
from typing import TYPE_CHECKING, Protocol

from planner.brain.situation import RememberedItem
from planner.language import commands
from planner.language.catalogue import message, say
from planner.language.motion_guard.mentioned_names import places_named
from planner.language.object_names import name_object
from planner.language.recall import read_recall
from planner.language.sentence import parse
from planner.memory import FACT, KINDS, PERSON, THING, FactRefusal, Memo, MemoryQuery, Recollection
from planner.mission.events import Command, Recalled
from planner.mission.recall_text import bounds_of, find_deeds, tell_deeds, tell_memos
from planner.plan import AnswerPlan, Code, GoalState, Refuse, Vocabulary, say_same
from planner.skills.viewpoints import room_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.language.commands import Intent
    from planner.mission.effects import AskBrain, AskMemory
    from planner.mission.errors import MissionError
    from planner.mission.loop import Loop
    from planner.mission.state import GivenOrder, Mission, MissionState
    from planner.site.known_places import KnownPlaces


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
            what = say("memory.asked", what=ask.label) if ask.label else say("memory.anything")
            code = Code.NOT_REMEMBERED
            return Recalled(ask.id, ask.ticket, code, message(code, what=what))
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
            place=room_of(self._loop.book.facts, ask.place) or ask.place,
            since_unix_s=since_unix_s,
            until_unix_s=until_unix_s,
            kinds=kinds,
            limit=60,
        )

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
    running = book.running_goal
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


SPOKEN_BY = "sentence"
MOST_FACTS = 20
"""Older facts about one thing that are looked through."""


class GoalBook(Protocol):
    """Tell where all goals stand, and obey commands about them, as the loop does."""

    @property
    def book(self) -> MissionState: ...

    @property
    def status_age_s(self) -> float: ...

    def obey(self, command: Command) -> MissionError | None:
        """Obey a command at once, or return why it can't be obeyed."""


class FactCommands:
    """Carry out "remember that …" and "forget what I said about …"."""

    def __init__(self, lookup: MemoryLookup | None, places: KnownPlaces, loop: GoalBook) -> None:
        self._lookup, self._places, self._loop = lookup, places, loop

    def read_correction(self, given: Mission, intent: Intent | None) -> commands.TeachFact | None:
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
            told = fact.words if isinstance(fact, commands.TeachFact) else None
        if isinstance(intent, commands.Replace | commands.HereCommand) and told is None:
            return None
        return commands.read_fact_correction(given.text, told)

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

    async def carry_out(
        self, intent: commands.TeachFact | commands.ForgetFacts
    ) -> AnswerPlan | Refuse:
        """Do it and say how it went."""
        recollection = self._lookup.recollection if self._lookup is not None else None
        if recollection is None:
            return Refuse(code=Code.MEMORY_UNAVAILABLE, reason=message(Code.MEMORY_UNAVAILABLE))
        try:
            if isinstance(intent, commands.TeachFact):
                return await self._teach(recollection, intent)
            return await self._forget(recollection, intent)
        except FactRefusal as refused:
            return Refuse(code=Code.NOT_KEPT, reason=message(Code.NOT_KEPT, why=refused.said))

    async def _teach(self, recollection: Recollection, intent: commands.TeachFact) -> AnswerPlan:
        named = set(places_named(intent.words, self._places.vocabulary))
        facts, pose = self._loop.book.facts, self._loop.book.pose
        room = facts.room_at(pose.x_m, pose.y_m) if intent.here and pose is not None else None
        if room is None and len(named) == 1:
            room = named.pop()
        kept = await recollection.teach(
            intent.words, said_by=SPOKEN_BY, room=room, map_id=self._places.site.map_id
        )
        gone = await self._forget_older(recollection, intent.instead_of, kept)
        if gone:
            return AnswerPlan(text=say("memory.kept_instead", words=kept.words, old=gone[0].words))
        if intent.here and room is not None:
            where = facts.targets[room].name
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
        older = tuple(
            m for m in found if m.id != kept.id and commands.name_subject(m.words) == thing
        )
        for memo in older:
            await recollection.forget(memo.id)
        return older

    async def _forget(self, recollection: Recollection, intent: commands.ForgetFacts) -> AnswerPlan:
        kinds = ((FACT,) if intent.told else ()) + ((THING, PERSON) if intent.seen else ())
        if not intent.about:
            count = await recollection.forget_all(kinds)
            return AnswerPlan(text=say("memory.forgot_all", count=count))
        gone = await recollection.forget_about(intent.about, kinds)
        about = say_same(intent.about)
        if not gone:
            return AnswerPlan(text=say("memory.nothing_about", about=about))
        return AnswerPlan(text=say("memory.forgot", about=about, count=len(gone)))
