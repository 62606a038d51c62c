"""Tell whose question a plain yes or no answers, before it becomes a goal of its own."""

from __future__ import annotations

from planner.language.commands import Resume
from planner.language.utterance import Utterance
from planner.mission.goal_reference import goal_to_resume
from planner.mission.open_questions import WAITS, asks_freely, takes_yes
from planner.mission.state import MissionState


def meant(book: MissionState, said: Utterance) -> tuple[str, ...]:
    """Return the goals whose question a sentence may answer; one alone is beyond doubt.

    None unless it is a plain yes or no and one of them takes it. A question that takes neither (a
    brain's about the order, which offers no or several orders) counts where it is no older than the
    newest of these: it may be meant, too.
    """
    if said.consent is None:
        return ()
    intent = said.intent
    if not (intent is None or (isinstance(intent, Resume) and goal_to_resume(book) is None)):
        return ()  # "go on" is a yes where there is nothing else to go on with
    waiting = [m for m in book.missions.values() if m.state in WAITS]
    taking = {m.id: m.updated_unix_s for m in waiting if takes_yes(m)}
    if not taking:  # "Do you mean the kitchen?" of a model: it reads the word itself
        alone = len(waiting) == 1 and intent is None
        return tuple(m.id for m in waiting if alone and asks_freely(m))
    newest_unix_s = max(taking.values())
    return tuple(m.id for m in waiting if m.id in taking or m.updated_unix_s >= newest_unix_s)
