"""Hold the fence's geometry against shapes whose answers are known, and against sampling."""

from __future__ import annotations

import json
from math import hypot
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geometry.fence import SIGHT_M, Zone, build_fence
from bridge.fence_file import load_fence, parse_fence
from wire.errors import Misconfigured
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from pathlib import Path

    from bridge.core.geometry.polygon import Polygon

MAP = "0123456789abcdef"


def box(x0: float, y0: float, x1: float, y1: float) -> Polygon:
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


ROOM = build_fence(MAP, (box(0, 0, 6, 4),), (box(2, 1, 3, 2),))
# two rooms that overlap in a doorway: the overlap's lines are no fence
PAIR = build_fence(MAP, (box(0, 0, 3, 3), box(2.5, 1, 6, 2)))
# two rooms that share a whole edge
TWINS = build_fence(MAP, (box(0, 0, 3, 3), box(3, 0, 6, 3)))


@pytest.mark.parametrize(
    ("x", "y", "allowed"),
    [(1, 1, True), (2.5, 1.5, False), (-0.1, 1, False), (5.9, 3.9, True), (7, 7, False)],
)
def test_points_inside_and_outside(x: float, y: float, allowed: bool) -> None:
    assert ROOM.allows(x, y) is allowed
    assert (ROOM.margin_m(x, y) > 0) is allowed


@pytest.mark.parametrize(
    ("x", "y", "margin"),
    [(0.2, 2, 0.2), (2.5, 0.75, 0.25), (-0.5, 2, -0.5), (2.5, 1.5, -0.5), (4.5, 2.5, SIGHT_M)],
)
def test_distance_to_the_boundary(x: float, y: float, margin: float) -> None:
    assert ROOM.margin_m(x, y) == pytest.approx(margin)


@pytest.mark.parametrize(
    ("a", "b", "crosses"),
    [
        ((1, 1), (1, 3), False),
        ((1, 1.5), (4, 1.5), True),
        ((0.3, 1.5), (5.7, 1.5), True),
        ((0.3, 2.5), (5.7, 2.5), False),
        ((5.9, 1), (6.1, 1), True),
        ((1.9, 0.9), (3.1, 0.9), False),
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


def test_an_edge_shared_by_two_outlines_is_no_fence() -> None:
    assert not TWINS.crosses(2.9, 1.5, 3.1, 1.5)
    assert TWINS.margin_m(2.9, 1.5) == pytest.approx(SIGHT_M)


def test_a_fence_that_allows_nothing_lets_nothing_in() -> None:
    nothing = build_fence(MAP, ())
    assert not nothing.allows(0, 0)
    assert nothing.margin_m(0, 0) == -SIGHT_M


def test_the_slowest_zone_rules() -> None:
    zones = (Zone(box(0, 0, 2, 2), 0.3), Zone(box(1, 1, 3, 3), 0.2))
    fence = build_fence(MAP, (box(0, 0, 6, 4),), (), zones)
    assert fence.max_speed_mps(0.5, 0.5) == 0.3
    assert fence.max_speed_mps(1.5, 1.5) == 0.2
    assert fence.max_speed_mps(5, 3) is None


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
    assert ROOM.max_speed_mps(x, y) is None


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
    assert fence.max_speed_mps(0.8, 0.1) == 0.2
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
    with pytest.raises(Misconfigured) as caught:
        parse_fence(data)
    assert caught.value.code == code


def test_a_fence_that_leaves_a_strip_is_none_that_leaves_nothing() -> None:
    strip = parse_fence(_text(keep_outs=[[[0, 0], [5.9, 0], [5.9, 4], [0, 4]]]))
    assert strip.allows(5.95, 2.0)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Misconfigured, match="fence_missing"):
        load_fence(tmp_path / "none.json")
