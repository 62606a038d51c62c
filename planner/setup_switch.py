"""Leave the robot to set-up, or to this process's next start: its starter knows which."""

from __future__ import annotations

from processes.service import is_supervised
from wire import EXIT_MAP, EXIT_SET_UP


class ProcessSwitch:
    """Remember that a person asked for it; the planner's watch ends the process then."""

    def __init__(self, is_there: bool, why: str = "", exit_status: int | None = None) -> None:
        """Take what the planner's end is to tell.

        Args:
            is_there: whether the starter of this process starts the other one in its place.
            why: told in the log.
            exit_status: tells the starter what to start; None: the same again.
        """
        self.is_there, self.why, self.exit_status = is_there, why, exit_status
        self.is_thrown = False

    def throw(self) -> None:
        """Ask for it."""
        self.is_thrown = self.is_there


def switches_of(
    may_set_up: bool, may_take_robot: bool, may_map: bool
) -> tuple[ProcessSwitch, ProcessSwitch, ProcessSwitch, ProcessSwitch]:
    """Return the ways in which a planner leaves its place to another start."""
    return (
        ProcessSwitch(may_set_up, "set-up takes the bridge's place", EXIT_SET_UP),
        ProcessSwitch(may_take_robot, "the home's own robot takes this one's place", EXIT_SET_UP),
        ProcessSwitch(may_map, "another map is taken up", EXIT_MAP),
        ProcessSwitch(is_supervised(), "the next start reads the settings again"),
    )
