"""Say why a request to the missions was not taken, by stable code, in both languages."""

from __future__ import annotations

from planner.language.catalogue import list_names, say, say_or_quote
from planner.mission.state import RESERVED_KEYS
from planner.plan import Bilingual, GoalState


class MissionError(Exception):
    """Refuse a request; nothing changed. ``code`` is stable, ``message`` is for people."""

    code = "mission_error"

    def __init__(self, **facts: str | int | Bilingual) -> None:
        self.message: Bilingual = say(f"refusal.{self.code}", **facts)
        super().__init__(f"{self.code}: {self.message.en}")


class UnknownGoal(MissionError):
    """There is no goal of that id."""

    code = "unknown_goal"

    def __init__(self, goal_id: str, known: tuple[str, ...]) -> None:
        newest = ", ".join(known[-5:]) or say("refusal.no_goals")
        self.goal_id, shown = goal_id, goal_id[:64]
        super().__init__(shown=shown, newest=newest)


class BadState(MissionError):
    """The goal is not in a state in which that can be asked."""

    code = "bad_state"

    def __init__(self, goal_id: str, what: str, state: GoalState, allowed: tuple[str, ...]) -> None:
        super().__init__(
            what=say_or_quote("goal_act", what),
            goal_id=goal_id,
            state=say_or_quote("goal_state", state.value),
            needs=list_names(say_or_quote("goal_state", each) for each in allowed),
        )


class NothingToResume(MissionError):
    """No goal is paused and none is kept waiting."""

    code = "nothing_to_resume"


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


class ReservedKey(MissionError):
    """The Idempotency-Key begins like those of the goals that standing orders give."""

    code = "idempotency_reserved"

    def __init__(self, key: str) -> None:
        super().__init__(key=key[:64], prefix=RESERVED_KEYS)


class NotOwnGoal(MissionError):
    """An agent asks something of a goal that it did not give."""

    code = "not_own_goal"

    def __init__(self, goal_id: str) -> None:
        super().__init__(shown=goal_id[:64])


class PersonMissing(MissionError):
    """An agent asks for what is a person's alone."""

    code = "person_needed"


class JournalDown(MissionError):
    """The journal cannot be written, so no goal may start."""

    code = "journal_unavailable"

    def __init__(self, trouble: str | None) -> None:
        """Take what the system says; None: the disk was only too slow."""
        slow = say("refusal.disk_slow")
        super().__init__(why=slow if trouble is None else say("refusal.disk_fails", why=trouble))
