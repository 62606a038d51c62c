"""Make of a point or a place what localization takes for a person's word on where the robot is."""

from __future__ import annotations

import secrets
from math import hypot
from typing import TYPE_CHECKING

from wire import Pose2, PoseHint

if TYPE_CHECKING:
    from planner.site.places import Place

POINT_M = 1.0
"""How near a point is meant."""
MOST_CORNERS = 128
MOST_M = 15.0
"""The widest circle that the wire takes."""


def hint_at(x_m: float, y_m: float, yaw_rad: float | None) -> PoseHint:
    """Return the hint that the robot is about a point of ``map`` [m, rad]."""
    pose = Pose2(x_m, y_m, yaw_rad or 0.0)
    return PoseHint(id=_new_id(), pose=pose, radius_m=POINT_M, any_heading=yaw_rad is None)


def hint_in(place: Place) -> PoseHint:
    """Return the hint that the robot is in a room, or at a place that has no outline."""
    if place.polygon is None:
        return hint_at(place.pose.x_m, place.pose.y_m, None)
    xs, ys = zip(*place.polygon, strict=True)
    x_m, y_m = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
    reach_m = max(hypot(x - x_m, y - y_m) for x, y in place.polygon)
    return PoseHint(
        id=_new_id(),
        pose=Pose2(x_m, y_m, 0.0),
        radius_m=min(max(reach_m, POINT_M), MOST_M),
        any_heading=True,
        outline=place.polygon if len(place.polygon) <= MOST_CORNERS else (),
    )


def _new_id() -> str:
    return f"hint-{secrets.token_hex(6)}"
