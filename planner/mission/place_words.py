"""Write the names of a site's places into orders, and find them there. Pure."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, place_alone, plain
from planner.mission.outcomes import spot_at
from planner.plan import Entry, Vocabulary

if TYPE_CHECKING:
    from planner.site.site_view import SiteView

_WITHIN = re.compile(r"^(?P<room>[^,]+?),? (?:on|in|at|by|near|beside|next to) (?P<inner>[^,]+)$")


def names_of(facts: SiteView) -> Vocabulary:
    """Return the names of a site's places, for finding them in words."""
    return Vocabulary(
        entries=tuple(
            Entry(
                id=target.id,
                kind="room" if target.room else "place",
                name=target.name,
                aliases=target.aliases,
            )
            for target in facts.targets.values()
        )
    )


def name_place(facts: SiteView, place: str, chinese: bool, said: str) -> str:
    """Return a place's name as it was said, else the site's in that language."""
    found = [e for e in find_places(said, names_of(facts)) if e.id == place]
    spelt = plain(said)[found[0].start : found[0].end] if found else ""
    if spelt and has_chinese(spelt) is chinese:
        return spelt
    return facts.targets[place].name.of("zh" if chinese else "en")


def write_drive(facts: SiteView, place: str, said: str) -> str:
    """Return the order to drive to a place, in the language of what was said."""
    chinese = has_chinese(said)
    name = name_place(facts, place, chinese, said)
    return f"去{name}" if chinese else f"go to the {name}"


def find_place(facts: SiteView, words: str) -> str | None:
    """Return the place that words name and nothing besides: of "the study, by the desk" the desk.

    None where they name none, or one that is not in the other.
    """
    names = names_of(facts)
    alone = place_alone(words, names)
    within = _WITHIN.match(plain(words)) if alone is None else None
    if within is None:
        return alone
    room, inner = place_alone(within["room"], names), place_alone(within["inner"], names)
    if room is None or inner is None:
        return None
    if room_of(facts, inner) == room:
        return inner
    return room if room_of(facts, room) == inner else None


def room_of(facts: SiteView, place: str) -> str | None:
    """Return the room in which a place stands; None of a room, and of what stands in none."""
    target = facts.targets[place]
    return None if target.room else spot_at(facts, target.pose).room


def put_place(facts: SiteView, order: str, place: str, said: str) -> str | None:
    """Return an order with another place in it; None where it names none, or several.

    "Go to the bedroom and see if the cat is on the bed" names one: the bed, and the room it is in.
    """
    found = find_places(order, names_of(facts))
    named = {each.id for each in found}
    inner = {each for each in named if not named - {each, room_of(facts, each)}}
    if not inner or place in named:
        return None
    replaced = inner.pop()
    around = room_of(facts, place)
    if len(named) == 2 and around is None:
        return None  # of a bed, another room makes no order
    words, chinese = plain(order), has_chinese(order)
    for each in reversed(found):
        put = place if each.id == replaced else around or place
        name = name_place(facts, put, chinese, said)
        words = words[: each.start] + name + words[each.end :]
    return words
