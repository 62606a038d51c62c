"""Hold the fence to its outlines: inside, margins, crossings, zones, and the file it comes from."""

from __future__ import annotations

import json
from itertools import pairwise
from math import hypot, inf, nan, sqrt
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geometry import fence as fences
from bridge.core.geometry.fence import (
    SIGHT_M,
    Edge,
    FenceCell,
    Polygon,
    Zone,
    bounds,
    build_fence,
    contains,
    cut,
    edges_of,
    meet,
    nearest_m,
    permits,
)
from bridge.fence_file import load_fence, parse_fence
from tests.bridge.core.table import table
from wire.errors import ConfigError
from wire.fingerprint import fingerprint

MAP = "0123456789abcdef"


def box(x0: float, y0: float, x1: float, y1: float) -> Polygon:
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


ROOM = build_fence(MAP, (box(0, 0, 6, 4),), (box(2, 1, 3, 2),))


# two rooms that overlap in a doorway: the overlap's lines are no fence
PAIR = build_fence(MAP, (box(0, 0, 3, 3), box(2.5, 1, 6, 2)))


@pytest.mark.parametrize(
    ("a", "b", "crosses"),
    [
        ((1.9, 1.0), (3.1, 1.0), True),
        ((1.9, 1.8), (2.3, 2.2), True),
        ((7, 7), (8, 8), True),
        ((float("nan"), 1), (1, 1), True),
        ((1, 1), (1, float("inf")), True),
    ],
)
def test_segments(a: tuple[float, float], b: tuple[float, float], crosses: bool) -> None:
    assert ROOM.crosses(*a, *b) is crosses


def test_lines_between_overlapping_outlines_are_no_fence() -> None:
    assert not PAIR.crosses(1, 1.5, 5, 1.5)
    assert PAIR.margin_m(2.75, 1.5) == pytest.approx(hypot(0.25, 0.5))
    assert PAIR.crosses(2.75, 1.5, 4, 2.5)


def test_a_fence_that_allows_nothing_lets_nothing_in() -> None:
    nothing = build_fence(MAP, ())
    assert not nothing.allows(0, 0)
    assert nothing.margin_m(0, 0) == -SIGHT_M


@given(st.floats(-1.5, 7.5), st.floats(-1.5, 5.5))
def test_cells_answer_as_the_whole_boundary_does(x: float, y: float) -> None:
    sides = [min(x, 6 - x), min(y, 4 - y)]
    if all(side > 1e-6 for side in sides) and not (2 <= x <= 3 and 1 <= y <= 2):
        hole = hypot(max(2 - x, 0, x - 3), max(1 - y, 0, y - 2))
        expected = min(*sides, hole, SIGHT_M)
        if hole > 1e-6:
            assert ROOM.margin_m(x, y) == pytest.approx(expected)


@given(st.floats(), st.floats())
def test_no_number_raises_and_none_is_let_in(x: float, y: float) -> None:
    allowed = ROOM.allows(x, y)
    assert not allowed or (0 <= x <= 6 and 0 <= y <= 4)
    assert allowed or ROOM.margin_m(x, y) <= 0
    assert ROOM.crosses(x, y, y, x) in (True, False)
    assert ROOM.zones_near(x, y) == []


def _text(**change: object) -> bytes:
    record = {
        "version": 1,
        "map_id": MAP,
        "allowed": [[[0, 0], [6, 0], [6, 4], [0, 4]]],
        "keep_outs": [],
        "speed_zones": [],
    }
    return json.dumps(record | change).encode()


def test_a_file_becomes_a_fence_and_its_hash(tmp_path: Path) -> None:
    path = tmp_path / "fence.json"
    zone = {"polygon": [[0, 0], [1, 0], [1, 1]], "max_speed_mps": 0.2}
    path.write_bytes(_text(speed_zones=[zone]))
    fence, digest = load_fence(path)
    assert fence.map_id == MAP
    assert fence.zones_near(0.8, 0.1) == [(0.0, 0.2)]
    assert digest == fingerprint(path.read_bytes())


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (b"", "fence_invalid"),
        (b"{}", "fence_invalid"),
        (_text(version=2), "fence_invalid"),
        (_text(alowed=[]), "fence_invalid"),
        (_text(allowed=[]), "fence_invalid"),
        (_text(allowed=[[[0, 0], [1, 1]]]), "fence_invalid"),
        (_text(allowed=[[[0, 0], [1, 1], [2, 2]]]), "fence_degenerate"),
        (_text(allowed=[[[0, 0], [1e9, 0], [0, 1]]]), "fence_invalid"),
        (_text(map_id="x"), "fence_invalid"),
        (_text(keep_outs=[[[-1, -1], [7, -1], [7, 5], [-1, 5]]]), "fence_empty"),
        (_text(keep_outs=[[[0, 0], [6, 0], [6, 4], [0, 4]]]), "fence_empty"),
        (
            _text(keep_outs=[[[0, 0], [3, 0], [3, 4], [0, 4]], [[3, 0], [6, 0], [6, 4], [3, 4]]]),
            "fence_empty",
        ),
    ],
)
def test_a_wrong_file_is_refused(data: bytes, code: str) -> None:
    with pytest.raises(ConfigError) as caught:
        parse_fence(data)
    assert caught.value.code == code


def test_a_fence_that_leaves_a_strip_is_none_that_leaves_nothing() -> None:
    strip = parse_fence(_text(keep_outs=[[[0, 0], [5.9, 0], [5.9, 4], [0, 4]]]))
    assert strip.allows(5.95, 2.0)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="fence_missing"):
        load_fence(tmp_path / "none.json")


def oblong(x0: float, y0: float, x1: float, y1: float) -> Polygon:
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def line(x0: float, y0: float, x1: float, y1: float) -> Edge:
    return x0, y0, x1 - x0, y1 - y0, (x1 - x0) ** 2 + (y1 - y0) ** 2


ROOMS = build_fence(
    "0" * 16, (oblong(-3, -1, 9, 5),), (oblong(2, 1, 3, 2),), (Zone(oblong(0, 0, 2, 2), 0.3),)
)


def test_cells_hold_all_that_may_be_seen_from_them() -> None:
    room = build_fence("0" * 16, ROOMS.allowed, ROOMS.keep_outs)
    assert (room.cell_m, room.cells) == (0.25, ROOMS.cells)  # 12 m in 48
    assert build_fence("0" * 16, (oblong(0, -12, 3, 12),)).cell_m == 0.5
    assert build_fence("0" * 16, (oblong(-10, 0, 15, 3),)).cell_m == pytest.approx(25 / 48)
    assert build_fence("0" * 16, ()).cells == {}
    low, high = min(room.cells), max(room.cells)
    assert (low, high) == ((-16, -8), (40, 24))  # 1 m more than the outline, all around
    half = 0.125 * sqrt(2) + 1e-6
    for (i, j), cell in room.cells.items():
        if (i + 3 * j) % 7:
            continue
        x, y = (i + 0.5) * 0.25, (j + 0.5) * 0.25
        away = nearest_m(ROOMS.boundary, x, y)
        assert set(cell.edges) == {e for e in ROOMS.boundary if nearest_m((e,), x, y) <= 1.0 + half}
        assert (cell.inside is None) is (away <= half)
        if cell.inside is not None:
            assert cell.inside is permits(ROOMS.allowed, ROOMS.keep_outs, x, y)


def test_long_and_short_segments_are_tried_against_all_that_they_can_meet() -> None:
    for x0, y0, x1, y1, crosses in (
        (1.0, 1.5, 1.9, 1.5, False), (1.0, 1.5, 2.0, 1.5, True), (1.9, 1.5, 3.1, 1.5, True),
        (1.5, 1.5, 3.5, 1.5, True), (-2.0, 1.5, 8.0, 1.5, True), (-2.0, 2.5, 8.0, 2.5, False),
        (-2.0, 0.5, -3.5, 0.5, True), (8.5, 4.5, 8.5, 5.5, True), (1.9, 0.9, 3.1, 0.9, False),
        (1.0, 0.0, 1.0, 1.0, False), (2.5, 1.5, 2.5, 1.6, True), (4.0, 1.5, 2.5, 1.5, True),
        (0.7, -0.6, 4.3, 3.0, True), (0.5, 1.5, 4.0, 1.5, True), (2.5, -0.9, 2.5, 4.0, True),
    ):  # fmt: skip
        assert ROOMS.crosses(x0, y0, x1, y1) is crosses, (x0, y0, x1, y1)
        assert ROOMS.crosses(x1, y1, x0, y0) is crosses


def test_a_square_on_the_boundary_answers_point_by_point() -> None:
    cell = fences._cell_at(0.0, 0.0, 0.25, (line(0, -9, 0, 9),), (oblong(0, -9, 9, 9),), ())
    assert cell == FenceCell((line(0, -9, 0, 9),), None)
    for x, inside, edges in ((0.18, True, 1), (-0.18, False, 1), (1.17, True, 1), (1.18, True, 0)):
        cell = fences._cell_at(x, 0.0, 0.25, (line(0, -9, 0, 9),), (oblong(0, -9, 9, 9),), ())
        assert (cell.inside, len(cell.edges)) == (inside, edges)


def test_marks_take_away_from_a_fence_and_are_prepared_once() -> None:
    square = ((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0))
    fence = build_fence("m", (square,))

    def text(x: float) -> str:
        corners = f"[[{x},1],[{x + 1},1],[{x + 1},2],[{x},2]]"
        zone = f'{{"polygon":{corners},"max_speed_mps":0.2}}'
        head = '"version":1,"map_id":"0123456789abcdef"'
        return f'{{{head},"keep_outs":[{corners}],"speed_zones":[{zone}]}}'

    marked = fence.with_marks(text(1.0))
    assert fence.allows(1.5, 1.5)
    assert not marked.allows(1.5, 1.5)
    assert marked.margin_m(0.5, 1.5) == pytest.approx(0.5)
    ((gap_m, speed_mps),) = marked.zones_near(0.5, 1.5)
    assert (gap_m, speed_mps) == pytest.approx((0.5, 0.2))
    assert marked.zones_near(1.5, 1.5) == [(0.0, 0.2)]
    assert marked.zones_near(3.9, 3.9) == []
    assert fence.with_marks(text(1.0)) is marked
    for step in range(20):
        fence.with_marks(text(1.0 + 0.01 * step), kept=text(1.0))
    assert len(fence.marked) <= 8
    assert fence.with_marks(text(1.0)) is marked, "what is in force is never prepared in a tick"
    for step in range(20):
        fence.with_marks(text(1.0 + 0.01 * step))
    assert fence.with_marks(text(1.0)) == marked


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
