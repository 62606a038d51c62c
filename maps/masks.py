"""Read keep-out and speed masks in Nav2's format as outlines for a fence. The careful reading.

A mask is a map whose occupancy means something else (Nav2's costmap filters). It has its own
resolution, origin and yaw, and becomes outlines in ``map``, grown by their own rounding. In a
keep-out mask any share of occupied closes a cell. In a speed mask 1 to 100 make a limit of
``base + multiplier * value``, percent of the robot's fastest or m/s. A limit that no robot can keep
(under 0.05 m/s; Nav2 takes 0 for "no limit") closes the area. Unknown says nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, cos, floor, inf, sin
from typing import TYPE_CHECKING, Literal

import cv2
import numpy as np

from maps.cell_array import cell_array
from maps.errors import SiteError
from maps.grid import FREE, GridMap
from maps.map_file import NO_OCCUPANCY, load_occupancy
from maps.outlines import outlines
from wire.fence import MAX_CORNERS, FenceFile, SpeedZone

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from maps.outlines import Polygon

_TOLERANCE_CELLS = 1.0
_SMALL_HOLE_M2 = 0.5
"""A hole in a closed area that holds no more than a robot."""
_SLOWEST_MPS = 0.05
"""The least that a fence's zone may say."""
_LARGEST = 1000.0
"""Of a speed mask's base and multiplier; Nav2's are 100 and -1."""
MOST_LIMITS = 10
"""Different limits of one mask; more are rounded down to so many."""


@dataclass(frozen=True, slots=True)
class SpeedScale:
    """Say how a speed mask's values become limits; Nav2's usual mask has base 100, multiplier -1.

    ``kind`` percent: of ``fastest_mps``; mps: metres a second.
    """

    fastest_mps: float
    kind: Literal["percent", "mps"] = "percent"
    base: float = 100.0
    multiplier: float = -1.0

    def __post_init__(self) -> None:
        """Refuse what makes no limit: infinite speed would drop the mask without a word.

        Raises:
            SiteError: ``value_malformed``.
        """
        for name, number in (("base", self.base), ("multiplier", self.multiplier)):
            if not abs(number) <= _LARGEST:
                text = (
                    f"the speed mask's {name}: expected -{_LARGEST:g} to {_LARGEST:g}, got {number}"
                )
                zh = f"限速掩膜的 {name}：应在 -{_LARGEST:g} 到 {_LARGEST:g} 之间，收到 {number}"
                raise SiteError("value_malformed", text, zh)

    def limit_mps(self, value: int) -> float:
        """Return the limit where the mask says 0 to 100; infinite for 0, which is none."""
        if value == 0:
            return inf
        said = self.base + self.multiplier * value
        limit = self.fastest_mps * said / 100.0 if self.kind == "percent" else said
        return max(0.0, limit)


@dataclass(frozen=True, slots=True)
class MaskAreas:
    """Hold what a mask closes and where it slows."""

    keep_outs: tuple[Polygon, ...]
    speed_zones: tuple[SpeedZone, ...] = ()


def join_masks(fence: FenceFile, masks: Sequence[MaskAreas]) -> FenceFile:
    """Return a fence with the areas of masks joined to its own, each area once.

    Raises:
        SiteError: ``map_too_ragged``: the outlines take more corners than a fence may have.
    """
    keep_outs = dict.fromkeys((*fence.keep_outs, *(a for mask in masks for a in mask.keep_outs)))
    zones = list(fence.speed_zones)
    zones += [zone for mask in masks for zone in mask.speed_zones if zone not in zones]
    lines = (*fence.allowed, *keep_outs, *(zone.polygon for zone in zones))
    corners = sum(map(len, lines))
    if not (corners <= MAX_CORNERS and len(keep_outs) <= 200 and len(zones) <= 200):
        text = f"with the masks the fence takes {corners} corners in {len(lines)} outlines"
        zh = f"加上掩膜后，围栏的 {len(lines)} 条边界共有 {corners} 个角"
        zh = f"{zh}；最多 {MAX_CORNERS} 个角，每种区域 200 个"
        raise SiteError("map_too_ragged", f"{text}; at most {MAX_CORNERS} and 200 of a kind", zh)
    return FenceFile(
        version=1,
        map_id=fence.map_id,
        allowed=fence.allowed,
        keep_outs=tuple(keep_outs),
        speed_zones=tuple(zones),
    )


def read_keep_outs(path: Path, onto: GridMap) -> MaskAreas:
    """Return the areas that a keep-out mask closes.

    Raises:
        SiteError: ``mask_elsewhere`` and what reading a map raises.
    """
    values, frame = _values(path, onto)
    closed = (values > 0) & (values != NO_OCCUPANCY) & _on_floor(frame, onto)
    return MaskAreas(_areas(closed, frame))


def read_speed_zones(path: Path, onto: GridMap, scale: SpeedScale) -> MaskAreas:
    """Return the areas that a speed mask slows, the slowest limit wherever they overlap.

    Raises:
        SiteError: ``mask_elsewhere`` and what reading a map raises.
    """
    values, frame = _values(path, onto)
    table = np.array([scale.limit_mps(value) if value <= 100 else inf for value in range(256)])
    limits = np.where(_on_floor(frame, onto), table[values], inf)
    closed = limits < _SLOWEST_MPS
    found = sorted({limit for limit in np.unique(limits).tolist() if _SLOWEST_MPS <= limit < inf})
    if len(found) > MOST_LIMITS:
        found = [found[floor(k * len(found) / MOST_LIMITS)] for k in range(MOST_LIMITS)]
    zones = []
    for index, limit in enumerate(found):
        above = found[index + 1] if index + 1 < len(found) else inf
        zones += [
            SpeedZone(polygon=area, max_speed_mps=round(min(limit, 10.0), 3))
            for area in _areas(limits < above, frame)
        ]
    return MaskAreas(_areas(closed, frame), tuple(zones))


@dataclass(frozen=True, slots=True)
class _Frame:
    """Lay the mask's own cells into ``map``."""

    cells: GridMap
    x_m: float
    y_m: float
    yaw_rad: float

    def in_map(self, polygon: Polygon) -> Polygon:
        turn, rise = cos(self.yaw_rad), sin(self.yaw_rad)
        return tuple(
            (
                round(self.x_m + x * turn - y * rise, 4),
                round(self.y_m + x * rise + y * turn, 4),
            )
            for x, y in polygon
        )


def _values(path: Path, onto: GridMap) -> tuple[NDArray[np.uint8], _Frame]:
    record, width, height, cells = load_occupancy(path)
    values = np.frombuffer(cells, np.uint8).reshape(height, width)
    x_m, y_m, yaw_rad = record.origin
    frame = _Frame(GridMap(width, height, record.resolution, 0.0, 0.0, b""), x_m, y_m, yaw_rad)
    across_m, up_m = width * record.resolution, height * record.resolution
    corners = frame.in_map(((0.0, 0.0), (across_m, 0.0), (across_m, up_m), (0.0, up_m)))
    xs, ys = zip(*corners, strict=True)
    right_m = onto.origin_x_m + onto.width * onto.resolution_m
    top_m = onto.origin_y_m + onto.height * onto.resolution_m
    apart = max(xs) <= onto.origin_x_m or min(xs) >= right_m
    if apart or max(ys) <= onto.origin_y_m or min(ys) >= top_m:
        mask = f"x {min(xs):.2f} to {max(xs):.2f}, y {min(ys):.2f} to {max(ys):.2f}"
        left, low = f"x {onto.origin_x_m:.2f}", f"y {onto.origin_y_m:.2f}"
        floor_plan = f"{left} to {right_m:.2f}, {low} to {top_m:.2f}"
        text = f"{path}: the mask spans {mask}; the map spans {floor_plan}: mend the mask's origin"
        mask, floor_plan = mask.replace(" to ", " 到 "), floor_plan.replace(" to ", " 到 ")
        zh = f"{path}：掩膜范围为 {mask}，地图范围为 {floor_plan}：请修改掩膜的 origin"
        raise SiteError("mask_elsewhere", text, zh)
    return values, frame


def _on_floor(frame: _Frame, onto: GridMap) -> NDArray[np.bool_]:
    """Return the mask's cells that lie on free floor of the map, wholly or in part.

    Elsewhere nothing drives, and a mask painted over a map has its walls: grown, they shut doors.
    """
    free = (cell_array(onto) == FREE).astype(np.uint8)
    reach = ceil(max(0.0, frame.cells.resolution_m / onto.resolution_m - 1.0) / 2)
    free = np.asarray(cv2.dilate(free, np.ones((2 * reach + 1,) * 2, np.uint8)), np.uint8)
    framed = np.pad(free, 1)
    size, turn, rise = frame.cells.resolution_m, cos(frame.yaw_rad), sin(frame.yaw_rad)
    x = (np.arange(frame.cells.width) + 0.5) * size
    y = (np.arange(frame.cells.height)[:, None] + 0.5) * size
    column = (frame.x_m + x * turn - y * rise - onto.origin_x_m) / onto.resolution_m
    row = (frame.y_m + x * rise + y * turn - onto.origin_y_m) / onto.resolution_m
    at_column = np.clip(np.floor(column), -1, onto.width).astype(np.intp) + 1
    at_row = np.clip(np.floor(row), -1, onto.height).astype(np.intp) + 1
    return np.asarray(framed[at_row, at_column] != 0, np.bool_)


def _areas(marked: NDArray[np.bool_], frame: _Frame) -> tuple[Polygon, ...]:
    """Return outlines that hold every marked cell: grown by the most that rounding takes off."""
    if not marked.any():
        return ()
    around = 3
    grown = np.pad(marked.astype(np.uint8), around)
    grown = np.asarray(cv2.dilate(grown, np.ones((2 * around - 3,) * 2, np.uint8)), np.uint8)
    size = frame.cells.resolution_m
    height, width = grown.shape
    grid = GridMap(width, height, size, -around * size, -around * size, b"")
    found: list[Polygon] = []
    for piece in _without_holes(grown, _SMALL_HOLE_M2 / size**2):
        found += outlines(piece.astype(bool), grid, _TOLERANCE_CELLS).outer
    return tuple(map(frame.in_map, found))


def _without_holes(cells: NDArray[np.uint8], least_cells: float) -> Iterator[NDArray[np.uint8]]:
    """Cut cells so that no part goes round a hole: an outline of a fence has none.

    Holes of fewer cells are left for the outline to cover. Parts grow by a cell, so that no gap is
    left along a cut.
    """
    lines, tree = cv2.findContours(cells, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    holes = [
        line
        for line, links in zip(lines, tree[0] if lines else (), strict=True)
        if links[3] >= 0 and cv2.contourArea(line) > least_cells
    ]
    if not holes:
        yield np.asarray(cv2.dilate(cells, np.ones((3, 3), np.uint8)), np.uint8)
        return
    x, _, wide, _ = cv2.boundingRect(max(holes, key=cv2.contourArea))
    cut = x + wide // 2
    for part in (np.s_[:, :cut], np.s_[:, cut:]):
        kept = np.zeros_like(cells)
        kept[part] = cells[part]
        yield from _without_holes(kept, least_cells)
