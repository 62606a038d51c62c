"""Say what a language brings to read orders that hang on something, and what reads their parts.

The words are each language's own (``en/compound.py``, ``zh/compound.py``); what is made of them is
the same for all (``compound.py``).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from planner.language.folding import has_chinese
from planner.language.schedule.parts import TimeOfDay
from planner.language.schedule.time_finder import whole_parts
from planner.plan import Recall, Step

ReadSteps = Callable[[str], tuple[Step, ...] | None]
"""Return the steps of one order, or None where it is no plan."""
NamePlace = Callable[[str], str]
"""Return a place's name in the sentence's language, by its id."""


def read_hour(words: str) -> str | None:
    """Return the hour that words name; None of a bare "seven", which is not said to be a.m."""
    parts = whole_parts(words, in_chinese=has_chinese(words))
    clock = next((part for part in parts if isinstance(part, TimeOfDay)), None)
    sure = clock is not None and (clock.sure or re.search(r"\d[:：]\d\d$", words) is not None)
    return f"{clock.hour:02d}:{clock.minute:02d}" if clock is not None and sure else None


@dataclass(frozen=True, slots=True)
class ConditionParts:
    """Hold a condition cut out of a sentence: the question that tells it, and what hangs on it."""

    question: str
    thing: str
    denied: bool
    """It holds where the answer is no."""
    is_placed: bool
    """It says where."""
    anybody: str = ""
    """The question whether anybody is there, for one who is named: no eye tells who is who."""


@dataclass(frozen=True, slots=True)
class MemoryParts:
    """Hold a condition about before: the question that memory answers."""

    question: str
    denied: bool
    """It holds where nothing is remembered."""


@dataclass(frozen=True, slots=True)
class PartReaders:
    """Hold what reads the parts of a sentence, each alone."""

    steps: ReadSteps
    memory: Callable[[str], Recall | None]
    """Reads a question about before; None of any other."""
    name: NamePlace
    person: Callable[[str], str | None]
    """Return a person's name as it is written, where words are one."""


@dataclass(frozen=True, slots=True)
class CompoundForms:
    """Hold one language's words. Each pattern reads a normalised sentence whole."""

    trigger: re.Pattern[str]
    """Without it nothing is tried."""
    conditions: tuple[re.Pattern[str], ...]
    """Groups ``body`` (condition and order, in one) or ``if`` and ``then``; ``else`` or none.

    A group ``unless``, where it is found, denies the condition.
    """
    read_condition: Callable[[str], ConditionParts | None]
    read_memory: Callable[[str], MemoryParts | None]
    clock: re.Pattern[str]
    """Groups ``after`` and ``before``: an hour that people's clock has, or has not yet, reached."""
    go_there: re.Pattern[str]
    """Group ``verb``: a drive to the place that the condition names."""
    to: str
    """Stands between that verb and the place's name."""
    tells: tuple[tuple[re.Pattern[str], str], ...]
    """What is to be told to "him", and the order to say it."""
    calls: str
    """Stands between a person's name and the words for them."""
    cuts: re.Pattern[str]
    """Where a condition may end in ``body``."""
    rounds: re.Pattern[str]
    """Groups ``main`` and ``times``."""
    count: Callable[[str], int | None]
    slowly: re.Pattern[str]
    """Words that ask for no more than half the speed."""
