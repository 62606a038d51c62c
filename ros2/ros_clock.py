"""Put the robot's ROS clock onto ours, by the least delayed of the relay's states.

Scans take a turn and odometry a while before they are sent, so their own arrivals would date them
too young; the relay says what its clock shows as it sends.
"""

from __future__ import annotations

from math import inf

from devices.clock import SensorClock
from ros2.robot_words import Unreadable

OLDEST_S, NEWEST_S = 1.0, 0.05
"""How far from the relay's clock a stamp may lie; beyond, it is another clock's."""


class RosClock:
    """Date the stamps of one robot."""

    def __init__(self) -> None:
        self._clock = SensorClock()

    def reset(self) -> None:
        """Forget what was learnt: another relay speaks."""
        self._clock.reset()

    def note(self, ros_s: float, now_s: float) -> None:
        """Take what the relay's clock showed in a state that came now."""
        self._clock.note(ros_s, now_s)

    def date(self, ros_s: float, now_s: float) -> float:
        """Return when a stamp of the robot's ROS clock was, on ours.

        Raises:
            Unreadable: no relay has spoken, or the stamp is of another clock than its.
        """
        placed_s = self._clock.date(ros_s, inf)
        if placed_s is None:
            raise Unreadable("it came before the relay's clock was known")
        if not -OLDEST_S <= placed_s - now_s <= NEWEST_S:
            raise Unreadable(
                f"its stamp lies {placed_s - now_s:+.3g} s from the relay's clock, expected "
                f"{-OLDEST_S:g} to {NEWEST_S:g}"
            )
        return max(0.0, min(placed_s, now_s))
