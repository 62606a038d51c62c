"""Write the names of a site's places into orders, and find them there. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.plan import Entry, Vocabulary

if TYPE_CHECKING:
    from planner.site.site_view import SiteView


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
