"""Receive a person's sentence: decide once, before any brain, what it is to the missions.

Pure. The one door for text, voice, page, command line and the lockstep harness: whoever feeds the
missions asks :func:`receive` and does what it says, a stop first of all.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from planner.language.commands import Replace
from planner.language.commands import Resume as GoOn
from planner.mission.answer_timeouts import has_room
from planner.mission.answered_question import meant
from planner.mission.bridge_status import at_rest
from planner.mission.planner_commands import current
from planner.plan import GoalState

if TYPE_CHECKING:
    from planner.language.utterance import Utterance
    from planner.mission.events import Submitted
    from planner.mission.state import Book

OLD_STATUS_S = 1.0
"""A status older than this says nothing of whether the robot moves now."""


@dataclass(frozen=True, slots=True)
class Reception:
    """Say what is to be done with a sentence."""

    given: Submitted
    stops: bool = False
    """The bridge is told to stop before anything else."""
    takes_back: str | None = None
    """The goal that it ends."""
    crowded: bool = False
    """It would be a new goal, and too many are open."""


def receive(
    book: Book, said: Utterance, given: Submitted, now_s: float, *, answers: bool = True
) -> Reception:
    """Return what is to be done with a sentence that came now.

    Args:
        book: where everything stands.
        said: the sentence as it was read.
        given: the goal that it would be, without marks.
        now_s: on the clock of the book.
        answers: it may answer a question.
    """
    if said.orders_stop:
        return Reception(replace(given, stop=True), stops=True)
    intent, full = said.intent, not has_room(book)
    may_answer = answers and not (given.confirm or given.replace)
    asking = meant(book, said) if may_answer else ()
    if said.may_mean_stop and not asking and is_active(book, now_s):
        marked = replace(given, stop=full, doubtful_stop=not full, confirm=True, replace=False)
        return Reception(marked, stops=True)
    replaces = isinstance(intent, Replace)
    first = isinstance(intent, Replace) and intent.now
    local = bool(asking) or (intent is not None and not replaces)
    marked = replace(
        given,
        replace=given.replace if not replaces else not first,
        first=first,
        resumes=isinstance(intent, GoOn) and not asking,
        asking=asking,
        local=local,
    )
    takes_back = current(book) if first else None
    return Reception(marked, takes_back=takes_back, crowded=full and not local)


def is_active(book: Book, now_s: float) -> bool:
    """Return whether anything moves, is about to move, or waits; in doubt it does."""
    thinking = any(m.state is GoalState.PLANNING for m in book.missions.values())
    if book.running is not None or book.queue or thinking:
        return True
    status = book.status
    if status is None:
        return False  # no bridge was ever heard, so nothing of ours can move
    return not now_s - book.status_s <= OLD_STATUS_S or not at_rest(status)
