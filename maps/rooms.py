"""Propose rooms: cut free floor where it narrows to a door. Knows cells; names nothing.

Middles of rooms are cells far from all that is not free; from these the floor is shared out (a
watershed of the clearance), and two parts that meet along more than a door's width are one room. A
part of an open plan is cut once more, where it narrows to an opening without a door; what stands
free of the walls is left out of that, since a table cuts no room.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING

import cv2
import numpy as np

from maps.cell_array import cell_array
from maps.grid import FREE
from maps.outlines import outlines

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from maps.grid import GridMap
    from maps.outlines import Polygon

    Cells = NDArray[np.bool_]
    Labels = NDArray[np.int32]


@dataclass(frozen=True, slots=True)
class _Passage:
    """Hold how far from a wall a room has its middle, and how wide the way to the next may be."""

    middle_m: float  # from a wall
    widest_m: float


DOORS = _Passage(middle_m=0.65, widest_m=1.3)
"""A door of 1.2 m is nowhere wider than 0.6 m to a side, a corridor of 1.4 m is."""
OPENINGS = _Passage(middle_m=1.2, widest_m=2.6)
OPEN_PLAN_M2 = 40.0
"""Most single rooms of a home are smaller."""
FURNITURE_M = 2.5
"""What stands free of the walls and is no longer is furniture."""
SMALLEST_M2 = 2.0
SMALLEST_OPEN_M2 = 8.0
"""Of the parts of an open plan: a bay is no room."""
_TOLERANCE_CELLS = 1.5


@dataclass(frozen=True, slots=True)
class ProposedRoom:
    """Hold an outline in ``map``, its area, and the spot with the most room to stand."""

    polygon: Polygon
    area_m2: float
    x_m: float
    y_m: float
    clearance_m: float


def propose_rooms(grid: GridMap, floor: Cells | None = None) -> tuple[ProposedRoom, ...]:
    """Return the rooms of a map's free floor, the largest first.

    Args:
        grid: the map.
        floor: the cells to look at; left out, all free ones.
    """
    free = cell_array(grid) == FREE if floor is None else floor
    clearance_m, step_m = _clearance_m(free, grid.resolution_m), grid.resolution_m
    labels = _cut(free, DOORS, step_m)
    rooms = [
        room
        for label in np.unique(labels[labels > 0])
        for part in _parts_of(labels == label, step_m)
        if (room := _room(part & free, clearance_m, grid)) is not None
    ]
    return tuple(sorted(rooms, key=lambda room: -room.area_m2))


def _clearance_m(free: Cells, step_m: float) -> NDArray[np.float64]:
    distance = cv2.distanceTransform(np.pad(free.astype(np.uint8), 1), cv2.DIST_L2, 5)[1:-1, 1:-1]
    return np.asarray(distance, np.float64) * step_m


def _parts_of(room: Cells, step_m: float) -> list[Cells]:
    """Return the parts of an open plan; the room itself where it is small, or has no openings."""
    if room.sum() * step_m**2 <= OPEN_PLAN_M2:
        return [room]
    labels = _cut(_without_furniture(room, step_m), OPENINGS, step_m)
    parts = [labels == label for label in np.unique(labels[labels > 0])]
    if any(part.sum() * step_m**2 < SMALLEST_OPEN_M2 for part in parts):
        return [room]
    return parts


def _without_furniture(room: Cells, step_m: float) -> Cells:
    """Return the cells of a room with those of whatever stands free in it."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(
        (~np.pad(room, 1)).astype(np.uint8), connectivity=8
    )
    sizes_m = stats[:, [cv2.CC_STAT_WIDTH, cv2.CC_STAT_HEIGHT]].max(axis=1) * step_m
    small = [label for label in range(1, count) if sizes_m[label] <= FURNITURE_M]
    return room | np.isin(labels[1:-1, 1:-1], small)


def _cut(free: Cells, cut: _Passage, step_m: float) -> Labels:
    """Share the floor out among the middles: one label a room, 0 elsewhere."""
    return _merge_parts(_shared_out(free, cut.middle_m, step_m), cut.widest_m, step_m)


def _shared_out(free: Cells, middle_m: float, step_m: float) -> Labels:
    """Grow the middles over the floor, the widest cells first: they meet where it is narrowest."""
    clearance_m = _clearance_m(free, step_m)
    _, middles = cv2.connectedComponents((clearance_m > middle_m).astype(np.uint8))
    labels = middles.astype(np.float32)  # what OpenCV can dilate, exact up to 16 million
    cross = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
    for level in range(ceil(middle_m / step_m), -1, -1):
        room = free & (clearance_m > level * step_m)
        while True:
            grown = np.asarray(cv2.dilate(labels, cross), np.float32)
            new = room & (labels == 0) & (grown > 0)
            if not new.any():
                break
            labels[new] = grown[new]
    return labels.astype(np.int32)


def _merge_parts(labels: Labels, widest_m: float, step_m: float) -> Labels:
    """Join parts that meet along more than a door, or an opening."""
    touching: dict[tuple[int, int], int] = {}
    for first, second in ((labels[:, :-1], labels[:, 1:]), (labels[:-1], labels[1:])):
        meets = (first > 0) & (second > 0) & (first != second)
        pairs = np.sort(np.stack([first[meets], second[meets]]), axis=0)
        found, counts = np.unique(pairs, axis=1, return_counts=True)
        for (low, high), many in zip(found.T.tolist(), counts.tolist(), strict=True):
            touching[low, high] = max(touching.get((low, high), 0), many)
    joined = np.arange(int(labels.max()) + 1)
    for (low, high), many in touching.items():
        if many * step_m > widest_m:
            joined[joined == joined[high]] = joined[low]
    return np.asarray(joined[labels], np.int32)


def _room(cells: Cells, clearance_m: NDArray[np.float64], grid: GridMap) -> ProposedRoom | None:
    area_m2 = float(cells.sum()) * grid.resolution_m**2
    if area_m2 < SMALLEST_M2:
        return None
    found = outlines(cells, grid, _TOLERANCE_CELLS).outer
    if not found:
        return None
    row, column = np.unravel_index(int(np.argmax(np.where(cells, clearance_m, -1.0))), cells.shape)
    x_m, y_m = grid.centre_of(int(column), int(row))
    largest = max(found, key=len)
    room_m = float(clearance_m[row, column])
    return ProposedRoom(largest, round(area_m2, 2), round(x_m, 3), round(y_m, 3), round(room_m, 2))
