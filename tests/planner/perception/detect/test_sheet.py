"""Lay out pictures of several directions: all of them, in their order, as large as fits."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain.image_questions import LONG_SIDE_PX, MAX_VIEWS
from planner.perception.detect import lay_out, unpack_color
from planner.perception.detect.pictures import GAP_PX, LABEL_PX, Picture, grid_of
from tests.laws import at_least

COLORS = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (0, 255, 255), (255, 0, 255), (128, 128, 128)]


def plain(color: tuple[int, int, int], width: int, height: int) -> Picture:
    return np.full((height, width, 3), color, np.uint8)


def laid_out(*pictures: tuple[Picture, str]) -> Picture:
    sheet = unpack_color(lay_out(pictures, LONG_SIDE_PX))
    assert not isinstance(sheet, str)
    return sheet


@pytest.mark.parametrize(
    ("count", "size"), [(6, (640, 480)), (3, (640, 480)), (6, (320, 240)), (4, (480, 640))]
)
def test_every_picture_is_there_in_its_order_and_below_its_label(
    count: int, size: tuple[int, int]
) -> None:
    grid = grid_of(count, size, LONG_SIDE_PX)
    sheet = laid_out(*((plain(c, *size), f"{n} left") for n, c in enumerate(COLORS[:count], 1)))
    assert max(sheet.shape) <= LONG_SIDE_PX
    assert grid.width >= min(size[0], 320), "a model sees what a person would"
    for number, color in enumerate(COLORS[:count]):
        row, column = divmod(number, grid.columns)
        top, left = row * (grid.height + LABEL_PX + GAP_PX), column * (grid.width + GAP_PX)
        tile = sheet[top + LABEL_PX : top + LABEL_PX + grid.height, left : left + grid.width]
        middle = tile[16:-16, 16:-16].reshape(-1, 3)
        assert np.abs(middle.astype(int) - color).max() < 12, number
        strip = sheet[top : top + LABEL_PX, left : left + grid.width]
        assert strip.min() < 90, "something is written there"
        assert strip.max() > 240


@at_least(200)
@given(
    st.integers(1, MAX_VIEWS), st.tuples(st.integers(1, 4000), st.integers(1, 4000)),
    st.integers(64, 1024),
)  # fmt: skip
def test_a_sheet_is_never_longer_than_it_may_be_and_a_tile_never_larger_than_its_picture(
    count: int, size: tuple[int, int], long_side: int
) -> None:
    grid = grid_of(count, size, long_side)
    assert grid.columns * grid.rows >= count > grid.columns * (grid.rows - 1)
    assert grid.width <= size[0]
    assert grid.height <= size[1]
    wide = grid.columns * (grid.width + GAP_PX) - GAP_PX
    high = grid.rows * (grid.height + GAP_PX + LABEL_PX) - GAP_PX
    assert wide <= max(long_side, grid.columns * (1 + GAP_PX))
    assert high <= max(long_side, grid.rows * (1 + GAP_PX + LABEL_PX))


def test_pictures_of_two_sizes_and_a_long_label_find_room() -> None:
    sheet = laid_out(
        (plain(COLORS[0], 1920, 1080), "1 ahead on the left"),
        (plain(COLORS[1], 100, 300), "x" * 99),
    )
    assert max(sheet.shape) <= LONG_SIDE_PX
    found = {tuple(int(v > 128) for v in px) for px in sheet[::7, ::7].reshape(-1, 3)}
    assert {(1, 0, 0), (0, 1, 0)} <= found
