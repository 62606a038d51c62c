"""Bring a sentence that has stopped the robot to its end: as a stop, as a doubt, as a correction.

Law: the goal that a person took back never goes on by itself, and what is put in its place drives
without a further yes only where the person's own words take the old one back and ask for the new.
"""

from __future__ import annotations

from planner.language.catalogue import join, say
from planner.mission.events import Planned
from planner.mission.plan_roles import ends_goal, takes_back
from planner.mission.queue import cancel, finish
from planner.mission.spoken_status import stop_told
from planner.mission.state import Mission, MissionState
from planner.mission.transaction import Transaction
from planner.mission.transitions import PersonCause
from planner.plan import Bilingual, Code, GoalState, Outcome, PlanRole, StepPlan, words_of

UNCONFIRMED = say("goal.unconfirmed")


def end_stopped(
    turn: Transaction, mission: Mission, echoed: bool, also: Bilingual | None = None
) -> None:
    """End a sentence that was an order to stop, and say whether the bridge has heard it."""
    if echoed:
        told = stop_told(turn.book) if also is None else join((stop_told(turn.book), also))
        said = Outcome(code=Code.STOPPED, message=told)
        finish(turn, mission, PersonCause.ORDERS_STOP, said)
        return
    said = Outcome(code=Code.FAULT, message=UNCONFIRMED)
    turn.move_to(mission, PersonCause.STOP_UNHEARD, reason="bridge_silent", outcome=said)


def end_paused(turn: Transaction, goal_id: str | None) -> None:
    """End a goal that a person's words have stopped, and that is not to go on."""
    stopped = turn.mission(goal_id)
    if stopped is not None and stopped.state in (GoalState.PAUSED, GoalState.QUEUED):
        cancel(turn, stopped)


def stop_after_all(turn: Transaction, mission: Mission, event: Planned) -> None:
    """Take a sentence that orders no step for the stop that it was."""
    plan = event.plan
    cancels = isinstance(plan, StepPlan) and plan.does is PlanRole.CANCEL
    if cancels and ends_goal(mission.words):
        end_paused(turn, mission.interrupted)
    also = words_of(plan) if event.brain is None else None  # the planner's own, as it was told
    end_stopped(turn, turn.put(mission, brain=event.brain), echoed=True, also=also)


def corrects(turn: Transaction, mission: Mission) -> bool:
    """Tell whether a sentence that has stopped a goal puts another drive in its place."""
    stopped = turn.mission(mission.interrupted)
    return stopped is not None and bool(stopped.steps) and takes_back(mission.words)


def ask_what_was_meant(book: MissionState, mission: Mission) -> Bilingual:
    """Ask whether a sentence with a stop word in it was an order to do something."""
    told, text = stop_told(book), mission.text[:60]
    return say("goal.doubtful_stop", told=told, text=text)
