"""Distances and gradients of a map are those of geometry, to within a cell."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from localization.distance_field import MAX_DISTANCE_M, DistanceField, surface_cells
from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from tests.localization.rooms import RES_M, ROOM, field_of

ROOM_FIELD = field_of(ROOM, 6.0, 4.0)


def test_the_distance_is_to_the_nearest_wall() -> None:
    x_m, y_m = np.array([3.5, 0.6]), np.array([2.2, 2.0])
    assert ROOM_FIELD.distance(x_m, y_m) == pytest.approx([1.53, 0.525], abs=RES_M)


@given(st.floats(0.3, 5.7), st.floats(1.0, 2.8))
def test_a_step_along_the_gradient_goes_away_from_obstacles(x_m: float, y_m: float) -> None:
    distance, by_x, by_y = ROOM_FIELD.distance_and_gradient(np.array([x_m]), np.array([y_m]))
    step = 1e-6
    further = ROOM_FIELD.distance(
        np.array([x_m + step * by_x[0]]), np.array([y_m + step * by_y[0]])
    )
    assert further[0] >= distance[0] - 1e-9


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
def test_any_place_has_a_distance(x_m: float, y_m: float) -> None:
    distance, by_x, by_y = ROOM_FIELD.distance_and_gradient(np.array([x_m]), np.array([y_m]))
    assert 0.0 <= distance[0] <= MAX_DISTANCE_M + 1e-6
    assert np.isfinite((by_x[0], by_y[0])).all()
    on_the_map = -1e-6 <= x_m <= 6.0 and -1e-6 <= y_m <= 4.0
    assert on_the_map or not ROOM_FIELD.is_occupied(np.array([x_m]), np.array([y_m]))[0]


@given(st.integers(1, 60), st.integers(1, 60), st.integers(0, 12), st.integers(0, 2**32 - 1))
def test_each_cell_s_distance_is_that_to_the_nearest_surface_of_all(
    rows: int, columns: int, obstacles: int, seed: int
) -> None:
    draw = np.random.default_rng(seed)
    occupied = np.zeros((rows, columns), bool)
    occupied[draw.integers(0, rows, obstacles), draw.integers(0, columns, obstacles)] = True
    field = DistanceField(occupied, ~occupied, RES_M, (0.0, 0.0))
    lines = np.argwhere(surface_cells(field.occupied))
    cells = np.argwhere(np.ones_like(field.occupied))
    nearest = np.full(len(cells), np.inf)
    for line in lines:
        nearest = np.minimum(nearest, np.hypot(*(cells - line).T))
    expected = np.minimum(nearest * RES_M, MAX_DISTANCE_M).reshape(field.distance_m.shape)
    assert np.abs(field.distance_m - expected).max() < 1e-5


def test_the_inside_of_a_solid_is_no_surface() -> None:
    solid = np.ones((5, 5), bool)
    assert surface_cells(solid).sum() == 16
    assert not surface_cells(np.zeros((3, 3), bool)).any()


def test_a_map_without_obstacles_is_far_from_everything() -> None:
    bare = DistanceField(np.zeros((4, 4), bool), np.ones((4, 4), bool), RES_M, (0.0, 0.0))
    assert bare.distance(np.array([0.1]), np.array([0.1]))[0] == MAX_DISTANCE_M


def test_a_maps_unknown_cells_are_neither_floor_nor_obstacle() -> None:
    field = DistanceField.of_map(GridMap(3, 1, RES_M, 1.0, 2.0, bytes((OCCUPIED, UNKNOWN, FREE))))
    assert (field.occupied.sum(), field.free.sum()) == (1, 1)
    y_m = np.full(3, 2.02)
    assert field.is_occupied(np.array([1.02, 1.07, 1.12]), y_m).tolist() == [True, False, False]
