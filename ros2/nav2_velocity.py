"""Bring Nav2's velocity to the bridge as an external brain's: owned, granted, never repeated. Pure.

Each twist is said at most once, with the newest status as what it has seen: silence is how Nav2
says that it has died, and the bridge's lease of 0.25 s then stops the robot. A standstill that Nav2
asks for lets the dead-man go; what moves after a pause is a mission of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from devices.clock import SensorClock
from ros2.graph import TWIST, TWIST_STAMPED
from ros2.messages import Unreadable, stamp_of
from ros2.operations import (
    AskType,
    NoAnswer,
    Subscribe,
    TopicMessage,
    TopicType,
    UnreadableMessage,
    plain_type,
)
from ros2.transport import NOTHING_MADE, LinkMessages
from ros2.trouble import STARTING, Ros2Trouble
from wire import Grant, Heartbeat, Hello, Mode, Velocity, keys
from wire.geometry import MAX_SPEED_MPS, MAX_TURN_RADPS

if TYPE_CHECKING:
    from ros2.operations import Answer, Message, Request
    from wire import Record, Status
    from wire.keys import Key
    from wire.ros2_config import Ros2Config

ASK_S = 2.0
PERIOD_S = 0.045
"""20 Hz and its jitter: the bridge counts seven in 250 ms as a flood."""
OLD_S = 0.25
"""A twist older than this is not said: by its stamp where it has one, by its waiting here else."""
PAUSE_S = 1.0
"""After so long without motion what comes is another goal of Nav2's."""
REFUSED_S = 2.0
"""So long a message that could not be read is told of."""
METRES, SECONDS = 60.0, 600.0
SIDEWAYS_MPS = 0.01
_STILL = 1e-4


@dataclass(frozen=True, slots=True)
class Twist:
    """Hold what Nav2 asks for, and when it came."""

    v_mps: float
    w_radps: float
    came_s: float

    @property
    def is_still(self) -> bool:
        """Return whether it asks to stand."""
        return abs(self.v_mps) < _STILL and abs(self.w_radps) < _STILL


class Nav2Velocity:
    """Hear one topic and say what an external brain says to the bridge. Told the time."""

    def __init__(self, ros2: Ros2Config, topic: str, planner_id: str, robot_hash: str) -> None:
        self._ros2, self._topic = ros2, topic
        self._me, self._robot_hash = planner_id, robot_hash
        self._closed: Ros2Trouble | None = Ros2Trouble(STARTING, f"{ros2.peer}: not reached yet")
        self._kind, self._wrong = "", Ros2Trouble(STARTING, f"{topic}: not heard yet")
        self._is_sound = False
        """Whether the topic has a right type and one publisher now."""
        self._asked_s = self._said_s = self._spoken_s = -inf
        self._moved_s = self._refused_s = -inf
        self._clock = SensorClock()
        self._twist: Twist | None = None
        self._missions, self._epoch, self._seq = 0, "", 0
        self.refused = 0

    def open(self, _now_s: float) -> None:
        """Begin anew: another robot may stand behind this connection."""
        self._closed, self._kind, self._twist, self._asked_s = None, "", None, -inf
        self._is_sound = False
        self._wrong = Ros2Trouble(STARTING, f"{self._topic}: not heard yet")
        self._clock.reset()

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now: nothing is said any more."""
        self._closed, self._twist = trouble, None

    def due(self, now_s: float) -> list[Request]:
        """Return what is to be asked of the graph."""
        if self._closed is not None or now_s - self._asked_s < ASK_S:
            return []
        self._asked_s = now_s
        return [AskType(self._topic)]

    def hear(self, said: Answer | None, now_s: float) -> LinkMessages:
        """Take one answer of the graph; nothing of the wire comes of it at once."""
        if isinstance(said, TopicMessage) and said.topic == self._topic and self._is_sound:
            try:
                self._twist = self._read(said.message, now_s)
            except Unreadable as why:
                self._refuse(str(why), now_s)
        elif isinstance(said, UnreadableMessage):
            self._refuse(said.reason, now_s)
        return NOTHING_MADE

    def subscribe(self, said: Answer | None) -> list[Request]:
        """Return the subscription that a topic's type asks for, once."""
        if not isinstance(said, TopicType | NoAnswer) or said.topic != self._topic:
            return []
        wrong = self._judge(said)
        self._is_sound = wrong is None
        if isinstance(said, NoAnswer) or wrong is not None:
            self._wrong, self._twist = wrong or self._wrong, None
            return []
        kind = TWIST if plain_type(said.kind) == plain_type(TWIST) else TWIST_STAMPED
        if self._kind == kind:
            return []
        self._kind = kind
        return [Subscribe(self._topic, kind)]

    def trouble(self, now_s: float) -> Ros2Trouble | None:
        """Return what keeps velocities away; None while they come."""
        if self._closed is not None:
            return self._closed
        if self._twist is not None and now_s - self._twist.came_s <= OLD_S:
            return None
        was_refused = now_s - self._refused_s <= REFUSED_S
        return self._wrong if not self._is_sound or was_refused else None

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
        wants = self._twist is not None and not self._twist.is_still and self._is_sound
        is_new = status.grant is None or status.grant.mission != self._mission()
        free = status.held is None and status.mode in (Mode.HOLD, Mode.ACTIVE)
        if wants and is_new and free:
            grant = Grant(**now, mission=self._mission(), metres=METRES, seconds=SECONDS)
            said.append((_widened_key(keys.GRANT), grant))
        return said

    def velocity(self, status: Status, now_s: float) -> Velocity | None:
        """Return the newest twist as the bridge hears it, once; None: nothing is to be said."""
        twist = self._twist
        owned = status.owner is not None and status.owner.planner_id == self._me
        if twist is None or not owned or now_s - self._said_s < PERIOD_S:
            return None
        fresh = now_s - twist.came_s <= OLD_S and twist.came_s != self._spoken_s
        if not fresh or status.grant is None:
            return None
        self._spoken_s = twist.came_s
        if not twist.is_still:
            self._moved_s = now_s
        if status.epoch != self._epoch:
            self._epoch, self._seq = status.epoch, 0
        self._seq += 1
        self._said_s = now_s
        return Velocity(
            source_id=self._me,
            epoch=status.epoch,
            seq=self._seq,
            seen=status.seq,
            v_mps=twist.v_mps,
            w_radps=twist.w_radps,
            dead_man=not twist.is_still,
        )

    def _refuse(self, why: str, now_s: float) -> None:
        self.refused += 1
        self._twist, self._refused_s = None, now_s
        self._wrong = Ros2Trouble("ros2_unreadable", f"{self._topic}: {why}")

    def _mission(self) -> str:
        return f"{self._me}-{self._missions}"

    def _read(self, message: Message, now_s: float) -> Twist | None:
        """Return a twist; None where it is too old by its own stamp."""
        inner = message.get("twist") if self._kind == TWIST_STAMPED else message
        v, sideways, w = (
            _number(inner, part, axis, most)
            for part, axis, most in (
                ("linear", "x", MAX_SPEED_MPS),
                ("linear", "y", MAX_SPEED_MPS),
                ("angular", "z", MAX_TURN_RADPS),
            )
        )
        if not abs(sideways) <= SIDEWAYS_MPS:
            raise Unreadable(f"linear.y {sideways:g}: a differential base can't go sideways")
        if self._kind == TWIST_STAMPED and (stamp_s := stamp_of(message)) > 0.0:
            placed_s = self._clock.note(stamp_s, now_s)
            if not now_s - placed_s <= OLD_S:
                return None
        if now_s - self._moved_s > PAUSE_S and (v or w):
            self._missions += 1
            self._moved_s = now_s
        return Twist(v, w, now_s)

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

    def _judge(self, said: TopicType | NoAnswer) -> Ros2Trouble | None:
        if isinstance(said, NoAnswer):
            return Ros2Trouble("ros2_no_rosapi", f"{self._ros2.peer}: {said.reason}")
        if not said.kind:
            return Ros2Trouble("ros2_topic_missing", f"the graph has no {self._topic}")
        if plain_type(said.kind) not in {plain_type(TWIST), plain_type(TWIST_STAMPED)}:
            found = f"{self._topic} is {said.kind}, expected {TWIST} or {TWIST_STAMPED}"
            return Ros2Trouble("ros2_cmd_vel_type", found)
        if said.publishers is not None and said.publishers > 1:
            found = f"{said.publishers} publish on {self._topic}, expected one"
            return Ros2Trouble("ros2_two_robots", found)
        return None


def _widened_key(key: object) -> Key[Record]:
    return key  # type: ignore[return-value]  # a Key only ever produces its message


def _number(parent: object, part: str, axis: str, most: float) -> float:
    inner = parent.get(part) if isinstance(parent, dict) else None
    value = inner.get(axis) if isinstance(inner, dict) else None
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not -most <= value <= most:  # type: ignore[operator]  # a number it is
        raise Unreadable(f"{part}.{axis} holds {repr(value)[:40]}, expected a speed")
    return float(value)  # type: ignore[arg-type]  # a number it is
