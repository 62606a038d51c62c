"""Masks close and slow at least what they paint, wherever their own frame lies."""

from __future__ import annotations

from math import cos, inf, sin
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from maps import GridMap, SiteError
from maps.masks import MaskAreas, SpeedScale, join_masks, read_keep_outs, read_speed_zones
from planner.site.polygon import contains
from wire.fence import MAX_CORNERS, FenceFile, SpeedZone, crosses_itself

FLOOR = GridMap(200, 160, 0.05, 0.0, 0.0, bytes(200 * 160))  # 10 m x 8 m, all free
SCALE = SpeedScale(fastest_mps=0.5)


def mask(folder: Path, picture: NDArray[np.uint8], **changes: object) -> Path:
    cv2.imwrite(str(folder / "mask.pgm"), picture)
    keys = {
        "image": "mask.pgm", "mode": "scale", "resolution": 0.05, "origin": [0.0, 0.0, 0.0],
        "negate": 0, "occupied_thresh": 1.0, "free_thresh": 0.0,
    } | changes  # fmt: skip
    path = folder / "mask.yaml"
    path.write_text("\n".join(f"{key}: {value}" for key, value in keys.items()))
    return path


def painted(*areas: tuple[slice, slice, int]) -> NDArray[np.uint8]:
    picture = np.full((160, 200), 255, np.uint8)
    for rows, columns, grey in areas:
        picture[rows, columns] = grey
    return picture


def closes(found: MaskAreas, x_m: float, y_m: float) -> bool:
    return any(contains(area, x_m, y_m) for area in found.keep_outs)


def limit_mps(found: MaskAreas, x_m: float, y_m: float) -> float:
    zones = (z for z in found.speed_zones if contains(z.polygon, x_m, y_m))
    return min((zone.max_speed_mps for zone in zones), default=inf)


@pytest.mark.parametrize("yaw_rad", [0.0, 0.5, 2.0])
@pytest.mark.parametrize("resolution_m", [0.05, 0.02, 0.1])
def test_every_painted_cell_is_closed(tmp_path: Path, yaw_rad: float, resolution_m: float) -> None:
    picture = painted((slice(30, 60), slice(40, 90), 0), (slice(100, 101), slice(20, 21), 0))
    origin = (3.0, 1.0, yaw_rad)
    path = mask(tmp_path, picture, resolution=resolution_m, origin=list(origin))
    found = read_keep_outs(path, FLOOR)
    for row, column in np.argwhere(picture[::-1] == 0)[::37]:
        along, up = (column + 0.5) * resolution_m, (row + 0.5) * resolution_m
        x_m = 3.0 + along * cos(yaw_rad) - up * sin(yaw_rad)
        y_m = 1.0 + along * sin(yaw_rad) + up * cos(yaw_rad)
        assert closes(found, x_m, y_m) or not FLOOR.contains(x_m, y_m)
    assert all(crosses_itself(area) is None for area in found.keep_outs)


def test_a_ring_closes_its_line_and_not_what_it_goes_round(tmp_path: Path) -> None:
    ring = painted((slice(30, 130), slice(40, 160), 0), (slice(40, 120), slice(50, 150), 255))
    found = read_keep_outs(mask(tmp_path, ring), FLOOR)
    assert closes(found, 2.2, 4.0)
    assert closes(found, 5.0, 1.7)
    assert not closes(found, 5.0, 4.0)


def test_nav2s_usual_speed_mask_slows_by_its_shade(tmp_path: Path) -> None:
    """Base 100, multiplier -1: half grey is half speed, white says nothing, black is closed."""
    picture = painted(
        (slice(20, 60), slice(20, 60), 128),
        (slice(20, 60), slice(80, 120), 64),
        (slice(100, 140), slice(20, 60), 0),
    )
    found = read_speed_zones(mask(tmp_path, picture), FLOOR, SCALE)
    assert limit_mps(found, 2.0, 6.0) == pytest.approx(0.25, abs=0.01)
    assert limit_mps(found, 5.0, 6.0) == pytest.approx(0.125, abs=0.01)
    assert limit_mps(found, 8.0, 6.0) == inf
    assert closes(found, 2.0, 2.0)
    assert not closes(found, 5.0, 6.0)


def test_metres_a_second_are_taken_as_they_are(tmp_path: Path) -> None:
    path = mask(tmp_path, painted((slice(20, 60), slice(20, 60), 128)))
    scale = SpeedScale(0.5, "mps", base=0.0, multiplier=0.004)
    assert limit_mps(read_speed_zones(path, FLOOR, scale), 2.0, 6.0) == pytest.approx(0.2, abs=0.01)


def test_many_shades_become_few_limits_and_never_a_faster_one(tmp_path: Path) -> None:
    shades = np.tile(np.linspace(30, 250, 200).astype(np.uint8), (160, 1))
    found = read_speed_zones(mask(tmp_path, shades), FLOOR, SCALE)
    assert len({zone.max_speed_mps for zone in found.speed_zones}) <= 10
    for column in range(5, 195, 10):
        share = 1.0 - round((255 - int(shades[0, column])) / 255 * 100) / 100
        assert limit_mps(found, (column + 0.5) * 0.05, 4.0) <= 0.5 * share + 1e-6


def test_walls_of_the_map_are_not_closed_again(tmp_path: Path) -> None:
    walled = GridMap(200, 160, 0.05, 0.0, 0.0, bytes([1, 0] * 100) * 160)
    found = read_keep_outs(mask(tmp_path, painted((slice(0, 160), slice(0, 1), 0))), walled)
    assert found.keep_outs == ()


def test_a_mask_beside_the_map_is_refused(tmp_path: Path) -> None:
    path = mask(tmp_path, painted((slice(0, 9), slice(0, 9), 0)), origin=[50.0, 0.0, 0.0])
    with pytest.raises(SiteError, match="mask_elsewhere"):
        read_keep_outs(path, FLOOR)


def test_unknown_says_nothing(tmp_path: Path) -> None:
    path = mask(
        tmp_path, painted((slice(20, 60), slice(20, 60), 120)), mode="trinary",
        occupied_thresh=0.65, free_thresh=0.196,
    )  # fmt: skip
    assert read_keep_outs(path, FLOOR).keep_outs == ()


SQUARE = ((0.0, 0.0), (10.0, 0.0), (10.0, 8.0), (0.0, 8.0))
FENCE = FenceFile(
    version=1,
    map_id="0123456789abcdef",
    allowed=(SQUARE,),
    keep_outs=(((1.0, 1.0), (2.0, 1.0), (2.0, 2.0)),),
    speed_zones=(SpeedZone(polygon=SQUARE, max_speed_mps=0.3),),
)


def test_masks_join_a_fence_and_take_nothing_from_it(tmp_path: Path) -> None:
    path = mask(tmp_path, painted((slice(30, 60), slice(40, 90), 0)))
    areas = read_keep_outs(path, FLOOR)
    joined = join_masks(FENCE, [areas])
    assert joined.keep_outs == (*FENCE.keep_outs, *areas.keep_outs)
    assert (joined.allowed, joined.speed_zones) == (FENCE.allowed, FENCE.speed_zones)
    assert join_masks(joined, [areas]) == joined, "the same mask again changes nothing"


def test_masks_of_too_many_corners_are_refused(tmp_path: Path) -> None:
    many = tuple(((0.01 * k, 0.0), (0.01 * k, 1.0), (1.0, 1.0)) for k in range(MAX_CORNERS // 3))
    with pytest.raises(SiteError, match="at most 1000") as refused:
        join_masks(FENCE, [MaskAreas(many)])
    assert refused.value.code == "map_too_ragged"


@pytest.mark.parametrize(
    ("base", "multiplier"), [(float("nan"), -1.0), (100.0, float("inf")), (1e308, -1.0)]
)
def test_a_scale_that_makes_no_limit_is_refused(base: float, multiplier: float) -> None:
    """With an infinite multiplier every zone of the mask was passed over."""
    with pytest.raises(SiteError, match="value_malformed") as refused:
        SpeedScale(0.5, base=base, multiplier=multiplier)
    assert "限速掩膜" in refused.value.message["zh"]
