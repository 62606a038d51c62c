"""Draw a map's cells from keyframes by tracing their beams, the newest word counting most.

Each cell keeps log odds, bounded to both sides (Hornung et al. 2013): a wardrobe that was seen a
hundred times is gone after a dozen beams went through its place. Numpy and OpenCV.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import cv2
import numpy as np

from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.errors import BilingualError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.mapping.keyframes import Keyframe

    Floats = NDArray[np.float64]

RESOLUTION_M = 0.05
HIT, MISS = 0.85, -0.4
"""Log odds of 0.7 and 0.4, as in OctoMap."""
LEAST, MOST = -2.0, 3.5
FREE_BELOW = -0.3
"""One beam through a cell makes it floor; as many misses as hits leave it unknown."""
OCCUPIED_ABOVE = 0.3
SHORT_OF_M = 0.075
"""Before its end a beam says nothing: it may graze the surface that it ends on."""
BLUR_M = 0.10
DENSE_SHARE = 0.25
"""Of the keyframes that saw the densest cell within the blur; a wall's skirt is seen by fewer."""
MARGIN_M = 0.5
"""Unknown cells around all that was seen."""
LARGEST_CELLS = 64_000_000


class MapTooLarge(BilingualError):
    """Report keyframes so far apart that no map holds them."""

    def __init__(self, columns: int, rows: int, cell_m: float) -> None:
        super().__init__(
            f"{columns} x {rows} cells of {cell_m} m; at most {LARGEST_CELLS}",
            f"地图需要 {columns} x {rows} 个 {cell_m} 米的格子；最多 {LARGEST_CELLS} 个",
        )


def draw_grid(
    keyframes: Sequence[Keyframe],
    lidar_m: tuple[float, float] = (0.0, 0.0),
    resolution_m: float = RESOLUTION_M,
) -> GridMap:
    """Return the cells that keyframes show; unknown where no beam went.

    Args:
        keyframes: in the order in which they were seen.
        lidar_m: where the lidar is in ``base``.
        resolution_m: side of a cell.

    Raises:
        MapTooLarge: the keyframes would take more than ``LARGEST_CELLS``.
    """
    ends = [keyframe.points_in_map() for keyframe in keyframes]
    starts = [_lidar_in_map(keyframe.pose, lidar_m) for keyframe in keyframes]
    every = np.vstack([np.zeros((1, 2)), *ends, *[start[None] for start in starts]])
    low = np.floor((every.min(axis=0) - MARGIN_M) / resolution_m).astype(np.int64)
    high = np.ceil((every.max(axis=0) + MARGIN_M) / resolution_m).astype(np.int64)
    columns, rows = (high - low).tolist()
    if not columns * rows <= LARGEST_CELLS:
        raise MapTooLarge(columns, rows, resolution_m)
    origin_m = low * resolution_m
    corner_m = (float(origin_m[0]), float(origin_m[1]))
    empty = GridMap(columns, rows, resolution_m, *corner_m, b"")
    log_odds = trace_beams(keyframes, empty, lidar_m).ravel()
    cells = np.full(rows * columns, UNKNOWN, np.uint8)
    cells[log_odds < FREE_BELOW] = FREE
    cells[(log_odds > OCCUPIED_ABOVE) & _densest(ends, empty)] = OCCUPIED
    return GridMap(columns, rows, resolution_m, *corner_m, cells.tobytes())


def _densest(ends: Sequence[Floats], frame: GridMap) -> NDArray[np.bool_]:
    """Return whether each cell has its share of the returns around it, shape (cells,).

    A lidar whose ranges err by 0.03 m sees some of a wall 0.1 m behind it, where no beam passes
    to say that nothing is there. Such a cell is left unknown.
    """
    shape = (frame.height, frame.width)
    origin_m = (frame.origin_x_m, frame.origin_y_m)
    returns = np.zeros(shape[0] * shape[1], np.float32)
    for points_m in ends:
        hit = np.unique(_cells((points_m - origin_m) / frame.resolution_m, shape))
        returns[hit] += 1.0  # each keyframe counts once
    near = 2 * round(BLUR_M / frame.resolution_m) + 1
    counts = returns.reshape(shape)
    around = np.asarray(cv2.dilate(counts, np.ones((near, near), np.uint8)), np.float32)
    return np.asarray(counts >= DENSE_SHARE * around).ravel()


def trace_beams(
    keyframes: Sequence[Keyframe], frame: GridMap, lidar_m: tuple[float, float] = (0.0, 0.0)
) -> NDArray[np.float32]:
    """Return what keyframes say of each cell of a map's frame, as log odds, shape (rows, columns).

    Args:
        keyframes: in the order in which they were seen.
        frame: whose size, resolution and origin count; what lies outside it is left out.
        lidar_m: where the lidar is in ``base``.
    """
    origin_m, size_m = np.array((frame.origin_x_m, frame.origin_y_m)), frame.resolution_m
    shape = (frame.height, frame.width)
    log_odds = np.zeros(shape[0] * shape[1], np.float32)
    for keyframe in keyframes:
        start = (_lidar_in_map(keyframe.pose, lidar_m) - origin_m) / size_m
        ends = (keyframe.points_in_map() - origin_m) / size_m
        _trace(log_odds, shape, start, ends, SHORT_OF_M / size_m)
    return log_odds.reshape(shape)


def _trace(
    log_odds: NDArray[np.float32], shape: tuple[int, int], start: Floats, ends: Floats,
    short_of: float,
) -> None:  # fmt: skip
    """Count one scan, in units of cells: each cell once as hit, or else once as passed."""
    if not len(ends):
        return
    along = ends - start
    length = np.hypot(along[:, 0], along[:, 1])
    steps = np.arange(0.0, max(float(length.max()), 0.5), 0.5)
    beam, step = np.nonzero(steps[None, :] < length[:, None] - short_of)
    way = start + along[beam] * (steps[step] / length[beam])[:, None]
    passed = np.unique(_cells(way, shape))
    hit = np.unique(_cells(ends, shape))
    passed = passed[~np.isin(passed, hit, assume_unique=True)]
    log_odds[hit] = np.minimum(log_odds[hit] + HIT, MOST)
    log_odds[passed] = np.maximum(log_odds[passed] + MISS, LEAST)


def _cells(points: Floats, shape: tuple[int, int]) -> NDArray[np.int64]:
    """Return the numbers of the cells that points lie in; of points outside none."""
    index = np.floor(points).astype(np.int64)
    inside = ((index >= 0) & (index < (shape[1], shape[0]))).all(axis=1)
    return np.asarray(index[inside, 1] * shape[1] + index[inside, 0])


def _lidar_in_map(pose: Floats, lidar_m: tuple[float, float]) -> Floats:
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x_m, y_m = lidar_m
    return np.array((pose[0] + c * x_m - s * y_m, pose[1] + s * x_m + c * y_m))
