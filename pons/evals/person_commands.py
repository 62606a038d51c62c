"""Carry out what a scripted person says to the planner itself, by the planner's own reading.

Standing orders and facts are kept in no store: that they are read is what a conversation shows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.brain.situation import RememberedItem
from planner.language.commands import ForgetFacts, Intent, TeachFact, name_subject
from planner.language.recall import read_recall
from planner.language.schedule import ScheduleCommand, can_lean
from planner.memory.index_terms import read_terms
from planner.mission.events import Planned
from planner.mission.planner_commands import PlannerCommands
from planner.plan import AnswerPlan, Bilingual, Clarify, Code, Refuse, say_same
from planner.site.known_places import KnownPlaces

if TYPE_CHECKING:
    from planner.language.schedule import ChangeOrders, OrderCommand
    from planner.mission.effects import AskBrain
    from planner.mission.goal_book import GoalBook
    from planner.mission.state import Mission
    from planner.mission.tasks import Think
    from planner.plan import Language, StepRecord, Vocabulary
    from planner.site.site import Site

_KEPT = say_same("So it is kept. 记住了。")


class PersonCommands(PlannerCommands):
    """Stand before a brain as the planner does, with memory for one conversation."""

    def __init__(self, think: Think, site: Site, loop: GoalBook) -> None:
        """Take the brain behind it, the site, and where the goals stand."""
        super().__init__(think, KnownPlaces(site), loop, _NoLocalizer())
        self.desk = OrderDouble()
        self.facts: list[str] = []

    async def carry_out(self, intent: Intent, mission: Mission) -> AnswerPlan | Refuse:
        """Do it and say how it went."""
        if isinstance(intent, TeachFact):
            old = intent.instead_of
            self.facts = [f for f in self.facts if not old or name_subject(f) != old]
            self.facts.append(intent.words)
            return AnswerPlan(text=_KEPT)
        if isinstance(intent, ForgetFacts):
            self.facts = [each for each in self.facts if not _shares_terms(each, intent.about)]
            return AnswerPlan(text=_KEPT)
        return await super().carry_out(intent, mission)

    async def remember(self, ask: AskBrain, vocabulary: Vocabulary) -> tuple[RememberedItem, ...]:
        """Return the facts that were told."""
        question = read_recall(ask.text, vocabulary, ask.room)
        named = (question.step.object if question is not None else None) or ask.text
        return tuple(
            RememberedItem(what=each, said=True, fits=_shares_terms(each, named))
            for each in self.facts
        )


def _shares_terms(fact: str, words: str) -> bool:
    kept, asked = read_terms(fact), read_terms(words)
    return not {*kept.words, *kept.kinds}.isdisjoint({*asked.words, *asked.kinds})


class OrderDouble:
    """Take every standing order whose time is read; keep none."""

    def __init__(self) -> None:
        self._has_order = False

    async def take(self, command: OrderCommand, ask: AskBrain, given: Mission) -> Planned | None:
        del given
        if can_lean(command) and not self._has_order:
            return None
        self._has_order |= isinstance(command, ScheduleCommand)
        read = not isinstance(command, ScheduleCommand) or command.problem is None
        made = AnswerPlan(text=_KEPT) if read else Clarify(code=Code.INCOMPLETE, question=_KEPT)
        return Planned(ask.id, made)

    async def change(self, command: ChangeOrders, language: Language) -> Bilingual | None:
        del command, language
        return _KEPT

    def allowed_steps(self, source: str) -> tuple[StepRecord, ...] | None:
        del source
        return None

    def sentence_of(self, source: str) -> tuple[str, str | None]:
        del source
        return "", None

    def refuse_offer(self, text: str) -> Bilingual | None:
        del text
        return None


class _NoLocalizer:
    """Take no hint."""

    localizer = None

    async def hint(self, hint: object) -> None:
        del hint
