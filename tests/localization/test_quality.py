"""A score counts beams; quality fades with time, metres and blind axes, and 0.6 is 0.5."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from localization.quality import (
    BLIND_AXIS_M,
    ENOUGH_SCORE,
    FADING_M,
    FADING_S,
    KEPT_SCORE,
    passed_share,
    quality_of,
    scores,
)
from tests.localization.rooms import ROOM, cast, field_of, points_of
from wire import Pose2

FIELD = field_of(ROOM, 6.0, 4.0)
TRUE = Pose2(2.6, 1.7, 0.4)
LIDAR = (0.0, 0.0)


def poses(*some: Pose2) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    return np.array([(one.x_m, one.y_m, one.yaw_rad) for one in some])


def test_the_true_pose_scores_best_and_a_person_costs_its_share() -> None:
    free, beside = points_of(cast(ROOM, TRUE)), cast((*ROOM, (3.0, 2.4, 3.4, 2.6)), TRUE)
    at = poses(TRUE, Pose2(3.3, 1.2, 1.8))
    true, wrong = scores(FIELD, free, LIDAR, at)
    assert true > 0.98
    assert wrong < 0.5
    (crowded,) = scores(FIELD, points_of(beside), LIDAR, poses(TRUE))
    assert 0.7 < crowded < 0.98


def test_light_does_not_pass_through_walls() -> None:
    points = points_of(cast(ROOM, TRUE))
    assert passed_share(FIELD, points, LIDAR, poses(TRUE))[0] == 0.0
    assert passed_share(FIELD, points, LIDAR, poses(Pose2(5.0, 1.7, 0.4)))[0] > 0.2
    assert passed_share(FIELD, np.array([[0.1, 0.0]]), LIDAR, poses(TRUE))[0] == 0.0


def test_no_returns_are_no_score() -> None:
    assert scores(FIELD, np.empty((0, 2)), LIDAR, poses(TRUE)).tolist() == [0.0]


def test_the_threshold_of_scans_is_the_bridges_threshold_of_quality() -> None:
    assert quality_of(KEPT_SCORE, 0.0, 0.0, 0.0) == pytest.approx(0.5)
    assert KEPT_SCORE < ENOUGH_SCORE, "placing asks for more than keeping"
    assert quality_of(1.0, 0.0, 0.0, 0.0) == 1.0
    for faded in ((FADING_S, 0.0, 0.0), (0.0, FADING_M, 0.0), (0.0, 0.0, BLIND_AXIS_M)):
        assert quality_of(1.0, *faded) == pytest.approx(0.5)


@given(st.floats(-1, 1), st.floats(0, 1e6), st.floats(0, 1e6), st.floats(0, 1e6), st.floats(0, 9))
def test_quality_only_falls(score: float, s: float, m: float, axis: float, more: float) -> None:
    quality = quality_of(score, s, m, axis)
    assert 0.0 <= quality <= 1.0
    assert quality_of(score, s + more, m, axis) <= quality
    assert quality_of(score, s, m + more, axis) <= quality
    assert quality_of(score, s, m, axis + more) <= quality
