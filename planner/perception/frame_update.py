"""Make a sight of one look: detections onto the map, the map's things into memory. Pure.

Told the picture, what was found in it and where the robot was; asks no clock and no wire. Whether
a thing would be in the picture, if it still stood where it was seen, is judged in its favour: near
the picture's edge, small for its distance, behind what stands on the map or in the picture, nobody
says that it is gone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan2, hypot
from typing import TYPE_CHECKING

from planner.language.object_classes import Kind, kind_of
from planner.language.object_names import canonical
from planner.perception.data_association import PlacedDetection
from planner.perception.object_tracker import ObjectMemory, remember
from planner.perception.projection import View, cut_off, first_wall_m, pixel_of, place
from planner.perception.snapshot import LookSnapshot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from maps.grid import GridMap
    from planner.perception.interfaces import Picture
    from planner.perception.pose_buffer import Stance
    from planner.perception.snapshot import Detection, Thing
    from planner.site.site import Site
    from wire.camera_config import CameraConfig

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


@dataclass(frozen=True, slots=True)
class Scenery:
    """Hold the constants from look to look."""

    site: Site
    camera: CameraConfig


def saw(
    scenery: Scenery,
    before: ObjectMemory,
    picture: Picture,
    detections: tuple[Detection, ...],
    stance: Stance | None,
    passed_over: frozenset[str] = frozenset(),
) -> tuple[ObjectMemory, LookSnapshot]:
    """Return the memory after one look, and the look. Without a pose nothing is learnt.

    Things of kinds that were ``passed_over``, which this look did not look for, are not missed.
    """
    header = picture.color.header
    named = tuple(replace(seen, label=canonical(seen.label)) for seen in detections)
    look = LookSnapshot(header.seq, picture.taken_s, None, header.width, header.height, named)
    if stance is None:
        return before, replace(look, here=("",) * len(named))
    view = View(header, scenery.camera, stance)
    placed = tuple(_place_all(scenery.site, view, named))
    visible = Visible(view, scenery.site.grid, named)

    def is_expected(thing: Thing) -> bool:
        return thing.label not in passed_over and visible(thing)

    after, ids = remember(before, placed, is_expected, picture.taken_s)
    here = tuple(ids.get(index, "") for index in range(len(named)))
    return after, replace(look, base_in_map=stance.base_in_map, here=here)


def _place_all(site: Site, view: View, detections: tuple[Detection, ...]) -> list[PlacedDetection]:
    """Return the detections that can be put on the map."""
    found: list[PlacedDetection] = []
    for index, seen in enumerate(detections):
        spot = place(view, seen)
        if spot is None or not site.grid.contains(spot.x_m, spot.y_m):
            continue
        room = site.room_at(spot.x_m, spot.y_m)
        found.append(
            PlacedDetection(
                index, seen.label, seen.score, seen.color, seen.box, spot,
                room.id if room is not None else None, whole=not cut_off(view, seen),
            )
        )  # fmt: skip
    return found
