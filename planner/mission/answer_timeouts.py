"""End what nobody answers: after the time set for answers, by a newer order, or to make room.

Whatever waits for a person's word ends by itself one day, so that no number of open questions keeps
an order out. After a restart the time runs anew.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import message, say
from planner.mission.open_questions import WAITS, asks, confirms
from planner.mission.outcomes import ended_outcome
from planner.mission.queue import finish
from planner.mission.state import MAX_OPEN, Mission, MissionState
from planner.mission.transitions import GoalFact
from planner.plan import Bilingual, Code, GoalState, Outcome, say_same

if TYPE_CHECKING:
    from planner.mission.transaction import Transaction

SUPERSEDED = "superseded"


def end_unanswered(turn: Transaction) -> None:
    """End every goal whose question nobody answered in time; note since when the others wait."""
    asked_s: dict[str, float] = {}
    limit_s = turn.book.rules.answer_s
    for mission in tuple(turn.book.missions.values()):
        if mission.state not in WAITS:
            continue
        since_s = turn.book.asked_s.get(mission.id, turn.now_s)
        if turn.now_s - since_s > limit_s:
            said = message(Code.NO_ANSWER, text=_repeat_question(mission), seconds=f"{limit_s:.0f}")
            _end(turn, mission, said, GoalFact.UNANSWERED, Code.NO_ANSWER.value)
        else:
            asked_s[mission.id] = since_s
    if asked_s != turn.book.asked_s:
        turn.set(asked_s=asked_s)


def ask_anew(turn: Transaction, mission: Mission) -> None:
    """Forget since when a goal waits: it was answered, and may ask again."""
    left = {i: s for i, s in turn.book.asked_s.items() if i != mission.id}
    turn.set(asked_s=left)


def waiting_since(missions: dict[str, Mission], now_s: float) -> dict[str, float]:
    """Return since when each goal waits for an answer, in a process that has just begun."""
    return {m.id: now_s for m in missions.values() if m.state in WAITS}


def close_older(turn: Transaction, new: Mission) -> None:
    """End the brain's questions about older orders of the same source: a new order came instead.

    A question of a step and a plan that waits for its yes stay: they have their time.
    """
    for mission in tuple(turn.book.missions.values()):
        older = mission.order < new.order and mission.source == new.source
        if older and _about_order(mission):
            _make_way(turn, mission, new.text)


def has_room(book: MissionState) -> bool:
    """Tell whether one more order can be taken, perhaps in place of a question."""
    open_ = [m for m in book.missions.values() if not m.has_ended]
    return len(open_) < MAX_OPEN or any(m.state in WAITS for m in open_)


def make_room(turn: Transaction, text: str) -> None:
    """End the oldest questions while goals are more than may be open: about orders first."""
    while True:
        open_ = [m for m in turn.book.missions.values() if not m.has_ended]
        waiting = [m for m in open_ if m.state in WAITS]
        if len(open_) < MAX_OPEN or not waiting:
            return
        _make_way(turn, min(waiting, key=_worth), text)


def _worth(mission: Mission) -> tuple[int, int]:
    return (0 if _about_order(mission) else 1 if confirms(mission) else 2), mission.order


def _about_order(mission: Mission) -> bool:
    return mission.state is GoalState.NEEDS_CLARIFICATION and not asks(mission)


def _make_way(turn: Transaction, mission: Mission, newer: str) -> None:
    asked, newer = _repeat_question(mission), newer[:60]
    said = say("question.superseded", asked=asked, newer=newer)
    _end(turn, mission, said, GoalFact.SUPERSEDED, SUPERSEDED)


def _repeat_question(mission: Mission) -> Bilingual:
    return mission.outcome.message if mission.outcome is not None else say_same(mission.text[:200])


def _end(
    turn: Transaction, mission: Mission, said: Bilingual, cause: GoalFact, reason: str
) -> None:
    now_unix_s = turn.now_s + turn.book.wall_offset_s
    outcome: Outcome = ended_outcome(turn.book.facts, mission, turn.book.status, now_unix_s,
                             code=Code.NO_ANSWER, said=said)  # fmt: skip
    finish(turn, mission, cause, outcome, reason)
