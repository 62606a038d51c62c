"""Where the robot was at a picture's instant: in between, and never by guessing."""

from __future__ import annotations

from math import pi

import pytest

from planner.perception.pose_buffer import AHEAD_S, GAP_S, KEPT, PLACED_S, Poses
from wire import Localization, Odometry, Pose2, Twist2

MAP = "0" * 16


def moved(stamp_s: float, x_m: float, yaw_rad: float = 0.0, odom_id: str = "o1") -> Odometry:
    return Odometry(
        odom_id=odom_id, seq=1, stamp_s=stamp_s, base_in_odom=Pose2(x_m, 0.0, yaw_rad),
        twist=Twist2(1.0, 0.0), yaw_rate_radps=None,
    )  # fmt: skip


def placed(stamp_s: float, x_m: float = 10.0, **other: object) -> Localization:
    said = {"odom_id": "o1", "quality": 0.9, "map_id": MAP} | other
    return Localization.model_validate(
        {"seq": 1, "stamp_s": stamp_s, "odom_in_map": Pose2(x_m, 0.0, 0.0)} | said
    )


def told(*said: Odometry | Localization) -> Poses:
    poses = Poses(MAP)
    for one in said:
        poses.odometry(one) if isinstance(one, Odometry) else poses.localization(one)
    return poses


def test_the_pose_lies_between_two_odometries_and_two_localizations() -> None:
    poses = told(moved(1.0, 0.0, pi - 0.1), moved(1.02, 0.02, -pi + 0.1), placed(0.9, 10.0),
                 placed(1.1, 10.2))  # fmt: skip
    stance = poses.at(1.01)
    assert stance is not None
    assert stance.base_in_map.x_m == pytest.approx(10.11 + 0.01)
    assert abs(stance.base_in_map.yaw_rad) == pytest.approx(pi)  # by the shorter way


def test_turning_makes_it_less_sure() -> None:
    spin = moved(1.0, 0.0).model_copy(update={"twist": Twist2(0.0, 2.0)})
    still, turning = told(moved(1.0, 0.0), placed(1.0)).at(1.0), told(spin, placed(1.0)).at(1.0)
    assert still is not None
    assert turning is not None
    assert turning.sigma_rad > still.sigma_rad


@pytest.mark.parametrize(
    ("poses", "at_s", "known"),
    [
        (told(), 1.0, False),
        (told(moved(1.0, 0.0)), 1.0, False),
        (told(placed(1.0)), 1.0, False),
        (told(moved(1.0, 0.0), placed(1.0)), 1.0, True),
        (told(moved(1.0, 0.0), placed(1.0)), 0.99, False),  # older than the history
        (told(moved(1.0, 0.0), placed(1.0)), 1.0 + AHEAD_S / 2, True),
        (told(moved(1.0, 0.0), placed(1.0)), 1.0 + 2 * AHEAD_S, False),
        (told(moved(1.0, 0.0), moved(1.0 + 2 * GAP_S, 0.0), placed(1.2)), 1.2, False),
        (told(moved(1.0, 0.0), placed(1.0 - 2 * PLACED_S)), 1.0, False),  # localization is silent
        (told(moved(1.0, 0.0), placed(1.0, odom_id="o0")), 1.0, False),
        (told(placed(1.0), moved(0.9, 0.0, odom_id="o0"), moved(1.0, 0.0)), 1.0, False),
        (told(moved(1.0, 0.0), placed(1.0), placed(1.01, quality=0.2)), 1.0, False),
        (told(moved(1.0, 0.0), placed(1.0), placed(1.01, map_id="1" * 16)), 1.0, False),
    ],
)
def test_a_pose_is_known_or_it_is_none(poses: Poses, at_s: float, known: bool) -> None:
    assert (poses.at(at_s) is not None) is known


def test_the_history_is_bounded() -> None:
    poses = told(*(moved(0.02 * n, 0.0) for n in range(2 * KEPT)), placed(0.02 * 2 * KEPT))
    assert poses.at(0.02 * (2 * KEPT - 2)) is not None
    assert poses.at(0.02) is None
