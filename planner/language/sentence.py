"""Hold a person's sentence, and what it says by itself, each thing found out once.

Whatever the robot does, a sentence says this alone: whether it orders a stop or may mean one,
whether it is a plain yes or no, whether it is a command to the planner, and its language. What that
comes to where things stand is for the readers to say (``planner.language.readers``). Pure.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from planner.language.changes.reader import read_rest
from planner.language.commands import (
    ForgetFacts,
    HereCommand,
    Intent,
    Replace,
    TeachFact,
    intent_of,
    read_statement,
)
from planner.language.commands import ResumeCommand as GoOn
from planner.language.folding import is_chinese
from planner.language.schedule import OrderCommand, can_lean
from planner.language.stop import StopReading, is_stop, read_stop, words_behind_stop
from planner.language.yes_no import consents
from planner.plan import Language

REMEMBERED = 64
"""Sentences that are kept: the door, the missions and the brain see one value each."""


@dataclass(frozen=True)
class SaidSentence:
    """Hold a sentence as it was said; what it says by itself is read when it is first asked for."""

    text: str

    @cached_property
    def language(self) -> Language:
        """Return Chinese where the text is Chinese (``folding.is_chinese``), else English."""
        return language_of(self.text)

    @cached_property
    def reading(self) -> StopReading:
        """Return what it says about stopping."""
        return read_stop(self.text)

    @cached_property
    def consent(self) -> bool | None:
        """Return True for a plain yes, False for a plain no, None for anything else."""
        return consents(self.text)

    @cached_property
    def intent(self) -> Intent | None:
        """Return the command to the planner itself, where it is one."""
        return intent_of(self.text)

    @cached_property
    def statement(self) -> TeachFact | None:
        """Return the fact that it tells flatly, ordering nothing."""
        return read_statement(self.text)

    @cached_property
    def _instead(self) -> str | None:
        """Return the part that is done after the current goal, or in its place."""
        if self.intent is None:
            return read_rest(self.text)
        return self.intent.rest if isinstance(self.intent, Replace) else None

    @cached_property
    def orders_stop(self) -> bool:
        """Return whether it orders a stop, at its start or in place of the current goal."""
        at_once = self.reading is StopReading.ORDER
        return at_once or (self._instead is not None and is_stop(self._instead))

    @property
    def behind_stop(self) -> str:
        """Return what is said behind a stop in the same breath; a command as a whole has none."""
        whole = not (self.intent is None or isinstance(self.intent, Replace))
        return "" if whole else words_behind_stop(self.text)

    @property
    def may_mean_stop(self) -> bool:
        """Return whether a stop word stands in it that is not read as anything else."""
        if self._instead is not None:
            return read_stop(self._instead) is not StopReading.NONE
        stays = isinstance(self.intent, TeachFact | ForgetFacts | OrderCommand)
        return (self.intent is None or stays) and self.reading is StopReading.POSSIBLE

    @property
    def stays_put(self) -> bool:
        """Return whether it can't lead to motion, so that it needs no operator's proof.

        "You are in the kitchen" is left to the brain where no place answers to the name.
        """
        if isinstance(self.intent, OrderCommand) and can_lean(self.intent):
            return self.orders_stop or self.consent is False
        memory_or_goals = not (
            self.intent is None or isinstance(self.intent, Replace | GoOn | HereCommand)
        )
        return self.orders_stop or memory_or_goals or self.consent is False


@lru_cache(maxsize=REMEMBERED)
def parse(text: str) -> SaidSentence:
    """Return a sentence; the newest are kept with what was found out about them."""
    return SaidSentence(text)


def language_of(text: str) -> Language:
    """Return Chinese where the text is Chinese (``folding.is_chinese``), else English."""
    return Language.ZH if is_chinese(text) else Language.EN
