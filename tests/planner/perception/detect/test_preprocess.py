"""Follow single pixels into a model's input, and boxes back out of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf, nan
from typing import Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.perception.detect.detections import (
    MAX_CANDIDATES,
    MAX_FOUND,
    Row,
    filter_rows,
    in_picture,
    rows_of,
    strongest,
    suppress,
)
from planner.perception.detect.preprocess import (
    BORDER,
    BytePreparer,
    FloatPreparer,
    Preparer,
    Recipe,
    place,
)

BLUE, GREEN, RED = (250, 20, 10), (20, 240, 10), (20, 10, 230)
IMAGENET = Recipe("stretched", "rgb", 1 / 255, (0.485, 0.456, 0.406), (0.229, 0.224, 0.225))
UNIT = Recipe("centred", "rgb", 1 / 255)
NORMAL_RED = (
    *((230 / 255 - 0.485) / 0.229, (10 / 255 - 0.456) / 0.224, (20 / 255 - 0.406) / 0.225),
)


@pytest.mark.parametrize(
    ("recipe", "first", "border"),
    [
        (Recipe("corner", "bgr"), RED, BORDER),
        (UNIT, tuple(side / 255 for side in RED[::-1]), BORDER / 255),
        (IMAGENET, NORMAL_RED, None),
    ],
)  # fmt: skip
def test_a_picture_is_placed_ordered_and_scaled(
    recipe: Recipe, first: tuple[float, ...], border: float | None
) -> None:
    preparer = FloatPreparer(recipe, 64, 64)
    buffer, placed = preparer.prepare(np.full((48, 96, 3), RED, np.uint8))
    assert buffer.shape == (1, 3, 64, 64)
    assert buffer.dtype == np.float32
    assert buffer.flags.c_contiguous
    inside = buffer[0, :, placed.top : placed.top + placed.height, :]
    assert np.allclose(inside, np.array(first).reshape(3, 1, 1), atol=1e-5)
    if border is not None:
        assert placed.height == 32
        outside = np.delete(buffer, np.s_[placed.top : placed.top + 32], axis=2)
        assert np.allclose(outside, border)


MAKERS: dict[str, Callable[[], Preparer]] = {
    "floats": lambda: FloatPreparer(UNIT, 64, 64),
    "rgb bytes": lambda: BytePreparer("centred", "rgb", 64, 64),
    "bgr bytes": lambda: BytePreparer("centred", "bgr", 64, 64),
}


@pytest.mark.parametrize("made", MAKERS.values(), ids=MAKERS)
def test_one_buffer_serves_every_picture_and_keeps_nothing_of_the_last(
    made: Callable[[], Preparer],
) -> None:
    used = made()
    pictures = ((96, 48, RED), (48, 96, GREEN), (64, 64, BLUE), (96, 48, GREEN))
    for width, height, color in pictures:
        picture = np.full((height, width, 3), color, np.uint8)
        buffer, placed = used.prepare(picture)
        again, _ = used.prepare(picture)
        assert again is buffer
        assert again is used.buffer
        fresh, where = made().prepare(picture)
        assert placed == where
        assert np.array_equal(buffer, fresh)


@pytest.mark.parametrize(("channels", "red"), [("rgb", RED[::-1]), ("bgr", RED)])
@pytest.mark.parametrize(("width", "height"), [(64, 64), (96, 48), (48, 96), (64, 32)])
def test_bytes_go_in_as_they_are_on_grey(
    channels: Literal["rgb", "bgr"], red: tuple[int, ...], width: int, height: int
) -> None:
    picture = np.full((height, width, 3), RED, np.uint8)
    buffer, placed = BytePreparer("centred", channels, 64, 64).prepare(picture)
    expected = np.full((1, 64, 64, 3), BORDER, np.uint8)
    expected[0, placed.rows, placed.columns] = red
    assert buffer.dtype == np.uint8
    assert np.array_equal(buffer, expected)
    assert (placed.width == 64) == (width >= height)


@given(
    picture=st.tuples(st.integers(1, 500), st.integers(1, 500)),
    size=st.sampled_from([(64, 64), (320, 256), (416, 416)]),
    fit=st.sampled_from(["centred", "corner", "stretched"]),
)
@settings(max_examples=50)
def test_a_box_comes_back_from_where_it_was_placed(
    picture: tuple[int, int], size: tuple[int, int], fit: str
) -> None:
    placed = place(picture, size, fit)
    assert 0 <= placed.left <= placed.left + placed.width <= size[0]
    assert 0 <= placed.top <= placed.top + placed.height <= size[1]
    whole = (placed.left, placed.top, placed.left + placed.width, placed.top + placed.height)
    ((*box, _, _),) = in_picture([(*whole, 0.9, 0)], placed, *picture)
    assert box == pytest.approx([0, 0, *picture], abs=0.01)


BOX = (0.0, 0.0, 9.0, 9.0)


@pytest.mark.parametrize(
    "row",
    [
        (0.0, 0.0, nan, 9.0, 0.9, 0),
        (-inf, 0.0, inf, 9.0, 0.9, 0),
        (*BOX, nan, 0),
        (*BOX, 1.5, 0),
        (*BOX, 0.3, 1),
        (*BOX, 0.9, 5),
        (*BOX, 0.9, -1),
    ],
)
def test_only_possible_rows_are_believed(row: Row) -> None:
    good, halved = (*BOX, 0.9, 0), (*BOX, 1.0005, 1)
    assert filter_rows([good, row, halved], [0.4, 0.4]) == [good, (*BOX, 1.0, 1)]


def test_slivers_and_what_lies_outside_the_picture_are_left_out() -> None:
    boxes = [(-90, -90, -5, -5), (10, 10, 10.4, 40), (80, 80, 90, 90), (-5, -5, 900, 900)]
    rows: list[Row] = [(*box, 0.9, 0) for box in boxes]
    kept = in_picture(rows, place((64, 64), (64, 64), "centred"), 64, 64)
    assert kept == [(0, 0, 64, 64, 0.9, 0)]


def test_at_most_so_many_are_left_the_strongest_first() -> None:
    scores = np.random.default_rng(3).permutation(MAX_CANDIDATES + 50) / 1000
    rows: list[Row] = [(*BOX, score, number) for number, score in enumerate(scores.tolist())]
    best = sorted(scores.tolist(), reverse=True)
    assert [row[4] for row in strongest(rows)] == best[:MAX_FOUND]
    assert [row[4] for row in suppress(rows)] == best[:MAX_FOUND]  # each is of its own class
    assert [row[4] for row in strongest(rows[:3])] == sorted(scores[:3].tolist(), reverse=True)


def overlap(one: Sequence[float], other: Sequence[float]) -> float:
    wide = min(one[2], other[2]) - max(one[0], other[0])
    high = min(one[3], other[3]) - max(one[1], other[1])
    if wide <= 0 or high <= 0:
        return 0.0
    areas = [(it[2] - it[0]) * (it[3] - it[1]) for it in (one, other)]
    return wide * high / (sum(areas) - wide * high)


@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
@settings(max_examples=30)
def test_suppression_is_the_greedy_one_class_by_class(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    corners = rng.uniform(0, 60, (count, 2))
    boxes = np.concatenate((corners, corners + rng.uniform(5, 40, (count, 2))), axis=1)
    scores = rng.permutation(count).astype(np.float32) / count * 0.5 + 0.4
    numbers = rng.integers(0, 3, count)
    rows = rows_of(boxes.astype(np.float32), scores.astype(np.float32), numbers)
    kept: list[Row] = []
    for row in sorted(rows, key=lambda row: -row[4]):
        rivals = [it for it in kept if it[5] == row[5]]
        if all(overlap(it[:4], row[:4]) <= 0.5 for it in rivals):
            kept.append(row)
    assert suppress(rows) == kept
