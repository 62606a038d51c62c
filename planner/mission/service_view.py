"""Show where the missions stand, to who asks or watches: the half of the door that only tells."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner.mission.api_view import goal_of
from planner.mission.errors import UnknownGoal

if TYPE_CHECKING:
    from planner.mission.engine import Leg
    from planner.mission.event_hub import Subscription
    from planner.mission.loop import Loop
    from planner.mission.state import Book
    from planner.plan import Goal


class Shown:
    """Tell of goals, of what runs and of what ails. Changes nothing."""

    def __init__(self, loop: Loop, planner_id: str) -> None:
        """Show what this loop holds."""
        self._loop, self.planner_id = loop, planner_id

    @property
    def failed(self) -> BaseException | None:
        """Return what ended the mission loop, if something did: the process should end then."""
        return self._loop.failed

    @property
    def journal_trouble(self) -> str | None:
        """Return why the journal can't be written, or None."""
        return self._loop.trouble

    @property
    def first_waypoint_s(self) -> tuple[float, ...]:
        """Return the newest times from a goal's acceptance to its first waypoint [s]."""
        return tuple(self._loop.accepted.seconds)

    def goal(self, goal_id: str) -> Goal:
        """Return a goal.

        Raises:
            UnknownGoal: there is none of that id at hand.
        """
        mission = self._book.missions.get(goal_id)
        if mission is None:
            raise UnknownGoal(goal_id, tuple(self._book.missions))
        return goal_of(self._book, mission)

    def goals(self, limit: int = 50) -> tuple[Goal, ...]:
        """Return goals: first all that are open, then those that ended, each newest first."""
        by_age = sorted(self._book.missions.values(), key=lambda m: (m.ended, -m.order))
        return tuple(goal_of(self._book, mission) for mission in by_age[: max(0, limit)])

    def path(self) -> Leg | None:
        """Return the leg that is driven now, with its whole path."""
        return self._loop.leg

    def subscribe(self) -> Subscription:
        """Iterate over (seq, event) from now on; take a ``snapshot`` after, and drop older seqs."""
        return self._loop.hub.subscribe()

    def snapshot(self) -> dict[str, Any]:
        """Return where everything stands, with the seq of the newest event it contains."""
        status = self._book.status
        return {
            "seq": self._loop.hub.seq,
            "planner_id": self.planner_id,
            "running": self._book.running,
            "queue": list(self._book.queue),
            "goals": [goal.model_dump(mode="json") for goal in self.goals()],
            "status": status.model_dump(mode="json") if status is not None else None,
        }

    @property
    def _book(self) -> Book:
        return self._loop.book
