"""Name what a command to the planner itself needs of the missions: their book, and obedience."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from planner.mission.errors import MissionError
    from planner.mission.events import Command
    from planner.mission.state import MissionState


class GoalBook(Protocol):
    """Tell where all goals stand, and obey commands about them, as the loop does."""

    @property
    def book(self) -> MissionState:
        """Return where all goals stand."""

    @property
    def status_age_s(self) -> float:
        """Return the age of the bridge's newest status."""

    def obey(self, command: Command) -> MissionError | None:
        """Obey a command at once, or return why it can't be obeyed."""
