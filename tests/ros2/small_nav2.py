"""Stand in for Nav2, much smaller: one goal at a time, straight ways, no map, no recovery.

A stand-in and called so: it has Nav2's topics, the life of its action's goals and its preemption by
a newer goal, and none of its planning. Pure; told the time and the pose. Nav2 itself was not run.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import atan2, cos, hypot, pi, remainder, sin
from types import SimpleNamespace as Made
from typing import Any

ACCEPTED, EXECUTING, SUCCEEDED, CANCELED, ABORTED = 1, 2, 4, 5, 6
XY_M, YAW_RAD = 0.15, 0.15
V_MPS, W_RADPS = 0.4, 0.8


@dataclass
class SmallNav2:
    """Take PoseStamped goals, say twists and a GoalStatusArray."""

    via: list[tuple[float, float]] = field(default_factory=list)
    """Points to pass before a goal that is farther than 1 m: its map, as it were."""
    deaf: bool = False
    """It hears no goal, as a bt_navigator that was never activated."""
    gives_up: bool = False
    """It aborts each goal a second after it took it."""
    lies: bool = False
    """It says that it is there a second after it took a goal, wherever it is."""
    stuck: bool = False
    """It goes on executing and says no twist."""
    statuses: list[tuple[int, int, int]] = field(default_factory=list)
    """Of each goal: number, status, second of its stamp."""
    goals: list[tuple[float, float, float]] = field(default_factory=list)
    _left: list[tuple[float, float]] = field(default_factory=list)
    _began_s: float = 0.0

    def hear(
        self, goal: tuple[float, float, float], now_s: float, here: tuple[float, float]
    ) -> None:
        """Take a goal, x and y [m] and yaw [rad]; the one before it is aborted."""
        if self.deaf:
            return
        self._end(ABORTED)
        self.goals.append(goal)
        self.statuses.append((len(self.goals), EXECUTING, len(self.goals)))
        far = hypot(goal[0] - here[0], goal[1] - here[1]) > 1.0
        way = list(self.via) if far else []
        if way and hypot(way[-1][0] - here[0], way[-1][1] - here[1]) < hypot(
            way[0][0] - here[0], way[0][1] - here[1]
        ):
            way.reverse()
        self._left, self._began_s = way, now_s

    @property
    def executes(self) -> bool:
        """Return whether it drives to a goal now."""
        return bool(self.statuses) and self.statuses[-1][1] == EXECUTING

    def cancel(self) -> None:
        """End the goal as somebody else's client would."""
        self._end(CANCELED)

    def turn(self, now_s: float, x: float, y: float, yaw: float) -> tuple[float, float] | None:
        """Return the twist to say now; None: silence."""
        if not self.executes or self.stuck:
            return None
        late = now_s - self._began_s > 1.0
        if self.gives_up and late:
            self._end(ABORTED)
            return 0.0, 0.0
        if self.lies and late:
            self._end(SUCCEEDED)
            return 0.0, 0.0
        goal = self.goals[-1]
        aim = self._left[0] if self._left else goal[:2]
        far, course = hypot(aim[0] - x, aim[1] - y), atan2(aim[1] - y, aim[0] - x)
        if self._left and far < 0.3:
            del self._left[0]
        if self._left or far > XY_M:
            off = remainder(course - yaw, 2.0 * pi)
            return (0.0 if abs(off) > 0.5 else min(V_MPS, far)), _bounded(2.0 * off)
        off = remainder(goal[2] - yaw, 2.0 * pi)
        if abs(off) > YAW_RAD:
            return 0.0, _bounded(2.0 * off)
        self._end(SUCCEEDED)
        return 0.0, 0.0

    def status_array(self) -> Any:
        """Return what action_msgs/GoalStatusArray holds, newest first: its order means nothing."""
        return Made(
            status_list=[
                Made(
                    goal_info=Made(
                        goal_id=Made(uuid=[number] * 16), stamp=Made(sec=second, nanosec=0)
                    ),
                    status=status,
                )
                for number, status, second in reversed(self.statuses)
            ]
        )

    def _end(self, status: int) -> None:
        if self.executes:
            number, _, second = self.statuses[-1]
            self.statuses[-1] = (number, status, second)


def _bounded(w_radps: float) -> float:
    return max(-W_RADPS, min(W_RADPS, w_radps))


def forward(x: float, y: float, yaw: float, v: float, w: float, s: float) -> tuple[float, ...]:
    """Return the pose after so long a time [s], for bodies without physics."""
    return x + v * cos(yaw) * s, y + v * sin(yaw) * s, yaw + w * s
