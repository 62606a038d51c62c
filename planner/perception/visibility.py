"""Judge whether a thing would be in a picture, if it still stood where it was seen. Pure.

Told in favour of the thing: near the picture's edge, small for its distance, behind what stands on
the map or in the picture, nobody says that it is gone.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, hypot
from typing import TYPE_CHECKING

from planner.language.object_classes import Kind, kind_of
from planner.perception.projection import View, pixel_of
from planner.perception.raycast import first_wall_m

if TYPE_CHECKING:
    from collections.abc import Sequence

    from maps.grid import GridMap
    from planner.perception.snapshot import Detection, Thing

FARTHEST_M = 4.0
NEAREST_M = 0.4
SMALLEST_PX = 14.0
"""A thing that shows smaller may be missed."""
MARGIN = 0.08
"""Of the picture's width and height: what lies so near to its edge may be cut off."""
PERCH_M = 0.8
"""What stands on a table stands so far behind the table's edge, which is wall on the map."""
IN_FRONT_M = 0.3


@dataclass(frozen=True, slots=True)
class Visible:
    """Be asked about each thing, for one picture."""

    view: View
    grid: GridMap
    detections: Sequence[Detection]

    def __call__(self, thing: Thing) -> bool:
        """Tell whether the thing should have been seen."""
        at = pixel_of(self.view, thing.x_m, thing.y_m, thing.z_m)
        if at is None or not NEAREST_M <= at[2] <= FARTHEST_M:
            return False
        kind = kind_of(thing.label)
        u_px, v_px, depth_m = at
        size_px = min(kind.height_m, 2 * kind.reach_m) * self.view.header.focal_px / depth_m
        if not (size_px >= SMALLEST_PX and self._well_inside(u_px, v_px)):
            return False
        return not (self._hidden_by_map(thing, kind) or self._hidden_by_seen(u_px, v_px, depth_m))

    def _well_inside(self, u_px: float, v_px: float) -> bool:
        head = self.view.header
        x, y = u_px / head.width, v_px / head.height
        return MARGIN <= x <= 1.0 - MARGIN and MARGIN <= y <= 1.0 - MARGIN

    def _hidden_by_map(self, thing: Thing, kind: Kind) -> bool:
        camera = self.view.camera_in_map
        dx, dy = thing.x_m - camera.x_m, thing.y_m - camera.y_m
        own_m = kind.reach_m + thing.sigma_m + (PERCH_M if kind.perched else 0.1)
        clear_m = hypot(dx, dy) - own_m  # nearer to it, the wall on the map is its own or its table
        if not clear_m > 0.0:
            return False
        start = camera.x_m, camera.y_m
        return first_wall_m(self.grid, start, atan2(dy, dx), clear_m) is not None

    def _hidden_by_seen(self, u_px: float, v_px: float, depth_m: float) -> bool:
        return any(
            seen.depth_m is not None
            and seen.depth_m < depth_m - IN_FRONT_M
            and seen.box[0] <= u_px <= seen.box[2]
            and seen.box[1] <= v_px <= seen.box[3]
            for seen in self.detections
        )
