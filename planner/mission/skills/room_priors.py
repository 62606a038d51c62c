"""Rank rooms by how likely a kind of thing is there, by people's names for them. Pure, a table.

It orders the rooms of a search and leaves none out: a home whose rooms are called otherwise, or a
thing that may be anywhere, is searched by distance alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.room_names import sorts_of_room

if TYPE_CHECKING:
    from planner.mission.skills.perception import WantedObject
    from planner.site.site_view import Target

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
"""Kinds of things that are likely in each sort of room."""


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
