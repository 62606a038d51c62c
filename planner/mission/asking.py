"""Keep the questions that steps of any kind ask: hand on the answer, or end what nobody answers.

The robot stands and is free for other goals meanwhile; who waits behind the asking goal waits on.
What an answer means is for the skill that asked to say.
"""

from __future__ import annotations

from planner.mission.queue import enqueue, finish, note_step, release_answered
from planner.mission.records import Mission
from planner.mission.turn import Turn
from planner.mission.verdict import ended
from planner.plan import Code, GoalState, StepState, message, same

MAX_ANSWER = 2000


def asks(mission: Mission) -> bool:
    """Tell whether a goal waits for the answer to a question of one of its own steps."""
    step = mission.now
    return (
        mission.state is GoalState.NEEDS_CLARIFICATION
        and step is not None
        and step.state is StepState.RUNNING
    )


def take_answer(turn: Turn, mission: Mission, text: str) -> None:
    """Write the answer into its step, and go on in it first of all who wait."""
    mission = note_step(turn, mission, answer=text[:MAX_ANSWER])
    release_answered(turn)
    enqueue(turn, turn.put(mission, outcome=None), first=True)


def end_unanswered(turn: Turn) -> None:
    """End every goal whose question nobody answered in time; the robot stays where it is."""
    for mission_id, since_s in turn.book.asked_s.items():
        mission, limit_s = turn.mission(mission_id), turn.book.rules.answer_s
        waits = mission is not None and asks(mission)
        if waits and not turn.now_s - since_s > limit_s:
            continue
        left = {i: s for i, s in turn.book.asked_s.items() if i != mission_id}
        turn.set(asked_s=left)
        if mission is not None and waits:
            _unanswered(turn, mission, limit_s)


def _unanswered(turn: Turn, mission: Mission, limit_s: float) -> None:
    asked = mission.outcome.message if mission.outcome is not None else same("")
    said = message(Code.NO_ANSWER, text=asked, seconds=f"{limit_s:.0f}")
    now_unix_s = turn.now_s + turn.book.wall_offset_s
    outcome = ended(turn.book.facts, mission, None, turn.book.status, now_unix_s,
                    code=Code.NO_ANSWER, said=said)  # fmt: skip
    finish(turn, mission, GoalState.FAILED, outcome, Code.NO_ANSWER.value)
