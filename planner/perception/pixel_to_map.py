"""Turn a pixel that somebody points at into a point to drive up to, or say why there is none. Pure.

A model or a person may point anywhere. What is refused: the sky, a wall, what the map does not
know, what lies outside the fence. The map knows no difference between walls and furniture; what
stands so far inside a room's outline is taken for furniture, and its near side for the point.
"""

from __future__ import annotations

from math import atan2, cos, hypot, sin
from typing import TYPE_CHECKING

from maps.grid import FREE, OCCUPIED
from planner.perception.interfaces import MapPoint, PointRefusal
from planner.perception.projection import FARTHEST_M, FLOOR_FARTHEST_M, View, spot_at
from planner.perception.raycast import first_wall_m
from planner.site.polygon import border_distance_m

if TYPE_CHECKING:
    from planner.site.site import Site

FULL = 1000.0
"""A picture is so wide and so high, whatever its size."""
OFF_WALL_M = 0.20
"""Nearer to a room's outline the map's cells are its wall."""
DEEP_M = 1.3
"""So far behind its near side a point may lie in furniture."""
LEAST_HIGH_M = 0.3
"""Furniture is stood before; what is low is driven onto."""
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
    at = f"({spot.x_m:.2f}, {spot.y_m:.2f})"
    cell = site.grid.at(spot.x_m, spot.y_m)
    if cell == OCCUPIED or _on_a_wall(view, site, spot):
        face = _near_side(view, site, spot)
        if face is None:
            raise PointRefusal("point_on_wall", f"{at} is a wall, or behind one")
        return face
    if cell != FREE or not site.fence.allows(spot.x_m, spot.y_m):
        raise PointRefusal("point_off_map", f"{at} is not on floor that may be driven on")
    return spot


def _near_side(view: View, site: Site, spot: MapPoint) -> MapPoint | None:
    """Return the side that the camera sees of the mapped furniture that a point lies on, or None.

    Furniture stands inside a room, well away from its outline, where walls are; from its near side
    to the point there is nothing else.
    """
    camera = view.camera_in_map
    dx, dy = spot.x_m - camera.x_m, spot.y_m - camera.y_m
    range_m, angle = hypot(dx, dy), atan2(dy, dx)
    most_m = range_m + 2.0 * spot.sigma_m
    side_m = first_wall_m(site.grid, (camera.x_m, camera.y_m), angle, most_m)
    if side_m is None or range_m - side_m > DEEP_M:
        return None
    x_m, y_m = camera.x_m + side_m * cos(angle), camera.y_m + side_m * sin(angle)
    step_m = site.grid.resolution_m / 2.0
    for step in range(1, int((range_m - side_m) / step_m)):
        if site.grid.at(x_m + step * step_m * cos(angle), y_m + step * step_m * sin(angle)) == FREE:
            return None
    room = site.room_at(x_m, y_m)
    if room is None or room.polygon is None or not site.fence.allows(x_m, y_m):
        return None
    if not border_distance_m(room.polygon, x_m, y_m) >= OFF_WALL_M:
        return None
    return MapPoint(x_m, y_m, max(spot.z_m, LEAST_HIGH_M), spot.sigma_m)


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
