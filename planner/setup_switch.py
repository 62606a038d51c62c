"""Leave the robot to set-up: this process ends with a status that its starter knows."""

from __future__ import annotations


class ProcessSwitch:
    """Remember that an operator asked for set-up; the planner's watch ends the process then."""

    def __init__(self, *, is_there: bool) -> None:
        self.is_there = is_there
        """Whether who started this process starts set-up in its place."""
        self.is_thrown = False

    def throw(self) -> None:
        """Ask for it."""
        self.is_thrown = self.is_there
