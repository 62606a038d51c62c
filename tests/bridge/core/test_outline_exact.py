"""Hold the geometry of outlines to shapes that are drawn by hand, their corners included."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, inf, isnan, nan, sqrt

import pytest

from bridge.core.geometry import fence as fences
from bridge.core.geometry.fence import FenceCell, Zone, build_fence
from bridge.core.geometry.polygon import (
    Edge,
    Polygon,
    bounds,
    contains,
    cut,
    edges_of,
    meet,
    nearest_m,
    permits,
)
from tests.bridge.core.table import table


def box(x0: float, y0: float, x1: float, y1: float) -> Polygon:
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def line(x0: float, y0: float, x1: float, y1: float) -> Edge:
    return x0, y0, x1 - x0, y1 - y0, (x1 - x0) ** 2 + (y1 - y0) ** 2


def elsewhere(edge: Edge) -> Edge:
    """Turn an edge by 53 degrees, five times as long, 2 m and 3 m away: still round numbers."""
    x, y, dx, dy, square = edge
    return 2 + 3 * x - 4 * y, 3 + 4 * x + 3 * y, 3 * dx - 4 * dy, 4 * dx + 3 * dy, 25 * square


@table(("beside_m", "parts"), [(0.95e-6, 2), (-0.95e-6, 2), (1.05e-6, 1), (-1.05e-6, 1)])
def test_an_end_within_a_micrometre_of_an_edge_cuts_it(beside_m: float, parts: int) -> None:
    # beside the middle an edge begins that leads away
    away = line(0.5, beside_m, 0.5, 1.0 if beside_m > 0.0 else -1.0)
    assert len(cut(line(0.0, 0.0, 1.0, 0.0), [away])) == parts


@table(("gap_m", "parts"), [(0.95e-6, 1), (1.05e-6, 2)])
def test_a_piece_of_less_than_a_micrometre_is_left_out(gap_m: float, parts: int) -> None:
    assert len(cut(line(0.0, 0.0, 1.0, 0.0), [line(gap_m, -1.0, gap_m, 1.0)])) == parts


ROOF: Polygon = ((0, 0), (4, 0), (4, 2), (1, 3), (0, 1))
"""Slopes on its left and at its top."""


@table(
    ("x", "y", "inside"),
    [
        (2.0, 1.0, True), (0.1, 0.5, True), (-0.1, 0.5, False), (3.9, 1.9, True),
        (4.1, 1.0, False), (2.0, 2.6, True), (2.0, 2.7, False), (0.4, 2.0, False),
        (0.6, 2.0, True), (0.9, 2.9, False), (0.97, 2.9, True), (1.2, 2.9, True), (1.4, 2.9, False),
        (1.0, 3.1, False), (2.0, -0.1, False), (-9.0, 1.0, False), (9.0, 1.5, False),
        (nan, 1.0, False), (2.0, nan, False), (inf, 1.0, False), (0.0, 0.5, True),
        (4.0, 1.0, False), (2.0, 0.0, True), (0.5, 2.0, True),
    ],
)  # fmt: skip
def test_inside_an_outline(x: float, y: float, inside: bool) -> None:
    """The left and the lower line belong to it, the right and the upper do not."""
    assert contains(ROOF, x, y) is inside
    assert contains(tuple(reversed(ROOF)), x, y) is inside


def test_permitted_is_inside_one_and_outside_all_keep_outs() -> None:
    allowed, holes = (box(0, 0, 2, 2), box(3, 0, 5, 2)), (box(1, 1, 1.5, 1.5), box(4, 0, 4.5, 1))
    for x, y, fits in ((0.5, 0.5, True), (3.5, 0.5, True), (2.5, 0.5, False), (1.2, 1.2, False),
                       (4.2, 0.5, False), (4.2, 1.2, True)):  # fmt: skip
        assert permits(allowed, holes, x, y) is fits
    assert not permits((), holes, 0.5, 0.5)


def test_edges_close_the_outline_and_leave_out_what_has_no_length() -> None:
    triangle: Polygon = ((0, 0), (3, 0), (3, 0), (0, 4))
    assert edges_of(triangle) == [(0, 0, 3, 0, 9), (3, 0, -3, 4, 25), (0, 4, 0, -4, 16)]
    # so short that its square is none: no division by zero
    tiny: Polygon = ((0, 0), (1e-200, 0), (0, 1e-200))
    assert [edge[4] for edge in edges_of(tiny)] == [1e-300] * 3


@table(
    ("others", "at"),
    [
        ([], []),
        ([line(1, -1, 1, 1)], [1]),
        ([line(1, 0, 1, 1)], [1]),  # ends on it
        ([line(1, -1, 1, 0)], [1]),
        ([line(1, 0.5, 1, 1)], []),
        ([line(1, -1, 1, -0.5)], []),
        ([line(3, -1, 5, 1)], []),  # meets its line at its very end: no cut
        ([line(3, 1, 6, 4)], []),
        ([line(1, 0, 3, 0)], [1, 3]),  # lies on it
        ([line(-1, 0, 3, 0)], [3]),
        ([line(1, 1e-5, 3, 1e-5)], []),
        ([line(1, 0.9e-6, 3, 0.9e-6)], [1, 3]),
        ([line(1, -0.9e-6, 3, 1.1e-6)], [1, 1.9]),
        ([line(0, -1, 4, 3)], [1]),
        ([line(4, -1, 0, 3)], [3]),
        ([line(1, -1, 1, 1), line(1, 1, 1, -1)], [1]),
        ([line(1, -1, 1, 1), line(1 + 0.9e-6, -1, 1 + 0.9e-6, 1)], [1]),
        ([line(3, -1, 3, 1), line(1, -2, 1, 1)], [1, 3]),
        ([line(1, -1, 2, 3)], [1.25]),
        ([line(1, -1, 1, -0.0625)], []),
        ([line(4.25, -1, 4.25, 1)], []),
        ([line(-0.25, -1, -0.25, 1)], []),
    ],
)
@table("turned", [False, True])
def test_an_edge_is_cut_where_others_meet_it(
    others: list[Edge], at: list[float], turned: bool
) -> None:
    edge = line(0, 0, 4, 0)
    if turned and any(16 * number % 1 for other in others for number in other[:4]):
        return  # a micrometre is no round number there
    if turned:
        edge, *others = [elsewhere(one) for one in (edge, *others)]
    parts = cut(edge, others)
    marks = [0.0, *at, 4.0]
    expected = [line(a, 0, b, 0) for a, b in pairwise(marks)]
    if turned:
        expected = [elsewhere(one) for one in expected]
    assert len(parts) == len(expected)
    for part, wanted in zip(parts, expected, strict=True):
        assert part == pytest.approx(wanted, abs=1e-5)


def test_a_line_bounds_where_one_side_alone_is_permitted() -> None:
    allowed, holes = (box(0, 0, 2, 2), box(2, 0, 4, 2), box(1, 0, 3, 1)), (box(0.5, 0.5, 1, 1),)
    for part, is_one in (
        (line(0, 0, 2, 0), True), (line(0, 2, 0, 0), True), (line(2, 0, 2, 2), False),
        (line(1, 0, 1, 0.4), False), (line(0.5, 0.5, 1, 0.5), True), (line(1, 1, 0.5, 1), True),
        (line(1.2, 0.2, 1.4, 1.8), False), (line(9, 9, 9, 10), False), (line(4, 0, 4, 2), True),
        (line(0, 1.5, 0, 1.500001), True), (line(0, 1.5, 3, 1.5), False),
        (line(0, 2, 4, 2), True), (line(4, 2, 2, 2), True),
    ):  # fmt: skip
        assert bounds(part, allowed, holes) is is_one, part


@table(
    ("segment", "edge", "touches"),
    [
        ((0, 0, 2, 2), line(0, 2, 2, 0), True),
        ((0, 0, 1, 1), line(0, 2, 2, 0), True),  # just
        ((0, 0, 0.99, 0.99), line(0, 2, 2, 0), False),
        ((1, 1, 2, 2), line(0, 2, 2, 0), True),
        ((1.01, 1.01, 2, 2), line(0, 2, 2, 0), False),
        ((0, 0, 3, 1), line(0, 2, 2, 0), True),
        ((0, 2, 1, 3), line(0, 2, 2, 0), True),
        ((2, 0, 3, 3), line(0, 2, 2, 0), True),
        ((2.01, 0, 3, 3), line(0, 2, 2, 0), False),
        ((0, 2.01, 1, 3), line(0, 2, 2, 0), False),
        ((-1, 3.5, 0.5, 1.8), line(0, 2, 2, 0), False),
        ((0, 0, 2, 0), line(1, 0, 3, 0), True),  # parallel from here on
        ((0, 0, 1, 0), line(1, 0, 3, 0), True),
        ((0, 0, 0.9, 0), line(1, 0, 3, 0), False),
        ((3, 0, 4, 0), line(1, 0, 3, 0), True),
        ((3.1, 0, 4, 0), line(1, 0, 3, 0), False),
        ((4, 0, 3, 0), line(3, 0, 1, 0), True),
        ((4, 0, 3.1, 0), line(3, 0, 1, 0), False),
        ((1.5, 0, 2, 0), line(1, 0, 3, 0), True),
        ((0, 0, 9, 0), line(3, 0, 1, 0), True),
        ((0, 1, 2, 1), line(1, 0, 3, 0), False),
        ((0, 0, 2, 4), line(1, 2, 2, 4), True),
        ((0, 0, 2, 4), line(1, 2.1, 2, 4.1), False),
        ((2, 0, 2, 0), line(1, 0, 3, 0), True),  # a point
        ((1, 0, 1, 0), line(1, 0, 3, 0), True),
        ((3, 0, 3, 0), line(1, 0, 3, 0), True),
        ((3.1, 0, 3.1, 0), line(1, 0, 3, 0), False),
        ((0.9, 0, 0.9, 0), line(1, 0, 3, 0), False),
        ((2, 0.1, 2, 0.1), line(1, 0, 3, 0), False),
        ((1.5, 1, 1.5, 1), line(1, 0, 2, 2), True),
        ((1.5, 1.1, 1.5, 1.1), line(1, 0, 2, 2), False),
        ((1.25, 2.5, 1.25, 2.5), line(1, 2, 2, 4), True),  # on a slope that begins beside zero
        ((0.75, 1.5, 0.75, 1.5), line(1, 2, 2, 4), False),
        ((0, 0, 2, 4), line(3, 6, 4, 8), False),
        ((0, 0, 2, 4), line(2, 4, 4, 8), True),
    ],
)
def test_a_segment_touches_an_edge(
    segment: tuple[float, float, float, float], edge: Edge, touches: bool
) -> None:
    x0, y0, x1, y1 = segment
    assert meet(x0, y0, x1 - x0, y1 - y0, edge) is touches
    ex, ey, dx, dy, square = edge
    assert meet(x0, y0, x1 - x0, y1 - y0, (ex + dx, ey + dy, -dx, -dy, square)) is touches


@table(
    ("x", "y", "away"),
    [
        (1, 1, 1.0), (-1, -1, sqrt(2)), (5, 0, 1.0), (4, 1, 1.0), (2, -3, 3.0), (5, 3.5, 1.0),
        (6, 3, 2.0), (6, 5, hypot(2, 2)), (3, 2, 1.0), (4, 3, 0.0), (0, 0, 0.0),
    ],
)  # fmt: skip
def test_how_far_the_nearest_edge_is(x: float, y: float, away: float) -> None:
    edges = (line(0, 0, 4, 0), line(4, 2, 4, 3))
    if (x, y) == (5, 3.5):
        away = hypot(1, 0.5)
    assert nearest_m(edges, x, y) == pytest.approx(away)
    assert nearest_m(tuple(reversed(edges)), x, y) == pytest.approx(away)
    assert nearest_m((), x, y) == inf
    assert isnan(nearest_m(edges, nan, y))


# The fence that is built of them ---------------------------------------------------------------

ROOM = build_fence(
    "0" * 16, (box(-3, -1, 9, 5),), (box(2, 1, 3, 2),), (Zone(box(0, 0, 2, 2), 0.3),)
)


def test_cells_hold_all_that_may_be_seen_from_them() -> None:
    room = build_fence("0" * 16, ROOM.allowed, ROOM.keep_outs)
    assert (room.cell_m, room.cells) == (0.25, ROOM.cells)  # 12 m in 48
    assert build_fence("0" * 16, (box(0, -12, 3, 12),)).cell_m == 0.5
    assert build_fence("0" * 16, (box(-10, 0, 15, 3),)).cell_m == pytest.approx(25 / 48)
    assert build_fence("0" * 16, ()).cells == {}
    low, high = min(room.cells), max(room.cells)
    assert (low, high) == ((-16, -8), (40, 24))  # 1 m more than the outline, all around
    half = 0.125 * sqrt(2) + 1e-6
    for (i, j), cell in room.cells.items():
        if (i + 3 * j) % 7:
            continue
        x, y = (i + 0.5) * 0.25, (j + 0.5) * 0.25
        away = nearest_m(ROOM.boundary, x, y)
        assert set(cell.edges) == {e for e in ROOM.boundary if nearest_m((e,), x, y) <= 1.0 + half}
        assert (cell.inside is None) is (away <= half)
        if cell.inside is not None:
            assert cell.inside is permits(ROOM.allowed, ROOM.keep_outs, x, y)


@table(
    ("x", "y", "allowed", "margin"),
    [
        (0.0, 0.0, True, 1.0), (-2.75, 1.0, True, 0.25), (-3.25, 1.0, False, -0.25),
        (2.5, 1.5, False, -0.5), (2.5, 0.8, True, 0.2), (3.1, 2.1, True, hypot(0.1, 0.1)),
        (9.9, 3.0, False, -0.9), (10.5, 3.0, False, -1.0), (1e6, 0.0, False, -1.0),
        (0.0, -1e6, False, -1.0), (nan, 0.0, False, -1.0), (5.0, 2.0, True, 1.0),
        (-2.99, -0.99, True, 0.01), (8.9, 4.95, True, 0.05),
    ],
)  # fmt: skip
def test_margins_of_a_room(x: float, y: float, allowed: bool, margin: float) -> None:
    assert ROOM.allows(x, y) is allowed
    assert ROOM.margin_m(x, y) == pytest.approx(margin)


def test_long_and_short_segments_are_tried_against_all_that_they_can_meet() -> None:
    for x0, y0, x1, y1, crosses in (
        (1.0, 1.5, 1.9, 1.5, False), (1.0, 1.5, 2.0, 1.5, True), (1.9, 1.5, 3.1, 1.5, True),
        (1.5, 1.5, 3.5, 1.5, True), (-2.0, 1.5, 8.0, 1.5, True), (-2.0, 2.5, 8.0, 2.5, False),
        (-2.0, 0.5, -3.5, 0.5, True), (8.5, 4.5, 8.5, 5.5, True), (1.9, 0.9, 3.1, 0.9, False),
        (1.0, 0.0, 1.0, 1.0, False), (2.5, 1.5, 2.5, 1.6, True), (4.0, 1.5, 2.5, 1.5, True),
        (0.7, -0.6, 4.3, 3.0, True), (0.5, 1.5, 4.0, 1.5, True), (2.5, -0.9, 2.5, 4.0, True),
    ):  # fmt: skip
        assert ROOM.crosses(x0, y0, x1, y1) is crosses, (x0, y0, x1, y1)
        assert ROOM.crosses(x1, y1, x0, y0) is crosses


def test_a_square_on_the_boundary_answers_point_by_point() -> None:
    cell = fences._cell_at(0.0, 0.0, 0.25, (line(0, -9, 0, 9),), (box(0, -9, 9, 9),), ())
    assert cell == FenceCell((line(0, -9, 0, 9),), None)
    for x, inside, edges in ((0.18, True, 1), (-0.18, False, 1), (1.17, True, 1), (1.18, True, 0)):
        cell = fences._cell_at(x, 0.0, 0.25, (line(0, -9, 0, 9),), (box(0, -9, 9, 9),), ())
        assert (cell.inside, len(cell.edges)) == (inside, edges)
