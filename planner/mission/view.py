"""Show missions as the API does. Reads the book, changes nothing."""

from __future__ import annotations

from datetime import UTC, datetime

from planner.mission.records import Book, Mission
from planner.plan import Goal


def goal_of(book: Book, mission: Mission) -> Goal:
    """Return a mission as a goal, with its place in the queue."""
    position = book.queue.index(mission.id) if mission.id in book.queue else None
    return Goal(
        id=mission.id,
        text=mission.text,
        language=mission.language,
        state=mission.state,
        reason="held" if mission.held and mission.reason is None else mission.reason,
        plan=mission.plan,
        outcome=mission.outcome,
        brain=mission.brain,
        position=position,
        created=datetime.fromtimestamp(mission.created_unix_s, UTC),
        updated=datetime.fromtimestamp(mission.updated_unix_s, UTC),
    )
