"""Drive straight by a distance along the heading, backwards where it is negative.

Precondition: the map and the lidar leave room for the whole way; where they don't, nothing moves
and the room there is is told. Verdict: odometry has gone the distance along the heading within
``OFF_M`` and a twentieth of it, and at least half of it. After a pause or a crash only what is left
is driven, from where the robot stands. Budget: time for the way at 0.05 m/s, and half a metre more
than asked.
"""

from __future__ import annotations

from math import cos, hypot, sin

from planner.language.catalogue import message
from planner.language.formatting import metres
from planner.plan import Bilingual, Code
from planner.skills.actions import (
    DriveLeg,
    Fail,
    Finish,
    Retry,
    Scene,
    SkillAction,
    Way,
)
from wire import Pose2

THERE_M = 0.02
OFF_M, OFF_SHARE = 0.12, 0.05
SHORTEST_M = 0.10
"""The bridge calls a place reached within this, and does not set off for less."""
LIMIT_S, SLOWEST_MPS = 20.0, 0.05
MORE_M = 0.5


def move(scene: Scene[None]) -> SkillAction:
    """Return the straight leg, or how far odometry says that it came."""
    asked = scene.step.distance_m or 0.0
    pose, began = scene.pose, scene.began
    if pose is None or began is None:
        return Retry()
    if scene.part > 0:
        return _verdict(asked, scene.done)
    left_m = asked - along(pose, began)
    if abs(left_m) <= THERE_M:
        return _verdict(asked, scene.done)
    goal = Pose2(
        began.x_m + asked * cos(began.yaw_rad),
        began.y_m + asked * sin(began.yaw_rad),
        began.yaw_rad,
    )
    limit_s, limit_m = LIMIT_S + abs(left_m) / SLOWEST_MPS, abs(left_m) + MORE_M
    return DriveLeg(goal, heading=True, way=Way.STRAIGHT, limit_s=limit_s, limit_m=limit_m)


def along(pose: Pose2, began: Pose2) -> float:
    """Return how far a pose lies along the line of a beginning [m]."""
    dx, dy = pose.x_m - began.x_m, pose.y_m - began.y_m
    return dx * cos(began.yaw_rad) + dy * sin(began.yaw_rad)


def no_room(goal: Pose2, pose: Pose2, short_m: float) -> Fail:
    """Tell how much room the rest of a way has, of which ``short_m`` are not free."""
    left_m = hypot(goal.x_m - pose.x_m, goal.y_m - pose.y_m)
    room_m = max(0.0, left_m - short_m)
    said = message(Code.NO_ROOM, room=f"{room_m:.1f}", asked=f"{left_m:.1f}")
    return Fail(Code.NO_ROOM, "no_room", said)


def _tell_shortfall(asked: float, done: float) -> tuple[Bilingual, dict[str, float]]:
    figures = {"moved_m": round(done, 4), "residual_m": round(abs(asked - done), 4)}
    return message(Code.NOT_REACHED, asked=metres(asked), reached=metres(done)), figures


def _verdict(asked: float, done: float) -> Finish | Fail:
    said, figures = _tell_shortfall(asked, done)
    if abs(asked - done) <= min(OFF_M + OFF_SHARE * abs(asked), abs(asked) / 2.0):
        return Finish(dict(figures))
    reason = "too_short" if abs(asked) <= SHORTEST_M else "odometry_disagrees"
    return Fail(Code.NOT_REACHED, reason, said, figures)
