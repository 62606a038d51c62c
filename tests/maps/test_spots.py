"""A spot where no robot can stand is refused with what it lies on, in both languages."""

from __future__ import annotations

import pytest

from maps import FREE, OCCUPIED, UNKNOWN, GridMap, SiteError
from maps.spots import check_on_floor
from wire import Pose2

GRID = GridMap(3, 1, 1.0, 10.0, -2.0, bytes((FREE, OCCUPIED, UNKNOWN)))


def test_free_floor_is_a_spot() -> None:
    check_on_floor(GRID, "the start", "起点", Pose2(10.5, -1.5, 0.0))


@pytest.mark.parametrize(
    ("x_m", "code", "en", "zh"),
    [
        (11.5, "place_in_obstacle", "the start at (11.50, -1.50) is not on free", "在障碍物上"),
        (12.5, "place_in_obstacle", "but on floor that is unknown", "在未知区域"),
        (13.5, "place_outside_map", "spans x 10.00 to 13.00, y -2.00 to -1.00", "在地图之外"),
    ],
)
def test_what_it_lies_on_is_told(x_m: float, code: str, en: str, zh: str) -> None:
    with pytest.raises(SiteError) as refused:
        check_on_floor(GRID, "the start", "起点", Pose2(x_m, -1.5, 0.0))
    assert refused.value.code == code
    assert en in refused.value.message["en"]
    assert zh in refused.value.message["zh"]
