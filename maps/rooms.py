"""Propose rooms: cut free floor where it narrows to a door. Knows cells; names nothing.

Middles of rooms are cells far from all that is not free; from these the floor is shared out (a
watershed of the clearance), and two parts that meet along more than a door's width are one room.
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

MIDDLE_M = 0.65
"""From a wall: a door of 1.2 m is nowhere wider than 0.6 m to a side, a corridor of 1.4 m is."""
WIDEST_DOOR_M = 1.3
SMALLEST_M2 = 2.0
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
    distance = cv2.distanceTransform(np.pad(free.astype(np.uint8), 1), cv2.DIST_L2, 5)[1:-1, 1:-1]
    clearance_m = np.asarray(distance, np.float64) * grid.resolution_m
    labels = _merge_parts(_shared_out(free, clearance_m, grid.resolution_m), grid.resolution_m)
    rooms = [
        room
        for label in np.unique(labels[labels > 0])
        if (room := _room(labels == label, clearance_m, grid)) is not None
    ]
    return tuple(sorted(rooms, key=lambda room: -room.area_m2))


def _shared_out(free: Cells, clearance_m: NDArray[np.float64], step_m: float) -> Labels:
    """Grow the middles over the floor, the widest cells first: they meet where it is narrowest."""
    _, middles = cv2.connectedComponents((clearance_m > MIDDLE_M).astype(np.uint8))
    labels = middles.astype(np.float32)  # what OpenCV can dilate, exact up to 16 million
    cross = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
    for level in range(ceil(MIDDLE_M / step_m), -1, -1):
        room = free & (clearance_m > level * step_m)
        while True:
            grown = np.asarray(cv2.dilate(labels, cross), np.float32)
            new = room & (labels == 0) & (grown > 0)
            if not new.any():
                break
            labels[new] = grown[new]
    return labels.astype(np.int32)


def _merge_parts(labels: Labels, resolution_m: float) -> Labels:
    """Join parts that meet along more than a door."""
    touching: dict[tuple[int, int], int] = {}
    for first, second in ((labels[:, :-1], labels[:, 1:]), (labels[:-1], labels[1:])):
        meets = (first > 0) & (second > 0) & (first != second)
        pairs = np.sort(np.stack([first[meets], second[meets]]), axis=0)
        found, counts = np.unique(pairs, axis=1, return_counts=True)
        for (low, high), many in zip(found.T.tolist(), counts.tolist(), strict=True):
            touching[low, high] = max(touching.get((low, high), 0), many)
    joined = np.arange(int(labels.max()) + 1)
    for (low, high), many in touching.items():
        if many * resolution_m > WIDEST_DOOR_M:
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
