"""Judge a drive on what is true and on what reached the wheels: laws, and how often each broke.

Knows robot.toml's numbers, the simulator's truth, the fence, and the bridge's word for its mode.
Nothing here asks the core what it thinks is right.
"""

from __future__ import annotations

from collections import Counter, deque
from math import hypot
from typing import TYPE_CHECKING

from lockstep.latencies import TICK_S
from wire import Mode, Pose2, Twist2

if TYPE_CHECKING:
    from tools.lockstep.together import LockstepWorld

SPEED_SLACK_MPS = 0.03
TURN_SLACK_RADPS = 0.12
"""Wheels overshoot a little, and a caster drags."""
ACCEL_WINDOW = 10
ACCEL_SLACK_MPS = 0.06
FENCE_SLACK_M = 0.0
STOP_S = 0.3 + 0.15 + 0.7 / 1.0
"""Lag, jerk and the ramp of the faster wheel at its limit (0.75 m/s) at 1 m/s2."""
METRES_SLACK = 0.05
MOVING = {Mode.ACTIVE, Mode.TELEOP}


class Judge:
    """Watch one world, tick by tick."""

    def __init__(self, world: LockstepWorld) -> None:
        self._world = world
        self.broken: Counter[str] = Counter()
        self.metres = 0.0
        self.modes: Counter[str] = Counter()
        self._last = world.truth
        self._unmoving_since_s: float | None = None
        self._speeds: deque[tuple[float, float]] = deque(maxlen=ACCEL_WINDOW)
        self._by_hand = False
        self._contacts = world.contacts
        self._allowed: dict[str, float] = {}
        self._used: dict[str, float] = {}

    def look(self) -> None:
        """Judge this tick."""
        world = self._world
        mode = world.bridge.state.mode
        here, twist = world.truth, world.twist
        moved_m = hypot(here.x_m - self._last.x_m, here.y_m - self._last.y_m)
        self._last = here
        self.metres += moved_m
        self.modes[mode.value] += 1
        self._speed(twist)
        self._rates(mode, twist)
        self._fence(mode, here)
        self._judge_outside(mode, twist)
        self._budget(mode, moved_m)
        if world.contacts > self._contacts:
            self.broken["clearance"] += world.contacts - self._contacts
            self._contacts = world.contacts

    def _speed(self, twist: Twist2) -> None:
        limits = self._world.scene.robot.limits
        if abs(twist.v_mps) > limits.max_speed_mps + SPEED_SLACK_MPS:
            self.broken["speed"] += 1
        if abs(twist.w_radps) > limits.max_turn_radps + TURN_SLACK_RADPS:
            self.broken["speed"] += 1
        command = self._world.commands[-1]
        if command is not None:
            fastest = max(abs(command.left_radps), abs(command.right_radps))
            if fastest > limits.max_wheel_radps + 1e-9:
                self.broken["speed"] += 1
        meant = self._world.bridge.state.motion.limiter.sent
        if abs(meant.v_mps) > limits.max_speed_mps + 1e-9:
            self.broken["speed"] += 1

    def _rates(self, mode: Mode, twist: Twist2) -> None:
        """Judge both wheels' true speeds over a tenth of a second."""
        limits, base = self._world.scene.robot.limits, self._world.scene.robot.base
        half = base.wheel_separation_m / 2 * twist.w_radps
        now = (twist.v_mps - half, twist.v_mps + half)
        if len(self._speeds) == ACCEL_WINDOW:
            seconds = ACCEL_WINDOW * TICK_S
            for before, after in zip(self._speeds[0], now, strict=True):
                more = abs(after) - abs(before) if before * after > 0.0 else abs(after)
                if more > limits.max_accel_mps2 * seconds + ACCEL_SLACK_MPS:
                    self.broken["acceleration"] += 1
                if mode is Mode.ACTIVE and -more > limits.max_decel_mps2 * 2.5 * seconds + 0.1:
                    self.broken["acceleration"] += 1
        self._speeds.append(now)

    def _fence(self, mode: Mode, here: Pose2) -> None:
        """Judge the robot's centre; a hand on the stick may take it out, and it may come back."""
        inside = self._world.scene.fence.margin_m(here.x_m, here.y_m) >= FENCE_SLACK_M
        if mode is Mode.TELEOP and not inside:
            self._by_hand = True
        elif inside:
            self._by_hand = False
        elif not self._by_hand:
            self.broken["fence"] += 1

    def _judge_outside(self, mode: Mode, twist: Twist2) -> None:
        """Judge motion where nobody may move it, once the ramp must be over."""
        now_s = self._world.now_s
        if mode in MOVING:
            self._unmoving_since_s = None
        elif self._unmoving_since_s is None:
            self._unmoving_since_s = now_s
        elif now_s - self._unmoving_since_s > STOP_S:
            stands = abs(twist.v_mps) <= 0.02 and abs(twist.w_radps) <= 0.05
            self.broken.update({} if stands else {"motion outside": 1})

    def _budget(self, mode: Mode, moved_m: float) -> None:
        """Judge each mission's metres by the first grant that it got."""
        grants = self._world.bridge.state.grants
        mission = grants.mission
        if mission is None or mode is not Mode.ACTIVE:
            return
        first = self._allowed.setdefault(mission, grants.metres + moved_m)
        used_m = self._used[mission] = self._used.get(mission, 0.0) + moved_m
        if used_m > first + stop_m(self._world) + METRES_SLACK:
            self.broken["budget"] += 1


def stop_m(world: LockstepWorld) -> float:
    """Return the path of a stop from full speed, with lag [m]."""
    limits, drive = world.scene.robot.limits, world.scene.robot.drive
    v, d = limits.max_speed_mps, limits.max_decel_mps2
    return v * v / (2 * d) + v * (drive.lag_s + 0.1 + d / (2 * limits.stop_jerk_mps3))
