"""Read colour and depth of things that stand before walls, have holes, or are hidden in part."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from planner.language.object_classes import kind_of
from planner.perception.color_classifier import IDS, exposure, prevailing
from planner.perception.detect.depth_sampling import (
    ANY,
    MOST_PIXELS_A_SIDE,
    depth_at,
    hints,
    inner,
    look_inside,
)
from planner.perception.detect.pictures import Depth, Picture

WALL_MM = 4000
BOX = (20.0, 20.0, 60.0, 60.0)


def scene() -> tuple[Picture, Depth]:
    """Return a white wall at four metres."""
    return np.full((80, 80, 3), 240, np.uint8), np.full((80, 80), WALL_MM, np.uint16)


def test_depth_and_colour_are_the_thing_s_and_not_the_wall_s() -> None:
    picture, depth = scene()
    picture[30:50, 30:46], depth[30:50, 30:46] = (30, 30, 200), 1500
    seen = look_inside(picture, depth, BOX)
    assert seen.depth_m == pytest.approx(1.5)
    assert (seen.spread_m, seen.color) == (0.0, "red")


def test_a_thin_thing_before_the_one_meant_does_not_count() -> None:
    picture, depth = scene()
    picture[20:60, 20:60], depth[20:60, 20:60] = (200, 60, 30), 2500
    depth[20:60, 38:42] = 1200  # the leg of a table
    seen = look_inside(picture, depth, BOX)
    assert seen.depth_m == pytest.approx(2.5)
    assert seen.color == "blue"


def test_holes_are_no_depth() -> None:
    picture, depth = scene()
    depth[20:60, 20:60] = 1500
    depth[20:60, 20:60][np.random.default_rng(1).random((40, 40)) < 0.9] = 0
    assert look_inside(picture, depth, BOX).depth_m == pytest.approx(1.5)
    depth[30:50, 30:50] = 0
    seen = look_inside(picture, depth, BOX)
    assert (seen.depth_m, seen.spread_m, seen.color) == (None, 0.0, "white")


def test_the_spread_is_half_of_what_lies_between_the_quartiles() -> None:
    picture, depth = scene()
    depth[:, :] = np.linspace(1900, 2100, 80).astype(np.uint16)  # a slanted face, 2.5 mm a pixel
    seen = look_inside(picture, depth, BOX)
    assert seen.depth_m == pytest.approx(2.0, abs=0.01)
    assert seen.spread_m == pytest.approx(0.0127, abs=0.002)


@pytest.mark.parametrize(
    "box", [(0, 0, 1, 1), (79, 79, 80, 80), (10.2, 3.4, 11.9, 4.6), (0, 0, 80, 80), (5, 0, 6.5, 80)]
)
def test_the_middle_of_any_box_is_in_the_picture_and_not_large(
    box: tuple[float, float, float, float],
) -> None:
    picture, depth = scene()
    rows, columns = inner(box, 80, 80)
    assert min(picture[rows, columns].shape[:2]) > 0
    assert max(picture[rows, columns].shape[:2]) <= MOST_PIXELS_A_SIDE
    look_inside(picture, depth, box)


@pytest.mark.parametrize(
    ("rgb", "expected"),
    [
        ((200, 30, 30), "red"), ((120, 15, 15), "red"), ((235, 120, 30), "orange"),
        ((230, 210, 40), "yellow"), ((40, 150, 60), "green"), ((150, 200, 60), "green"),
        ((40, 80, 200), "blue"), ((60, 170, 200), "blue"), ((110, 50, 160), "purple"),
        ((240, 130, 180), "pink"), ((250, 170, 170), "pink"), ((120, 80, 45), "brown"),
        ((90, 50, 30), "brown"), ((15, 15, 18), "black"), ((128, 128, 130), "gray"),
        ((245, 244, 240), "white"),
    ],
)  # fmt: skip
def test_a_plain_colour_is_named(rgb: tuple[int, int, int], expected: str) -> None:
    noise = np.random.default_rng(3).integers(-8, 9, (400, 3))
    pixels = np.clip(np.array(rgb[::-1]) + noise, 0, 255).astype(np.uint8)
    assert prevailing(pixels) == expected
    assert expected in IDS


def test_where_colours_do_not_agree_there_is_none() -> None:
    thirds = np.repeat(
        np.array([(30, 30, 200), (200, 60, 30), (40, 200, 40)], np.uint8), 30, axis=0
    )
    assert prevailing(thirds) is None
    assert prevailing(thirds[:2]) is None


def test_paint_wins_over_the_white_of_pages_and_labels() -> None:
    def mixed(*parts: tuple[tuple[int, int, int], int]) -> str | None:
        return prevailing(np.concatenate([np.full((n, 3), bgr, np.uint8) for bgr, n in parts]))

    white, red, gray, green = (240, 240, 240), (30, 30, 200), (130, 130, 130), (40, 200, 40)
    assert mixed((white, 85), (red, 15)) == "red"
    assert mixed((white, 86), (red, 14)) == "white"
    assert mixed((white, 39), (red, 32), (gray, 29)) == "red"
    assert mixed((white, 75), (gray, 25)) == "white"
    assert mixed((gray, 75), (red, 25)) == "gray"
    assert mixed((white, 20), (red, 26), (gray, 27), (green, 27)) is None


def test_a_dim_picture_is_brightened_before_colours_count() -> None:
    lit = np.full((80, 80, 3), 240, np.uint8)
    lit[30:50, 30:50] = (40, 48, 70)  # dark wood
    dim = (lit // 2).astype(np.uint8)
    assert exposure(lit) == 1.0
    assert exposure(dim) == pytest.approx(235 / 120)
    assert exposure(np.zeros((80, 80, 3), np.uint8)) == 4.0  # and no more, whatever the dark holds
    for picture in (lit, dim):
        gain = exposure(picture)
        assert prevailing(picture[:20].reshape(-1, 3), gain) == "white"
        assert prevailing(picture[30:50, 30:50].reshape(-1, 3), gain) == "brown"
    assert prevailing(dim[:20].reshape(-1, 3)) == "gray"
    assert prevailing(dim[30:50, 30:50].reshape(-1, 3)) == "black"


@pytest.mark.parametrize(
    ("place", "expected"),
    [
        ((40.0, 40.0), 4.0),
        ((-9.0, 1e300), 4.0),
        ((np.nan, 40.0), None),
        ((40.0, np.nan), None),
        ((np.inf, -np.inf), None),
    ],
)
def test_who_points_nowhere_gets_no_depth(
    place: tuple[float, float], expected: float | None
) -> None:
    assert depth_at(scene()[1], *place) == expected


SIZE, FOCAL_PX = (320, 240), 234.0
CHAIR, TABLE = (100, 80, 140, 160), (60, 100, 260, 220)
"""A chair that shows above the table before it."""


def boxes(*rows: tuple[float, ...]) -> NDArray[np.float32]:
    return np.array(rows, np.float32)


def test_what_stands_lower_in_the_picture_stands_before() -> None:
    cup = (150, 105, 160, 118)
    behind, table, upon = hints(
        boxes(CHAIR, TABLE, cup), [kind_of(k) for k in ("chair", "table", "cup")], SIZE, FOCAL_PX
    )
    assert behind.others is not None
    assert behind.others.tolist() == [list(TABLE)]
    assert table.others is not None
    assert table.others.tolist() == [list(CHAIR), list(cup)]  # neither's pixels are its own
    assert upon.others is not None
    assert upon.others.tolist() == [list(TABLE)]


@pytest.mark.parametrize(
    ("label", "box", "focal_px", "least_m"),
    [
        ("chair", CHAIR, FOCAL_PX, 1.75),
        ("chair", (0, 80, 40, 160), FOCAL_PX, 0.0),  # cut off: who knows how large it is
        ("chair", CHAIR, None, 0.0),
        ("box", CHAIR, FOCAL_PX, 0.0),  # of any size
    ],
)
def test_what_shows_small_is_not_near(
    label: str, box: tuple[float, ...], focal_px: float | None, least_m: float
) -> None:
    (hint,) = hints(boxes(box), [kind_of(label)], SIZE, focal_px)
    assert hint.nearest_m == pytest.approx(least_m, abs=0.01)


def test_a_chair_behind_a_table_is_not_at_the_table() -> None:
    picture, depth = np.full((240, 320, 3), 240, np.uint8), np.full((240, 320), 5000, np.uint16)
    picture[80:160, 100:140], depth[80:160, 100:140] = (30, 30, 200), 3000
    picture[100:220, 60:260], depth[100:220, 60:260] = (200, 60, 30), 1500
    both = boxes(CHAIR, TABLE)
    rows = both.tolist()
    told = hints(both, [kind_of("chair"), kind_of("table")], SIZE, FOCAL_PX)
    chair, table = (look_inside(picture, depth, rows[row], told[row]) for row in (0, 1))
    assert (chair.color, table.color) == ("red", "blue")
    assert chair.depth_m == pytest.approx(3.0)
    assert table.depth_m == pytest.approx(1.5)
    assert look_inside(picture, depth, rows[0], ANY).depth_m == pytest.approx(1.5)  # unaided
    alone = hints(both[:1], [kind_of("chair")], SIZE, FOCAL_PX)[0]
    assert look_inside(picture, depth, rows[0], alone).depth_m == pytest.approx(3.0)
