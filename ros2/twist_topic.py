"""Hear the velocity that Nav2 says on one topic, as the graph names its type. Pure; told the time.

A topic of another type, or of two publishers, is not heard; a twist that is no number, sideways or
older than 0.25 s by its own stamp is none.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from devices.clock import SensorClock
from ros2.graph import TWIST, TWIST_STAMPED
from ros2.messages import stamp_of
from ros2.operations import (
    AskType,
    NoAnswer,
    Subscribe,
    TopicMessage,
    TopicType,
    UnreadableMessage,
    plain_type,
)
from ros2.robot_words import Unreadable
from ros2.trouble import STARTING, Ros2Trouble
from wire.geometry import MAX_SPEED_MPS, MAX_TURN_RADPS

if TYPE_CHECKING:
    from ros2.operations import Answer, Message, Request
    from wire.ros2_config import Ros2Config

ASK_S = 2.0
OLD_S = 0.25
"""A twist older than this is not said: by its stamp where it has one, by its waiting here else."""
REFUSED_S = 2.0
"""So long a message that could not be read is told of."""
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


class TwistTopic:
    """Hold the newest twist of one topic."""

    def __init__(self, ros2: Ros2Config, topic: str) -> None:
        self._ros2, self._topic = ros2, topic
        self._closed: Ros2Trouble | None = Ros2Trouble(STARTING, f"{ros2.peer}: not reached yet")
        self._kind, self._wrong = "", Ros2Trouble(STARTING, f"{topic}: not heard yet")
        self.is_sound = False
        """Whether the topic has a right type and one publisher now."""
        self._asked_s = self._refused_s = -inf
        self._clock = SensorClock()
        self.twist: Twist | None = None
        self.refused = 0

    def open(self) -> None:
        """Begin anew: another robot may stand behind this connection."""
        self._closed, self._kind, self.twist, self._asked_s = None, "", None, -inf
        self.is_sound = False
        self._wrong = Ros2Trouble(STARTING, f"{self._topic}: not heard yet")
        self._clock.reset()

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now: nothing is said any more."""
        self._closed, self.twist = trouble, None

    def due(self, now_s: float) -> list[Request]:
        """Return what is to be asked of the graph."""
        if self._closed is not None or now_s - self._asked_s < ASK_S:
            return []
        self._asked_s = now_s
        return [AskType(self._topic)]

    def hear(self, said: Answer | None, now_s: float) -> bool:
        """Take one answer of the graph; return whether a twist came with it."""
        if isinstance(said, TopicMessage) and said.topic == self._topic and self.is_sound:
            try:
                self.twist = self._read(said.message, now_s)
            except Unreadable as why:
                self._refuse(str(why), now_s)
            return self.twist is not None
        if isinstance(said, UnreadableMessage) and said.topic == self._topic:
            self._refuse(said.reason, now_s)
        return False

    def subscribe(self, said: Answer | None) -> list[Request]:
        """Return the subscription that a topic's type asks for, once."""
        if not isinstance(said, TopicType | NoAnswer) or said.topic != self._topic:
            return []
        wrong = self._judge(said)
        self.is_sound = wrong is None
        if isinstance(said, NoAnswer) or wrong is not None:
            self._wrong, self.twist = wrong or self._wrong, None
            return []
        kind = TWIST if plain_type(said.kind) == plain_type(TWIST) else TWIST_STAMPED
        if self._kind == kind:
            return []
        self._kind = kind
        return [Subscribe(self._topic, kind)]

    def fresh(self, now_s: float) -> Twist | None:
        """Return the newest twist while it may still be said."""
        twist = self.twist
        return twist if twist is not None and now_s - twist.came_s <= OLD_S else None

    def trouble(self, now_s: float) -> Ros2Trouble | None:
        """Return what keeps velocities away; None while they come."""
        if self._closed is not None:
            return self._closed
        if self.fresh(now_s) is not None:
            return None
        was_refused = now_s - self._refused_s <= REFUSED_S
        return self._wrong if not self.is_sound or was_refused else None

    def _refuse(self, why: str, now_s: float) -> None:
        self.refused += 1
        self.twist, self._refused_s = None, now_s
        self._wrong = Ros2Trouble("ros2_unreadable", f"{self._topic}: {why}")

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
        return Twist(v, w, now_s)

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


def _number(parent: object, part: str, axis: str, most: float) -> float:
    inner = parent.get(part) if isinstance(parent, dict) else None
    value = inner.get(axis) if isinstance(inner, dict) else None
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not -most <= value <= most:  # type: ignore[operator]  # a number it is
        raise Unreadable(f"{part}.{axis} holds {repr(value)[:40]}, expected a speed")
    return float(value)  # type: ignore[arg-type]  # a number it is
