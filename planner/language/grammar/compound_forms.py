"""Say what a language brings to read orders that hang on something, and what reads their parts.

The words are each language's own (``en/compound.py``, ``zh/compound.py``); what is made of them is
the same for all (``compound.py``).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime

from planner.language.folding import fold_words, has_chinese
from planner.language.schedule.parts import TimeOfDay
from planner.language.schedule.time_finder import whole_parts
from planner.plan import Recall, Step

HALF_A_DAY_H = 12
ReadSteps = Callable[[str], tuple[Step, ...] | None]
"""Return the steps of one order, or None where it is no plan."""
NamePlace = Callable[[str], str]
"""Return a place's name in the sentence's language, by its id."""


def read_hour(words: str, now: datetime | None = None) -> str | None:
    """Return the hour that words name, as HH:MM.

    A bare "seven", which is not said to be a.m., is the one that comes next after ``now``; without
    ``now`` it is none.
    """
    parts = whole_parts(fold_words(words), in_chinese=has_chinese(words))
    clock = next((part for part in parts if isinstance(part, TimeOfDay)), None)
    if clock is None:
        return None
    is_sure = clock.sure or clock.hour > HALF_A_DAY_H or re.search(r"\d[:：]\d\d$", words)
    if not is_sure and now is None:
        return None
    minutes = clock.hour * 60 + clock.minute
    if not is_sure and now is not None:
        first = minutes % (HALF_A_DAY_H * 60)
        halves = (first, first + HALF_A_DAY_H * 60)
        minutes = next((each for each in halves if each > now.hour * 60 + now.minute), first)
    return f"{minutes // 60:02d}:{minutes % 60:02d}"


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
