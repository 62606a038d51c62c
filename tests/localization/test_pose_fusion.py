"""Laws of the weights between a carried and a matched pose."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from localization.pose_fusion import BEAMS_A_FACT, PoseFusion, pose_array
from wire import Pose2

SURE = np.diag((2e6, 2e6, 2e6))
"""A view that holds all directions: 200 beams within a centimetre."""
WEAK = np.diag((BEAMS_A_FACT / 0.05**2, 2e6, 2e6))
"""A view that holds x to 0.05 m alone."""
coordinates = st.floats(-0.3, 0.3)


def settled(scans: int = 50) -> PoseFusion:
    fusion = PoseFusion()
    for _ in range(scans):
        fusion.carry(0.0, 0.0, 0.0)
        fusion.fuse(np.zeros(3), np.zeros(3), WEAK)
    return fusion


@given(coordinates, coordinates, coordinates, st.floats(0, 1), st.floats(0, 1))
def test_the_fused_pose_lies_between_the_two(
    x_m: float, y_m: float, yaw: float, metres: float, slip_rad: float
) -> None:
    fusion, matched = settled(), np.array((x_m, y_m, yaw))
    fusion.carry(metres, 0.0, slip_rad)
    fused = fusion.fuse(np.zeros(3), matched, WEAK)
    assert np.all(np.abs(fused) <= np.abs(matched) + 1e-12)
    assert np.all(fused * matched >= -1e-12)


def test_the_first_scan_after_a_restart_is_believed() -> None:
    fusion, matched = settled(), np.array((0.4, -0.3, 0.2))
    fusion.restart()
    assert fusion.fuse(np.zeros(3), matched, SURE) == pytest.approx(matched, abs=1e-3)


def test_what_a_scan_does_not_hold_stays_as_carried() -> None:
    fusion = settled()
    fusion.carry(0.05, 0.0, 0.0)
    nothing_along_x = np.diag((0.0, 2e6, 2e6))
    fused = fusion.fuse(np.zeros(3), np.array((0.2, 0.05, 0.0)), nothing_along_x)
    assert abs(fused[0]) < 0.001 < 0.02 < fused[1]


def test_a_weak_direction_wanders_less_than_its_scans() -> None:
    random, fusion, pose = np.random.default_rng(3), PoseFusion(), np.zeros(3)
    fused_m, step_m = [], []
    for _ in range(400):
        fusion.carry(0.03, 0.0, 0.0)
        matched = np.array((random.normal(0.0, 0.05), 0.0, 0.0))
        before, pose = pose, fusion.fuse(pose, matched, WEAK)
        fused_m.append(pose[0])
        step_m.append(abs(pose[0] - before[0]))
    assert np.std(fused_m[50:]) < 0.025
    assert max(step_m[50:]) < 0.04, "scans alone step by 0.15 m"


def test_slip_makes_the_next_scan_count_more() -> None:
    gained = []
    for slip_rad in (0.0, 0.05, 0.2):
        fusion = settled()
        fusion.carry(0.02, 0.0, slip_rad)
        gained.append(fusion.fuse(np.zeros(3), np.array((0.1, 0.0, 0.0)), WEAK)[0])
    assert gained == sorted(gained)
    assert gained[2] > 0.08


def test_wheels_that_err_alike_are_not_followed_away() -> None:
    """Wheels 5 % long at 0.5 m/s: 2.5 mm a scan, always forward."""
    fusion, off_m = settled(), 0.0
    for _ in range(300):
        fusion.carry(0.05, 0.0, 0.0)
        off_m = fusion.fuse(np.array((off_m + 0.0025, 0.0, 0.0)), np.zeros(3), WEAK)[0]
    assert off_m < 0.025


def test_it_expects_what_wheels_and_slip_may_hide() -> None:
    fusion, here, there = settled(), np.zeros(3), np.array((0.2, 0.0, 0.0))
    fusion.carry(0.0, 0.0, 0.0)
    assert not fusion.expects(here, there)
    fusion.carry(0.0, 0.0, 0.1)
    assert fusion.expects(here, there), "a wheel slipped"
    fusion = settled()
    fusion.restart()
    assert fusion.expects(here, np.array((1.0, 0.5, 0.3)))


def test_headings_join_at_half_a_turn() -> None:
    fusion = PoseFusion()
    fused = fusion.fuse(np.array((0.0, 0.0, 3.13)), np.array((0.0, 0.0, -3.13)), SURE)
    assert abs(fused[2]) == pytest.approx(3.13, abs=0.02)


def test_a_pose_becomes_three_numbers() -> None:
    assert pose_array(Pose2(1.0, 2.0, 3.0)).tolist() == [1.0, 2.0, 3.0]
