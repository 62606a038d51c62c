"""A lidar's range scale is found from views of a map, and nothing else is taken for it."""

from __future__ import annotations

from functools import cache
from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from localization.deskew import PointCloud
from localization.pose_fusion import PoseFusion, pose_array
from localization.range_scale import LARGEST_ERROR, NEXT_M, RangeScale
from localization.scan_fit import ScanFitter
from localization.scan_matching import align
from tests.localization.rooms import CORRIDOR, ROOM, Boxes, cast, field_of
from wire import Pose2

HOME = field_of(ROOM, 6.0, 4.0)
LIDAR_M = (0.0, 0.0)
TOUR = [
    Pose2(3.0 + 1.4 * cos(0.3 * k), 1.9 + 0.8 * sin(0.3 * k), 0.3 * k % (2 * pi) - pi)
    for k in range(30)
]
"""Round the room, 0.26 m and more from view to view."""


@cache
def true_ranges(boxes: Boxes, pose: Pose2) -> NDArray[np.float64]:
    return np.array(cast(boxes, pose, beams=120), np.float64)


def told(
    pose: Pose2, scale: float, *, boxes: Boxes = ROOM, offset_m: float = 0.0, noise_m: float = 0.0
) -> NDArray[np.float64]:
    """Return a view's returns in ``base``, true ranges times a scale."""
    ranges_m = true_ranges(boxes, pose)
    angles = -pi + 2 * pi * np.arange(len(ranges_m)) / len(ranges_m)
    noise = np.random.default_rng(7).normal(0.0, noise_m, len(ranges_m))
    ranges_m = ranges_m * scale + offset_m + noise
    points = np.column_stack((ranges_m * np.cos(angles), ranges_m * np.sin(angles)))
    return np.asarray(points[np.isfinite(ranges_m)])


def drive(lidar: RangeScale, scale: float, tour: list[Pose2], **errors: float) -> float:
    """Show a lidar's views where the robot places itself by them, and return what is found."""
    for true in tour:
        points_m = told(true, scale, **errors) / lidar.value  # type: ignore[arg-type]
        placed = align(HOME, points_m, pose_array(true)[None], redescending=True).poses[0]
        lidar.see(points_m, placed)
    return lidar.value


@settings(max_examples=10)
@given(
    scale=st.floats(0.975, 0.988) | st.floats(1.012, 1.025),
    noise_m=st.floats(0.0, 0.03),
)
def test_a_scale_is_found_to_a_half_percent(scale: float, noise_m: float) -> None:
    found = drive(RangeScale(HOME, LIDAR_M), scale, TOUR, noise_m=noise_m)
    assert found == pytest.approx(scale, abs=0.005)


@settings(max_examples=10)
@given(scale=st.floats(0.9985, 1.0015), noise_m=st.floats(0.0, 0.03))
def test_a_good_lidar_s_ranges_are_left_as_they_are(scale: float, noise_m: float) -> None:
    """What the estimate itself has wrong would be 0.04 m in a hall of ten metres."""
    assert drive(RangeScale(HOME, LIDAR_M), scale, TOUR, noise_m=noise_m) == 1.0


@settings(max_examples=10)
@given(offset_m=st.floats(-0.03, 0.03))
def test_what_is_the_same_at_all_ranges_is_not_the_scale(offset_m: float) -> None:
    """A map's surfaces lie half a cell before its cells' centres, wherever the robot looks."""
    found = drive(RangeScale(HOME, LIDAR_M), 1.0, TOUR, offset_m=offset_m)
    assert found == pytest.approx(1.0, abs=0.006)


def test_a_long_lidar_s_robot_is_placed_as_well_as_a_true_one_s() -> None:
    """Near one wall and far from the other, where the errors of its ranges do not cancel."""
    found = drive(RangeScale(HOME, LIDAR_M), 1.02, TOUR)
    beside = [
        Pose2(0.7, 1.9, 0.0),
        Pose2(5.3, 2.2, 1.0),
        Pose2(3.4, 0.6, 2.0),
        Pose2(3.2, 3.3, 0.5),
    ]

    def off_m(scale: float, divisor: float) -> float:
        errors = []
        for true in beside:
            points_m, start = told(true, scale) / divisor, pose_array(true)[None]
            placed = align(HOME, points_m, start, redescending=True).poses[0]
            errors.append(np.hypot(placed[0] - true.x_m, placed[1] - true.y_m))
        return float(np.mean(errors))

    plain, uncorrected, corrected = off_m(1.0, 1.0), off_m(1.02, 1.0), off_m(1.02, found)
    assert corrected < plain + 0.004 < uncorrected


def test_a_standing_robot_learns_from_one_view_alone() -> None:
    lidar, pose = RangeScale(HOME, LIDAR_M), TOUR[0]
    lidar.see(told(pose, 1.02), pose_array(pose))
    once = lidar.value
    for k in range(100):
        near_by = Pose2(pose.x_m + NEXT_M / 200 * k, pose.y_m, pose.yaw_rad)
        lidar.see(told(near_by, 1.02), pose_array(near_by))
        assert lidar.value == (once if k * NEXT_M / 200 < NEXT_M else lidar.value)
    assert lidar.value == once


def test_a_lidar_that_warms_up_is_followed() -> None:
    lidar = RangeScale(HOME, LIDAR_M)
    drive(lidar, 0.985, TOUR * 4)
    assert drive(lidar, 1.01, TOUR * 20) == pytest.approx(1.01, abs=0.006)


@settings(max_examples=10)
@given(scale=st.floats(0.5, 2.0))
def test_no_views_take_it_beyond_its_bound(scale: float) -> None:
    found = drive(RangeScale(HOME, LIDAR_M), scale, TOUR)
    assert abs(found - 1.0) <= LARGEST_ERROR + 1e-12


def test_along_a_bare_corridor_nothing_breaks_and_little_is_learnt_of_nothing() -> None:
    lidar = RangeScale(field_of(CORRIDOR, 40.0, 1.6), LIDAR_M)
    for k in range(60):
        pose = Pose2(5.0 + 0.3 * k, 0.8, 0.0)
        lidar.see(told(pose, 1.0, boxes=CORRIDOR), pose_array(pose))
    assert lidar.value == pytest.approx(1.0, abs=0.01)


def test_an_empty_view_and_one_in_open_space_change_nothing() -> None:
    lidar = RangeScale(HOME, LIDAR_M)
    lidar.see(np.zeros((0, 2)), pose_array(TOUR[0]))
    lidar.see(np.full((50, 2), 0.3), pose_array(TOUR[5]))
    assert lidar.value == pytest.approx(1.0, abs=1e-9)


def test_scans_that_fit_the_map_well_teach_the_fitter() -> None:
    fitter, fusion = ScanFitter(HOME, LIDAR_M), PoseFusion()
    for k, true in enumerate(TOUR):
        points_m = told(true, 1.02) / fitter.range_scale.value
        cloud = PointCloud(100.0 + k, points_m, len(points_m))
        fitter.near(cloud, pose_array(true), fusion, turned=False)
    assert fitter.range_scale.value == pytest.approx(1.02, abs=0.005)


def test_scans_of_people_teach_nothing() -> None:
    """Half of the beams end on somebody: the pose may be kept, but its view is no measure."""
    fitter, fusion = ScanFitter(HOME, LIDAR_M), PoseFusion()
    for k, true in enumerate(TOUR):
        points_m = told(true, 1.02)
        points_m[::2] = 0.4 * points_m[::2] / np.hypot(*points_m[::2].T)[:, None]
        cloud = PointCloud(100.0 + k, points_m, len(points_m))
        fitter.near(cloud, pose_array(true), fusion, turned=False)
    assert fitter.range_scale.value == 1.0
