"""Bring a sentence that has stopped the robot to its end: as a stop, as a doubt, as a correction.

Law: the goal that a person took back never goes on by itself, and what is put in its place drives
without a further yes only where the person's own words take the old one back and ask for the new.
"""

from __future__ import annotations

from planner.language.catalogue import join, say
from planner.language.commands import ResumeCommand
from planner.language.folding import has_chinese
from planner.language.sentence import parse
from planner.mission.events import Planned
from planner.mission.plan_roles import ends_goal, takes_back
from planner.mission.queue import cancel, finish
from planner.mission.spoken_status import stop_told
from planner.mission.state import GivenOrder, Mission, MissionState
from planner.mission.transaction import Transaction
from planner.mission.transitions import PersonCause
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Code,
    GoalState,
    Outcome,
    Plan,
    PlanRole,
    Refuse,
    StepPlan,
    words_of,
)

UNCONFIRMED = say("goal.unconfirmed")


def end_stopped(
    turn: Transaction, mission: Mission, echoed: bool, also: Bilingual | None = None
) -> None:
    """End a sentence that was an order to stop, and say whether the bridge has heard it."""
    heard = stop_told(turn.book) if echoed else UNCONFIRMED
    told = heard if also is None else join((heard, also))
    if echoed:
        said = Outcome(code=Code.STOPPED, message=told)
        finish(turn, mission, PersonCause.ORDERS_STOP, said)
        return
    said = Outcome(code=Code.FAULT, message=told)
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
    own = words_of(plan) if event.brain is None else None  # the planner's own, as it was told
    also = own or _tell_rest(turn, mission, plan)
    end_stopped(turn, turn.put(mission, brain=event.brain), echoed=True, also=also)


def tell_left(rest: str) -> Bilingual | None:
    """Say that what followed a stop in the same breath was not done; None: nothing did."""
    return say("goal.rest_left", text=_short(rest)) if rest else None


def _tell_rest(turn: Transaction, mission: GivenOrder, plan: Plan | None) -> Bilingual | None:
    """Say what became of the words behind a stop, of which no step has come."""
    rest = parse(mission.text).behind_stop
    if rest and isinstance(plan, AnswerPlan | Refuse):
        return words_of(plan)
    if rest and turn.book.queue and _says_go_on(rest):  # not with what was just stopped
        end_paused(turn, mission.interrupted)
        waiting = turn.book.missions[turn.book.queue[0]]
        return say("goal.rest_go_on", text=_short(waiting.text))
    return tell_left(rest)


def _says_go_on(rest: str) -> bool:
    """Tell whether words begin as an order to go on: "go on with the others"."""
    words = [*rest] if has_chinese(rest) else rest.split()
    joint = "" if has_chinese(rest) else " "
    return any(isinstance(parse(joint.join(words[:n])).intent, ResumeCommand) for n in (1, 2, 3))


def _short(text: str) -> str:
    return text[:60]


def corrects(turn: Transaction, mission: Mission) -> bool:
    """Tell whether a sentence that has stopped a goal puts another drive in its place."""
    stopped = turn.mission(mission.interrupted)
    words = parse(mission.text).behind_stop or mission.words  # the stop itself takes nothing back
    return stopped is not None and bool(stopped.steps) and takes_back(words)


def ask_what_was_meant(book: MissionState, mission: GivenOrder) -> Bilingual:
    """Ask whether a sentence with a stop word in it was an order to do something."""
    told, text = stop_told(book), _short(mission.text)
    return say("goal.doubtful_stop", told=told, text=text)
