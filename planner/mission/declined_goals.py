"""End a goal that a person said no to: nothing of it moves, and its deed is told."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.mission.outcomes import ended_outcome
from planner.mission.queue import finish, note_step, settle_activity
from planner.mission.transitions import PersonCause
from planner.plan import Bilingual, Code, StepState

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.mission.transaction import Transaction


def decline(turn: Transaction, mission: Mission, said: Bilingual) -> None:
    """End a goal where the robot stands; a question that was answered is over, the rest skipped."""
    if turn.book.running == mission.id:
        mission = settle_activity(turn) or mission
    if (
        mission.current_step is not None
        and mission.current_step.kind == "ask"
        and mission.current_step.answer is not None
    ):
        mission = note_step(turn, mission, state=StepState.SUCCEEDED)
    now_unix_s = turn.now_s + turn.book.wall_offset_s
    outcome = ended_outcome(turn.book.facts, mission, turn.book.status, now_unix_s,
                    code=Code.DECLINED, said=said)  # fmt: skip
    finish(turn, mission, PersonCause.DECLINES, outcome, Code.DECLINED.value)
