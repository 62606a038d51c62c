"""Turn on the spot by a signed angle, also by more than half a turn.

Law: the bridge turns to a heading by the shorter way, so a long turn goes in equal parts of at most
120 degrees, each aimed at a heading of the map: no part carries the error of the one before. After
a pause or a crash only what is left is turned. Verdict: odometry has turned by the angle within
``OFF_RAD`` and a twentieth of it, and at least by half. Budget: time for every part at a third of a
radian a second, and no way driven but what turning slips.
"""

from __future__ import annotations

from math import ceil, pi

from planner.language.catalogue import message
from planner.language.formatting import angle
from planner.plan import Code
from planner.skills.actions import (
    DriveLeg,
    Fail,
    Finish,
    Retry,
    Scene,
    SkillAction,
    Way,
)
from wire import Pose2, wrap

PART_RAD = 2.0 * pi / 3.0
THERE_RAD = 0.10
"""The bridge calls a heading reached within this, and does not set off for less."""
OFF_RAD, OFF_SHARE = 0.15, 0.05
LIMIT_S, SLOWEST_RADPS = 10.0, 0.33
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
        limit_s = LIMIT_S + abs(part) / SLOWEST_RADPS
        return DriveLeg(goal, heading=True, way=Way.SPIN, limit_s=limit_s, limit_m=LIMIT_M)
    return _verdict(asked, scene.done)


def turned_rad(pose: Pose2, began: Pose2, done_rad: float) -> float:
    """Return how far the heading has come [rad]: by the map, with odometry counting whole turns."""
    return done_rad + wrap(pose.yaw_rad - began.yaw_rad - done_rad)


def _verdict(asked: float, done: float) -> Finish | Fail:
    figures = {"turned_rad": round(done, 4), "residual_rad": round(asked - done, 4)}
    if abs(asked - done) <= min(OFF_RAD + OFF_SHARE * abs(asked), abs(asked) / 2.0):
        return Finish(figures)
    said = message(Code.NOT_REACHED, asked=angle(asked), reached=angle(done))
    reason = "too_short" if abs(asked) <= THERE_RAD else "odometry_disagrees"
    return Fail(Code.NOT_REACHED, reason, said, figures)
