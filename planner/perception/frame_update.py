"""Make a sight of one look: detections onto the map, the map's things into memory. Pure.

Told the picture, what was found in it and where the robot was; asks no clock and no wire.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from planner.language.object_names import canonical
from planner.perception.data_association import PlacedDetection
from planner.perception.object_tracker import ObjectMemory, remember
from planner.perception.projection import View, cut_off, place
from planner.perception.snapshot import LookSnapshot
from planner.perception.visibility import Visible

if TYPE_CHECKING:
    from planner.perception.interfaces import Picture
    from planner.perception.pose_buffer import Stance
    from planner.perception.snapshot import Detection, Thing
    from planner.site.site import Site
    from wire.camera_config import CameraConfig


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
