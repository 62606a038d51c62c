"""A lattice of poses contains the true one, and rates it above the others."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest

from localization.correlative_search import LatticeSearch, WindowSearch
from tests.localization.rooms import ROOM, cast, field_of, points_of
from wire import Pose2

FIELD = field_of(ROOM, 6.0, 4.0)
TRUE = Pose2(2.6, 1.7, 0.4)


def test_the_window_reaches_what_gauss_newton_does_not() -> None:
    points = points_of(cast(ROOM, TRUE))
    around = np.array((TRUE.x_m + 0.45, TRUE.y_m - 0.4, TRUE.yaw_rad + radians(18.0)))
    found = WindowSearch.of_field(FIELD).best(points, around)
    assert found[:2] == pytest.approx((TRUE.x_m, TRUE.y_m), abs=0.06)
    assert found[2] == pytest.approx(TRUE.yaw_rad, abs=radians(2.1))


def test_a_window_without_points_or_off_the_map_is_its_middle() -> None:
    search, points = WindowSearch.of_field(FIELD), points_of(cast(ROOM, TRUE))
    middle = np.array((1.0, 1.0, 0.0))
    assert search.best(np.empty((0, 2)), middle).tolist() == middle.tolist()
    far = np.array((500.0, 500.0, 0.0))
    assert search.best(points, far).tolist() == far.tolist()


def test_the_lattices_best_position_is_the_nearest_to_the_true_one() -> None:
    lattice = LatticeSearch(FIELD, step_m=0.2, sigma_m=0.15)
    rating = lattice.rate(points_of(cast(ROOM, TRUE)), TRUE.yaw_rad)
    row, column = lattice.positions()
    x_m, y_m = FIELD.cell_centre(row.ravel(), column.ravel())
    best = int(rating.ravel().argmax())
    assert rating.shape == row.shape == lattice.shape
    assert (x_m[best], y_m[best]) == pytest.approx((TRUE.x_m, TRUE.y_m), abs=0.16)
