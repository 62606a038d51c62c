"""A growing map is written whole, read back, and painted on its canvas; else refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.growing_map import (
    GROWING_MAP,
    GrowingMap,
    GrowingMapError,
    read_growing_map,
    write_growing_map,
)

SIZES = st.integers(1, 12)


@st.composite
def grids(draw: st.DrawFn) -> GridMap:
    width, height = draw(SIZES), draw(SIZES)
    drawn = draw(st.binary(min_size=width * height, max_size=width * height))
    cells = bytes(value % 3 for value in drawn)
    left, low = draw(st.integers(-12, 12)), draw(st.integers(-12, 12))
    return GridMap(width, height, 0.05, 0.05 * left, 0.05 * low, cells)


@given(grids(), st.integers(0, 10_000))
def test_it_comes_back_as_it_was(grid: GridMap, count: int) -> None:
    grown = GrowingMap(count + 1, count, 1, grid)
    assert GrowingMap.of_bytes(grown.to_bytes()) == grown


@given(grids(), grids())
def test_on_a_canvas_only_what_is_known_is_painted(canvas: GridMap, seen: GridMap) -> None:
    painted = GrowingMap(1, 1, 0, seen).paint_on(canvas)
    assert (painted.width, painted.height) == (canvas.width, canvas.height)
    for row in range(canvas.height):
        for column in range(canvas.width):
            at = canvas.centre_of(column, row)
            told = seen.at(*at)
            assert painted.at(*at) == (canvas.at(*at) if told == UNKNOWN else told)


@given(grids(), st.data())
def test_spoilt_bytes_are_refused_or_another_map(grid: GridMap, data: st.DataObject) -> None:
    whole = bytearray(GrowingMap(1, 1, 0, grid).to_bytes())
    at = data.draw(st.integers(0, len(whole) - 1))
    whole[at] ^= data.draw(st.integers(1, 255))
    try:
        found = GrowingMap.of_bytes(bytes(whole)).grid
    except GrowingMapError:
        return
    assert len(found.cells) == found.width * found.height


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{}\n",
        b"[1]\n",
        b'{"format": 2, "width": 1, "height": 1}\n',
        b'{"format": 1, "width": 100000, "height": 100000}\n',
        b'{"format": 1, "width": -1, "height": 1}\n',
        b'{"format": 1, "width": 2, "height": 2}\nno zlib',
    ],
)
def test_what_is_none_is_refused(data: bytes) -> None:
    with pytest.raises(GrowingMapError):
        GrowingMap.of_bytes(data)


def test_a_folder_holds_the_newest_or_none(tmp_path: Path) -> None:
    assert read_growing_map(tmp_path) is None
    for kind in (FREE, OCCUPIED):
        write_growing_map(
            tmp_path, GrowingMap(1, 1, 0, GridMap(1, 1, 0.05, 0.0, 0.0, bytes([kind])))
        )
    found = read_growing_map(tmp_path)
    assert found is not None
    assert found.grid.cells == bytes([OCCUPIED])
    assert [path.name for path in tmp_path.iterdir()] == [GROWING_MAP]
