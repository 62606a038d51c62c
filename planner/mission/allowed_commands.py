"""List what may be asked of a goal in which state. What is absent is forbidden."""

from __future__ import annotations

from planner.mission.errors import BadState, MissionError, UnknownGoal
from planner.mission.events import Cancel, ChangeSpeed, Command, Confirm, Move, Pause, Reply, Resume
from planner.mission.state import Mission, MissionState
from planner.plan import GoalState

ALLOWED: dict[type[Command], frozenset[GoalState]] = {
    Cancel: frozenset(
        {
            GoalState.QUEUED,
            GoalState.PLANNING,
            GoalState.AWAITING_CONFIRMATION,
            GoalState.NEEDS_CLARIFICATION,
            GoalState.RUNNING,
            GoalState.PAUSED,
        }
    ),
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
