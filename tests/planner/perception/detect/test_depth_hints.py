"""Where depth is read when something stands before a thing, on it, or shows beneath it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from planner.language.object_classes import kind_of
from planner.perception.detect.depth_sampling import ANY, hints, look_inside

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
