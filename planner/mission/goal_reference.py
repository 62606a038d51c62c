"""Find the goal that a person means who names none: to end it, to pause it, to go on with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.plan import GoalState

if TYPE_CHECKING:
    from planner.mission.state import MissionState

_OPEN = (
    GoalState.PLANNING,
    GoalState.NEEDS_CLARIFICATION,
    GoalState.AWAITING_CONFIRMATION,
    GoalState.PAUSED,
    GoalState.QUEUED,
)


def goal_to_end(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that a person means by "that": the running one, else the newest open one."""
    if book.running is not None:
        return book.running
    others = [m for m in book.missions.values() if not m.ended and m.id != asking]
    for state in _OPEN:
        found = [m for m in others if m.state is state]
        if found:
            return max(found, key=lambda m: m.order).id
    return None


def goal_to_pause(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that a person wants paused."""
    if book.running is not None:
        return book.running
    thinking = [
        m for m in book.missions.values() if m.state is GoalState.PLANNING and m.id != asking
    ]
    return max(thinking, key=lambda m: m.order).id if thinking else None


def goal_to_resume(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that was paused last, else the first that is kept waiting."""
    paused = [m for m in book.missions.values() if m.state is GoalState.PAUSED and m.id != asking]
    if paused:
        return max(paused, key=lambda m: (m.updated_unix_s, m.order)).id
    return next((i for i in book.queue if book.missions[i].held), None)
