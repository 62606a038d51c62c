"""Follow one goal from outside, whichever planner process has it. Reads, never changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.mission.api_view import goal_of
from planner.plan import ENDED

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.mission.state import MissionState
    from planner.plan import Goal, GoalState


class GoalHandle:
    """Be what a person who gave a goal sees of it."""

    def __init__(self, goal_id: str, book: Callable[[], MissionState]) -> None:
        self.id = goal_id
        self._book = book

    @property
    def record(self) -> Goal:
        """Return the goal as the API shows it."""
        book = self._book()
        return goal_of(book, book.missions[self.id])

    @property
    def state(self) -> GoalState:
        """Return where the goal stands."""
        return self._book().missions[self.id].state

    @property
    def has_ended(self) -> bool:
        """Tell whether nothing more happens to the goal by itself or by a person."""
        return self.state in ENDED
