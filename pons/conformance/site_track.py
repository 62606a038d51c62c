"""Find a straight line to drive to and fro on a site. Knows the map and the fence; no motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.navigation.costmap import static_costmap
from planner.site import Site
from pons.conformance.adapter import CannotTest
from pons.conformance.track import TestTrack

if TYPE_CHECKING:
    from pathlib import Path

    from planner.navigation.costmap import Costmap

LONGEST_M = 3.4
SHORTEST_M = 1.6
ROOM_M = 0.15
"""Kept free beside and behind it, over what a route needs: a broken brain steers a little off."""
STRIDE = 2


def find_track(folder: Path, radius_m: float) -> TestTrack:
    """Return the longest free line along x or y of a site, cut to the length needed.

    Raises:
        CannotTest: no line is long enough.
    """
    costmap = static_costmap(Site.load(folder), radius_m + ROOM_M)
    best = max(_lines(costmap), key=lambda line: line.length_m, default=None)
    if best is None or not best.length_m >= SHORTEST_M:
        found = 0.0 if best is None else best.length_m
        raise CannotTest(
            f"no_track: {folder} has no free straight line of {SHORTEST_M} m along x or y with "
            f"{radius_m + ROOM_M:.2f} m beside it; the longest has {found:.2f} m"
        )
    spare_m = max(0.0, best.length_m - LONGEST_M) / 2
    return TestTrack(best.at(spare_m), best.at(best.length_m - spare_m))


def _lines(costmap: Costmap) -> list[TestTrack]:
    """Return the longest run of free cells of each second row and column."""
    grid, free = costmap.grid, costmap.free
    lines = []
    for along_x in (True, False):
        rows = free if along_x else free.T
        for index in range(0, len(rows), STRIDE):
            first, last = _run([bool(cell) for cell in rows[index]])
            if last > first:
                ends = [(cell, index) if along_x else (index, cell) for cell in (first, last)]
                lines.append(TestTrack(grid.centre_of(*ends[0]), grid.centre_of(*ends[1])))
    return lines


def _run(cells: list[bool]) -> tuple[int, int]:
    """Return first and last index of the longest run of true cells; (0, 0) without one."""
    best, start = (0, 0), None
    for index, cell in enumerate([*cells, False]):
        if cell and start is None:
            start = index
        elif not cell and start is not None:
            if index - 1 - start > best[1] - best[0]:
                best = (start, index - 1)
            start = None
    return best
