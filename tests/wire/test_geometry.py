"""Frames compose as transforms do."""

from __future__ import annotations

from math import inf, isclose, isnan, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wire import IDENTITY, Pose2, between, compose, distance, inverse, transform, wrap

metres = st.floats(-100, 100)
poses = st.builds(Pose2, metres, metres, st.floats(-pi, pi))


def near(a: Pose2, b: Pose2) -> bool:
    turn = abs(wrap(a.yaw_rad - b.yaw_rad))
    return distance(a, b) < 1e-9 and turn < 1e-9


@given(poses)
def test_identity_changes_nothing(pose: Pose2) -> None:
    assert near(compose(IDENTITY, pose), pose)
    assert near(compose(pose, IDENTITY), pose)


@given(poses)
def test_inverse_undoes(pose: Pose2) -> None:
    assert near(compose(pose, inverse(pose)), IDENTITY)
    assert near(compose(inverse(pose), pose), IDENTITY)


@given(poses, poses, poses)
def test_composition_is_associative(a: Pose2, b: Pose2, c: Pose2) -> None:
    assert near(compose(compose(a, b), c), compose(a, compose(b, c)))


@given(poses, poses)
def test_between_leads_from_one_to_the_other(a: Pose2, b: Pose2) -> None:
    assert near(compose(a, between(a, b)), b)


@given(poses, poses)
def test_a_point_moves_as_the_pose_at_it(a: Pose2, b: Pose2) -> None:
    x_m, y_m = transform(a, b.x_m, b.y_m)
    there = compose(a, b)
    assert isclose(x_m, there.x_m, abs_tol=1e-9)
    assert isclose(y_m, there.y_m, abs_tol=1e-9)


@given(st.floats(-1e6, 1e6))
def test_wrap_keeps_the_direction(angle: float) -> None:
    assert -pi <= wrap(angle) <= pi
    assert isclose(wrap(wrap(angle) - wrap(angle)), 0.0, abs_tol=1e-9)


@pytest.mark.parametrize("angle", [nan, inf, -inf])
def test_wrap_of_no_angle_is_no_number(angle: float) -> None:
    assert isnan(wrap(angle))


def test_conventions_are_rep_103() -> None:
    facing_left = Pose2(0.0, 0.0, pi / 2)
    ahead = compose(facing_left, Pose2(1.0, 0.0, 0.0))
    assert near(ahead, Pose2(0.0, 1.0, pi / 2))
