"""Take memory's answer to the step that asked for it, or end the step without one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import message
from planner.mission.activity import LookingUp
from planner.mission.skills import Fail
from planner.mission.step_execution import finish_step
from planner.mission.step_failure import fail_step
from planner.plan import Code, StepState

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
    if event.code is Code.MEMORY_UNAVAILABLE:
        fail_step(turn, Fail(event.code, event.code.value, event.said))
        return
    finish_step(turn, StepState.SUCCEEDED, code=event.code, said=event.said)


def end_lookup_if_due(turn: Transaction) -> None:
    """End a wait for memory that has lasted too long."""
    activity = turn.book.activity
    if isinstance(activity, LookingUp) and turn.now_s >= activity.until_s:
        code = Code.MEMORY_UNAVAILABLE
        fail_step(turn, Fail(code, code.value, message(code)))
