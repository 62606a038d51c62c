"""Project pixels onto the map. Pure maths; never NaN: an impossible result is None.

Camera frame (``wire.CameraConfig``): on ``base`` at x, y, z, turned by yaw, pitched down by pitch,
never rolled. Pinhole (``wire.ImageHeader``): a pixel (u, v) at depth d along the optical axis lies
d (u - cx) / f to the right and d (v - cy) / f below that axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, isfinite, sin
from typing import TYPE_CHECKING

from planner.language.object_classes import kind_of
from planner.perception.interfaces import MapPoint
from wire import Pose2, compose, transform

if TYPE_CHECKING:
    from planner.perception.pose_buffer import Stance
    from planner.perception.snapshot import Detection
    from wire import ImageHeader
    from wire.camera_config import CameraConfig

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
