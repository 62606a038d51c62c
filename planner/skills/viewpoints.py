"""Choose the spots from which rooms are looked through, and the order of the rooms. Pure.

A room is looked round from its own pose first; what lies farther from there than a picture shows
well is looked at from more spots, each chosen to cover most of what is left. No map is known here:
a spot in furniture is moved or given up by the route search. Rooms: the one that is named, else
the one that the robot is in, then where such a thing was seen last, then where it is likely by the
names of the rooms, then the rest; of both always on to the nearest by the straight distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import hypot, sqrt
from typing import TYPE_CHECKING

from planner.language.room_names import sorts_of_room
from planner.site.polygon import border_distance_m, contains

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.perception.snapshot import Thing
    from planner.site.site_view import SiteView, Target
    from planner.skills.perception import WantedObject
    from wire import Pose2


Point = tuple[float, float]

REACH_M = 2.8
"""A cup is eight pixels high there, of 240."""
NEAR_M = 1.1
"""What lies on the floor nearer than this is below the picture."""
ASIDE_M = 0.8
"""A step aside shows it."""
STEP_M, MOST_POINTS = 0.4, 100
"""Points at which a room is judged; a hall has no more of them than a room."""
INSET_M = 0.5
"""A robot's middle keeps so far from a room's outline."""
LEAST_LEFT = 0.12
"""Of a room: when no more than this is out of reach, no further spot is worth the way."""
MAX_SPOTS = 4
HERE, NEAR = "here", "/near"


@dataclass(frozen=True, slots=True)
class Viewpoint:
    """Name a point from which to look round."""

    key: str
    room: str | None
    at: Point


def room_of(facts: SiteView, place: str | None) -> str | None:
    """Return the room that a place is, or stands in."""
    target = facts.targets.get(place or "")
    if target is None or target.room:
        return target.id if target is not None else None
    return facts.room_at(target.pose.x_m, target.pose.y_m)


def in_order(
    facts: SiteView, pose: Pose2, known: tuple[Thing, ...], wanted: WantedObject | None = None
) -> tuple[str, ...]:
    """Return all rooms in the order in which to look through them.

    Args:
        facts: the rooms.
        pose: where the robot stands.
        known: things that say by where they were seen in which rooms to begin.
        wanted: what is sought, where the first of it ends the search; None: all is to be seen.
    """
    at = (pose.x_m, pose.y_m)
    here = facts.room_at(*at)
    left = [t for t in facts.targets.values() if t.room and t.id != here]
    last_seen = {t.room: t.seen_s for t in sorted(known, key=lambda t: t.seen_s)}
    remembered = [t for t in left if t.id in last_seen]
    order = sorted(remembered, key=lambda t: -last_seen[t.id])
    rest = tuple(t for t in left if t.id not in last_seen)
    likely = likely_rooms(wanted, rest)
    for group in (likely, [t for t in rest if t not in likely]):
        order += _onwards(order[-1].pose if order else pose, group)
    return (*([here] if here is not None else []), *(t.id for t in order))


def _onwards(pose: Pose2, rooms: Iterable[Target]) -> list[Target]:
    """Return rooms in order, from a pose always on to the nearest."""
    left = list(rooms)
    order: list[Target] = []
    while left:
        at = (pose.x_m, pose.y_m)
        nearest = min(left, key=lambda t: (_gap_m(at, t), t.id))
        left.remove(nearest)
        order.append(nearest)
        pose = nearest.pose
    return order


def _gap_m(at: Point, target: Target) -> float:
    return hypot(target.pose.x_m - at[0], target.pose.y_m - at[1])


def spots_in(target: Target, first: Point | None = None) -> tuple[Viewpoint, ...]:
    """Return the spots from which a room is seen whole, ``first`` taken as one of them."""
    began = first or (target.pose.x_m, target.pose.y_m)
    points = _cover(target.polygon, began, (target.pose.x_m, target.pose.y_m))
    return tuple(Viewpoint(f"{target.id}/{n}", target.id, at) for n, at in enumerate(points))


def near_spot(target: Target, first: Point | None = None) -> tuple[Viewpoint, ...]:
    """Return the spot that shows the floor at the feet of one at the other spots, or None."""
    pose = (target.pose.x_m, target.pose.y_m)
    began = first or pose
    at = _before_the_feet(target.polygon, _cover(target.polygon, began, pose), pose)
    return () if at is None else (Viewpoint(f"{target.id}{NEAR}", target.id, at),)


@lru_cache(maxsize=256)
def _before_the_feet(
    outline: tuple[Point, ...] | None, stood: tuple[Point, ...], pose: Point
) -> Point | None:
    """Choose the point from which most of the floor is seen that no other spot shows."""
    left = [p for p in _grid(outline or (), 0.2) if not any(_is_shown(p, s) for s in stood)]
    stands = [
        s for s in (pose, *_grid(outline or (), INSET_M))
        if all(hypot(s[0] - o[0], s[1] - o[1]) >= ASIDE_M for o in stood)
    ]  # fmt: skip
    return max(stands, key=lambda s: sum(_is_shown(p, s) for p in left), default=None)


def _is_shown(p: Point, stand: Point) -> bool:
    return NEAR_M <= hypot(p[0] - stand[0], p[1] - stand[1]) <= REACH_M


@lru_cache(maxsize=256)
def _cover(outline: tuple[Point, ...] | None, began: Point, pose: Point) -> tuple[Point, ...]:
    """Choose points greedily until little of the outline is out of reach."""
    if outline is None:
        return (began,)
    inside = _grid(outline, 0.2)
    stands = [pose, *_grid(outline, INSET_M)]
    chosen = [began]
    left = [p for p in inside if _far(p, began)]
    while len(left) > LEAST_LEFT * len(inside) and len(chosen) < MAX_SPOTS:
        best = max(stands, key=lambda s: sum(not _far(p, s) for p in left))
        still = [p for p in left if _far(p, best)]
        if len(still) == len(left):
            break
        chosen.append(best)
        left = still
    return tuple(chosen)


def _far(a: Point, b: Point) -> bool:
    return hypot(a[0] - b[0], a[1] - b[1]) > REACH_M


@lru_cache(maxsize=256)
def _grid(outline: tuple[Point, ...], inset_m: float) -> tuple[Point, ...]:
    """Return the points of a room, so far from its outline: the same from wherever one looks."""
    if not outline:
        return ()
    xs, ys = [x for x, _ in outline], [y for _, y in outline]
    step_m = max(STEP_M, sqrt((max(xs) - min(xs)) * (max(ys) - min(ys)) / MOST_POINTS))
    columns, rows = int((max(xs) - min(xs)) / step_m) + 1, int((max(ys) - min(ys)) / step_m) + 1
    points = [
        (min(xs) + c * step_m, min(ys) + r * step_m) for c in range(columns) for r in range(rows)
    ]
    return tuple(
        p for p in points if contains(outline, *p) and border_distance_m(outline, *p) >= inset_m
    )


_MEALS = (
    "cup bottle fridge wine_glass fork knife spoon bowl cake pizza sandwich hot_dog donut banana "
    "apple orange carrot broccoli "
)


THINGS = {
    "kitchen": _MEALS + "microwave oven toaster sink",
    "dining_room": _MEALS,
    "bedroom": "bed",
    "living_room": "sofa tv remote book chair",
    "study": "book chair laptop keyboard mouse",
    "bathroom": "toilet sink toothbrush hair_drier",
}
"""Kinds of things that are likely in each sort of room, by people's names for it. It orders the
rooms of a search and leaves none out."""


def likely_rooms(wanted: WantedObject | None, rooms: tuple[Target, ...]) -> tuple[Target, ...]:
    """Return those of the rooms in which such a thing is likely; where its neighbour is, it is."""
    if wanted is None:
        return ()
    labels = [wanted.label] if wanted.by is None else [wanted.by.label, wanted.label]
    sorts = next((found for label in labels if (found := _with(label))), ())
    return tuple(room for room in rooms if sorts_of_room(_names(room)).intersection(sorts))


def _with(label: str) -> tuple[str, ...]:
    return tuple(sort for sort, things in THINGS.items() if label in things.split())


def _names(room: Target) -> tuple[str, ...]:
    return (room.id, room.name.en, room.name.zh, *room.aliases)
