"""Bound what an agent may do: a program with a token of its own, such as an assistant. Pure.

Laws: an agent's goals are its own, and it reaches no others; a yes that moves the robot, a resume
and all that changes what the robot keeps are a person's; what an agent says clears no hold. Its
stop is anybody's. Words are held to this here, routes in ``planner.api.access``.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.catalogue import message
from planner.language.commands import BatteryCommand, Doing, OutcomeCommand, WhereCommand
from planner.mission.awaited_word import AwaitedWord, wait_of
from planner.mission.errors import MissionError, NotOwnGoal, PersonMissing, UnknownGoal
from planner.mission.state import AGENT_SOURCE, MissionState
from planner.mission.transitions import refusal
from planner.plan import STEPLESS, Clarify, Code, Option, Plan, PlanRole, Refuse, StepPlan

if TYPE_CHECKING:
    from planner.mission.events import Command, Planned

MOST_OPEN = 8
"""Goals of all agents that have not ended: a program in a loop leaves room for people."""
MAY_ASK = (WhereCommand, Doing, BatteryCommand, OutcomeCommand)
"""What an agent may say to the planner itself: questions. What is absent is a person's to say."""
NEEDED = Refuse(code=Code.PERSON_NEEDED, reason=message(Code.PERSON_NEEDED))


def is_agents(source: str) -> bool:
    """Return whether an agent is the source of a goal."""
    return source.startswith(AGENT_SOURCE)


def has_room(book: MissionState) -> bool:
    """Return whether one more goal of an agent can be taken."""
    open_ = (m for m in book.missions.values() if not m.has_ended and is_agents(m.source))
    return sum(1 for _ in open_) < MOST_OPEN


def refuse_command(book: MissionState, command: Command, source: str) -> MissionError | None:
    """Return why this source may not have a command obeyed now; None: it may."""
    mission = book.missions.get(command.id)
    if mission is not None and is_agents(source) and mission.source != source:
        return NotOwnGoal(command.id)
    return refusal(book, command)


def refuse_answer(
    book: MissionState, command: Command, source: str, *, declines: bool
) -> MissionError | None:
    """Return why an agent may not answer a goal so; a plain no to its own is always its to say.

    What a brain asks about the order itself is for the giver of the order to answer; a plan's yes,
    and the answer to a step that asks people, are a person's.
    """
    mission = book.missions.get(command.id)
    if mission is None:
        return UnknownGoal(command.id, tuple(book.missions))
    refused = refuse_command(book, command, source)
    needs_person = wait_of(mission) in (AwaitedWord.STEP, AwaitedWord.PLAN)
    return refused or (PersonMissing() if needs_person and not declines else None)


def hold_to_agent(planned: Planned) -> Planned:
    """Return a brain's answer to an agent without what would reach the goals of others."""
    plan = planned.plan
    return planned if plan is None else replace(planned, plan=_hold_plan(plan))


def _hold_plan(plan: Plan) -> Plan:
    match plan:
        case StepPlan() if plan.does in STEPLESS:
            return NEEDED
        case StepPlan():
            return plan.model_copy(update={"does": PlanRole.NEW})
        case Clarify():
            left = tuple(filter(None, map(_bound_option, plan.options)))
            return plan.model_copy(update={"options": left})
        case _:
            return plan


def _bound_option(option: Option) -> Option | None:
    if option.plan is None:
        return option
    bound = _hold_plan(option.plan)
    return option.model_copy(update={"plan": bound}) if isinstance(bound, StepPlan) else None
