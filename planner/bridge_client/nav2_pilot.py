"""Let Nav2 drive the legs: its goal, its word, the pose, and its twists to the bridge. Pure.

The bridge knows no leg of an owner who drives by velocity, so whether one was reached, and why it
was not, is judged here: "reached" takes Nav2's word *and* the pose. A twist of Nav2's is said to
the bridge once, while fresh, and only under the very leg that the missions want now; limits, lidar,
fence and stops are the bridge's, as for every velocity.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, hypot
from typing import TYPE_CHECKING

from planner.bridge_client.bridge_status import holding_rows, standing
from wire import (
    LegReport,
    Mode,
    Nav2Goal,
    Nav2State,
    Pose2,
    Record,
    Status,
    Velocity,
    VelocitySequence,
    wrap,
)

if TYPE_CHECKING:
    from planner.bridge_client.ownership import MotionRequest
    from wire import RobotDescription
    from wire.ros2_config import Nav2Config

OLD_S = 0.25
"""A twist that is older is not said: by then Nav2 would have said another, or has died."""
PERIOD_S = 0.045
"""20 Hz and its jitter: the bridge counts seven in 250 ms as a flood."""
SILENT_S = 1.0
"""The ROS 2 process speaks ten times a second; one that is silent for so long is not heard."""
ACCEPT_S = 6.0
"""Nav2 takes a goal up within so long, or the goal has not reached it."""
SETTLE_S = 1.0
"""After Nav2's word that it is there the newest pose is waited for so long."""
IDLE_S = 30.0
"""So long Nav2 may plan, wait or clear its costmaps without a movement."""
MOVED_M, MOVED_RAD = 0.1, 0.2
_STILL = 1e-4


@dataclass(slots=True)
class _Aim:
    """Hold the leg that Nav2 is to drive, and how the robot moves in it."""

    mission: str
    leg: int
    goal: Pose2
    heading: bool
    begun_s: float
    marked: Pose2
    marked_s: float


class Nav2Pilot:
    """Drive one robot's legs by Nav2. Told the time."""

    def __init__(self, config: Nav2Config, planner_id: str) -> None:
        self._config, self._me = config, planner_id
        self._aim: _Aim | None = None
        self._state: Nav2State | None = None
        self._state_s = self._said_s = float("-inf")
        self._said_twist: tuple[str, int] = ("", 0)
        self._numbers = VelocitySequence()

    def aim(
        self, leg: tuple[str, int], start: Pose2, goal: Pose2, now_s: float, *, heading: bool
    ) -> None:
        """Take a leg on; where its heading does not matter Nav2 is to end as it came."""
        dx_m, dy_m = goal.x_m - start.x_m, goal.y_m - start.y_m
        came_rad = atan2(dy_m, dx_m) if hypot(dx_m, dy_m) > MOVED_M else start.yaw_rad
        end = goal if heading else Pose2(goal.x_m, goal.y_m, came_rad)
        self._aim = _Aim(*leg, end, heading, now_s, start, now_s)

    def hear(self, state: Nav2State, now_s: float) -> None:
        """Take Nav2's newest word."""
        self._state, self._state_s = state, now_s

    def left_m(self, status: Status, wanted: MotionRequest) -> float | None:
        """Return how far the goal is as the crow flies; Nav2's way is not known here."""
        aim, pose = self._aim_of(wanted), status.base_in_map
        if aim is None or pose is None:
            return None
        return hypot(aim.goal.x_m - pose.x_m, aim.goal.y_m - pose.y_m)

    def report(self, status: Status, wanted: MotionRequest, now_s: float) -> LegReport | None:
        """Return how far the wanted leg is, as the bridge says it of a leg of waypoints."""
        aim = self._aim_of(wanted)
        if aim is None:
            return None
        pose, state = status.base_in_map, self._ours(aim, now_s)
        far_m = self.left_m(status, wanted) or 0.0
        off_rad = 0.0
        if pose is not None and aim.heading:
            off_rad = abs(wrap(aim.goal.yaw_rad - pose.yaw_rad))
        near = far_m <= self._config.within_m and off_rad <= self._config.within_rad
        is_there = pose is not None and near
        refusal = self._refusal(aim, state, status, now_s, is_there=is_there)
        done = state is not None and state.phase == "succeeded"
        return LegReport(
            mission=wanted.grant or aim.mission,
            leg=aim.leg,
            following=state is not None and state.phase in ("sent", "driving"),
            reached=done and is_there,
            residual_m=far_m,
            residual_rad=off_rad,
            refusal=refusal,
        )

    def speak(
        self, status: Status, wanted: MotionRequest, share: float, now_s: float
    ) -> tuple[Record, ...]:
        """Return what is said on a status: Nav2's goal, and a twist or that none holds."""
        aim = self._aim_of(wanted)
        order = Nav2Goal(
            planner_id=self._me,
            seen=status.seq,
            mission=aim.mission if aim is not None else None,
            leg=aim.leg if aim is not None else 0,
            goal=aim.goal if aim is not None else None,
            here=status.base_in_map,
        )
        return (order, *self.drive(status, wanted, share, now_s))

    def drive(
        self, status: Status, wanted: MotionRequest, share: float, now_s: float
    ) -> tuple[Record, ...]:
        """Return the velocity to say to the bridge now: Nav2's newest, or the release of it."""
        owned = status.owner is not None and status.owner.planner_id == self._me
        if not owned or status.grant is None or now_s - self._said_s < PERIOD_S:
            return ()
        aim = self._aim_of(wanted)
        state = self._ours(aim, now_s) if aim is not None else None
        drives = state is not None and state.phase == "driving"
        if state is None or not drives or status.grant.mission != (wanted.grant or wanted.mission):
            if status.mode is not Mode.ACTIVE:
                return ()
            return (self._velocity(status, 0.0, 0.0, now_s),)
        age_s, twist = state.twist_age_s + now_s - self._state_s, (state.boot_id, state.twist)
        if not (state.twist > 0 and twist != self._said_twist and age_s <= OLD_S):
            return ()
        self._said_twist = twist
        return (self._velocity(status, share * state.v_mps, share * state.w_radps, now_s),)

    def _velocity(self, status: Status, v_mps: float, w_radps: float, now_s: float) -> Velocity:
        self._said_s = now_s
        return Velocity(
            source_id=self._me,
            epoch=status.epoch,
            seq=self._numbers.take_next(status.epoch),
            seen=status.seq,
            v_mps=v_mps,
            w_radps=w_radps,
            dead_man=abs(v_mps) >= _STILL or abs(w_radps) >= _STILL,
        )

    def _aim_of(self, wanted: MotionRequest) -> _Aim | None:
        aim = self._aim
        if aim is None or (aim.mission, aim.leg) != (wanted.mission, wanted.leg):
            return None
        return aim

    def _ours(self, aim: _Aim, now_s: float) -> Nav2State | None:
        """Return Nav2's newest word where it is fresh and about this leg."""
        state = self._state
        if state is None or not now_s - self._state_s <= SILENT_S:
            return None
        return state if (state.mission, state.leg) == (aim.mission, aim.leg) else None

    def _refusal(
        self, aim: _Aim, state: Nav2State | None, status: Status, now_s: float, *, is_there: bool
    ) -> str | None:
        """Return why this leg can't be driven on; None while it may."""
        self._mark(aim, status, now_s)
        if state is None:
            heard = now_s - self._state_s <= SILENT_S
            waited = now_s - aim.begun_s > (ACCEPT_S if heard else SILENT_S)
            return ("nav2_no_answer" if heard else "nav2_not_heard") if waited else None
        if state.phase in ("aborted", "cancelled"):
            return f"nav2_{state.phase}"
        if state.phase == "sent" and state.phase_s > ACCEPT_S:
            return "nav2_no_answer"
        if state.phase == "succeeded" and not is_there and state.phase_s > SETTLE_S:
            return "nav2_not_there"
        if state.phase == "driving" and state.code is not None and state.phase_s > ACCEPT_S:
            return "nav2_no_velocity"
        if state.phase == "driving" and now_s - aim.marked_s > IDLE_S:
            return "nav2_no_progress"
        return None

    def _mark(self, aim: _Aim, status: Status, now_s: float) -> None:
        """Note where the robot was last seen to move, or was kept from it by the bridge."""
        pose = status.base_in_map
        if pose is None:
            return
        moved_m = hypot(pose.x_m - aim.marked.x_m, pose.y_m - aim.marked.y_m)
        turned_rad = abs(wrap(pose.yaw_rad - aim.marked.yaw_rad))
        kept = status.blocked or bool(holding_rows(status))
        if kept or moved_m >= MOVED_M or turned_rad >= MOVED_RAD or not standing(status):
            aim.marked, aim.marked_s = pose, now_s


def pilot_of(robot: RobotDescription, planner_id: str) -> Nav2Pilot | None:
    """Return what drives by Nav2, where robot.toml has it so."""
    nav2 = robot.ros2.nav2 if robot.ros2 is not None else None
    return None if nav2 is None else Nav2Pilot(nav2, planner_id)
