"""Remember what the robot's node says, what its clock shows, and whether there is another. Pure."""

from __future__ import annotations

import logging
from math import inf
from typing import TYPE_CHECKING

from devices.clock import SensorClock
from ros2.robot_words import Unreadable
from ros2.trouble import Ros2Trouble, known_code

if TYPE_CHECKING:
    from ros2.robot_words import RelayState

log = logging.getLogger("ros2")

SILENT_S = 0.5
"""A node that was not heard for so long may be followed by another."""
BOTH_S = 2.0
"""So long after two nodes spoke by turns neither is believed."""
OLDEST_S, NEWEST_S = 1.0, 0.05
"""How far from the node's clock a stamp may lie; beyond, it is another clock's."""


class RosClock:
    """Put stamps of the robot's ROS clock onto ours, by the least delayed of its node's states.

    Scans take a turn and odometry a while before they are sent, so their own arrivals would date
    them too young; the node says what its clock shows as it sends.
    """

    def __init__(self) -> None:
        self._clock = SensorClock()

    def reset(self) -> None:
        """Forget what was learnt: another node speaks."""
        self._clock.reset()

    def note(self, ros_s: float, now_s: float) -> None:
        """Take what the node's clock showed in a state that came now."""
        self._clock.note(ros_s, now_s)

    def date(self, ros_s: float, now_s: float) -> float:
        """Return when a stamp of the robot's ROS clock was, on ours.

        Raises:
            Unreadable: no node has spoken, or the stamp is of another clock than its.
        """
        placed_s = self._clock.date(ros_s, inf)
        if placed_s is None:
            raise Unreadable("it came before the node's clock was known")
        if not -OLDEST_S <= placed_s - now_s <= NEWEST_S:
            raise Unreadable(
                f"its stamp lies {placed_s - now_s:+.3g} s from the node's clock, expected "
                f"{-OLDEST_S:g} to {NEWEST_S:g}"
            )
        return max(0.0, min(placed_s, now_s))


class RelayWatch:
    """Hold the newest state of the one node that may be driven by."""

    def __init__(self, peer: str, *, has_key: bool) -> None:
        self._peer, self._has_key = peer, has_key
        self.clock = RosClock()
        self.state: RelayState | None = None
        self._heard_s = self._other_s = self._both_s = -inf
        self._other = ""

    def forget(self) -> None:
        """Begin again: another robot may stand behind the next connection."""
        self.state = None
        self._heard_s = self._other_s = self._both_s = -inf
        self.clock.reset()

    def hear(self, state: RelayState, now_s: float) -> None:
        """Take a state; of another node only where the one that is known has fallen silent."""
        last = self.state
        if last is not None and state.relay != last.relay and now_s - self._heard_s <= SILENT_S:
            self._other, self._other_s = state.relay, now_s
            return
        if last is not None and state.relay == last.relay:
            if state.seq <= last.seq:
                return
            if now_s - self._other_s <= SILENT_S:
                self._both_s = now_s
        else:
            log.info("%s at %s", state.relay, self._peer)
            self._other_s = -inf
            self.clock.reset()
        self.clock.note(state.ros, now_s)
        self.state, self._heard_s = state, now_s

    def refusal(self, now_s: float) -> Ros2Trouble | None:
        """Return why this node may not be driven by, or its words not be believed."""
        relay = self.state
        if relay is None:
            return None
        if now_s - self._both_s <= BOTH_S:
            found = f"{relay.relay} and {self._other} speak by turns at {self._peer}"
            return Ros2Trouble("ros2_two_robots", found)
        if relay.keyed and not self._has_key:
            return Ros2Trouble("ros2_relay_key", "the node obeys only commands signed with its key")
        if relay.code is not None:
            return Ros2Trouble(known_code(relay.code), relay.found)
        if relay.others > 0:
            found = f"{relay.others} more publish on the base's cmd_vel"
            return Ros2Trouble("ros2_cmd_vel_shared", found)
        if not relay.cmd_vel:
            return Ros2Trouble("ros2_no_base", "the node finds nobody on the base's cmd_vel")
        return None
