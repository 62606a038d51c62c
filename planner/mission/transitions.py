"""Hold the tables of a goal's states: what leads from which to which, what may be asked in which.

What is absent is forbidden; docs and tests come from them. The key of the first is the state and
what happened: what a person said, what a brain answered, or what became of the goal on its way.
``Transaction.move_to`` is the one writer of ``Mission.state``.
"""

from __future__ import annotations

from enum import StrEnum

from planner.mission.errors import BadState, MissionError, UnknownGoal
from planner.mission.events import Cancel, ChangeSpeed, Command, Confirm, Move, Pause, Reply, Resume
from planner.mission.state import Mission, MissionState
from planner.plan import ENDED, GoalState

FIRST = GoalState.PLANNING
"""The state in which every goal is taken in."""


class PersonCause(StrEnum):
    """Name what a person does to a goal."""

    ORDERS_STOP = "its own words were an order to stop, and the bridge has stopped"
    STOP_UNHEARD = "its own words were an order to stop, and the bridge did not confirm it"
    ANSWERS_ANOTHER = "its own words were the answer to another goal's question"
    MAY_MEAN_SEVERAL = "its own words may answer several goals"
    EXPLAINS = "a person answered what a brain asked about the order"
    AGREES = "a person said yes, or answered a step's question"
    DECLINES = "a person said no"
    PAUSES = "a person paused or stopped it"
    RESUMES = "a person resumed it; its plan is kept"
    RESUMES_UNPLANNED = "a person resumed it before it had a plan"
    CANCELS = "a person cancelled it"


class BrainCause(StrEnum):
    """Name a brain's answers, and the faults found in its plan."""

    ANSWERS = "a brain answered in words"
    REFUSES = "a brain refused, or wrote no plan that can be carried out"
    FAILS = "no brain could be asked"
    ASKS = "a brain asked about the order"
    PLANS = "there is a plan, and nobody asked to see it first"
    NEEDS_YES = "there is a plan that a person must say yes to"


class GoalFact(StrEnum):
    """Name what becomes of a goal by itself."""

    TURN = "the robot is free, and it is this goal's turn"
    INTERRUPTED = "a hold, a fault, a hand or silence of the bridge took the robot"
    RESTARTED = "the planner was started anew"
    STEP_ASKS = "a step asks a person"
    STEPS_OVER = "all steps are over"
    STEP_FAILS = "a step failed and no plan mends it, or a budget is spent"
    PLACE_GONE = "a place that it names was forgotten"
    PROGRESS_UNKNOWN = "how far its step had come can't be known any more"
    UNANSWERED = "nobody answered in time"
    SUPERSEDED = "a newer order came before its answer"


Cause = PersonCause | BrainCause | GoalFact

_S = GoalState
OPEN = tuple(state for state in GoalState if state not in ENDED)

TRANSITIONS: dict[tuple[GoalState, Cause], GoalState] = {
    # What its own words were, before any brain is asked. A doubtful stop is judged after it.
    (_S.PLANNING, PersonCause.ORDERS_STOP): _S.SUCCEEDED,
    (_S.PLANNING, PersonCause.STOP_UNHEARD): _S.FAILED,
    (_S.PLANNING, PersonCause.ANSWERS_ANOTHER): _S.SUCCEEDED,
    (_S.PLANNING, PersonCause.MAY_MEAN_SEVERAL): _S.REFUSED,
    # What the first thought comes to.
    (_S.PLANNING, BrainCause.ANSWERS): _S.SUCCEEDED,
    (_S.PLANNING, BrainCause.REFUSES): _S.REFUSED,
    (_S.PLANNING, BrainCause.FAILS): _S.FAILED,
    (_S.PLANNING, BrainCause.ASKS): _S.NEEDS_CLARIFICATION,
    (_S.PLANNING, BrainCause.NEEDS_YES): _S.AWAITING_CONFIRMATION,
    (_S.PLANNING, BrainCause.PLANS): _S.QUEUED,
    # What a person says while it waits.
    (_S.NEEDS_CLARIFICATION, PersonCause.EXPLAINS): _S.PLANNING,
    (_S.NEEDS_CLARIFICATION, PersonCause.AGREES): _S.QUEUED,
    (_S.NEEDS_CLARIFICATION, PersonCause.DECLINES): _S.CANCELLED,
    (_S.AWAITING_CONFIRMATION, PersonCause.AGREES): _S.QUEUED,
    (_S.AWAITING_CONFIRMATION, PersonCause.DECLINES): _S.CANCELLED,
    (_S.NEEDS_CLARIFICATION, GoalFact.UNANSWERED): _S.FAILED,
    (_S.AWAITING_CONFIRMATION, GoalFact.UNANSWERED): _S.FAILED,
    (_S.NEEDS_CLARIFICATION, GoalFact.SUPERSEDED): _S.CANCELLED,
    (_S.AWAITING_CONFIRMATION, GoalFact.SUPERSEDED): _S.CANCELLED,
    # The robot is its own.
    (_S.QUEUED, GoalFact.TURN): _S.RUNNING,
    (_S.RUNNING, GoalFact.STEP_ASKS): _S.NEEDS_CLARIFICATION,
    (_S.RUNNING, BrainCause.NEEDS_YES): _S.AWAITING_CONFIRMATION,
    (_S.RUNNING, BrainCause.ANSWERS): _S.SUCCEEDED,
    (_S.RUNNING, BrainCause.REFUSES): _S.REFUSED,
    (_S.RUNNING, GoalFact.STEPS_OVER): _S.SUCCEEDED,
    (_S.RUNNING, GoalFact.STEP_FAILS): _S.FAILED,
    (_S.RUNNING, PersonCause.DECLINES): _S.CANCELLED,
    # A pause keeps its place; one that waits in the queue is held there and changes no state.
    (_S.RUNNING, PersonCause.PAUSES): _S.PAUSED,
    (_S.PLANNING, PersonCause.PAUSES): _S.PAUSED,
    (_S.RUNNING, GoalFact.INTERRUPTED): _S.PAUSED,
    (_S.RUNNING, GoalFact.RESTARTED): _S.PAUSED,
    (_S.PLANNING, GoalFact.RESTARTED): _S.PAUSED,
    (_S.PAUSED, PersonCause.RESUMES): _S.QUEUED,
    (_S.PAUSED, PersonCause.RESUMES_UNPLANNED): _S.PLANNING,
    # Whatever is open can be cancelled, and ends where its places or its beginning are gone.
    **{(state, PersonCause.CANCELS): _S.CANCELLED for state in OPEN},
    **{(state, GoalFact.PLACE_GONE): _S.FAILED for state in OPEN},
    **{(state, GoalFact.PROGRESS_UNKNOWN): _S.FAILED for state in OPEN},
}


class ForbiddenTransition(Exception):
    """A goal was to change its state in a way that the table does not hold. A fault of ours."""


def next_state(state: GoalState, cause: Cause) -> GoalState:
    """Return the state that a cause leads to.

    Raises:
        ForbiddenTransition: the table holds none; it names what the state can be left by.
    """
    after = TRANSITIONS.get((state, cause))
    if after is None:
        known = ", ".join(known.name for at, known in TRANSITIONS if at is state) or "nothing"
        raise ForbiddenTransition(f"{state.value} can't be left by {cause.name}, but by {known}")
    return after


ALLOWED: dict[type[Command], frozenset[GoalState]] = {
    Cancel: frozenset(OPEN),
    Pause: frozenset({GoalState.QUEUED, GoalState.PLANNING, GoalState.RUNNING}),
    Resume: frozenset({GoalState.QUEUED, GoalState.PAUSED}),
    Confirm: frozenset({GoalState.AWAITING_CONFIRMATION}),
    Reply: frozenset({GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION}),
    Move: frozenset({GoalState.QUEUED}),
    ChangeSpeed: frozenset({GoalState.RUNNING}),
}


def refusal(book: MissionState, command: Command) -> MissionError | None:
    """Return why a command can't be obeyed now, or None."""
    mission = book.missions.get(command.id)
    if mission is None:
        return UnknownGoal(command.id, tuple(book.missions))
    allowed = ALLOWED[type(command)]
    if mission.state not in allowed:
        return _bad(mission, command, allowed)
    if isinstance(command, Move) and command.before is not None:
        other = book.missions.get(command.before)
        if other is None:
            return UnknownGoal(command.before, tuple(book.missions))
        if other.state not in allowed:
            return _bad(other, command, allowed)
    return None


def _bad(mission: Mission, command: Command, allowed: frozenset[GoalState]) -> BadState:
    states = tuple(sorted(state.value for state in allowed))
    return BadState(mission.id, api_name(type(command)), mission.state, states)


def api_name(command: type[Command]) -> str:
    """Return a command's name in the API."""
    name = command.__name__.lower()
    return {"reply": "answer"}.get(name, name)
