"""Read a person's sentence once, at the door, into one value that is handed down.

Whatever the robot does, a sentence says this by itself: whether it orders a stop or may mean one,
whether it is a plain yes or no, whether it is a command to the planner, and its language. What is
none of these is an order for a brain. Pure.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from planner.language.changes.rows import read_rest
from planner.language.commands import (
    ForgetFacts,
    HereCommand,
    Intent,
    Replace,
    TeachFact,
    intent_of,
)
from planner.language.commands import ResumeCommand as GoOn
from planner.language.folding import is_chinese
from planner.language.schedule import OrderCommand, can_lean
from planner.language.stop import StopReading, is_stop, read_stop, words_behind_stop
from planner.language.yes_no import consents
from planner.plan import Language

REMEMBERED = 64
"""Sentences whose reading is kept: the door, the missions and the brain see one value each."""


@dataclass(frozen=True, slots=True)
class Utterance:
    """Hold a sentence and its meaning by itself, at any state of the robot."""

    text: str
    intent: Intent | None
    """The command to the planner itself, where it is one."""
    reading: StopReading
    """What it says about stopping."""
    consent: bool | None
    """True for a plain yes, False for a plain no, None for anything else."""
    language: Language
    instead: StopReading | None = None
    """What the part says about stopping that is done after the current goal, or in its place."""
    begins_with_stop: bool = False
    """Whether that part orders a stop."""

    @property
    def orders_stop(self) -> bool:
        """Return whether it orders a stop, at its start or in place of the current goal."""
        return self.reading is StopReading.ORDER or self.begins_with_stop

    @property
    def behind_stop(self) -> str:
        """Return what is said behind a stop in the same breath; a command as a whole has none."""
        whole = not (self.intent is None or isinstance(self.intent, Replace))
        return "" if whole else words_behind_stop(self.text)

    @property
    def may_mean_stop(self) -> bool:
        """Return whether a stop word stands in it that is not read as anything else."""
        if self.instead is not None:
            return self.instead is not StopReading.NONE
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
            self.intent is None
            or isinstance(
                self.intent,
                Replace | GoOn | HereCommand,
            )
        )
        return self.orders_stop or memory_or_goals or self.consent is False


@lru_cache(maxsize=REMEMBERED)
def parse(text: str) -> Utterance:
    """Return a sentence's meaning by itself; the stop lane reads it first."""
    reading, intent = read_stop(text), intent_of(text)
    rest = intent.rest if isinstance(intent, Replace) else None
    if intent is None:
        rest = read_rest(text)
    return Utterance(
        text,
        intent,
        reading,
        consents(text),
        language_of(text),
        read_stop(rest) if rest is not None else None,
        rest is not None and is_stop(rest),
    )


def language_of(text: str) -> Language:
    """Return Chinese where the text is Chinese (``folding.is_chinese``), else English."""
    return Language.ZH if is_chinese(text) else Language.EN
