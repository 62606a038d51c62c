"""Say what a language brings to read orders that hang on something, and what reads their parts.

The words are each language's own (``en/compound.py``, ``zh/compound.py``); what is made of them is
the same for all (``compound.py``, ``lasting_orders.py``, ``branch_orders.py``).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from planner.plan import Recall, Step

ReadSteps = Callable[[str], tuple[Step, ...] | None]
"""Return the steps of one order, or None where it is no plan."""
NamePlace = Callable[[str], str]
"""Return a place's name in the sentence's language, by its id."""


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
    statement: str = ""
    """The condition itself, as words to be told to somebody."""


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
    reports: re.Pattern[str]
    """An order to tell the person themselves: the look's own answer is that."""
    calls: str
    """Stands between a person's name and the words for them."""
    cuts: re.Pattern[str]
    """Where a condition may end in ``body``."""
    failures: re.Pattern[str]
    """Groups ``main`` and ``else``."""
    rounds: re.Pattern[str]
    """Groups ``main`` and ``times``."""
    count: Callable[[str], int | None]
    waits: tuple[re.Pattern[str], ...]
    """Groups ``before``, ``rest``, and one of ``who``, ``named``, ``word`` and ``time``.

    A group ``at`` is where to wait; ``named`` is one of whom there are many.
    """
    time: Callable[[str], str | None]
    slowly: re.Pattern[str]
    """Words that ask for no more than half the speed."""
    follows: re.Pattern[str]
    """Groups ``main``, ``number`` and ``unit``."""
    there: tuple[tuple[re.Pattern[str], str], ...] = ()
    """Other words for "go there" and "wait there", and these."""
    inside: re.Pattern[str] | None = None
    """Ends a condition that is about the place which its order drives to; group ``rest``."""
    within: str = ""
    """Stands between what is asked about and that place's name."""
    tries: re.Pattern[str] | None = None
    """An order to look in another place, ``place``, and no more: for what the condition names.

    Groups ``try`` and ``look`` hold its verb, where it has one.
    """
    the: str = ""
    """Stands before a thing's bare name."""
    search: str = ""
    """The order to search ``{thing}`` in ``{place}``."""
    look_there: str = ""
    """The order to look in ``{place}``, for a group ``try`` of `tries` that names no thing."""
    informs: re.Pattern[str] | None = None
    """An order to tell ``who`` that the condition holds, in no words of its own."""
    news: str = ""
    """The order to tell ``{who}`` what ``{said}``."""
    wait_at: str = ""
    """The order to drive to where is waited, ``{at}``."""
    folk: re.Pattern[str] | None = None
    """People who have no name: the kids, the postman."""
    mine: re.Pattern[str] | None = None
    """What nobody is called by: "my" sister."""
    hunts: tuple[re.Pattern[str], ...] = ()
    """Groups ``what`` (found, it ends), ``for`` or none, ``at`` or none, ``before``, ``rest``."""
    any_hunted: re.Pattern[str] | None = None
    """What names no thing or person to be found: "it", "something", "no more cups"."""
    find: str = ""
    """The order to find ``{what}``, with where, ``{at}``."""
    find_and: str = ""
    """That order, and what is to be done then, ``{rest}``."""
    follows_until: re.Pattern[str] | None = None
    """Groups ``main`` and ``word``: whom to follow, and what is said in the end."""
    ends: re.Pattern[str] | None = None
    """A word in the end that stands for a stop: "until I say so"."""
    answers: tuple[tuple[bool, re.Pattern[str]], ...] = ()
    """Groups ``ask``, ``then``, ``else`` or none, ``echo`` (the question's own verb) or none.

    With each stands whether ``then`` hangs on a yes.
    """
    open_question: re.Pattern[str] | None = None
    """Stands in a question that no yes or no answers."""
    polls: tuple[re.Pattern[str], ...] = ()
    """Groups ``number``, ``unit``, ``main``, and one of ``until`` (a condition) and ``time``."""
    poll_there: str = ""
    """The condition ``{until}`` at ``{place}``."""
    spins: re.Pattern[str] | None = None
    """Groups ``until`` (what is to be seen), and ``right`` where the turn is to the right."""
    spun_to: str = ""
    """The condition that ``{until}`` is there."""
