"""A turn goes by the shorter way in parts, does only what is left, and is judged by odometry."""

from __future__ import annotations

from math import degrees, pi, radians

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.mission.skills import DriveLeg, Fail, Finish, Retry, Way, act_of
from planner.mission.skills.turn import PART_RAD
from tests.planner.mission.skills.scenes import scene
from wire import Pose2, wrap


def turn(angle_rad: float, **more: object) -> object:
    return act_of(scene("turn", step={"angle_rad": angle_rad}, **more))


@settings(max_examples=50)
@given(st.floats(-4 * pi, 4 * pi), st.floats(-pi, pi), st.floats(-0.05, 0.05))
def test_the_parts_add_up_whatever_each_leaves(angle: float, yaw: float, off: float) -> None:
    began, pose, done, part = Pose2(1.0, 2.0, yaw), Pose2(1.0, 2.0, yaw), 0.0, 0
    while isinstance(act := turn(angle, pose=pose, began=began, done=done, part=part), DriveLeg):
        step = wrap(act.goal.yaw_rad - pose.yaw_rad)
        assert (act.way, act.heading, act.limit_m) == (Way.SPIN, True, 0.5)
        assert abs(step) <= PART_RAD + 0.06, "the bridge never finds the other way shorter"
        done += step + off
        pose, part = Pose2(1.0, 2.0, wrap(act.goal.yaw_rad + off)), part + 1
        assert part <= 10
    assert abs(done - angle) <= 0.1 + 1e-6
    assert isinstance(act, Finish) == (abs(done - angle) <= abs(angle) / 2)


@pytest.mark.parametrize(
    ("asked_deg", "turned_deg", "left_deg"), [(90, 60, 30), (-200, -150, -50), (720, 700, 20)]
)
def test_after_a_pause_only_what_is_left_is_turned(
    asked_deg: float, turned_deg: float, left_deg: float
) -> None:
    here = Pose2(0.0, 0.0, wrap(radians(turned_deg)))
    almost = radians(turned_deg) + 0.05  # odometry and the map differ a little; the map decides
    act = turn(radians(asked_deg), pose=here, done=almost, part=1)
    assert isinstance(act, DriveLeg)
    assert degrees(wrap(act.goal.yaw_rad - here.yaw_rad)) == pytest.approx(left_deg, abs=0.01)


@pytest.mark.parametrize(
    ("asked", "done", "reason"),
    [(pi / 2, pi / 2 - 0.1, None), (pi / 2, 0.9, "odometry_disagrees"), (0.08, 0.0, "too_short")],
)
def test_the_verdict_is_odometrys(asked: float, done: float, reason: str | None) -> None:
    act = turn(asked, pose=Pose2(0, 0, wrap(asked)), done=done, part=1)
    assert isinstance(act, Finish | Fail)
    assert act.figures == {"turned_rad": round(done, 4), "residual_rad": round(asked - done, 4)}
    assert getattr(act, "reason", None) == reason


def test_a_pose_that_never_settles_ends_and_none_is_waited_for() -> None:
    assert isinstance(turn(1.0, pose=Pose2(0, 0, 0.5), done=0.5, part=3), Fail)
    assert isinstance(turn(1.0, pose=None, began=None), Retry)
