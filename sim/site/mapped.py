"""Make a home of a map alone, for sites that nobody declared: occupied cells become walls.

A site without home.yaml has map.yaml and places.yaml. Its occupied cells are merged into boxes of
a wall's height, for physics, lidar and camera alike; unknown cells hold nothing. Around it all runs
a wall, so that nobody drives off the world.
"""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, Annotated

import numpy as np
from pydantic import ConfigDict, Field

from maps import OCCUPIED, load_map
from maps.cell_array import cell_array
from maps.yaml_records import SiteRecord, parse_yaml, read_bytes
from sim.site.spec import Furniture, Home, HomePlace, HomeWall, Name, Room
from wire import ConfigError
from wire.geometry import Pose2, wrap

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from maps import GridMap

    Box = tuple[float, float, float, float]

MAP_FILE, PLACES_FILE = "map.yaml", "places.yaml"
MOST_BOXES = 5_000
"""More make a scan of rays slower than it is due; a house of 25 m x 25 m has some hundreds."""
_DOCK = "home"
_BOUNDS_M = 499.0


class _Spot(SiteRecord):
    """Take of a place what a robot's start needs; the planner judges the rest."""

    model_config = ConfigDict(frozen=True, extra="ignore", allow_inf_nan=False)
    id: str
    pose: Pose2


class _Spots(SiteRecord):
    model_config = ConfigDict(frozen=True, extra="ignore", allow_inf_nan=False)
    home: str
    places: Annotated[tuple[_Spot, ...], Field(min_length=1, max_length=10_000)]


def mapped_home(site_dir: Path) -> Home:
    """Return a home whose furniture is the map's walls and whose dock is the site's home.

    Raises:
        SiteError: map or places can't be read.
        ConfigError: ``map_too_ragged``, ``map_far`` or ``dock_unknown``.
    """
    grid = load_map(site_dir / MAP_FILE).grid
    path = site_dir / PLACES_FILE
    spots = parse_yaml(read_bytes(path), _Spots, path)
    dock = next((spot.pose for spot in spots.places if spot.id == spots.home), None)
    if dock is None:
        raise ConfigError("dock_unknown", f"{path}: home {spots.home!r} is no place of it")
    return home_of_cells(grid, occupied_cells(grid), dock, str(site_dir))


def occupied_cells(grid: GridMap) -> NDArray[np.bool_]:
    """Return which cells of a map hold something, shape (rows, columns)."""
    return np.equal(cell_array(grid), OCCUPIED)


def home_of_cells(grid: GridMap, occupied: NDArray[np.bool_], dock: Pose2, where: str) -> Home:
    """Return a home whose furniture is these cells of a map.

    Args:
        grid: the map.
        occupied: its cells that hold something, shape (rows, columns).
        dock: where a robot starts, in ``map``.
        where: names the map in errors.

    Raises:
        ConfigError: ``map_too_ragged`` or ``map_far``.
    """
    boxes = boxes_of_cells(grid, occupied)
    if len(boxes) > MOST_BOXES:
        text = f"{where}: its walls make {len(boxes)} boxes; at most {MOST_BOXES} are simulated"
        raise ConfigError("map_too_ragged", text)
    around = _around(grid)
    if max(map(abs, around)) > _BOUNDS_M:
        text = f"{where}: it reaches to {max(map(abs, around)):.0f} m; at most {_BOUNDS_M:g}"
        raise ConfigError("map_far", text)
    wall = HomeWall()
    at = (dock.x_m, dock.y_m, degrees(wrap(dock.yaw_rad)))
    return Home(
        version=1,
        site="mapped",
        name=Name(en="mapped", zh="地图"),
        wall=wall,
        dock=_DOCK,
        rooms={"floor": Room(name=Name(en="floor", zh="地面"), box=around, pose=at)},
        furniture={
            f"wall_{number}": Furniture(box=box, height_m=wall.height_m, **{"class": "none"})
            for number, box in enumerate(boxes)
        },
        places={_DOCK: HomePlace(name=Name(en="home", zh="家"), pose=at)},
    )


def wall_boxes(grid: GridMap) -> list[Box]:
    """Merge occupied cells into boxes [x0, y0, x1, y1] that cover each of them once, in ``map``.

    Cells in a row become one box, and equal boxes of rows above one another; along columns where
    that gives fewer.
    """
    return boxes_of_cells(grid, occupied_cells(grid))


def boxes_of_cells(grid: GridMap, occupied: NDArray[np.bool_]) -> list[Box]:
    """Merge these cells of a map into boxes, likewise."""
    by_row = _boxes(occupied)
    by_column = _boxes(occupied.T)
    cells = (
        by_row
        if len(by_row) <= len(by_column)
        else [(low, left, high, right) for left, low, right, high in by_column]
    )
    size = grid.resolution_m
    return [
        (
            round(grid.origin_x_m + left * size, 4),
            round(grid.origin_y_m + low * size, 4),
            round(grid.origin_x_m + right * size, 4),
            round(grid.origin_y_m + high * size, 4),
        )
        for left, low, right, high in cells
    ]


def _boxes(occupied: NDArray[np.bool_]) -> list[tuple[int, int, int, int]]:
    """Return (first column, first row, column after, row after) of each box."""
    found: list[tuple[int, int, int, int]] = []
    growing: dict[tuple[int, int], int] = {}
    for row in range(len(occupied) + 1):
        runs: set[tuple[int, int]] = set()
        if row < len(occupied):
            steps = np.diff(np.pad(occupied[row].astype(np.int8), 1))
            starts, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
            runs = set(zip(starts.tolist(), ends.tolist(), strict=True))
        ended = [run for run in growing if run not in runs]
        found += [(run[0], growing.pop(run), run[1], row) for run in ended]
        for run in runs:
            growing.setdefault(run, row)
    return sorted(found)


def _around(grid: GridMap) -> Box:
    """Return a box around the map, whose walls lie wholly outside of it."""
    out_m = HomeWall().thickness_m
    right_m = grid.origin_x_m + grid.width * grid.resolution_m
    top_m = grid.origin_y_m + grid.height * grid.resolution_m
    left_m, low_m = grid.origin_x_m, grid.origin_y_m
    return (
        round(left_m - out_m, 4), round(low_m - out_m, 4),
        round(right_m + out_m, 4), round(top_m + out_m, 4),
    )  # fmt: skip
