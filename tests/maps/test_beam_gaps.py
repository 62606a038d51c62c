"""Slivers between beams are floor; what is wider, or beside a wall, stays unknown."""

from __future__ import annotations

import numpy as np
import pytest

from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.beam_gaps import THIN_M, fill_beam_gaps, wide_unknown
from maps.cell_array import cell_array

SIDE = 60


def floor_with(wide_cells: int) -> GridMap:
    """Return a floor with a strip of unknown cells across it."""
    cells = np.full((SIDE, SIDE), FREE, np.uint8)
    cells[:, 30 : 30 + wide_cells] = UNKNOWN
    return GridMap(SIDE, SIDE, 0.05, 0.0, 0.0, cells.tobytes())


@pytest.mark.parametrize("wide_cells", range(1, 9))
def test_a_strip_is_a_gap_while_it_is_thin(wide_cells: int) -> None:
    grid = floor_with(wide_cells)
    thin = wide_cells * grid.resolution_m < THIN_M
    assert wide_unknown(grid).any() != thin
    assert (UNKNOWN in fill_beam_gaps(grid).cells) != thin


def test_the_strip_before_a_wall_stays_unknown() -> None:
    cells = np.full((SIDE, SIDE), FREE, np.uint8)
    cells[:, 40], cells[:, 39] = OCCUPIED, UNKNOWN
    grid = GridMap(SIDE, SIDE, 0.05, 0.0, 0.0, cells.tobytes())
    assert fill_beam_gaps(grid) == grid


def test_what_is_known_is_never_changed() -> None:
    cells = np.random.default_rng(1).integers(0, 3, (SIDE, SIDE)).astype(np.uint8)
    grid = GridMap(SIDE, SIDE, 0.05, 0.0, 0.0, cells.tobytes())
    filled = cell_array(fill_beam_gaps(grid))
    assert (filled[cells != UNKNOWN] == cells[cells != UNKNOWN]).all()
    assert set(np.unique(filled[cells == UNKNOWN])) <= {FREE, UNKNOWN}


def test_unknown_floor_at_the_edge_of_the_map_is_wide() -> None:
    cells = np.full((SIDE, SIDE), FREE, np.uint8)
    cells[:, :2] = UNKNOWN
    assert wide_unknown(GridMap(SIDE, SIDE, 0.05, 0.0, 0.0, cells.tobytes()))[:, :2].all()
