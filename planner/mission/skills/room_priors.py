"""Say in which rooms a kind of thing is likely, by what people call the rooms. Pure, a table.

It orders the rooms of a search and leaves none out: a home whose rooms are called otherwise, or a
thing that may be anywhere, is searched by distance alone. A name counts by what it ends in: a
"kitchen balcony" is no kitchen, 主卧卫生间 no bedroom.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from planner.language.folding import fold

if TYPE_CHECKING:
    from planner.mission.skills.perception import Wanted
    from planner.mission.state import Target

_MEALS = (
    "cup bottle fridge wine_glass fork knife spoon bowl cake pizza sandwich hot_dog donut banana "
    "apple orange carrot broccoli "
)


class Sort(NamedTuple):
    """Describe one sort of room."""

    en: str
    """What its English names end in."""
    zh: str
    """What its Chinese names end in."""
    things: str
    """Kinds of things that are likely there."""


SORTS = (
    Sort("kitchen, kitchenette, cooking area, galley, pantry, break room",
         "厨房, 灶间, 伙房, 茶水间", _MEALS + "microwave oven toaster sink"),
    Sort("dining room, dining area, dining, diner, canteen",
         "餐厅, 饭厅, 食堂", _MEALS),
    Sort("bedroom, bed room, sleeping room, guest room, nursery",
         "卧室, 卧房, 主卧, 次卧, 睡房, 寝室, 客房, 儿童房", "bed"),
    Sort("living room, living area, living, lounge, sitting room, family room, parlour",
         "客厅, 起居室, 会客厅, 会客室", "sofa tv remote book chair"),
    Sort("study, study room, office, library, den",
         "书房, 办公室, 工作间, 图书室", "book chair laptop keyboard mouse"),
    Sort("bathroom, bath, restroom, washroom, toilet, shower room",
         "卫生间, 洗手间, 浴室, 厕所, 盥洗室", "toilet sink toothbrush hair_drier"),
)  # fmt: skip
_PARTS = re.compile(r"[/&+,，、和与]| and ")
_NUMBER = re.compile(r" ?(?:\d+|\b[a-z]|[一二三四五六])号?$")


def likely_rooms(wanted: Wanted | None, rooms: tuple[Target, ...]) -> tuple[Target, ...]:
    """Return those of the rooms in which such a thing is likely; where its neighbour is, it is."""
    if wanted is None:
        return ()
    labels = [wanted.label] if wanted.by is None else [wanted.by.label, wanted.label]
    sorts = next((found for label in labels if (found := _with(label))), ())
    return tuple(room for room in rooms if any(_is(room, sort) for sort in sorts))


def _with(label: str) -> tuple[Sort, ...]:
    return tuple(sort for sort in SORTS if label in sort.things.split())


def _is(room: Target, sort: Sort) -> bool:
    names = (room.id, room.name.en, room.name.zh, *room.aliases)
    ends = (*(f" {en}" for en in sort.en.split(", ")), *sort.zh.split(", "))
    return any(part.endswith(ends) for name in names for part in _parts(name))


def _parts(name: str) -> list[str]:
    """Return the rooms that one name is made of, each after a space, without their numbers."""
    plain = " ".join(re.split(r"[\s_-]+", fold(name)))
    return [" " + _NUMBER.sub("", part.strip()) for part in _PARTS.split(plain)]
