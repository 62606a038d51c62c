"""Take the reducer's part of a site, and the names that a brain may use."""

from __future__ import annotations

from planner.language.catalogue import place_name
from planner.mission.state import SiteView, Target
from planner.plan import Entry, Vocabulary
from planner.site import Place, Site


def facts_of(site: Site, taught: tuple[Place, ...] = ()) -> SiteView:
    """Return the rooms and places of a site, and the taught ones, as targets; and its home."""
    places = (*site.places, *taught)
    return SiteView({place.id: _target(place) for place in places}, site.home.id, site.map_id)


def _target(place: Place) -> Target:
    return Target(
        id=place.id,
        room=place.kind == "room",
        name=place_name(place.name.en, place.name.zh),
        pose=place.pose,
        polygon=place.polygon,
        aliases=(*place.aliases.en, *place.aliases.zh),
    )


def vocabulary_of(site: Site, taught: tuple[Place, ...] = ()) -> Vocabulary:
    """Return the names that a plan for this site may use, the taught ones last."""
    return Vocabulary(entries=tuple(_entry(site, place) for place in (*site.places, *taught)))


def _entry(site: Site, place: Place) -> Entry:
    room = site.room_at(place.pose.x_m, place.pose.y_m) if place.kind == "place" else None
    return Entry(
        id=place.id,
        kind=place.kind,
        name=place_name(place.name.en, place.name.zh),
        aliases=(*place.aliases.en, *place.aliases.zh),
        room=room.id if room is not None else None,
    )
