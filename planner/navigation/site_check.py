"""Say what is wrong with a site before a robot drives there: ``pons site check``. Moves nothing.

Finds what loading does not refuse: floor that nobody can reach, spots without room, maps that say
less than they seem to. Each finding has a code that stays, and a sentence in every language.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Literal

import cv2
import numpy as np

from maps import FREE, OCCUPIED, UNKNOWN, LoadedMap, load_map
from maps.cell_array import cell_array
from planner.language.catalogue import say
from planner.navigation.costmap import Costmap, Mask, static_costmap
from planner.navigation.start_and_goal import end_cells
from planner.plan.base import Bilingual
from planner.site import Place, Site, SiteError
from planner.site.fence_check import PLACE_M
from planner.site.polygon import area_m2
from wire import margins

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    Outline = NDArray[np.float32]

STAND_M = 0.10
"""Beside the disc, where a robot stands: pose and cells err by about as much as the gate keeps."""
COARSE_M = 0.10
"""Of cells this large a door of 0.90 m may lose two, which leaves no way for a disc of 0.30 m."""
MUCH_UNKNOWN = 0.5
"""Of the cells within the known part's rectangle."""
KEPT_SHARE = 0.01
OVERLAP_SHARE = 0.1
"""Of the smaller of two rooms: their outlines run along the middle of walls, give or take."""
_DRAWN_CELLS = 100
ISLAND_SHARE = 0.05
"""Of the free floor, cut off from the robot's home."""

Level = Literal["error", "warning"]


@dataclass(frozen=True, slots=True)
class SiteFinding:
    """Hold one thing that is wrong; with an error a robot can't start, stand or get somewhere."""

    code: str
    level: Level
    words: Bilingual


def check_site(folder: Path, radius_m: float) -> tuple[SiteFinding, ...]:
    """Return all that is wrong with a site for a robot of a radius, the errors first.

    A site that can't be loaded has one finding, the reason.
    """
    try:
        site = Site.load(folder)
        loaded = load_map(folder / "map.yaml")
    except SiteError as error:
        words = Bilingual(en=error.message["en"], zh=error.message["zh"])
        return (SiteFinding(error.code, "error", words),)
    costmap = static_costmap(site, radius_m)
    found = [*_of_map(loaded), *_of_places(site, costmap), *_of_rooms(site)]
    found += _of_floor(site, costmap)
    return tuple(sorted(found, key=lambda finding: finding.level != "error"))


def _finding(code: str, level: Level = "warning", **facts: str) -> SiteFinding:
    return SiteFinding(code, level, say(f"site_check.{code}", **facts))


def _of_map(loaded: LoadedMap) -> Iterator[SiteFinding]:
    grid, record = loaded.grid, loaded.record
    cells = cell_array(grid)
    if grid.resolution_m > COARSE_M:
        yield _finding("resolution_coarse", cell=f"{grid.resolution_m:g}", most=f"{COARSE_M:g}")
    kept = loaded.kept_unknown / len(grid.cells)
    if kept >= KEPT_SHARE:
        yield _finding(
            "unknown_kept", share=f"{100 * kept:.0f}", threshold=f"{record.free_thresh:g}"
        )
    unknown = _unknown_share(cells != UNKNOWN)
    if unknown >= MUCH_UNKNOWN:
        yield _finding("unknown_much", share=f"{100 * unknown:.0f}")
    if not (cells == OCCUPIED).any():
        yield _finding("no_walls")


def _unknown_share(known: Mask) -> float:
    """Return how much of the smallest rectangle around the known cells is unknown, at any angle."""
    rows = np.flatnonzero(known.any(axis=1))
    if not len(rows):
        return 0.0
    first = known[rows].argmax(axis=1)
    last = known.shape[1] - known[rows, ::-1].argmax(axis=1)
    ends = [np.column_stack((xs, rows + dy)) for xs in (first, last) for dy in (0, 1)]
    _, (width, height), _ = cv2.minAreaRect(np.concatenate(ends).astype(np.float32))
    return max(0.0, 1.0 - float(known.sum()) / max(1.0, width * height))


def _of_places(site: Site, costmap: Costmap) -> Iterator[SiteFinding]:
    home = site.home.pose
    column, row = site.grid.cell_of(home.x_m, home.y_m)
    reached = _mark_reached(costmap, row, column)
    if reached is None:
        room = float(costmap.clearance_m[row, column])
        yield _finding(
            "home_tight", "error", place=site.home.id, room=f"{room:.2f}",
            wanted=f"{costmap.radius_m + margins.OBSTACLE_MARGIN_M:.2f}",
        )  # fmt: skip
    for place in site.places:
        yield from _of_place(place, site, costmap, reached)


def _of_place(
    place: Place, site: Site, costmap: Costmap, reached: Mask | None
) -> Iterator[SiteFinding]:
    column, row = site.grid.cell_of(place.pose.x_m, place.pose.y_m)
    room = float(costmap.clearance_m[row, column])
    wanted = costmap.radius_m + STAND_M
    if not room >= wanted:
        yield _finding("place_tight", place=place.id, room=f"{room:.2f}", wanted=f"{wanted:.2f}")
    to_fence = site.fence.border_distance_m(place.pose.x_m, place.pose.y_m)
    if not to_fence >= PLACE_M:
        yield _finding(
            "place_near_fence", place=place.id, room=f"{to_fence:.2f}", wanted=f"{PLACE_M:g}"
        )
    if reached is None or bool(reached[end_cells(costmap, site, place.pose)].any()):
        return
    loose = _without_margin(costmap)
    loosely = _reached_in(site, loose)
    if loosely is not None and bool(loosely[end_cells(loose, site, place.pose)].any()):
        margin = f"{margins.OBSTACLE_MARGIN_M:g}"
        yield _finding("margin_closes_way", "error", place=place.id, margin=margin)
    else:
        yield _finding("place_unreachable", "error", place=place.id)


def _of_rooms(site: Site) -> Iterator[SiteFinding]:
    rooms = [(room, np.array(room.polygon, np.float32)) for room in site.rooms if room.polygon]
    for room, _ in rooms:
        if not room.contains(room.pose.x_m, room.pose.y_m):
            yield _finding("room_apart", room=room.id)
    for (one, outline), (other, beside) in combinations(rooms, 2):
        shared = _shared_m2(outline, beside)
        smaller = min(area_m2(one.polygon or ()), area_m2(other.polygon or ()))
        if shared >= OVERLAP_SHARE * smaller:
            yield _finding("rooms_overlap", room=one.id, other=other.id, area=f"{shared:.1f}")


def _shared_m2(one: Outline, other: Outline) -> float:
    """Return the area that two outlines share, drawn at a hundredth of its extent."""
    low, high = np.maximum(one.min(0), other.min(0)), np.minimum(one.max(0), other.max(0))
    if not (high > low).all():
        return 0.0
    step_m = float((high - low).max()) / _DRAWN_CELLS
    size = np.ceil((high - low) / step_m).astype(int)
    drawn = []
    for outline in (one, other):
        canvas = np.zeros((size[1] + 1, size[0] + 1), np.uint8)
        corners = np.round((outline - low) / step_m * 16).astype(np.int32)
        drawn.append(cv2.fillPoly(canvas, [corners], 1, cv2.LINE_8, 4) != 0)
    return float((drawn[0] & drawn[1]).sum()) * step_m**2


def _mark_reached(costmap: Costmap, row: int, column: int) -> Mask | None:
    label = int(costmap.labels[row, column])
    return None if label == 0 else np.asarray(costmap.labels == label)


def _without_margin(costmap: Costmap) -> Costmap:
    """Return the costmap of a robot that needs no room beside its disc."""
    return Costmap(
        costmap.grid,
        costmap.radius_m - margins.OBSTACLE_MARGIN_M,
        costmap.occupied,
        costmap.clearance_m,
        costmap.fence_gap_m + margins.FENCE_MARGIN_M,
    )


def _reached_in(site: Site, costmap: Costmap) -> Mask | None:
    home = site.home.pose
    column, row = site.grid.cell_of(home.x_m, home.y_m)
    return _mark_reached(costmap, row, column)


def _of_floor(site: Site, costmap: Costmap) -> Iterator[SiteFinding]:
    free = cell_array(site.grid) == FREE
    _, parts = cv2.connectedComponents(free.astype(np.uint8), connectivity=4)
    column, row = site.grid.cell_of(site.home.pose.x_m, site.home.pose.y_m)
    apart = float((free & (parts != parts[row, column])).sum()) / max(1, int(free.sum()))
    if apart >= ISLAND_SHARE:
        yield _finding("floor_apart", share=f"{100 * apart:.0f}")
    if not site.rooms:
        yield _finding("no_rooms")
    stands = costmap.clearance_m >= costmap.radius_m
    if not stands.any():
        yield _finding("no_room_to_stand", "error", radius=f"{costmap.radius_m:g}")
