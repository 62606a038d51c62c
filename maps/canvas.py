"""Make the site in which a home is mapped: floor around the robot, all else unknown, a wide fence.

Its map_id and frame stay while the map grows over it, so that bridge, planner and localization of
one run agree on what ``map`` is. The growing map itself is a file beside it (maps.growing_map).
"""

from __future__ import annotations

from math import ceil

import numpy as np

from maps.grid import FREE, UNKNOWN, GridMap
from maps.growing_map import GROWING_MAP, GrowingMap
from maps.new_site import NewSite, map_picture, map_yaml, places_of_home
from wire.fence import FenceFile, fence_text
from wire.fingerprint import map_id
from wire.geometry import Pose2

SIDE_M = 40.0
"""The robot begins in the middle, so a home may reach 20 m from it to each side."""
RESOLUTION_M = 0.05
FLOOR_M = 0.2
"""Free around the robot's own disc: it stands there, so floor is there."""
EDGE_M = 1.0
"""From the fence to the canvas' edge."""


def canvas_site(radius_m: float, side_m: float = SIDE_M, mark: str = "") -> NewSite:
    """Return a site whose ``map`` begins where the robot stands, heading along x.

    Args:
        radius_m: of the robot's disc.
        side_m: of the square that may be mapped.
        mark: one word that no other canvas bears; it makes the map_id another one, so that a place
            taught on one canvas is none of another's.
    """
    count = round(side_m / RESOLUTION_M)
    origin_m = -0.5 * count * RESOLUTION_M
    middle_m = origin_m + (np.arange(count) + 0.5) * RESOLUTION_M
    away_m = np.hypot(middle_m[None, :], middle_m[:, None])
    cells = np.where(away_m <= radius_m + FLOOR_M, FREE, UNKNOWN).astype(np.uint8)
    grid = GridMap(count, count, RESOLUTION_M, origin_m, origin_m, cells.tobytes())
    text, picture = map_yaml(grid) + (f"# {mark}\n".encode() if mark else b""), map_picture(grid)
    reach_m = -origin_m - EDGE_M
    square = ((-reach_m, -reach_m), (reach_m, -reach_m), (reach_m, reach_m), (-reach_m, reach_m))
    fence = FenceFile(version=1, map_id=map_id(text, picture), allowed=(square,))
    home = Pose2(0.0, 0.0, 0.0)
    files = {
        "map.yaml": text,
        "map.pgm": picture,
        "places.yaml": places_of_home(home),
        "fence.json": fence_text(fence).encode(),
        GROWING_MAP: _initial_floor(grid, radius_m + FLOOR_M).to_bytes(),
    }
    return NewSite(files, home, ())


def _initial_floor(canvas: GridMap, reach_m: float) -> GrowingMap:
    """Return the floor in the middle of a canvas as a map that has just begun to grow."""
    half = ceil(reach_m / RESOLUTION_M) + 1
    first = canvas.width // 2 - half
    rows = range(first, first + 2 * half)
    cells = b"".join(
        canvas.cells[row * canvas.width + first : row * canvas.width + first + 2 * half]
        for row in rows
    )
    corner_m = canvas.origin_x_m + first * RESOLUTION_M
    grid = GridMap(2 * half, 2 * half, RESOLUTION_M, corner_m, corner_m, cells)
    return GrowingMap(0, 0, 0, grid)
