"""Turn on the spot by an angle, or drive straight by a distance: what odometry measures.

Law: the bridge turns to a heading by the shorter way, so a long turn goes in equal parts of at most
120 degrees, each aimed at a heading of the map: no part carries the error of the one before. A move
needs room by map and lidar for the whole way; where there is none, nothing moves and the room there
is is told. After a pause or a crash only what is left is done, from where the robot stands.
Verdict: odometry has come within ``OFF_RAD`` or ``OFF_M`` and a twentieth of what was asked, and at
least half of it. Budget: time at the slowest, and half a metre more than asked.
"""

from __future__ import annotations

from math import ceil, cos, hypot, pi, sin

from planner.language.catalogue import message
from planner.language.formatting import angle, metres
from planner.plan import Code
from planner.skills.actions import DriveLeg, Fail, Finish, Retry, Scene, SkillAction, Way
from wire import Pose2, wrap

OFF_SHARE = 0.05
PART_RAD = 2.0 * pi / 3.0
THERE_RAD = 0.10
"""The bridge calls a heading reached within this, and does not set off for less."""
OFF_RAD = 0.15
TURN_S, SLOWEST_RADPS = 10.0, 0.33
MORE_PARTS = 2
"""Beyond what the angle needs: a pose that will not settle must not turn a robot for ever."""
LIMIT_M = 0.5


def turn(scene: Scene[None]) -> SkillAction:
    """Return the next part of the turn, or how far odometry says that it came."""
    asked = scene.step.angle_rad or 0.0
    if scene.pose is None or scene.began is None:
        return Retry()
    left = asked - turned_rad(scene.pose, scene.began, scene.done)
    going = scene.part < ceil(abs(asked) / PART_RAD) + MORE_PARTS
    if going and (abs(left) > THERE_RAD or (scene.part == 0 and left != 0.0)):
        part = left / max(1, ceil(abs(left) / PART_RAD - 1e-9))
        here = scene.pose
        goal = Pose2(here.x_m, here.y_m, wrap(here.yaw_rad + part))
        limit_s = TURN_S + abs(part) / SLOWEST_RADPS
        return DriveLeg(goal, heading=True, way=Way.SPIN, limit_s=limit_s, limit_m=LIMIT_M)
    return _judge_turn(asked, scene.done)


def turned_rad(pose: Pose2, began: Pose2, done_rad: float) -> float:
    """Return how far the heading has come [rad]: by the map, with odometry counting whole turns."""
    return done_rad + wrap(pose.yaw_rad - began.yaw_rad - done_rad)


def _judge_turn(asked: float, done: float) -> Finish | Fail:
    figures = {"turned_rad": round(done, 4), "residual_rad": round(asked - done, 4)}
    if abs(asked - done) <= min(OFF_RAD + OFF_SHARE * abs(asked), abs(asked) / 2.0):
        return Finish(figures)
    said = message(Code.NOT_REACHED, asked=angle(asked), reached=angle(done))
    reason = "too_short" if abs(asked) <= THERE_RAD else "odometry_disagrees"
    return Fail(Code.NOT_REACHED, reason, said, figures)


THERE_M = 0.02
OFF_M = 0.12
SHORTEST_M = 0.10
"""The bridge calls a place reached within this, and does not set off for less."""
MOVE_S, SLOWEST_MPS = 20.0, 0.05
MORE_M = 0.5


def move(scene: Scene[None]) -> SkillAction:
    """Return the straight leg, or how far odometry says that it came."""
    asked = scene.step.distance_m or 0.0
    pose, began = scene.pose, scene.began
    if pose is None or began is None:
        return Retry()
    if scene.part > 0:
        return _judge_move(asked, scene.done)
    left_m = asked - along(pose, began)
    if abs(left_m) <= THERE_M:
        return _judge_move(asked, scene.done)
    goal = Pose2(
        began.x_m + asked * cos(began.yaw_rad),
        began.y_m + asked * sin(began.yaw_rad),
        began.yaw_rad,
    )
    limit_s, limit_m = MOVE_S + abs(left_m) / SLOWEST_MPS, abs(left_m) + MORE_M
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


def _judge_move(asked: float, done: float) -> Finish | Fail:
    figures = {"moved_m": round(done, 4), "residual_m": round(abs(asked - done), 4)}
    if abs(asked - done) <= min(OFF_M + OFF_SHARE * abs(asked), abs(asked) / 2.0):
        return Finish(dict(figures))
    said = message(Code.NOT_REACHED, asked=metres(asked), reached=metres(done))
    reason = "too_short" if abs(asked) <= SHORTEST_M else "odometry_disagrees"
    return Fail(Code.NOT_REACHED, reason, said, figures)
