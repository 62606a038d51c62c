"""Find where a map is wrong by what a drive saw, as a list of things gone and things new.

A map stays as it is wherever the drive agrees with it within a wall's blur, or saw nothing; so a
map drawn by hand or by another robot keeps its lines. Only whole patches of change count: each can
be taken or left by a person. Pure numpy and OpenCV.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import cv2
import numpy as np

from localization.mapping.occupancy import LARGEST_CELLS, MapTooLarge, trace_beams
from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.cell_array import cell_array

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.mapping.keyframes import Keyframe

    Cells = NDArray[np.uint8]
    Bools = NDArray[np.bool_]

SEEN_FREE = -1.1
"""Log odds: three keyframes more looked through a cell than saw it."""
SEEN_OCCUPIED = 1.6
"""Two keyframes more saw it than looked through it."""
SEEN_AT_ALL = 0.3
BLUR_M = 0.10
"""Between a surface of the map and the same one seen anew: half a cell, the pose, and the lidar."""
JOINED_M = 0.10
"""Cells nearer to each other belong to one thing."""
LEAST_CELLS = 5
"""A smaller patch is the rim of a thing that is a little otherwise than drawn."""
LEAST_FLOOR_M2 = 0.25
"""Floor in smaller patches is told as one sum: slivers between beams, seen at last."""

ChangeKind = Literal["gone", "new", "floor"]


@dataclass(frozen=True, slots=True)
class MapChange:
    """Hold one patch of a map that is otherwise than drawn."""

    kind: ChangeKind
    """``gone``: an obstacle that is none; ``new``: one that the map lacks; ``floor``: unknown."""
    area_m2: float
    x_m: float
    """The middle of its bounding box in ``map``."""
    y_m: float
    width_m: float
    """Along x."""
    depth_m: float
    cells: NDArray[np.int64]
    """Numbers of its cells on the frame, row by row."""


def frame_around(old: GridMap, keyframes: Sequence[Keyframe]) -> GridMap:
    """Return the map with unknown cells added on each side where a drive saw beyond its edge.

    Raises:
        MapTooLarge: that would take more than ``LARGEST_CELLS``.
    """
    size_m = old.resolution_m
    seen = np.vstack([np.empty((0, 2)), *[one.points_in_map() for one in keyframes]])
    if not len(seen):
        return old
    low = np.floor((seen.min(axis=0) - (old.origin_x_m, old.origin_y_m)) / size_m).astype(np.int64)
    high = np.floor((seen.max(axis=0) - (old.origin_x_m, old.origin_y_m)) / size_m).astype(np.int64)
    left, below = np.maximum(0, 1 - low).tolist() if (low < 0).any() else (0, 0)
    right = max(0, int(high[0]) + 2 - old.width) if high[0] >= old.width else 0
    above = max(0, int(high[1]) + 2 - old.height) if high[1] >= old.height else 0
    if not any((left, below, right, above)):
        return old
    columns, rows = old.width + left + right, old.height + below + above
    if not columns * rows <= LARGEST_CELLS:
        raise MapTooLarge(columns, rows, size_m)
    cells = np.pad(cell_array(old), ((below, above), (left, right)), constant_values=UNKNOWN)
    return GridMap(
        columns,
        rows,
        size_m,
        old.origin_x_m - left * size_m,
        old.origin_y_m - below * size_m,
        cells.tobytes(),
    )


def find_changes(
    frame: GridMap, keyframes: Sequence[Keyframe], lidar_m: tuple[float, float]
) -> tuple[MapChange, ...]:
    """Return how a map differs from what keyframes saw: the largest first, floor at the end.

    Args:
        frame: the map, wide enough for all that was seen.
        keyframes: where they are in its frame, in the order in which they were seen.
        lidar_m: where the lidar is in ``base``.
    """
    cells, seen = cell_array(frame), trace_beams(keyframes, frame, lidar_m)
    blur = round(BLUR_M / frame.resolution_m)
    occupied, free = cells == OCCUPIED, seen <= SEEN_FREE
    new = (seen >= SEEN_OCCUPIED) & ~_widen(occupied, blur)
    confirmed = _widen(seen > SEEN_AT_ALL, blur)
    gone = occupied & free & ~confirmed
    gone |= _crumbs(occupied & ~gone, gone) & ~confirmed
    floor = (cells == UNKNOWN) & free
    join = max(1, round(JOINED_M / frame.resolution_m / 2))
    things = [
        *_patches(frame, gone, "gone", join, LEAST_CELLS),
        *_patches(frame, new, "new", join, LEAST_CELLS),
    ]
    cell_m2 = frame.resolution_m**2
    spots = _patches(frame, floor, "floor", 0, 1)
    wide = [one for one in spots if one.area_m2 >= LEAST_FLOOR_M2]
    slivers = [one.cells for one in spots if one.area_m2 < LEAST_FLOOR_M2]
    found = sorted(things, key=lambda one: -one.area_m2) + wide
    if slivers:
        numbers = np.concatenate(slivers)
        found.append(replace(_measure(frame, numbers, "floor"), area_m2=len(numbers) * cell_m2))
    return tuple(found)


def apply_changes(frame: GridMap, changes: Sequence[MapChange]) -> GridMap:
    """Return the map with changes carried out."""
    cells = cell_array(frame).ravel().copy()
    for change in changes:
        cells[change.cells] = OCCUPIED if change.kind == "new" else FREE
    return replace(frame, cells=cells.tobytes())


def _widen(mask: Bools, by: int) -> Bools:
    kernel = np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * by + 1, 2 * by + 1)))
    return np.asarray(cv2.dilate(mask.astype(np.uint8), kernel), np.bool_)


def _crumbs(left: Bools, gone: Bools) -> Bools:
    """Return what is left of things that are gone: few cells, that no three beams met."""
    count, labels, about, _ = cv2.connectedComponentsWithStats(left.astype(np.uint8))
    small = np.asarray(about)[:, cv2.CC_STAT_AREA] < LEAST_CELLS
    beside = np.zeros(count, np.bool_)
    beside[np.unique(np.asarray(labels)[_widen(gone, 1)])] = True
    return np.asarray((small & beside)[np.asarray(labels)] & left, np.bool_)


def _patches(
    frame: GridMap, mask: Bools, kind: ChangeKind, join: int, least_cells: int
) -> list[MapChange]:
    """Return the patches of a mask; what is split by less than twice ``join`` cells is one."""
    joined = _widen(mask, join) if join else mask
    count, labels = cv2.connectedComponents(joined.astype(np.uint8), connectivity=8)
    flat = np.where(mask, np.asarray(labels), 0).ravel()
    order = np.argsort(flat, kind="stable")
    bounds = np.searchsorted(flat[order], np.arange(1, count + 1))
    groups = [order[bounds[one] : bounds[one + 1]] for one in range(count - 1)]
    return [_measure(frame, cells, kind) for cells in groups if len(cells) >= least_cells]


def _measure(frame: GridMap, cells: NDArray[np.int64], kind: ChangeKind) -> MapChange:
    row, column = np.divmod(cells, frame.width)
    size_m = frame.resolution_m
    return MapChange(
        kind,
        len(cells) * size_m**2,
        frame.origin_x_m + 0.5 * (int(column.min()) + int(column.max()) + 1) * size_m,
        frame.origin_y_m + 0.5 * (int(row.min()) + int(row.max()) + 1) * size_m,
        (int(column.max()) - int(column.min()) + 1) * size_m,
        (int(row.max()) - int(row.min()) + 1) * size_m,
        np.asarray(cells, np.int64),
    )
