"""Give the reducer its one working copy: changes collect here, effects queue here, then both leave.

Local to one ``advance``; outside it nothing is mutable.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from planner.mission.activity import Driving
from planner.mission.effects import Effect, GoalChange, Journal
from planner.mission.state import MAX_ENDED, Mission, MissionState
from planner.mission.transitions import Cause, ForbiddenTransition, next_state
from planner.plan import StepRecord


class Transaction:
    """Work on one event."""

    def __init__(self, book: MissionState, now_s: float) -> None:
        self._before = book
        self.book = book
        self.now_s = now_s
        self._effects: list[Effect] = []

    def emit(self, effect: Effect) -> None:
        """Queue an effect."""
        self._effects.append(effect)

    def set(self, **changes: Any) -> None:
        """Change fields of the book."""
        self.book = replace(self.book, **changes)

    def mission(self, mission_id: str | None) -> Mission | None:
        """Return a mission, or None."""
        return self.book.missions.get(mission_id) if mission_id is not None else None

    @property
    def running(self) -> Mission | None:
        """Return the mission that has the robot, or None."""
        return self.book.running_goal

    @property
    def at_work(self) -> Mission:
        """Return the mission that has the robot, for what is done in its name alone.

        Raises:
            KeyError: none has it.
        """
        return self.book.missions[self.book.running or ""]

    @property
    def now_unix_s(self) -> float:
        """Return the time by the wall clock."""
        return self.now_s + self.book.wall_offset_s

    def put(self, mission: Mission, **changes: Any) -> Mission:
        """Keep a mission with changes, stamped. Its state is changed by ``move_to`` alone.

        Raises:
            ForbiddenTransition: ``changes`` name another state.
        """
        if changes.get("state", mission.state) is not mission.state:
            raise ForbiddenTransition("the state is changed by move_to, with its cause")
        return self._keep(mission, changes)

    def put_steps(self, mission: Mission, steps: tuple[StepRecord, ...]) -> Mission:
        """Keep a mission with other records of its plan's steps; without a plan, as it is."""
        if mission.plan is None:
            return mission
        return self.put(mission, plan=mission.plan.model_copy(update={"steps": steps}))

    def move_to(self, mission: Mission, cause: Cause, **changes: Any) -> Mission:
        """Bring a mission into the state that the table gives for a cause, with changes.

        Raises:
            ForbiddenTransition: the table gives none.
        """
        return self._keep(mission, {**changes, "state": next_state(mission.state, cause)})

    def _keep(self, mission: Mission, changes: dict[str, Any]) -> Mission:
        # Wall clocks step back; a record's times never do.
        changes["updated_unix_s"] = max(self.now_unix_s, mission.updated_unix_s)
        changed = mission.model_copy(update=changes)
        self.set(missions={**self.book.missions, mission.id: changed})
        return changed

    @property
    def driving(self) -> Driving | None:
        """Return the leg that the running step drives, or None where it does something else."""
        activity = self.book.activity
        return activity if isinstance(activity, Driving) else None

    @property
    def leg(self) -> Driving:
        """Return the leg that the running step drives, for what is done to it alone.

        Raises:
            TypeError: it does something else.
        """
        if not isinstance(self.book.activity, Driving):
            raise TypeError(f"no leg is driven, but {self.book.activity!r}")
        return self.book.activity

    def change(self, **changes: Any) -> None:
        """Change fields of the running step's activity, if it has one."""
        activity = self.book.activity
        if activity is None:
            return
        if any(getattr(activity, name) != value for name, value in changes.items()):
            self.set(activity=replace(activity, **changes))

    @property
    def next_entry(self) -> int:
        """Return the journal entry that will hold what this turn changes."""
        return self.book.written + 1

    def take_ticket(self) -> int:
        """Return the number of a question that is asked now."""
        self.set(tickets=self.book.tickets + 1)
        return self.book.tickets

    def close(self) -> tuple[MissionState, tuple[Effect, ...]]:
        """Journal what changed, before anything else is asked; forget the oldest ended goals."""
        before = self._before.missions
        changed = tuple(m for i, m in self.book.missions.items() if before.get(i) is not m)
        if changed:
            self.set(written=self.next_entry)
            journal = Journal(self.book.written, changed, self.book.queue)
            self._effects = [journal, *self._effects, *(GoalChange(m.id) for m in changed)]
            self._forget()
        return self.book, tuple(self._effects)

    def _forget(self) -> None:
        ended = [m for m in self.book.missions.values() if m.has_ended]
        if len(ended) > MAX_ENDED:
            ended.sort(key=lambda m: m.order)
            gone = {m.id for m in ended[: len(ended) - MAX_ENDED]}
            self.set(missions={i: m for i, m in self.book.missions.items() if i not in gone})
