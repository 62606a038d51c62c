"""Hold the coarse-to-fine search to the exact one: the same floors joined, nearly its cost."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from planner.navigation.coarse_search import (
    BLOCK,
    CellFloor,
    CoarseFloor,
    cheapest_of_blocks,
    floor_of,
)
from planner.navigation.search import costs_to

Floats = NDArray[np.float32]
SIZES = st.integers(60, 140)


def office(seed: int, rows: int, columns: int, wall: int, doors: bool = True) -> Floats:
    """Make costs of rooms between walls of ``wall`` cells, dearer near them, a door in most."""
    random = np.random.default_rng(seed)
    cost = random.uniform(1.0, 1.5, (rows, columns)).astype(np.float32)
    for start in range(30, columns - 20, 30):
        cost[:, start - 4 : start + wall + 4] = 4.0
        cost[:, start : start + wall] = np.inf
        if doors:
            door = int(random.integers(0, rows - 8))
            cost[door : door + 8, start : start + wall] = 3.0
    for start in range(30, rows - 20, 30):
        door = int(random.integers(0, columns - 8))
        across = cost[start : start + wall]
        kept = across[:, door : door + 8].copy()
        across[:] = np.inf
        across[:, door : door + 8] = np.where(np.isfinite(kept), kept, 3.0)
    return cost


def cost_of(cost: Floats, cells: list[tuple[int, int]]) -> float:
    """Add up what a way of cells (column, row) costs."""
    return sum(
        hypot(x - u, y - v) * float(cost[y, x] + cost[v, u]) / 2
        for (x, y), (u, v) in pairwise(cells)
    )


@given(st.integers(0, 10_000), SIZES, SIZES, st.integers(7, 12))
def test_it_joins_what_cells_join_at_nearly_the_least_cost(
    seed: int, rows: int, columns: int, wall: int
) -> None:
    cost = office(seed, rows, columns, wall)
    free = np.argwhere(np.isfinite(cost))
    (y, x), (v, u) = np.random.default_rng(seed).choice(free, 2).tolist()
    best = CellFloor(cost).find_path((x, y), (u, v), {})
    found = CoarseFloor(cost).find_path((x, y), (u, v), {})
    assert (best is None) == (found is None)
    if best is None or found is None:
        return
    assert found[0] == (x, y)
    assert found[-1] == (u, v)
    assert all(max(abs(a - c), abs(b - d)) == 1 for (a, b), (c, d) in pairwise(found))
    for (a, b), (c, d) in pairwise(found):
        assert np.isfinite([cost[b, a], cost[d, c], cost[b, c], cost[d, a]]).all(), "no corner cut"
    # On a floor as small as this one, the ends' own blocks weigh most.
    assert cost_of(cost, found) <= 1.03 * cost_of(cost, best) + 2.0 * BLOCK


@given(st.integers(0, 10_000))
def test_fields_over_blocks_change_no_answer(seed: int) -> None:
    cost = office(seed, 100, 130, 8)
    floor, goal = CoarseFloor(cost), (5, 5)
    if not np.isfinite(cost[5, 5]) or not np.isfinite(cost[95, 125]):
        return
    fields = {
        end: costs_to(floor.lattice, end) for end in (floor.index(goal), floor.index((60, 60)))
    }
    plain, known = (floor.find_path((125, 95), goal, given) for given in ({}, fields))
    assert (plain is None) == (known is None)
    if plain is not None and known is not None:
        assert cost_of(cost, known) == pytest.approx(cost_of(cost, plain), rel=0.02)


def test_walls_that_only_blocks_pass_are_not_passed() -> None:
    cost = np.ones((80, 80), np.float32)
    cost[:, 41:43] = np.inf  # narrower than a block, so blocks see no wall
    assert CoarseFloor(cost).find_path((5, 5), (70, 70), {}) is None
    cost[77:, 41:43] = 1.0  # a way that the first corridor does not hold
    found = CoarseFloor(cost).find_path((5, 5), (70, 5), {})
    assert found is not None
    assert any(row >= 77 for _, row in found)


def test_a_block_is_as_cheap_as_its_cheapest_cell() -> None:
    cost = np.full((BLOCK + 1, BLOCK), np.inf, np.float32)
    cost[1, 2], cost[BLOCK, 0] = 3.0, 2.0
    assert cheapest_of_blocks(cost).tolist() == [[3.0], [2.0]]


def test_only_floors_that_are_large_and_fine_are_searched_by_blocks() -> None:
    large, small = np.ones((600, 600), np.float32), np.ones((200, 200), np.float32)
    assert isinstance(floor_of(large, 0.05, 0.3), CoarseFloor)
    assert isinstance(floor_of(small, 0.05, 0.3), CellFloor)
    assert isinstance(floor_of(large, 0.10, 0.3), CellFloor), "blocks wider than a radius"
