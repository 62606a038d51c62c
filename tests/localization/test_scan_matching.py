"""Gauss-Newton finds the pose near its start, past people, and knows what it cannot know."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest

from localization.scan_matching import align, thin, to_map
from tests.localization.rooms import CORRIDOR, ROOM, cast, field_of, points_of
from wire import Pose2

FIELD = field_of(ROOM, 6.0, 4.0)
TRUE = Pose2(2.6, 1.7, 0.4)
PERSON = (3.0, 2.4, 3.4, 2.6)


def start(
    dx: float, dy: float, turn_deg: float
) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    return np.array([[TRUE.x_m + dx, TRUE.y_m + dy, TRUE.yaw_rad + radians(turn_deg)]])


@pytest.mark.parametrize(
    ("dx", "dy", "turn_deg"), [(0.0, 0.0, 0.0), (0.1, -0.1, 5.0), (-0.2, 0.1, -10.0)]
)
def test_it_finds_the_true_pose_from_near_it(dx: float, dy: float, turn_deg: float) -> None:
    points = points_of(cast((*ROOM, PERSON), TRUE))
    found = align(FIELD, points, start(dx, dy, turn_deg)).poses[0]
    assert found[:2] == pytest.approx((TRUE.x_m, TRUE.y_m), abs=0.03)
    assert found[2] == pytest.approx(TRUE.yaw_rad, abs=radians(0.7))


def test_many_starts_at_once_end_as_each_alone() -> None:
    points = points_of(cast(ROOM, TRUE))
    starts = np.vstack((start(0.1, 0.0, 3.0), start(-0.1, 0.1, -4.0)))
    together = align(FIELD, points, starts).poses
    alone = np.vstack([align(FIELD, points, one[None]).poses for one in starts])
    assert together == pytest.approx(alone, abs=2e-3)


def test_along_a_bare_corridor_the_prediction_stays() -> None:
    field = field_of(CORRIDOR, 40.0, 1.6)
    points = points_of(cast(CORRIDOR, Pose2(20.0, 0.8, 0.1)))
    result = align(field, points, np.array([[20.3, 0.85, 0.05]]))
    assert result.poses[0, 0] == pytest.approx(20.3, abs=0.02), "not pulled along"
    assert result.poses[0, 1:] == pytest.approx((0.8, 0.1), abs=0.03)
    assert abs(result.free_axis[0, 0]) == pytest.approx(1.0, abs=0.02)
    assert not align(FIELD, points_of(cast(ROOM, TRUE)), start(0, 0, 0)).free_axis.any()


def test_no_points_move_nothing() -> None:
    assert (
        align(FIELD, np.empty((0, 2)), start(0.1, 0.1, 1.0)).poses == start(0.1, 0.1, 1.0)
    ).all()


def test_thinning_keeps_both_ends_and_transforming_is_the_poses() -> None:
    points = np.column_stack((np.arange(10.0), np.zeros(10)))
    assert thin(points, 4)[:, 0].tolist() == [0.0, 3.0, 6.0, 9.0]
    assert thin(points, 20) is points
    x_m, y_m = to_map(np.array([[1.0, 2.0, np.pi / 2]]), points[1:2])
    assert (x_m[0, 0], y_m[0, 0]) == pytest.approx((1.0, 3.0))


def test_redescending_a_row_of_cartons_before_a_wall_pulls_nothing() -> None:
    points = 0.987 * points_of(cast(ROOM, TRUE))  # a lidar whose ranges are short, as some are
    row = points[: len(points) * 3 // 10]
    row *= 1.0 - 0.2 / np.hypot(row[:, 0], row[:, 1])[:, None]
    pulled = align(FIELD, points, start(0.0, 0.0, 0.0)).poses[0]
    held = align(FIELD, points, start(0.02, -0.02, 1.0), redescending=True).poses[0]
    assert np.hypot(pulled[0] - TRUE.x_m, pulled[1] - TRUE.y_m) > 0.08, "by Cauchy's loss"
    assert np.hypot(held[0] - TRUE.x_m, held[1] - TRUE.y_m) < 0.03
