"""What moved since a map was drawn is found where it is, and nothing else of the map changes."""

from __future__ import annotations

from functools import lru_cache
from math import hypot

import numpy as np
import pytest
from numpy.typing import NDArray

from localization.distance_field import DistanceField
from localization.mapping.keyframes import pose_after, pose_between
from localization.mapping.map_anchors import AnchoredDrive, DriveElsewhere, place_on_map
from localization.mapping.map_changes import (
    MapChange,
    apply_changes,
    find_changes,
    frame_around,
)
from localization.mapping.scan_tracker import KeyframeLink, ScanTracker
from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.cell_array import cell_array
from tests.localization.mapping.test_map_builder import CUPBOARD, course
from tests.localization.rooms import RES_M, ROOM, Boxes, cast, points_of
from wire import Pose2

Floats = NDArray[np.float64]
TABLE = (4.0, 2.6, 4.8, 3.2)
LIDAR_M = (0.0, 0.0)


def grid_of(boxes: Boxes, width_m: float = 6.0, height_m: float = 4.0) -> GridMap:
    """Return a drawn map: boxes are filled, all else is floor."""
    cells = np.full((round(height_m / RES_M), round(width_m / RES_M)), FREE, np.uint8)
    for x0, y0, x1, y1 in boxes:
        at = [round(one / RES_M) for one in (x0, y0, x1, y1)]
        cells[at[1] : at[3], at[0] : at[2]] = OCCUPIED
    return GridMap(cells.shape[1], cells.shape[0], RES_M, 0.0, 0.0, cells.tobytes())


@lru_cache
def driven(boxes: Boxes, laps: int = 1, seed: int = 1) -> tuple[list[KeyframeLink], Floats]:
    """Drive round a room with wheels 5 % wrong; return the keyframes and their true poses."""
    random, true, tracker = np.random.default_rng(seed), course(laps), ScanTracker()
    carried, links, at = np.zeros(3), [], []
    for index, pose in enumerate(true):
        if index:
            step = pose_between(true[index - 1], pose)
            carried = pose_after(carried, step * (1.05, 1.05, 1.03))
        points = points_of(cast(boxes, Pose2(*pose_after(pose, np.zeros(3)).tolist())))
        points += random.normal(0.0, 0.01, points.shape)
        link = tracker.use_scan(points, carried, float(index))
        if link is not None:
            links.append(link)
            at.append(pose)
    return links, np.array(at)


@lru_cache
def placed(old: Boxes, now: Boxes) -> tuple[GridMap, AnchoredDrive, Floats]:
    grid = grid_of(old)
    links, true = driven(now)
    return grid, place_on_map(links, DistanceField.of_map(grid), LIDAR_M), true


def changes(old: Boxes, now: Boxes) -> tuple[GridMap, tuple[MapChange, ...]]:
    grid, drive, _ = placed(old, now)
    frame = frame_around(grid, drive.keyframes)
    assert frame == grid, "nothing was seen beyond the map"
    return grid, find_changes(frame, drive.keyframes, LIDAR_M)


MOVED: Boxes = (*(box for box in ROOM if box != CUPBOARD), TABLE)


@pytest.mark.parametrize("now", [ROOM, MOVED])
def test_keyframes_lie_where_they_were_taken_in_the_frame_of_the_map(now: Boxes) -> None:
    _, drive, true = placed(ROOM, now)
    assert drive.dropped == 0
    off = pose_between(true, np.array([one.pose for one in drive.keyframes]))
    assert np.hypot(off[:, 0], off[:, 1]).max() < 0.03
    assert np.abs(off[:, 2]).max() < 0.01


def test_a_map_that_is_right_stays_as_it_is() -> None:
    assert changes(ROOM, ROOM)[1] == ()


def two_changes() -> tuple[GridMap, MapChange, MapChange]:
    grid, found = changes(ROOM, MOVED)
    gone, new = sorted(found, key=lambda one: one.kind)
    assert (gone.kind, new.kind) == ("gone", "new")
    return grid, gone, new


def test_a_cupboard_that_is_gone_is_floor_and_a_table_can_be_left_out() -> None:
    grid, gone, _ = two_changes()
    assert hypot(gone.x_m - 1.6, gone.y_m - 3.45) < 0.1
    assert gone.area_m2 == pytest.approx(1.2 * 0.75, rel=0.1), "all but the blur of the wall"
    mended = apply_changes(grid, [gone])
    assert mended.at(1.6, 3.5) == FREE
    assert mended.at(1.6, 3.95) == OCCUPIED, "the wall behind it"
    assert mended.at(1.6, 3.95) == grid.at(1.6, 3.95)
    assert OCCUPIED not in {mended.at(x_m, 2.9) for x_m in (4.0, 4.4, 4.75)}


def test_a_table_that_came_is_drawn_and_nothing_else() -> None:
    grid, _, new = two_changes()
    x0, y0, x1, y1 = TABLE
    mended = cell_array(apply_changes(grid, [new]))
    row, column = np.nonzero(mended != cell_array(grid))
    x_m, y_m = (column + 0.5) * RES_M, (row + 0.5) * RES_M
    assert len(x_m) > 10
    assert ((x_m > x0 - 0.06) & (x_m < x1 + 0.06) & (y_m > y0 - 0.06) & (y_m < y1 + 0.06)).all()


def test_what_nobody_saw_stays_as_it_was() -> None:
    grid = grid_of(ROOM)
    cells = cell_array(grid).copy()
    cells[:2, :2] = UNKNOWN  # the corner of two walls
    cells[62:78, 22:42] = UNKNOWN  # within the cupboard
    kept = GridMap(grid.width, grid.height, RES_M, 0.0, 0.0, cells.tobytes())
    links, _ = driven(ROOM)
    drive = place_on_map(links, DistanceField.of_map(kept), LIDAR_M)
    assert find_changes(kept, drive.keyframes, LIDAR_M) == ()


def test_a_drive_through_another_room_is_refused() -> None:
    other: Boxes = ((0.0, 0.0, 9.0, 0.1), (0.0, 4.9, 9.0, 5.0), (0.0, 0.0, 0.1, 5.0),
                    (8.9, 0.0, 9.0, 5.0), (3.0, 2.2, 3.4, 2.6))  # fmt: skip
    links, _ = driven(ROOM)
    with pytest.raises(DriveElsewhere):
        place_on_map(links, DistanceField.of_map(grid_of(other, 9.0, 5.0)), LIDAR_M)


def test_a_map_grows_where_a_drive_saw_beyond_its_edge() -> None:
    grid = grid_of(ROOM)
    shown = cell_array(grid)[:, :90]
    half = GridMap(90, grid.height, RES_M, 0.0, 0.0, np.ascontiguousarray(shown).tobytes())
    links, _ = driven(ROOM)
    drive = place_on_map(links, DistanceField.of_map(half), LIDAR_M)
    frame = frame_around(half, drive.keyframes)
    assert frame.width > 115
    assert (frame.origin_x_m, frame.origin_y_m, frame.height) == (0.0, 0.0, grid.height)
    assert np.array_equal(cell_array(frame)[:, :90], shown)
    mended = apply_changes(frame, find_changes(frame, drive.keyframes, LIDAR_M))
    assert mended.at(5.2, 2.0) == FREE
    assert OCCUPIED in {mended.at(x_m, 2.0) for x_m in (5.87, 5.92, 5.97)}
