"""Bring Nav2's velocity to the bridge as an external brain's: owned, granted, never repeated. Pure.

Each twist is said at most once, with the newest status as what it has seen: silence is how Nav2
says that it has died, and the bridge's lease of 0.25 s then stops the robot. A standstill that Nav2
asks for lets the dead-man go; what moves after a pause is a mission of its own.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from ros2.transport import NOTHING_MADE, LinkMessages
from ros2.twist_topic import TwistTopic
from wire import Grant, Heartbeat, Hello, Mode, Velocity, VelocitySequence, keys

if TYPE_CHECKING:
    from ros2.operations import Answer, Request
    from ros2.trouble import Ros2Trouble
    from wire import Record, Status
    from wire.keys import Key
    from wire.ros2_config import Ros2Config

PERIOD_S = 0.045
"""20 Hz and its jitter: the bridge counts seven in 250 ms as a flood."""
PAUSE_S = 1.0
"""After so long without motion what comes is another goal of Nav2's."""
METRES, SECONDS = 60.0, 600.0


class Nav2Velocity:
    """Hear one topic and say what an external brain says to the bridge. Told the time."""

    def __init__(self, ros2: Ros2Config, topic: str, planner_id: str, robot_hash: str) -> None:
        self._topic = TwistTopic(ros2, topic)
        self._me, self._robot_hash = planner_id, robot_hash
        self._said_s = self._spoken_s = self._moved_s = -inf
        self._missions = 0
        self._numbers = VelocitySequence()

    def open(self, _now_s: float) -> None:
        """Begin anew: another robot may stand behind this connection."""
        self._topic.open()

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now: nothing is said any more."""
        self._topic.close(trouble)

    def due(self, now_s: float) -> list[Request]:
        """Return what is to be asked of the graph."""
        return self._topic.due(now_s)

    def hear(self, said: Answer | None, now_s: float) -> LinkMessages:
        """Take one answer of the graph; nothing of the wire comes of it at once."""
        came, twist = self._topic.hear(said, now_s), self._topic.twist
        moves = came and twist is not None and not twist.is_still
        if moves and now_s - self._moved_s > PAUSE_S:
            self._missions += 1
            self._moved_s = now_s
        return NOTHING_MADE

    def subscribe(self, said: Answer | None) -> list[Request]:
        """Return the subscription that a topic's type asks for, once."""
        return self._topic.subscribe(said)

    @property
    def refusal_count(self) -> int:
        """Return how many messages could not be read."""
        return self._topic.refused

    def trouble(self, now_s: float) -> Ros2Trouble | None:
        """Return what keeps velocities away; None while they come."""
        return self._topic.trouble(now_s)

    def answer(self, status: Status) -> list[tuple[Key[Record], Record]]:
        """Return what an owner says on each status."""
        said: list[tuple[Key[Record], Record]] = []
        owner = status.owner
        if owner is None or owner.planner_id != self._me:
            if owner is None and status.map_id is not None:
                said.append((_widened_key(keys.HELLO), self._hello(status, status.map_id)))
            return said
        now = {"planner_id": self._me, "epoch": status.epoch, "seen": status.seq}
        said.append((_widened_key(keys.HEARTBEAT), Heartbeat(**now, used=status.seq)))
        twist = self._topic.twist
        wants = twist is not None and not twist.is_still and self._topic.is_sound
        is_new = status.grant is None or status.grant.mission != self._mission()
        free = status.held is None and status.mode in (Mode.HOLD, Mode.ACTIVE)
        if wants and is_new and free:
            grant = Grant(**now, mission=self._mission(), metres=METRES, seconds=SECONDS)
            said.append((_widened_key(keys.GRANT), grant))
        return said

    def velocity(self, status: Status, now_s: float) -> Velocity | None:
        """Return the newest twist as the bridge hears it, once; None: nothing is to be said."""
        twist = self._topic.fresh(now_s)
        owned = status.owner is not None and status.owner.planner_id == self._me
        if twist is None or not owned or now_s - self._said_s < PERIOD_S:
            return None
        if twist.came_s == self._spoken_s or status.grant is None:
            return None
        self._spoken_s = twist.came_s
        if not twist.is_still:
            self._moved_s = now_s
        self._said_s = now_s
        return Velocity(
            source_id=self._me,
            epoch=status.epoch,
            seq=self._numbers.take_next(status.epoch),
            seen=status.seq,
            v_mps=twist.v_mps,
            w_radps=twist.w_radps,
            dead_man=not twist.is_still,
        )

    def _mission(self) -> str:
        return f"{self._me}-{self._missions}"

    def _hello(self, status: Status, map_id: str) -> Hello:
        return Hello(
            planner_id=self._me,
            kind="external",
            seen=status.seq,
            protocol=status.protocol,
            robot_hash=self._robot_hash,
            fence_hash=status.fence_hash,
            map_id=map_id,
        )


def _widened_key(key: object) -> Key[Record]:
    return key  # type: ignore[return-value]  # a Key only ever produces its message
