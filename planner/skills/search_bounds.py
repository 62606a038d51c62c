"""Bound a search by the size of its site and by what its goal may still drive. Pure.

Law: a larger site never has the smaller bound, none is below that of a small home, and none is
above a grant. What the plan still has to drive afterwards is kept for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import hypot, sqrt
from typing import TYPE_CHECKING, Any

from planner.site.polygon import area_m2
from planner.skills.viewpoints import spots_in

if TYPE_CHECKING:
    from planner.site.site_view import SiteView
    from planner.skills.actions import Scene

Point = tuple[float, float]

GRANT_M, GRANT_S = 60.0, 600.0
"""What the bridge lets one mission drive."""
LEAST_M, LEAST_S = 55.0, 540.0
MOST_M, MOST_S = GRANT_M - 1.0, GRANT_S
"""By then the last way must be over: where a grant ends under way, nobody tells what was seen."""
TOUR = 0.7124
"""Beardwood, Halton and Hammersley (1959): the shortest tour of n points in an area A is about
0.7124 sqrt(n A) long."""
ROUND_ABOUT = 1.5
"""So much longer than straight a way through a home may be."""
FROM_ROOM_TO_ROOM = 2.0
"""Likewise from the middle of one room to that of another, through two doors and a hallway:
measured 1.9 to 2.4 in the home that comes with Pons."""
SPOT_S, WAY_MPS = 26.0, 0.3
"""One look round, with six gazes; and the mean speed on the way between two of them."""
ROOM_M2 = 12.0
"""Of a room whose outline nobody has drawn."""
MOST_KEPT_M = 25.0
"""Kept for the way after a search, at most: else a long plan would leave nothing to search with."""
LEAST_PICTURES, MOST_PICTURES = 24, 96


@dataclass(frozen=True, slots=True)
class SearchBounds:
    """Hold what one search may spend."""

    begin_m: float
    """No way is begun after so much was driven."""
    end_m: float
    """The last way is over by then."""
    seconds: float


def bound_search(facts: SiteView, left_m: float = GRANT_M) -> SearchBounds:
    """Return the bounds of a search through a site.

    The way is that of a tour of all spots to look round from, times ``FROM_ROOM_TO_ROOM``; the time
    is that way and a look at each spot.

    Args:
        facts: the rooms.
        left_m: what the goal's grant still held when the search began [m].
    """
    rooms = [t for t in facts.targets.values() if t.room]
    spots = sum(len(spots_in(room)) for room in rooms)
    area = sum(ROOM_M2 if t.polygon is None else area_m2(t.polygon) for t in rooms)
    way_m = FROM_ROOM_TO_ROOM * TOUR * sqrt(spots * area)
    end_m = max(0.0, min(MOST_M, left_m - (GRANT_M - MOST_M)))
    begin_m = min(max(LEAST_M, way_m), MOST_M)
    seconds = min(max(LEAST_S, way_m / WAY_MPS + SPOT_S * spots), MOST_S)
    return SearchBounds(min(begin_m, end_m), end_m, seconds)


def bound_pictures(scene: Scene[Any]) -> int:
    """Return how many pictures one search may show: all directions of each room, and of here.

    What the owner set, and what the goal's calls allow, is exceeded by nothing but a person's yes
    to a longer search; then the goal's own purse still ends it.
    """
    limits, times = scene.eyes.pictures, 1 + getattr(scene.state, "longer", 0)
    if not limits.by_site:
        return limits.most * times
    rooms = sum(t.room for t in scene.facts.targets.values())
    return min(limits.most, max(LEAST_PICTURES, scene.eyes.views * (rooms + 1))) * times


def way_after_m(at: Point, ways: tuple[tuple[Point, ...], ...]) -> float:
    """Return what a goal has yet to drive once its search ends at a point, the longest way of all.

    Args:
        at: x, y [m] in ``map``.
        ways: where the steps after the search drive, for each branch that may come.
    """
    lengths = (ROUND_ABOUT * way_m((at, *way)) for way in ways)
    return min(MOST_KEPT_M, max(lengths, default=0.0))


def way_m(points: tuple[Point, ...]) -> float:
    """Return the straight length of a way through points [m]."""
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points))
