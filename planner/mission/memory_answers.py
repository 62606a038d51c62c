"""Take memory's answer to the step that asked for it, or end the step without one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import message
from planner.mission.activity import LookingUp
from planner.mission.skills.conditions import judge_recalled
from planner.mission.step_execution import carry_out
from planner.plan import Code

if TYPE_CHECKING:
    from planner.mission.events import Recalled
    from planner.mission.transaction import Transaction


def on_recalled(turn: Transaction, event: Recalled) -> None:
    """End the step with memory's answer, if it still waits for it."""
    mission, activity = turn.running, turn.book.activity
    if mission is None or mission.id != event.id or not isinstance(activity, LookingUp):
        return
    if activity.ticket != event.ticket:
        return
    step = mission.steps[mission.step]
    carry_out(turn, mission, judge_recalled(step.role, event.code, event.said))


def end_lookup_if_due(turn: Transaction) -> None:
    """End a wait for memory that has lasted too long."""
    mission, activity = turn.running, turn.book.activity
    if mission is None or not isinstance(activity, LookingUp) or turn.now_s < activity.until_s:
        return
    code, step = Code.MEMORY_UNAVAILABLE, mission.steps[mission.step]
    carry_out(turn, mission, judge_recalled(step.role, code, message(code)))
