"""Turn a pixel that somebody points at into a point to drive up to, or say why there is none. Pure.

A model or a person may point anywhere. What is refused: the sky, a wall, what the map does not
know, what lies outside the fence. Furniture is wall here: the map knows no difference.
"""

from __future__ import annotations

from math import atan2, hypot
from typing import TYPE_CHECKING

from maps.grid import FREE, OCCUPIED
from planner.perception.interfaces import MapPoint, PointRefusal
from planner.perception.projection import FARTHEST_M, FLOOR_FARTHEST_M, View, spot_at
from planner.perception.raycast import first_wall_m

if TYPE_CHECKING:
    from planner.site.site import Site

FULL = 1000.0
"""A picture is so wide and so high, whatever its size."""
HIGH_M = 0.25
"""What is seen above this in front of a wall may be the wall itself, for all that depth tells."""


def pixel(view: View, x: float, y: float) -> tuple[float, float]:
    """Return the pixel of a point given in 0 to 1000."""
    return x / FULL * view.header.width, y / FULL * view.header.height


def point_on_map(view: View, site: Site, x: float, y: float, depth_m: float | None) -> MapPoint:
    """Return the point of the map at a point of a picture (x right, y down, each 0 to 1000).

    Raises:
        PointRefusal: it shows no floor and nothing that stands on free floor.
    """
    if not (0.0 <= x <= FULL and 0.0 <= y <= FULL):
        raise PointRefusal("point_malformed", f"({x}, {y}); expected 0 to {FULL:g} each")
    spot = spot_at(view, *pixel(view, x, y), depth_m)
    if spot is None:
        far = f"beyond {FARTHEST_M if depth_m is not None else FLOOR_FARTHEST_M:g} m"
        code = "point_no_depth" if depth_m is None else "point_too_far"
        raise PointRefusal(code, f"no depth there, and no floor within reach or {far}")
    _check_floor(view, site, spot)
    return spot


def _check_floor(view: View, site: Site, spot: MapPoint) -> None:
    at = f"({spot.x_m:.2f}, {spot.y_m:.2f})"
    cell = site.grid.at(spot.x_m, spot.y_m)
    if cell == OCCUPIED or _on_a_wall(view, site, spot):
        raise PointRefusal("point_on_wall", f"{at} is a wall or furniture")
    if cell != FREE or not site.fence.allows(spot.x_m, spot.y_m):
        raise PointRefusal("point_off_map", f"{at} is not on floor that may be driven on")


def _on_a_wall(view: View, site: Site, spot: MapPoint) -> bool:
    """Tell whether the way there leads through a wall, or the point may well be one's face."""
    camera = view.camera_in_map
    dx, dy = spot.x_m - camera.x_m, spot.y_m - camera.y_m
    range_m = hypot(dx, dy)
    beyond_m = 2.0 * spot.sigma_m if spot.z_m > HIGH_M else 0.0
    return (
        first_wall_m(site.grid, (camera.x_m, camera.y_m), atan2(dy, dx), range_m + beyond_m)
        is not None
    )
