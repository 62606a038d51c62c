"""Write a site's places as the names that sentences are searched for. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.mission.outcomes import spot_at
from planner.plan import Entry, Vocabulary

if TYPE_CHECKING:
    from planner.site.site_view import SiteView


def names_of(facts: SiteView) -> Vocabulary:
    """Return the names of a site's places, each with the room in which it stands."""
    return Vocabulary(
        entries=tuple(
            Entry(
                id=target.id,
                kind="room" if target.room else "place",
                name=target.name,
                aliases=target.aliases,
                room=None if target.room else spot_at(facts, target.pose).room,
            )
            for target in facts.targets.values()
        )
    )
