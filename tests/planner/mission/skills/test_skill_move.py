"""A move drives what is left of its own line, says what room there is, and trusts odometry."""

from __future__ import annotations

from math import pi

import pytest

from planner.mission.skills import DriveLeg, Fail, Finish, Retry, Way, act_of, no_room
from tests.planner.mission.skills.scenes import scene
from wire import Pose2


def move(distance_m: float, **more: object) -> object:
    return act_of(scene("move", step={"distance_m": distance_m}, **more))


@pytest.mark.parametrize("distance_m", [0.5, -0.3, 10.0])
def test_it_aims_along_the_heading_at_which_it_began(distance_m: float) -> None:
    began = Pose2(1.0, 2.0, pi / 2)
    for pose in (began, Pose2(1.05, 2.0 + distance_m / 3, pi / 2 + 0.1)):
        act = move(distance_m, pose=pose, began=began)
        assert isinstance(act, DriveLeg)
        assert (act.way, act.heading) == (Way.STRAIGHT, True)
        goal = (act.goal.x_m, act.goal.y_m, act.goal.yaw_rad)
        assert goal == pytest.approx((1.0, 2.0 + distance_m, pi / 2))
        assert act.limit_m is not None
        assert act.limit_m <= abs(distance_m) + 0.5


@pytest.mark.parametrize(
    ("asked", "done", "reason"),
    [(0.5, 0.45, None), (-0.3, -0.31, None), (2.0, 1.5, "odometry_disagrees"),
     (0.1, 0.0, "too_short"), (-0.5, 0.5, "odometry_disagrees")],
)  # fmt: skip
def test_the_verdict_is_odometrys(asked: float, done: float, reason: str | None) -> None:
    act = move(asked, done=done, part=1)
    assert isinstance(act, Finish | Fail)
    assert act.figures["moved_m"] == done
    assert act.figures["residual_m"] == pytest.approx(abs(asked - done))
    assert getattr(act, "reason", None) == reason


def test_room_is_told_in_metres_and_a_pose_is_waited_for() -> None:
    said = no_room(Pose2(3.0, 0.0, 0.0), Pose2(1.0, 0.0, 0.0), 0.5).said
    assert said is not None
    assert "1.5 m" in said.en
    assert "1.5 米" in said.zh
    assert isinstance(move(1.0, pose=None), Retry)
