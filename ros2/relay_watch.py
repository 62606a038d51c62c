"""Remember what the relay says, what its clock shows, and whether there is another. Pure."""

from __future__ import annotations

import logging
from math import inf
from typing import TYPE_CHECKING

from ros2.operations import plain_type
from ros2.ros_clock import RosClock
from ros2.trouble import Ros2Trouble, known_code

if TYPE_CHECKING:
    from ros2.robot_words import RelayState

log = logging.getLogger("ros2")

SILENT_S = 0.5
"""A relay that was not heard for so long may be followed by another."""
BOTH_S = 2.0
"""So long after two relays spoke by turns neither is believed."""


class RelayWatch:
    """Hold the newest state of the one relay that may be driven by."""

    def __init__(self, cmd_vel: str, topic: str, *, has_key: bool) -> None:
        self._cmd_vel, self._topic, self._has_key = cmd_vel, topic, has_key
        self.clock = RosClock()
        self.state: RelayState | None = None
        self._heard_s = self._other_s = self._both_s = -inf
        self._other = ""

    def forget(self) -> None:
        """Begin anew: another robot may stand behind the next connection."""
        self.state = None
        self._heard_s = self._other_s = self._both_s = -inf
        self.clock.reset()

    def hear(self, state: RelayState, now_s: float) -> None:
        """Take a state; of another relay only where the one that is known has fallen silent."""
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
            log.info("relay %s on %s", state.relay, self._topic)
            self._other_s = -inf
            self.clock.reset()
        self.clock.note(state.ros, now_s)
        self.state, self._heard_s = state, now_s

    def refusal(self, now_s: float, kind: str = "") -> Ros2Trouble | None:
        """Return why this relay may not be driven by, or its words not be believed.

        Args:
            now_s: the time.
            kind: the type of cmd_vel as the graph says it; empty where it was not asked.
        """
        relay = self.state
        if relay is None:
            return None
        if now_s - self._both_s <= BOTH_S:
            found = f"{relay.relay} and {self._other} speak by turns on {self._topic}"
            return Ros2Trouble("ros2_two_robots", found)
        if relay.keyed and not self._has_key:
            return Ros2Trouble(
                "ros2_relay_key", "the relay obeys only commands signed with its key"
            )
        if relay.code is not None:
            return Ros2Trouble(known_code(relay.code), relay.found)
        if relay.others > 0:
            found = f"{relay.others} more publish on {self._cmd_vel}"
            return Ros2Trouble("ros2_cmd_vel_shared", found)
        if not relay.cmd_vel:
            return Ros2Trouble("ros2_no_base", f"the relay finds nobody on {self._cmd_vel}")
        if kind and plain_type(kind) != plain_type(relay.cmd_vel):
            found = f"the graph says that {self._cmd_vel} is {kind}, the relay publishes"
            return Ros2Trouble("ros2_relay_disagrees", f"{found} {relay.cmd_vel}")
        return None
