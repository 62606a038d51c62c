"""Give Nav2 the planner's goals, and tell the planner what becomes of them. Pure; told the time.

A goal goes out on /goal_pose, which every Nav2 hears; which of Nav2's action goals came of it is
read from the action's status topic. To cancel is to send Nav2 where the robot stands: the one way
that needs no service. Nothing here moves a wheel: Nav2's twists are handed to the planner, and go
through the bridge or nowhere.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

from .graph_check import Trouble
from .readings import UnusableMessage, read_twist

UNASKED_S = 0.5
"""A planner that says nothing for so long wants nothing; it speaks twenty times a second."""
SETTLE_S = 1.0
"""Before the first goal: goals of before are told by then, and Nav2 has met our publisher."""
AGAIN_S = 2.0
"""What Nav2 does not take up is said again so often."""
OLD_S = 0.25
"""A twist older than this is not said: by its stamp where it has one, by its waiting here else."""
FASTEST_MPS, FASTEST_RADPS, SIDEWAYS_MPS = 5.0, 10.0, 0.01
PHASES = {1: "driving", 2: "driving", 3: "driving", 4: "succeeded", 5: "cancelled", 6: "aborted"}
"""By action_msgs/GoalStatus: accepted, executing, cancelling, succeeded, cancelled, aborted."""
MOST_GOALS = 64
"""Nav2 forgets what ended; more than so many goals at once is no Nav2."""
Pose = tuple[float, float, float]
"""x [m], y [m], yaw [rad] in the map."""


@dataclass(frozen=True)
class PlannerOrder:
    """Hold what the planner wants now; no goal: Nav2 is to end what it does."""

    planner: str
    mission: str | None
    leg: int
    goal: Pose | None
    here: Pose | None

    @property
    def ident(self) -> tuple[str, str | None, int]:
        """Return which leg this is of."""
        return self.planner, self.mission, self.leg


@dataclass(frozen=True)
class _PublishedGoal:
    order: PlannerOrder
    known: frozenset[str]
    """The action's goals that were there before it."""


def read_order(text: str) -> PlannerOrder:
    """Read a planner's order.

    Raises:
        UnusableMessage: it is none.
    """
    try:
        raw = json.loads(text)
        mission = None if raw["mission"] is None else str(raw["mission"])
        poses = [_pose(raw[name]) for name in ("goal", "here")]
        return PlannerOrder(str(raw["planner_id"]), mission, int(raw["leg"]), *poses)
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
        raise UnusableMessage(f"no order of the planner: {error}"[:200]) from None


@dataclass(frozen=True)
class ShownPlan:
    """Hold what people may look at: the bridge's mode, the way and the places in the map [m]."""

    mode: str
    held: str
    path: tuple[tuple[float, float], ...]
    places: tuple[tuple[str, float, float], ...]


def read_plan(text: str) -> ShownPlan:
    """Read what the planner shows.

    Raises:
        UnusableMessage: it is none.
    """
    try:
        raw = json.loads(text)
        path = tuple((float(x), float(y)) for x, y in raw["path"])
        places = tuple((str(p["name"]), float(p["x_m"]), float(p["y_m"])) for p in raw["places"])
        if not all(isfinite(x) and isfinite(y) for x, y in (*path, *(p[1:] for p in places))):
            raise ValueError("a point is not finite")
        return ShownPlan(str(raw["mode"]), str(raw["held"]), path, places)
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
        raise UnusableMessage(f"no plan of the planner: {error}"[:200]) from None


def _pose(raw: Any) -> Pose | None:
    if raw is None:
        return None
    x, y, yaw = (float(raw[name]) for name in ("x_m", "y_m", "yaw_rad"))
    if not (isfinite(x) and isfinite(y) and isfinite(yaw)):
        raise ValueError("a pose is not finite")
    return x, y, yaw


class Nav2Dialogue:
    """Hold the dialogue of one planner with one Nav2."""

    def __init__(self, now_s: float) -> None:
        """Begin; Nav2 may have goals of before."""
        self._joined_s = now_s
        self._order: PlannerOrder | None = None
        self._ordered_s = self._published_s = self._refused_s = self._came_s = -inf
        self._sent: _PublishedGoal | None = None
        self._mine = ""
        self._goals: dict[str, tuple[tuple[int, int], str | None]] = {}
        self._phase, self._since_s = "idle", now_s
        self._refusal = ""
        self._twist = (0.0, 0.0)
        self.trouble: Trouble | None = ("ros2_starting", "Nav2's topic was not looked at yet")
        """What the graph says of the topic of its velocity."""
        self.twists = self._seq = 0
        """How many twists came; and how often it was told."""

    def take(self, order: PlannerOrder, now_s: float) -> None:
        """Hear the planner; its newest word counts."""
        self._order, self._ordered_s = order, now_s

    def hear_twist(self, message: Any, age_s: float, now_s: float) -> None:
        """Take a twist of Nav2's; ``age_s`` by its own stamp, 0 where it has none."""
        try:
            v, sideways, w = read_twist(message)
            if not abs(sideways) <= SIDEWAYS_MPS:
                raise UnusableMessage(
                    f"linear.y {sideways:g}: a differential base can't go sideways"
                )
            if not (abs(v) <= FASTEST_MPS and abs(w) <= FASTEST_RADPS):
                raise UnusableMessage(f"({v:g} m/s, {w:g} rad/s) is no speed of a robot")
        except UnusableMessage as why:
            self._refuse(str(why), now_s)
            self._came_s = -inf
            return
        if self.trouble is None and age_s <= OLD_S:
            self._twist, self._came_s = (v, w), now_s
            self.twists += 1

    def hear_status(self, message: Any, now_s: float) -> None:
        """Take action_msgs/GoalStatusArray."""
        goals = {}
        for one in list(message.status_list)[:MOST_GOALS]:
            info = one.goal_info
            ident = bytes(bytearray(info.goal_id.uuid)).hex()
            goals[ident] = (info.stamp.sec, info.stamp.nanosec), PHASES.get(one.status)
        self._goals = goals
        if self._sent is None:
            return
        if not self._mine:
            new = [ident for ident in goals if ident not in self._sent.known]
            self._mine = max(new, key=lambda ident: goals[ident][0]) if new else ""
        phase = goals[self._mine][1] if self._mine in goals else None
        if phase is not None and self._phase in ("sent", "driving"):
            self._enter(phase, now_s)

    def due(self, now_s: float) -> Pose | None:
        """Return the goal that is to be published now."""
        if now_s - self._joined_s < SETTLE_S:
            return None
        order = self._order
        if order is not None and order.goal is not None and now_s - self._ordered_s <= UNASKED_S:
            return self._pursue(order, now_s)
        return self._call_off(now_s)

    def state(self, boot: str, now_s: float) -> dict[str, Any]:
        """Return what the planner is told."""
        self._seq += 1
        code, found = self._wrong(now_s) or (None, "")
        order = self._sent.order if self._sent is not None else None
        fresh = self._is_fresh(now_s)
        v, w = self._twist if fresh else (0.0, 0.0)
        return {
            "boot_id": boot,
            "seq": self._seq,
            "mission": order.mission if order is not None else None,
            "leg": order.leg if order is not None else 0,
            "phase": self._phase,
            "phase_s": max(0.0, now_s - self._since_s),
            "twist": self.twists if fresh else 0,
            "twist_age_s": max(0.0, now_s - self._came_s) if fresh else 0.0,
            "v_mps": v,
            "w_radps": w,
            "code": code,
            "detail": found[:400],
        }

    def _is_fresh(self, now_s: float) -> bool:
        return self.trouble is None and now_s - self._came_s <= OLD_S

    def _wrong(self, now_s: float) -> Trouble | None:
        if now_s - self._refused_s <= AGAIN_S and not self._is_fresh(now_s):
            return "ros2_unreadable", self._refusal
        return self.trouble

    def _pursue(self, order: PlannerOrder, now_s: float) -> Pose | None:
        sent = self._sent
        if sent is None or sent.order.ident != order.ident:
            self._sent, self._mine = _PublishedGoal(order, frozenset(self._goals)), ""
            self._enter("sent", now_s)
        elif self._phase != "sent" or now_s - self._published_s < AGAIN_S:
            return None
        self._published_s = now_s
        return order.goal

    def _call_off(self, now_s: float) -> Pose | None:
        """Send Nav2 to where the robot stands, until what it was asked for has ended."""
        drives_mine = self._goals.get(self._mine, (None, None))[1] == "driving"
        if self._phase not in ("sent", "driving") and not drives_mine:
            self._sent, self._mine = None, ""
            self._enter("idle", now_s)
            return None
        if self._phase in ("sent", "driving"):
            self._enter("cancelled", now_s)
            self._published_s = -inf
        here = self._order.here if self._order is not None else None
        if here is None or now_s - self._published_s < AGAIN_S:
            return None
        self._published_s = now_s
        return here

    def _refuse(self, why: str, now_s: float) -> None:
        self._refusal, self._refused_s = why[:200], now_s

    def _enter(self, phase: str, now_s: float) -> None:
        if phase != self._phase:
            self._phase, self._since_s = phase, now_s
