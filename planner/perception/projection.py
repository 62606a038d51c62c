"""Project pixels onto the map, and a pixel that somebody points at to a spot to drive up to.

Pure maths; never NaN: an impossible result is None, a point that leads nowhere a refusal. Camera
frame (``wire.CameraConfig``): on ``base`` at x, y, z, turned by yaw, pitched down by pitch, never
rolled. Pinhole (``wire.ImageHeader``): a pixel (u, v) at depth d along the optical axis lies
d (u - cx) / f to the right and d (v - cy) / f below that axis.

A model or a person may point anywhere. What is refused: the sky, a wall, what the map does not
know, what lies outside the fence. The map knows no difference between walls and furniture; what
stands so far inside a room's outline is taken for furniture, and its near side for the point.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, isfinite, sin
from typing import TYPE_CHECKING

from maps.grid import FREE, OCCUPIED
from planner.language.object_classes import kind_of
from planner.perception.interfaces import MapPoint, PointRefusal
from planner.site.polygon import border_distance_m
from wire import Pose2, compose, transform

if TYPE_CHECKING:
    from maps.grid import GridMap
    from planner.perception.pose_buffer import Stance
    from planner.perception.snapshot import Detection
    from planner.site.site import Site
    from wire import ImageHeader
    from wire.camera_config import CameraConfig

MOST_STEPS = 1_000


def first_wall_m(
    grid: GridMap, start: tuple[float, float], angle_rad: float, most_m: float
) -> float | None:
    """Return how far away the first occupied cell is [m]; None where none is within ``most_m``.

    Steps are half a cell: a wall of one cell is passed over at its very corner at most.
    """
    step_m = max(grid.resolution_m / 2, most_m / MOST_STEPS)
    dx, dy = step_m * cos(angle_rad), step_m * sin(angle_rad)
    x_m, y_m = start
    for step in range(1, int(most_m / step_m) + 1):
        if grid.at(x_m + step * dx, y_m + step * dy) == OCCUPIED:
            return step * step_m
    return None


FARTHEST_M = 10.0
FLOOR_FARTHEST_M = 5.0
"""Beyond it half a degree of pitch moves a point of the floor by more than 0.2 m."""
SIGMA_PITCH_RAD = 0.01
"""Of a camera's mounting, and of a body that nods."""
SIGMA_PX = 2.0
"""Of a box's edge."""
EDGE_PX = 2.0
"""A box that comes so near to the picture's edge is cut off there."""
USUAL_SHARE = 0.8
"""Of a class's greatest extent: so wide a thing shows on average, seen from anywhere."""
SLIVER_PX = 12.0
"""So little of what is cut off tells nothing of where its middle is."""
SIGMA_LEAST_M = 0.02
PERCHED_SHARE = 0.4
"""Of the way: what may stand on a table lies anywhere before where its foot meets the floor."""
FINEST_M = 0.01
PER_METRE2 = 0.008
"""Noise of depth [m per m²], as stereo and structured light have it."""


@dataclass(frozen=True, slots=True)
class View:
    """Hold one camera at one instant: its optics, where it is and how surely."""

    header: ImageHeader
    camera: CameraConfig
    stance: Stance

    @property
    def camera_in_map(self) -> Pose2:
        """Return where the camera stands, on the floor plane."""
        at = Pose2(self.camera.x_m, self.camera.y_m, self.camera.yaw_rad)
        return compose(self.stance.base_in_map, at)


@dataclass(frozen=True, slots=True)
class Ray:
    """Give one pixel's direction, per metre along the optical axis, in the camera's level frame."""

    ahead: float
    left: float
    up: float


def ray_of(view: View, u_px: float, v_px: float) -> Ray:
    """Return where a pixel looks: the pinhole's ray, turned level by the pitch."""
    head = view.header
    right = (u_px - head.center_x_px) / head.focal_px
    down = (v_px - head.center_y_px) / head.focal_px
    c, s = cos(view.camera.pitch_rad), sin(view.camera.pitch_rad)
    return Ray(c - down * s, -right, -(s + down * c))


def place(view: View, seen: Detection) -> MapPoint | None:
    """Return where a detected thing's middle is, by depth, else by where it meets the floor."""
    left, top, right, bottom = seen.box
    if not (all(map(isfinite, seen.box)) and left < right and top < bottom):
        return None
    if cut_off(view, seen) and min(right - left, bottom - top) < SLIVER_PX:
        return None
    if seen.depth_m is not None:
        return _by_depth(view, seen, seen.depth_m)
    return _by_floor(view, seen)


def _by_depth(view: View, seen: Detection, depth_m: float) -> MapPoint | None:
    left, top, right, bottom = seen.box
    if not (0.0 < depth_m <= FARTHEST_M and 0.0 <= seen.depth_spread_m <= FARTHEST_M):
        return None
    kind, focal_px = kind_of(seen.label), view.header.focal_px
    width_m = (right - left) * depth_m / focal_px
    beyond_px = _beyond_m(view, seen, width_m) * focal_px / depth_m
    ray = ray_of(view, (left + right) / 2 + beyond_px, (top + bottom) / 2)
    cut = cut_off(view, seen)
    behind_m = kind.middle_m(width_m, cut=cut)
    range_m = depth_m * hypot(ray.ahead, ray.left) + behind_m
    noise_m = FINEST_M + PER_METRE2 * depth_m * depth_m
    along_m = hypot(noise_m, seen.depth_spread_m / 2, behind_m / 2)
    across_m = depth_m * SIGMA_PX / focal_px + 0.05 * width_m
    if cut:
        across_m, along_m = across_m + kind.reach_m / 4, hypot(along_m, kind.reach_m / 2)
    z_m = view.camera.z_m + depth_m * ray.up
    return _spot(view, atan2(ray.left, ray.ahead), range_m, z_m, (along_m, across_m))


def _beyond_m(view: View, seen: Detection, width_m: float) -> float:
    """Return how far right of a box's middle the thing's own lies, cut off at one side of it [m].

    The other edge is the thing's: its middle lies half of a usual width from there.
    """
    at_left, at_right = seen.box[0] <= EDGE_PX, seen.box[2] >= view.header.width - EDGE_PX
    hidden_m = max(0.0, 2 * USUAL_SHARE * kind_of(seen.label).reach_m - width_m)
    return hidden_m / 2 * (at_right - at_left)


def _by_floor(view: View, seen: Detection) -> MapPoint | None:
    left, top, right, bottom = seen.box
    if cut_off(view, seen):
        return None  # its foot may be outside the picture: nobody knows how much nearer it is
    foot = ray_of(view, (left + right) / 2, bottom)
    reached = _floor_m(view, foot)
    if reached is None:
        return None
    kind = kind_of(seen.label)
    range_m, along_m = reached
    if kind.perched:
        along_m = max(along_m, PERCHED_SHARE * range_m)
    depth_m = range_m / hypot(foot.ahead, foot.left)
    across_m = depth_m * SIGMA_PX / view.header.focal_px + kind.reach_m / 4
    z_m = (bottom - top) * depth_m / view.header.focal_px / 2
    along_m = hypot(along_m, kind.behind_m / 2)
    angle = atan2(foot.left, foot.ahead)
    return _spot(view, angle, range_m + kind.behind_m, z_m, (along_m, across_m))


def spot_at(view: View, u_px: float, v_px: float, depth_m: float | None) -> MapPoint | None:
    """Return the point that a pixel shows, by its depth where it has one, else on the floor."""
    if not (0.0 <= u_px <= view.header.width and 0.0 <= v_px <= view.header.height):
        return None
    ray = ray_of(view, u_px, v_px)
    angle = atan2(ray.left, ray.ahead)
    if depth_m is None:
        reached = _floor_m(view, ray)
        return None if reached is None else _spot(view, angle, reached[0], 0.0, (reached[1], 0.0))
    if not 0.0 < depth_m <= FARTHEST_M:
        return None
    along_m = FINEST_M + PER_METRE2 * depth_m * depth_m
    across_m = depth_m * SIGMA_PX / view.header.focal_px
    range_m, z_m = depth_m * hypot(ray.ahead, ray.left), view.camera.z_m + depth_m * ray.up
    return _spot(view, angle, range_m, z_m, (along_m, across_m))


def _floor_m(view: View, ray: Ray) -> tuple[float, float] | None:
    """Return how far away a ray meets the floor, and how surely; None above the horizon."""
    if not (ray.ahead > 0.0 and ray.up < 0.0):
        return None
    range_m = view.camera.z_m * hypot(ray.ahead, ray.left) / -ray.up
    if not 0.0 < range_m <= FLOOR_FARTHEST_M:
        return None
    # r = z / tan(a), so dr = z / sin²(a) da = (r² + z²) / z da
    angle_rad = hypot(SIGMA_PITCH_RAD, SIGMA_PX / view.header.focal_px)
    return range_m, (range_m * range_m + view.camera.z_m**2) / view.camera.z_m * angle_rad


def _spot(
    view: View, angle_rad: float, range_m: float, z_m: float, sigmas_m: tuple[float, float]
) -> MapPoint | None:
    """Return the point at an angle and a range from the camera; (along, across) are its errors."""
    camera = view.camera_in_map
    x_m, y_m = transform(camera, range_m * cos(angle_rad), range_m * sin(angle_rad))
    along_m, across_m = sigmas_m
    turned_m = range_m * view.stance.sigma_rad
    sigma_m = hypot(max(along_m, hypot(across_m, turned_m)), view.stance.sigma_m, SIGMA_LEAST_M)
    if not all(map(isfinite, (x_m, y_m, z_m, sigma_m))):
        return None
    return MapPoint(x_m, y_m, max(0.0, z_m), sigma_m)


def cut_off(view: View, seen: Detection) -> bool:
    """Return whether a box reaches the picture's edge: it may show only a part of the thing."""
    left, top, right, bottom = seen.box
    inside_x = left > EDGE_PX and right < view.header.width - EDGE_PX
    return not (inside_x and top > EDGE_PX and bottom < view.header.height - EDGE_PX)


def pixel_of(view: View, x_m: float, y_m: float, z_m: float) -> tuple[float, float, float] | None:
    """Return where a point of the world is in the picture: (u, v, depth); None behind it."""
    camera = view.camera_in_map
    dx, dy = x_m - camera.x_m, y_m - camera.y_m
    c, s = cos(camera.yaw_rad), sin(camera.yaw_rad)
    ahead, left, up = c * dx + s * dy, c * dy - s * dx, z_m - view.camera.z_m
    c, s = cos(view.camera.pitch_rad), sin(view.camera.pitch_rad)
    depth_m, down_m = c * ahead - s * up, -(s * ahead + c * up)
    if not depth_m > 0.05:
        return None
    head = view.header
    u_px = head.center_x_px - head.focal_px * left / depth_m
    return u_px, head.center_y_px + head.focal_px * down_m / depth_m, depth_m


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
