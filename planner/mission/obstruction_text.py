"""Say in both languages what stands in the way: where, how wide, and since when. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import message, say
from planner.language.formatting import definite
from planner.plan import Bilingual, Code
from planner.site.polygon import area_m2, border_distance_m, contains

if TYPE_CHECKING:
    from planner.mission.activity import RouteDoubt
    from planner.mission.recovery import ShutWay
    from planner.site.site_view import SiteView, Target

DOOR_M = 0.45
"""From the line between two rooms; outlines reach to the middle of walls, and what stands in a
door sticks out of it."""


def tell_obstruction(facts: SiteView, shut: ShutWay, place: Bilingual) -> Bilingual:
    """Return the sentence of a way to a place that was given up before this obstruction."""
    if shut.gap:
        return say(
            "obstruction.narrow",
            place=definite(place),
            width_m=shut.obstruction.width_m,
            where=spot_of(facts, shut.obstruction.middle),
        )
    minutes = int((shut.since_unix_s + shut.local_offset_s) // 60)
    return say(
        "obstruction.blocked",
        place=definite(place),
        width_m=max(0.1, round(shut.obstruction.width_m, 1)),
        where=spot_of(facts, shut.obstruction.middle),
        time=f"{minutes // 60 % 24:02d}:{minutes % 60:02d}",
    )


def tell_occupied(place: Bilingual, near_m: float) -> Bilingual:
    """Return the sentence of a goal on which something stands, with how near the robot came."""
    return message(Code.GOAL_OCCUPIED, place=definite(place), metres=f"{near_m:.1f}")


def tell_doubt(facts: SiteView, doubt: RouteDoubt) -> Bilingual:
    """Return the sentence of a way that is doubted: why it bends, or goes on all the same."""
    return say(f"route_doubt.{doubt.code}", where=spot_of(facts, doubt.at_m))


def spot_of(facts: SiteView, point: tuple[float, float]) -> Bilingual:
    """Name a point of ``map``: the door between two rooms, else the room."""
    rooms = [t for t in facts.targets.values() if t.room and t.polygon is not None]
    inside = [room for room in rooms if contains(room.polygon or (), *point)]
    here = min(inside, key=lambda room: area_m2(room.polygon or ()), default=None)
    if here is None:
        return say("obstruction.at_point")
    beside = [room for room in rooms if room is not here and _borders(room, point)]
    if not beside:
        return say("obstruction.in_room", room=here.name)
    other = min(beside, key=lambda room: border_distance_m(room.polygon or (), *point))
    return say("obstruction.at_door", room=here.name, other=other.name)


def _borders(room: Target, point: tuple[float, float]) -> bool:
    return border_distance_m(room.polygon or (), *point) <= DOOR_M
