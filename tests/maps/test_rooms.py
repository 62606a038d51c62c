"""Rooms are cut at doors; an open plan also at its openings, whatever stands in it."""

from __future__ import annotations

import numpy as np
import pytest

from maps.grid import FREE, OCCUPIED, GridMap
from maps.rooms import propose_rooms

STEP_M = 0.05


def home(width_m: float, height_m: float) -> np.ndarray:
    """Return the cells of one empty room with a wall around it."""
    cells = np.full((round(height_m / STEP_M), round(width_m / STEP_M)), FREE, np.uint8)
    cells[:2] = cells[-2:] = OCCUPIED
    cells[:, :2] = cells[:, -2:] = OCCUPIED
    return cells


def wall(cells: np.ndarray, at_m: float, opening_m: float) -> None:
    """Build a wall across at x, with an opening in its middle."""
    column, rows = round(at_m / STEP_M), cells.shape[0]
    half = round(opening_m / 2 / STEP_M)
    cells[: rows // 2 - half, column : column + 2] = OCCUPIED
    cells[rows // 2 + half :, column : column + 2] = OCCUPIED


def areas_m2(cells: np.ndarray) -> list[float]:
    rows, columns = cells.shape
    grid = GridMap(columns, rows, STEP_M, 0.0, 0.0, cells.tobytes())
    return [round(room.area_m2) for room in propose_rooms(grid)]


@pytest.mark.parametrize(
    ("opening_m", "rooms"),
    [(0.9, [24, 24]), (1.2, [24, 24]), (2.0, [24, 24]), (2.2, [24, 24]), (3.6, [49])],
)
def test_an_open_plan_is_cut_at_its_openings_and_not_where_it_is_open(
    opening_m: float, rooms: list[int]
) -> None:
    cells = home(10.2, 5.0)
    wall(cells, 5.1, opening_m)
    assert areas_m2(cells) == pytest.approx(rooms, abs=2)


def test_an_opening_cuts_no_room_of_ordinary_size() -> None:
    cells = home(6.0, 5.0)
    wall(cells, 3.0, 2.0)
    assert areas_m2(cells) == pytest.approx([29], abs=1)


def test_furniture_cuts_no_open_plan() -> None:
    cells = home(10.2, 5.0)
    cells[25:75, 100:110] = OCCUPIED  # a shelf, 2.5 m long, across the middle
    assert areas_m2(cells) == pytest.approx([47], abs=1)


def test_a_bay_is_no_room() -> None:
    cells = home(11.0, 5.0)
    wall(cells, 9.4, 2.2)
    assert len(areas_m2(cells)) == 1
