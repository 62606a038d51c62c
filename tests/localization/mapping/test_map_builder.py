"""A room that is driven through is drawn where it is, and a moved cupboard moves on the map."""

from __future__ import annotations

import io
from functools import lru_cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from localization.mapping.keyframes import (
    KeyframeFileError,
    keyframe_of,
    pose_after,
    pose_between,
    read_keyframes,
)
from localization.mapping.map_builder import MapBuilder
from localization.mapping.occupancy import MapTooLarge, draw_grid
from localization.mapping.scan_tracker import ScanTracker
from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from tests.localization.rooms import ROOM, Boxes, cast, points_of
from wire import Pose2

Floats = NDArray[np.float64]
START = np.array((3.0, 2.0, 0.1))
CUPBOARD = (1.0, 3.0, 2.2, 4.0)
TURN_RAD = 0.1


def course(laps: int, step_m: float = 0.1) -> Floats:
    """Return poses round the room's middle, from START on."""
    angle = np.arange(0.0, 2 * np.pi * laps, step_m / 0.9)
    x_m, y_m = 2.1 + 0.9 * np.cos(angle) + 0.0, 2.0 + 0.9 * np.sin(angle)
    return np.column_stack((x_m, y_m, angle + START[2]))


def drive(
    boxes: Boxes, laps: int, builder: MapBuilder, tracker: ScanTracker, seed: int = 1
) -> tuple[Floats, Floats]:
    """Drive with wheels 5 % wrong; return tracked and true poses, both in the first one."""
    random, true = np.random.default_rng(seed), course(laps)
    carried = np.zeros(3)
    found = []
    for index, pose in enumerate(true):
        if index:
            step = pose_between(true[index - 1], pose)
            carried = pose_after(carried, step * (1.05, 1.05, 1.03))
        points = points_of(cast(boxes, Pose2(*pose_after(pose, np.zeros(3)).tolist())))
        points += random.normal(0.0, 0.01, points.shape)
        link = tracker.use_scan(points, carried, float(index))
        if link is not None and builder.add(link):
            tracker.correct(builder.poses)
        found.append(tracker.pose)
    return np.array(found), pose_between(true[0], true)


def mapped(boxes: Boxes = ROOM, laps: int = 3) -> tuple[MapBuilder, ScanTracker, Floats, Floats]:
    builder, tracker = MapBuilder(), ScanTracker()
    found, true = drive(boxes, laps, builder, tracker)
    return builder, tracker, found, true


@pytest.fixture(scope="module")
def room() -> tuple[MapBuilder, ScanTracker, Floats, Floats]:
    return mapped()


def at(builder: MapBuilder, x_m: float, y_m: float) -> int:
    """Return the map's cell at a point of the room."""
    point = pose_between(course(1)[0], np.array((x_m, y_m, 0.0)))
    return drawn(builder, len(builder.keyframes)).at(float(point[0]), float(point[1]))


@lru_cache
def drawn(builder: MapBuilder, _keyframes: int) -> GridMap:
    """Return the map's cells, traced once for all points that a test asks for."""
    return builder.draw()


def test_the_pose_holds_though_wheels_are_wrong(
    room: tuple[MapBuilder, ScanTracker, Floats, Floats],
) -> None:
    _, _, found, true = room
    off = pose_between(true, found)
    assert np.hypot(off[:, 0], off[:, 1]).max() < 0.05
    assert np.abs(off[:, 2]).max() < 0.02


def test_loops_are_found_and_the_same_drive_gives_the_same_bytes(
    room: tuple[MapBuilder, ScanTracker, Floats, Floats],
) -> None:
    builder = room[0]
    assert builder.loops > 2
    assert mapped()[0].to_bytes() == builder.to_bytes()


def test_walls_floor_and_what_nobody_saw(
    room: tuple[MapBuilder, ScanTracker, Floats, Floats],
) -> None:
    builder = room[0]
    for x_m, y_m in ((3.0, 0.1), (0.1, 2.0), (1.6, 3.0)):
        steps = (-0.05, 0.0, 0.05)
        near = [at(builder, x_m + dx, y_m + dy) for dx in steps for dy in steps]
        assert OCCUPIED in near, (x_m, y_m)
    assert at(builder, 3.0, 2.0) == FREE
    assert at(builder, 1.6, 3.6) == UNKNOWN, "within the cupboard"
    assert at(builder, 9.0, 9.0) == UNKNOWN


def test_another_day_goes_on_and_mends_what_was_moved(
    room: tuple[MapBuilder, ScanTracker, Floats, Floats],
) -> None:
    kept = MapBuilder.of_bytes(room[0].to_bytes(), (0.0, 0.0))
    assert at(kept, 1.6, 3.05) == OCCUPIED or at(kept, 1.6, 3.0) == OCCUPIED
    before = len(kept.keyframes)
    tracker = ScanTracker(np.zeros(3), kept.keyframes)
    gone = tuple(box for box in ROOM if box != CUPBOARD)
    found, true = drive(gone, 2, kept, tracker, seed=2)
    assert len(kept.keyframes) > before + 10
    off = pose_between(true, found)
    assert np.hypot(off[:, 0], off[:, 1]).max() < 0.08
    assert at(kept, 1.6, 3.05) == FREE
    assert at(kept, 1.6, 3.6) == FREE
    assert OCCUPIED in [at(kept, 1.6, y_m) for y_m in (3.85, 3.9, 3.95)], "the wall behind it"


def test_a_covered_lidar_leaves_the_pose_to_odometry() -> None:
    tracker = ScanTracker()
    assert tracker.use_scan(points_of(cast(ROOM, Pose2(3.0, 2.0, 0.0))), np.zeros(3), 0.0)
    assert tracker.use_scan(np.empty((0, 2)), np.array((0.6, 0.0, 0.0)), 1.0) is None
    assert tracker.pose == pytest.approx((0.6, 0.0, 0.0))
    points = points_of(cast(ROOM, Pose2(3.7, 2.0, 0.0)))
    link = tracker.use_scan(points, np.array((0.7, 0.0, 0.0)), 2.0)
    assert link is not None
    assert link.sigma_m > 0.05, "half of its way was odometry's"


def test_a_keyframe_needs_a_relation() -> None:
    builder, points = MapBuilder(), points_of(cast(ROOM, Pose2(3.0, 2.0, 0.0)))
    link = ScanTracker().use_scan(points, np.zeros(3), 0.0)
    assert link is not None
    builder.add(link)
    with pytest.raises(ValueError, match="relation"):
        builder.add(link)


@pytest.mark.parametrize(
    "data", [b"", b"PK\x03\x04", b"\x93NUMPY" + bytes(50), bytes(200), b"\x80\x04junk"]
)
def test_a_file_that_is_not_ours_is_refused(data: bytes) -> None:
    with pytest.raises(KeyframeFileError, match=r"^not a file of keyframes$"):
        read_keyframes(data)


@pytest.mark.parametrize(("array", "rows"), [("poses", 400_000), ("points_mm", 400_000)])
def test_a_file_that_unpacks_to_more_than_its_frames_hold_is_refused(array: str, rows: int) -> None:
    arrays: dict[str, Any] = {
        "format": np.int64(1), "poses": np.zeros((1, 3)), "stamps_s": np.zeros(1),
        "counts": np.ones(1, np.int64), "points_mm": np.zeros((1, 2), np.int32),
        "edges": np.zeros((0, 6)),
    }  # fmt: skip
    out = io.BytesIO()
    np.savez_compressed(out, **arrays | {array: np.zeros((rows, *arrays[array].shape[1:]))})
    with pytest.raises(KeyframeFileError, match=r"^not a file of keyframes$"):
        read_keyframes(out.getvalue())


def test_half_a_file_is_refused(room: tuple[MapBuilder, ScanTracker, Floats, Floats]) -> None:
    data = room[0].to_bytes()
    for end in (10, len(data) // 2, len(data) - 1):
        with pytest.raises(KeyframeFileError):
            read_keyframes(data[:end])


def test_keyframes_ten_kilometres_apart_are_no_map() -> None:
    far = np.array((1e4, 1e4, 0.0))
    points = np.ones((40, 2))
    with pytest.raises(MapTooLarge, match="cells"):
        draw_grid([keyframe_of(np.zeros(3), points, 0.0), keyframe_of(far, points, 1.0)])
    assert set(draw_grid([]).cells) == {UNKNOWN}
