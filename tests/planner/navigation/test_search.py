"""Hold the search to the cheapest way, judged by an independent Bellman-Ford over the cells."""

from __future__ import annotations

from itertools import pairwise
from math import inf, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from planner.navigation.search import _GREED, Lattice, costs_to, find_path

Cell = tuple[int, int]


def steps(cost: NDArray[np.float32], column: int, row: int) -> list[tuple[Cell, float]]:
    """Return where one may step from a cell, and at what price."""
    rows, columns = cost.shape

    def at(c: int, r: int) -> float:
        return float(cost[r, c]) if 0 <= c < columns and 0 <= r < rows else inf

    found = []
    for dc, dr in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)]:
        c, r = column + dc, row + dr
        if inf not in (at(c, r), at(c, row), at(column, r)):
            length = sqrt(2) if dc and dr else 1.0
            found.append(((c, r), length * (at(column, row) + at(c, r)) / 2))
    return found


def cheapest(cost: NDArray[np.float32], start: Cell) -> dict[Cell, float]:
    """Relax every step until nothing changes: slow, and with nothing in common with A*."""
    best, changed = {start: 0.0}, True
    while changed:
        changed = False
        for cell, so_far in list(best.items()):
            for there, price in steps(cost, *cell):
                if so_far + price < best.get(there, inf) - 1e-9:
                    best[there] = so_far + price
                    changed = True
    return best


@st.composite
def floors(draw: st.DrawFn) -> NDArray[np.float32]:
    rows, columns = draw(st.integers(1, 7)), draw(st.integers(1, 7))
    cells = st.sampled_from([1.0, 1.0, 1.5, 4.0, inf])
    values = draw(st.lists(cells, min_size=rows * columns, max_size=rows * columns))
    cost = np.array(values, np.float32).reshape(rows, columns)
    cost[0, 0] = cost[-1, -1] = 1.0
    return cost


@given(floors(), st.booleans())
def test_the_way_found_is_the_cheapest_there_is(cost: NDArray[np.float32], known: bool) -> None:
    lattice = Lattice.of(cost)
    goal_cell = (cost.shape[1] - 1, cost.shape[0] - 1)
    start, goal = lattice.index(0, 0), lattice.index(*goal_cell)
    path = find_path(lattice, start, goal, costs_to(lattice, goal) if known else None)
    wanted = cheapest(cost, (0, 0)).get(goal_cell)
    if wanted is None:
        assert path is None
        return
    assert path is not None
    cells = [lattice.cell(index) for index in path]
    assert (cells[0], cells[-1]) == ((0, 0), goal_cell)
    total = 0.0
    for here, there in pairwise(cells):
        total += dict(steps(cost, *here))[there]
    assert wanted * (1 - 1e-9) <= total <= wanted * _GREED


@given(floors(), st.data())
def test_landmarks_of_a_freer_floor_change_no_cost(
    cost: NDArray[np.float32], data: st.DataObject
) -> None:
    """Costs to any cells, worked out before obstacles raised some, only ever bound from below."""
    freer = np.where(np.isinf(cost), 1.0, np.maximum(1.0, cost - 0.5)).astype(np.float32)
    before, lattice = Lattice.of(freer), Lattice.of(cost)
    rows, columns = cost.shape
    marks = data.draw(
        st.lists(
            st.tuples(st.integers(0, columns - 1), st.integers(0, rows - 1)), min_size=1, max_size=4
        )
    )
    fields = [costs_to(before, before.index(*mark)) for mark in marks]
    start, goal = lattice.index(0, 0), lattice.index(columns - 1, rows - 1)
    path = find_path(lattice, start, goal, landmarks=fields)
    wanted = cheapest(cost, (0, 0)).get((columns - 1, rows - 1))
    assert (path is None) == (wanted is None)
    if path is None or wanted is None:
        return
    cells = [lattice.cell(index) for index in path]
    total = sum(dict(steps(cost, *here))[there] for here, there in pairwise(cells))
    assert total <= wanted * _GREED + 1e-6


@given(floors())
def test_costs_to_a_goal_are_exact_everywhere(cost: NDArray[np.float32]) -> None:
    lattice = Lattice.of(cost)
    field = costs_to(lattice, lattice.index(0, 0))
    wanted = cheapest(cost, (0, 0))
    for row, column in np.ndindex(cost.shape):
        assert field[lattice.index(column, row)] == pytest.approx(wanted.get((column, row), inf))


@given(floors(), st.data())
def test_costs_of_a_freer_floor_still_lead_to_the_cheapest_way(
    cost: NDArray[np.float32], data: st.DataObject
) -> None:
    freer = Lattice.of(cost)
    goal = freer.index(cost.shape[1] - 1, cost.shape[0] - 1)
    field = costs_to(freer, goal)
    blocked = cost.copy()
    row = data.draw(st.integers(0, cost.shape[0] - 1))
    column = data.draw(st.integers(0, cost.shape[1] - 1))
    blocked[row, column] = inf
    if np.isinf(blocked[0, 0]) or np.isinf(blocked[-1, -1]):
        return
    lattice = Lattice.of(blocked)
    path = find_path(lattice, lattice.index(0, 0), goal, field)
    wanted = cheapest(blocked, (0, 0)).get((cost.shape[1] - 1, cost.shape[0] - 1))
    assert (path is None) == (wanted is None)
    if path is not None and wanted is not None:
        cells = [lattice.cell(index) for index in path]
        pairs = pairwise(cells)
        total = sum(dict(steps(blocked, *a))[b] for a, b in pairs)
        assert wanted * (1 - 1e-9) <= total <= wanted * _GREED


def test_start_and_goal_in_one_cell_are_a_way_of_one_cell() -> None:
    lattice = Lattice.of(np.ones((2, 2), np.float32))
    cell = lattice.index(1, 1)
    assert find_path(lattice, cell, cell) == [cell]
