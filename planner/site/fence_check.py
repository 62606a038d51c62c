"""Refuse a proposed fence that could not be lived with, before an operator is asked to read it.

The bridge checks again, and by itself, whatever it can know. Knows the site; asks nobody.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.site.fence import Fence
from planner.site.polygon import border_distance_m
from wire.fence import MAX_CORNERS, MAX_TEXT, fence_text, flaw

if TYPE_CHECKING:
    from collections.abc import Iterator

    from planner.site.places import Place
    from planner.site.site import Site
    from wire import FenceFile, Pose2

PLACE_M = 0.25
"""A stop pose keeps 0.15 m from the fence and a place counts as reached within 0.10 m."""


class FenceRefusal(Exception):
    """Refuse a fence proposal; ``code`` is stable, the text gives the value and the expectation."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


def check_fence(fence: FenceFile, site: Site, robot_in_map: Pose2 | None) -> None:
    """Accept a fence for a site and for where the robot stands now, as far as that is known.

    Raises:
        FenceRefusal: the first thing that speaks against it.
    """
    refusal = next(_against(fence, site, robot_in_map), None)
    if refusal is not None:
        raise FenceRefusal(*refusal)


def _against(fence: FenceFile, site: Site, robot_in_map: Pose2 | None) -> Iterator[tuple[str, str]]:
    corners = sum(len(outline) for outline in fence.outlines)
    if not corners <= MAX_CORNERS:
        yield "fence_too_large", f"{corners} corners in all, at most {MAX_CORNERS}"
        return  # what follows takes time that grows with them
    length = len(fence_text(fence))
    if not length <= MAX_TEXT:
        yield "fence_too_large", f"{length} characters as text, at most {MAX_TEXT}"
    wrong = flaw(fence)
    if wrong is not None:
        yield wrong
    if fence.map_id != site.map_id:
        yield "fence_of_another_map", f"it is for map {fence.map_id}, this site's is {site.map_id}"
    proposed = Fence(fence, "")
    for place in site.places:
        yield from _place(proposed, place)
    if robot_in_map is not None and not proposed.allows(robot_in_map.x_m, robot_in_map.y_m):
        at = f"({robot_in_map.x_m:.2f}, {robot_in_map.y_m:.2f})"
        yield "fence_excludes_robot", f"the robot stands at {at}, which it does not allow"


def _place(fence: Fence, place: Place) -> Iterator[tuple[str, str]]:
    x_m, y_m = place.pose.x_m, place.pose.y_m
    at = f"the place {place.id!r} at ({x_m:.2f}, {y_m:.2f})"
    if not fence.allows(x_m, y_m):
        yield "fence_excludes_place", f"{at} would be outside; move the place first, or the fence"
        return
    near_m = min(border_distance_m(outline, x_m, y_m) for outline in fence.outlines)
    if not near_m >= PLACE_M:
        text = f"{at} would be {near_m:.2f} m from the fence, at least {PLACE_M} m are needed"
        yield "fence_near_place", text
