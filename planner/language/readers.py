"""Read a sentence: one ladder of readers, and the first that takes it says what it is.

===================  ==========================================================================
``stop``             an order to stop, or words that are taken for one while something moves
``answer``           a plain yes or no, where one question alone can be meant
``change``           what it makes of the order before: "again", "no, the study"
``clock_order``      a standing order, or a word about those that are kept
``command``          a word to the planner itself: pause, go on, where are you, remember that …
``idle_answer``      a yes or no though nothing was asked
``template``         the grammar: every word is accounted for, and it is done at once
``semantic_parser``  what the learned reader reads, which is only offered
``not_read``         nothing of these: told in one sentence, with its cure
===================  ==========================================================================

With a model set, the model stands in place of the last four and gets the words as they were said
(``planner.brain.fallback``). The ladder is climbed in three goes: the missions read at the door,
before the goal is written down; the planner's own commands once it is; then the brain. Behind a
reading the guard reads the words again, for it trusts no reader; so do memory for a question to it,
and the rest behind a stop. Each reader begins with its
gate, a test that costs little; what it may know besides the words it asks of where things stand.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, TypeVar

from planner.language.catalogue import say
from planner.language.commands import (
    ForgetFacts,
    HereCommand,
    OutcomeCommand,
    Replace,
    TeachFact,
)
from planner.language.grammar.context import Context
from planner.language.grammar.lexicon import lexicon_of
from planner.language.grammar.parser import plan
from planner.language.motion_guard.mentioned_names import find_places
from planner.language.reading import (
    AnswerReading,
    ChangeReading,
    CommandReading,
    HaltReading,
    OrdersReading,
    PlanReading,
)
from planner.language.schedule import OrderCommand
from planner.language.semantic_parser.offer import UNREAD, offer_plan
from planner.language.sentence import SaidSentence
from planner.plan import (
    AnswerPlan,
    Clarify,
    Plan,
    Refuse,
    StepPlan,
    Vocabulary,
)


class GoalsAtHand(Protocol):
    """Say what stands at the door besides a sentence: questions, the order before, motion."""

    def asked_by(self, said: SaidSentence) -> tuple[str, ...]:
        """Return the goals whose question a sentence may answer; none unless it may."""
        ...

    def change_of(self, said: SaidSentence) -> ChangeReading | None:
        """Return what a sentence makes of the orders before it; None: nothing, or in doubt."""
        ...

    def may_stop(self, said: SaidSentence) -> bool:
        """Return whether words that may mean a stop are to be taken for one now."""
        ...


class PlannerWords(Protocol):
    """Say what the planner knows of a goal whose words are read: its question, facts, places."""

    @property
    def open_order(self) -> OrderCommand | None:
        """Return what was said about standing orders, where the words answer its question."""
        ...

    def correct_fact(self, said: SaidSentence) -> TeachFact | None:
        """Return the fact that the words put in place of an older one."""
        ...

    def tell_fact(self, said: SaidSentence) -> TeachFact | None:
        """Return the fact that the words tell flatly, where nothing was asked."""
        ...

    def is_place(self, name: str) -> bool:
        """Return whether a place answers to a name."""
        ...

    @property
    def has_outcome(self) -> bool:
        """Return whether anything was done before that could be told."""
        ...


@dataclass(frozen=True)
class OrderWords:
    """Hold an order that the built-in brain reads, with what it reads it against."""

    said: SaidSentence
    vocabulary: Vocabulary
    context: Context
    is_answer: bool = False
    """The words answer a question about the order."""

    @cached_property
    def exact(self) -> Plan:
        """Return what the grammar makes of the words."""
        return plan(self.said.text, self.vocabulary, self.context)


def stop(said: SaidSentence, goals: GoalsAtHand) -> HaltReading | None:
    """Take an order to stop; and what may be one, unless it answers a question."""
    if said.orders_stop:
        return HaltReading(said.behind_stop)
    halts = not goals.asked_by(said) and goals.may_stop(said)
    return HaltReading(is_doubtful=True) if halts else None


def answer(said: SaidSentence, goals: GoalsAtHand) -> AnswerReading | None:
    """Take a plain yes or no that a question waits for."""
    asking = goals.asked_by(said)
    return AnswerReading(asking) if asking else None


def change(said: SaidSentence, goals: GoalsAtHand) -> ChangeReading | None:
    """Take what leans on the orders before; the newest that was read so goes on as steps."""
    return goals.change_of(said)


def clock_order(said: SaidSentence, words: PlannerWords) -> OrdersReading | None:
    """Take a standing order, a word about one, or the answer to the question about one."""
    command = said.intent if isinstance(said.intent, OrderCommand) else words.open_order
    return None if command is None else OrdersReading(command)


def command(said: SaidSentence, words: PlannerWords) -> CommandReading | None:
    """Take a word to the planner itself. A fact goes before what else the words could be."""
    intent = None if isinstance(said.intent, OrderCommand) else said.intent
    if intent is None or isinstance(intent, Replace | HereCommand):
        intent = words.correct_fact(said) or intent
    match intent:
        case HereCommand(name) if not words.is_place(name):
            intent = None  # "you are in the way": nothing of ours
        case ForgetFacts(about) if words.is_place(about):
            intent = None  # "forget about the kitchen": a drive may be meant
        case OutcomeCommand() if not words.has_outcome:
            intent = None  # nothing was done before: a brain reads "how many?"
    intent = intent or words.tell_fact(said)
    return None if intent is None else CommandReading(intent)


_MOVES = re.compile(r"\b(?:go|do|drive|come|move|start)\b|[去来走回到开]", re.IGNORECASE)
"""With these a yes is an order, too: "go there"."""


def idle_answer(said: SaidSentence, order: OrderWords) -> PlanReading | None:
    """Take a mere yes or no, though nothing was asked."""
    idle = said.consent is not None and not order.is_answer and not _MOVES.search(said.text)
    if not idle or isinstance(order.exact, StepPlan | AnswerPlan):
        return None
    return PlanReading(AnswerPlan(text=say("talk.nothing_asked")))


def template(said: SaidSentence, order: OrderWords) -> PlanReading | None:
    """Take what the grammar reads word for word, and what it refuses or asks about."""
    del said
    made = order.exact
    lost = isinstance(made, Clarify | Refuse) and made.code in UNREAD
    return None if lost else PlanReading(made)


def semantic_parser(said: SaidSentence, order: OrderWords) -> PlanReading | None:
    """Take what the learned reader reads: a plan that is offered, or a question to memory.

    What it returns waits for a yes.
    """
    told, language = order.exact, order.context.language or said.language
    made = offer_plan(told, said.text, order.vocabulary, language, order.context)
    return None if made is None else PlanReading(made)


def not_read(said: SaidSentence, order: OrderWords) -> PlanReading:
    """Say why nobody has read a sentence, with the cure; offer what of it was read."""
    del said
    return PlanReading(order.exact)


_Where = TypeVar("_Where")
_Read = TypeVar("_Read")
_Readers = tuple[Callable[[SaidSentence, _Where], _Read | None], ...]

AT_THE_DOOR: _Readers[GoalsAtHand, HaltReading | AnswerReading | ChangeReading]
AT_THE_DOOR = (stop, answer, change)
BY_THE_PLANNER: _Readers[PlannerWords, OrdersReading | CommandReading]
BY_THE_PLANNER = (clock_order, command)
BUILT_IN: _Readers[OrderWords, PlanReading]
BUILT_IN = (idle_answer, template, semantic_parser, not_read)
READERS = (*AT_THE_DOOR, *BY_THE_PLANNER, *BUILT_IN)
READERS_WITH_MODEL = (*AT_THE_DOOR, *BY_THE_PLANNER)
"""A model behind them reads what none of these takes."""


def learn_names(names: Vocabulary) -> None:
    """Prepare the names of a site, so that no sentence waits for it; once a site."""
    lexicon_of(names)
    find_places("", names)


def readings(
    said: SaidSentence, where: _Where, readers: _Readers[_Where, _Read]
) -> Iterator[_Read]:
    """Yield what each reader takes a sentence for: who declines the first gets the next."""
    for reader in readers:
        reading = reader(said, where)
        if reading is not None:
            yield reading


def read_order(order: OrderWords) -> PlanReading:
    """Return what the built-in brain makes of an order, by the first of its readers."""
    return next(readings(order.said, order, BUILT_IN))
