"""Poses between stamps."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from localization.interpolation import KEPT, PoseTrack, blend
from wire import Pose2


def test_between_two_stamps_it_goes_straight_and_turns_the_short_way() -> None:
    track = PoseTrack()
    track.add(1.0, Pose2(0.0, 0.0, pi - 0.1))
    track.add(2.0, Pose2(1.0, -2.0, -pi + 0.1))
    middle = track.at(1.5)
    assert middle is not None
    assert (middle.x_m, middle.y_m) == (0.5, -1.0)
    assert abs(middle.yaw_rad) == pytest.approx(pi)
    assert track.at(2.0) == Pose2(1.0, -2.0, -pi + 0.1)


def test_outside_what_is_held_it_does_not_guess() -> None:
    track = PoseTrack()
    assert (track.at(0.0), track.newest_s) == (None, None)
    track.add(1.0, Pose2(0.0, 0.0, 0.0))
    assert (track.at(0.99), track.at(1.01), track.newest_s) == (None, None, 1.0)
    track.clear()
    assert track.at(1.0) is None


def test_what_does_not_rise_in_time_is_ignored() -> None:
    track = PoseTrack()
    track.add(1.0, Pose2(0.0, 0.0, 0.0))
    track.add(1.0, Pose2(5.0, 0.0, 0.0))
    track.add(0.5, Pose2(6.0, 0.0, 0.0))
    assert track.at(1.0) == Pose2(0.0, 0.0, 0.0)
    assert track.at(0.5) is None


def test_it_holds_no_more_than_it_says() -> None:
    track = PoseTrack()
    for stamp in range(KEPT + 10):
        track.add(float(stamp), Pose2(float(stamp), 0.0, 0.0))
    assert track.at(9.0) is None
    assert track.at(10.5) == Pose2(10.5, 0.0, 0.0)


@given(st.floats(0.0, 1.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_blend_lies_between(share: float, a: float, b: float) -> None:
    middle = blend(Pose2(a, 0.0, 0.0), Pose2(b, 0.0, 0.0), share)
    assert min(a, b) - 1e-9 <= middle.x_m <= max(a, b) + 1e-9
