"""A scan counts where odometry may have brought the robot, and a lost one where the map agrees."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from localization.correlative_search import WINDOW_M, WINDOW_RAD
from localization.mapping.carry_law import AGREEING_FIT, LESS_FIT, LOST_SCANS, CarryLaw

FITS = st.floats(0.0, 1.0)
STEPS = st.tuples(st.floats(-2.0, 2.0), st.floats(-0.1, 0.1), st.floats(-3.0, 3.0))


@given(st.lists(STEPS, max_size=8), st.integers(0, 5))
def test_the_farther_odometry_carried_the_wider_the_bound_and_never_beyond_the_window(
    steps: list[tuple[float, float, float]], refused: int
) -> None:
    law = CarryLaw()
    law.count(0.9)
    for _ in range(refused):
        law.refuse()
    before = law.bound_match()
    for step in steps:
        law.carry(np.array(step))
        bound = law.bound_match()
        assert before.off_m <= bound.off_m <= WINDOW_M
        assert before.off_rad <= bound.off_rad <= WINDOW_RAD
        before = bound


@given(FITS)
def test_a_lost_robot_is_taken_up_only_where_the_map_agrees_as_before(fit: float) -> None:
    law = CarryLaw()
    law.count(fit)
    tracked = law.bound_match()
    for _ in range(LOST_SCANS):
        assert not law.is_lost
        law.refuse()
    assert law.is_lost
    lost = law.bound_match()
    assert lost.fit == min(AGREEING_FIT, fit - LESS_FIT)
    assert lost.fit > tracked.fit
    assert lost.passed < tracked.passed
    law.count(fit)
    assert not law.is_lost
    assert law.bound_match() == tracked


def test_between_two_frames_of_odometry_a_robot_may_have_rolled_on() -> None:
    law = CarryLaw()
    law.count(0.9)
    near = law.bound_match()
    law.join()
    assert law.bound_match().off_m > near.off_m
    law.count(0.9)
    assert law.bound_match() == near
