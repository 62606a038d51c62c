"""Leave the robot to set-up, or to this process's next start: its starter knows which."""

from __future__ import annotations


class ProcessSwitch:
    """Remember that a person asked for it; the planner's watch ends the process then."""

    def __init__(self, is_there: bool) -> None:
        self.is_there = is_there
        """Whether the starter of this process starts the other one in its place."""
        self.is_thrown = False

    def throw(self) -> None:
        """Ask for it."""
        self.is_thrown = self.is_there
