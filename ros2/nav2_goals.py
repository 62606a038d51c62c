"""Give Nav2 the planner's goals, and tell the planner what becomes of them. Pure; told the time.

A goal goes out on /goal_pose, which every Nav2 hears over every transport; which of Nav2's action
goals came of it is read from the action's status topic. To cancel is to send Nav2 where the robot
stands: the one way that needs no service. Nothing here moves a wheel: Nav2's twists are handed to
the planner, and go through the bridge or nowhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, inf, sin
from typing import TYPE_CHECKING, Final

from ros2.operations import Advertise, Publish, Subscribe, TopicMessage, UnreadableMessage
from ros2.trouble import Ros2Trouble
from ros2.twist_topic import TwistTopic
from wire.nav2_dialogue import UNASKED_S, Nav2Goal, Nav2Phase, Nav2State

if TYPE_CHECKING:
    from ros2.operations import Answer, Message, Request
    from wire.geometry import Pose2
    from wire.ros2_config import Nav2Config, Ros2Config

POSE_STAMPED: Final = "geometry_msgs/msg/PoseStamped"
STATUS_ARRAY: Final = "action_msgs/msg/GoalStatusArray"
SETTLE_S = 1.0
"""Before the first goal: goals of before are told by then, and Nav2 has met our publisher."""
AGAIN_S = 2.0
"""What Nav2 does not take up is said again so often."""
PHASES: Final[dict[int, Nav2Phase]] = {
    1: "driving", 2: "driving", 3: "driving", 4: "succeeded", 5: "cancelled", 6: "aborted",
}  # fmt: skip
"""By action_msgs/GoalStatus: accepted, executing, cancelling, succeeded, cancelled, aborted."""
MOST_GOALS = 64
"""Nav2 forgets what ended; more than so many goals at once is no Nav2."""


@dataclass(frozen=True, slots=True)
class _ActionGoal:
    ident: str
    stamp: tuple[int, int]
    phase: Nav2Phase | None


@dataclass(frozen=True, slots=True)
class _SentGoal:
    """Hold the goal that was published last for the planner."""

    order: Nav2Goal
    known: frozenset[str]
    """The action's goals that were there before it."""


class Nav2Goals:
    """Hold the dialogue of one planner with one Nav2."""

    def __init__(self, ros2: Ros2Config, nav2: Nav2Config, boot_id: str) -> None:
        self._nav2, self._boot_id = nav2, boot_id
        self._topic = TwistTopic(ros2, nav2.cmd_vel)
        self._joined_s: float | None = None
        self._is_told = False
        self._order: Nav2Goal | None = None
        self._ordered_s = self._published_s = self._refused_s = -inf
        self._sent: _SentGoal | None = None
        self._mine = ""
        self._goals: dict[str, _ActionGoal] = {}
        self._phase: Nav2Phase = "idle"
        self._since_s = 0.0
        self._unreadable = ""
        self._twists = self._seq = 0

    def open(self, now_s: float) -> None:
        """Begin anew on a connection; what was sent before may never have come."""
        self._topic.open()
        self._joined_s, self._is_told = now_s, False
        self._goals.clear()
        self._forget(now_s)

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now."""
        self._topic.close(trouble)
        self._joined_s = None

    def take(self, order: Nav2Goal, now_s: float) -> None:
        """Hear the planner; its newest word counts."""
        self._order, self._ordered_s = order, now_s

    def hear(self, said: Answer | None, now_s: float) -> list[Request]:
        """Take one answer of the graph; return the subscription that it asks for."""
        if self._topic.hear(said, now_s):
            self._twists += 1
        if isinstance(said, TopicMessage) and said.topic == self._nav2.status:
            self._hear_status(said.message, now_s)
        elif isinstance(said, UnreadableMessage) and said.topic == self._nav2.status:
            self._refuse(said.reason, now_s)
        return self._topic.subscribe(said)

    def due(self, now_s: float) -> list[Request]:
        """Return what is to be said to the graph now."""
        if self._joined_s is None:
            return []
        requests: list[Request] = [] if self._topic.is_sound else self._topic.due(now_s)
        if not self._is_told:
            self._is_told = True
            requests += [
                Advertise(self._nav2.goal_pose, POSE_STAMPED),
                Subscribe(self._nav2.status, STATUS_ARRAY, keeps=True),
            ]
        if now_s - self._joined_s < SETTLE_S:
            return requests
        wanted = self._standing_order(now_s)
        if wanted is not None:
            return requests + self._pursue(wanted, now_s)
        return requests + self._call_off(now_s)

    def state(self, now_s: float) -> Nav2State:
        """Return what the planner is told."""
        self._seq += 1
        trouble, twist = self._trouble(now_s), self._topic.fresh(now_s)
        order = self._sent.order if self._sent is not None else None
        return Nav2State(
            boot_id=self._boot_id,
            seq=self._seq,
            mission=order.mission if order is not None else None,
            leg=order.leg if order is not None else 0,
            phase=self._phase,
            phase_s=max(0.0, now_s - self._since_s),
            twist=self._twists if twist is not None else 0,
            twist_age_s=max(0.0, now_s - twist.came_s) if twist is not None else 0.0,
            v_mps=twist.v_mps if twist is not None else 0.0,
            w_radps=twist.w_radps if twist is not None else 0.0,
            code=trouble.code if trouble is not None else None,
            detail=trouble.detail if trouble is not None else "",
        )

    @property
    def twists(self) -> int:
        """Return how many twists came."""
        return self._twists

    def _trouble(self, now_s: float) -> Ros2Trouble | None:
        if now_s - self._refused_s <= AGAIN_S:
            return Ros2Trouble("ros2_unreadable", f"{self._nav2.status}: {self._unreadable}")
        return self._topic.trouble(now_s)

    def _standing_order(self, now_s: float) -> Nav2Goal | None:
        """Return the order that stands; a planner that fell silent wants nothing."""
        order = self._order
        spoke = now_s - self._ordered_s <= UNASKED_S
        return order if spoke and order is not None and order.goal is not None else None

    def _pursue(self, order: Nav2Goal, now_s: float) -> list[Request]:
        sent = self._sent
        if sent is None or _ident(sent.order) != _ident(order):
            self._sent = _SentGoal(order, frozenset(self._goals))
            self._mine = ""
            self._enter("sent", now_s)
        elif self._phase != "sent" or now_s - self._published_s < AGAIN_S:
            return []
        return self._publish(order.goal, now_s)

    def _call_off(self, now_s: float) -> list[Request]:
        """Send Nav2 to where the robot stands, until what it was asked for has ended."""
        if self._phase not in ("sent", "driving") and not self._drives_mine():
            self._forget(now_s)
            return []
        if self._phase in ("sent", "driving"):
            self._enter("cancelled", now_s)
            self._published_s = -inf
        here = self._order.here if self._order is not None else None
        if here is None or now_s - self._published_s < AGAIN_S:
            return []
        return self._publish(here, now_s)

    def _drives_mine(self) -> bool:
        goal = self._goals.get(self._mine)
        return goal is not None and goal.phase == "driving"

    def _publish(self, pose: Pose2 | None, now_s: float) -> list[Request]:
        if pose is None:
            return []
        self._published_s = now_s
        return [Publish(self._nav2.goal_pose, pose_stamped(self._nav2.frame, pose))]

    def _hear_status(self, message: Message, now_s: float) -> None:
        try:
            goals = {goal.ident: goal for goal in read_goals(message)}
        except (TypeError, ValueError, KeyError, AttributeError, OverflowError) as error:
            self._refuse(f"no list of goals: {error}", now_s)
            return
        self._goals = goals
        sent = self._sent
        if sent is None:
            return
        if not self._mine:
            new = [goal for goal in goals.values() if goal.ident not in sent.known]
            self._mine = max(new, key=lambda goal: goal.stamp).ident if new else ""
        mine = goals.get(self._mine)
        if mine is not None and mine.phase is not None and self._phase in ("sent", "driving"):
            self._enter(mine.phase, now_s)

    def _refuse(self, why: str, now_s: float) -> None:
        self._unreadable, self._refused_s = why[:200], now_s

    def _enter(self, phase: Nav2Phase, now_s: float) -> None:
        if phase != self._phase:
            self._phase, self._since_s = phase, now_s

    def _forget(self, now_s: float) -> None:
        self._sent, self._mine = None, ""
        self._enter("idle", now_s)


def _ident(order: Nav2Goal) -> tuple[str, str | None, int]:
    return order.planner_id, order.mission, order.leg


def pose_stamped(frame: str, pose: Pose2) -> Message:
    """Return a pose as geometry_msgs/PoseStamped, of no particular time: the newest transform."""
    half = pose.yaw_rad / 2.0
    return {
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": frame},
        "pose": {
            "position": {"x": pose.x_m, "y": pose.y_m, "z": 0.0},
            "orientation": {"x": 0.0, "y": 0.0, "z": sin(half), "w": cos(half)},
        },
    }


def read_goals(message: Message) -> list[_ActionGoal]:
    """Return the goals of a GoalStatusArray; an id comes as numbers, or in base64 from rosbridge.

    Raises:
        TypeError, ValueError, KeyError, AttributeError, OverflowError: it is none.
    """
    goals = []
    for one in message["status_list"][:MOST_GOALS]:
        info = one["goal_info"]
        stamp, uuid = info["stamp"], info["goal_id"]["uuid"]
        ident = uuid if isinstance(uuid, str) else bytes(uuid).hex()
        order = int(stamp["sec"]), int(stamp["nanosec"])
        goals.append(_ActionGoal(ident[:64], order, PHASES.get(int(one["status"]))))
    return goals
