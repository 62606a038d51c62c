"""Hold plane geometry to what is known by hand and to its laws."""

from __future__ import annotations

from math import hypot

from hypothesis import given
from hypothesis import strategies as st

from planner.site.polygon import area_m2, border_distance_m, contains

SQUARE = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))
ELL = ((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0))
ordinates = st.floats(-5, 5)


def test_area_does_not_depend_on_the_winding() -> None:
    assert area_m2(ELL) == 3.0
    assert area_m2(tuple(reversed(ELL))) == 3.0


@given(ordinates, ordinates)
def test_contains_agrees_with_the_square_it_draws(x_m: float, y_m: float) -> None:
    inside = 0 < x_m < 2 and 0 < y_m < 2
    if border_distance_m(SQUARE, x_m, y_m) > 1e-9:  # on the line itself either answer is right
        assert contains(SQUARE, x_m, y_m) is inside
        assert contains(tuple(reversed(SQUARE)), x_m, y_m) is inside


@given(ordinates, ordinates)
def test_the_notch_of_an_ell_is_outside(x_m: float, y_m: float) -> None:
    if border_distance_m(ELL, x_m, y_m) > 0:
        notch = x_m > 1 and y_m > 1
        assert contains(ELL, x_m, y_m) is (contains(SQUARE, x_m, y_m) and not notch)


@given(ordinates, ordinates)
def test_no_corner_is_nearer_than_the_border(x_m: float, y_m: float) -> None:
    corner_m = min(hypot(x_m - cx, y_m - cy) for cx, cy in SQUARE)
    assert border_distance_m(SQUARE, x_m, y_m) <= corner_m


def test_distances_known_by_hand() -> None:
    assert border_distance_m(SQUARE, 1.0, 0.25) == 0.25
    assert border_distance_m(SQUARE, 5.0, 6.0) == 5.0
