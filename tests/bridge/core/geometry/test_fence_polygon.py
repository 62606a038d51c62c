"""Hold outlines, their edges and what bounds to numbers worked out by hand."""

from __future__ import annotations

from itertools import pairwise
from math import inf, nan

import pytest

from bridge.core.geometry.fence import (
    Edge,
    Polygon,
    bounds,
    contains,
    cut,
    edges_of,
    meet,
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
