"""Say what the keeper of standing orders needs: goals that are given, and two clocks."""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from planner.orders.scheduler import ClockReading

if TYPE_CHECKING:
    from planner.mission.state import Mission, MissionState
    from planner.plan import Language, Step


class GoalGiver(Protocol):
    """Give goals, as ``planner.mission.standing_goals.StandingGoals`` does."""

    @property
    def book(self) -> MissionState: ...

    def publish(self, event: dict[str, Any]) -> None: ...

    def find(self, key: str) -> str | None: ...

    async def give(
        self, goal_id: str, text: str, language: Language, key: str, source: str,
        steps: tuple[Step, ...] = (),
    ) -> str: ...  # fmt: skip

    def outcome(self, goal_id: str) -> Mission | None: ...

    def waits(self, goal_id: str) -> bool: ...

    def cancel(self, goal_id: str) -> None: ...


def read_elapsed_s() -> float:
    """Return a monotonic time that goes on while the machine is suspended, where it has one [s]."""
    return time.clock_gettime(getattr(time, "CLOCK_BOOTTIME", time.CLOCK_MONOTONIC))


@dataclass(frozen=True, slots=True)
class OrderClocks:
    """Give the clocks, and ids."""

    monotonic: Callable[[], float] = time.monotonic
    """The missions' clock, by which a status is fresh: it stands while the machine is suspended."""
    unix: Callable[[], float] = time.time
    new_id: Callable[[], str] = lambda: f"g-{uuid.uuid4().hex[:12]}"
    elapsed: Callable[[], float] = read_elapsed_s
    """Beside it the wall clock is judged: a suspended hour is an hour, not a clock put on."""

    def read(self) -> ClockReading:
        """Return now on wall clock and elapsed time."""
        return ClockReading(self.unix(), self.elapsed())
