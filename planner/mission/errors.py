"""Say why a request to the missions was not taken, by stable code, in both languages."""

from __future__ import annotations

from planner.language.catalogue import say
from planner.plan import Bilingual, GoalState


class MissionError(Exception):
    """Refuse a request; nothing changed. ``code`` is stable, ``message`` is for people."""

    code = "mission_error"

    def __init__(self, **facts: str | int) -> None:
        self.message: Bilingual = say(f"refusal.{self.code}", **facts)
        super().__init__(f"{self.code}: {self.message.en}")


class UnknownGoal(MissionError):
    """There is no goal of that id."""

    code = "unknown_goal"

    def __init__(self, goal_id: str, known: tuple[str, ...]) -> None:
        newest = ", ".join(known[-5:]) or "none"
        shown = goal_id[:64]
        super().__init__(shown=shown, newest=newest)


class BadState(MissionError):
    """The goal is not in a state in which that can be asked."""

    code = "bad_state"

    def __init__(self, goal_id: str, what: str, state: GoalState, allowed: tuple[str, ...]) -> None:
        needs = ", ".join(allowed)
        super().__init__(what=what, goal_id=goal_id, state=state.value, needs=needs)


class NothingToResume(MissionError):
    """No goal is paused and none is kept waiting."""

    code = "nothing_to_resume"

    def __init__(self) -> None:
        super().__init__()


class QueueFull(MissionError):
    """As many goals wait as may wait."""

    code = "queue_full"

    def __init__(self, waiting: int) -> None:
        super().__init__(waiting=waiting)


class IdempotencyConflict(MissionError):
    """The same Idempotency-Key came with another request."""

    code = "idempotency_conflict"

    def __init__(self, key: str, goal_id: str) -> None:
        super().__init__(key=key[:64], goal_id=goal_id)


class JournalDown(MissionError):
    """The journal cannot be written, so no goal may start."""

    code = "journal_unavailable"

    def __init__(self, why: str) -> None:
        super().__init__(why=why)
