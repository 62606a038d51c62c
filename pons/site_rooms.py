"""List the rooms that are proposed on a site, with the names of its files and those people taught.

Reads files alone: what was taught lies in the home's own store, whether a planner runs or not.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from maps.room_proposals import read_proposals
from planner.state_database import FILE

if TYPE_CHECKING:
    from pathlib import Path

    from maps.new_site import NewSite
    from planner.site.known_places import KnownPlaces


def proposal_line(made: NewSite) -> str:
    """Say where the home of a new site is, and how many rooms are proposed on it."""
    rooms = "1 room" if len(made.rooms) == 1 else f"{len(made.rooms)} rooms"
    return f"home at ({made.home.x_m:.2f}, {made.home.y_m:.2f}); {rooms} proposed"


def print_rooms(folder: Path, home: Path, *, as_json: bool = False) -> None:
    """Print a line for each proposed room: its area, its middle, and its name where it has one.

    Args:
        folder: the site's.
        home: where the state lies, and in it what people taught.
        as_json: whether to print one object in their place.

    Raises:
        SiteError: the site or the store of taught places can't be read.
    """
    places, proposals = _places(folder, home), read_proposals(folder)
    if as_json:
        rooms = [
            {
                "id": room.id,
                "area_m2": room.area_m2,
                "x_m": room.pose.x_m,
                "y_m": room.pose.y_m,
                "name": named.name.model_dump()
                if (named := places.room_at(room.pose.x_m, room.pose.y_m))
                else None,
            }
            for room in proposals
        ]
        print(json.dumps({"rooms": rooms}, ensure_ascii=False, indent=1))
        return
    for room in proposals:
        named = places.room_at(room.pose.x_m, room.pose.y_m)
        name = f"named {named.name.en}" if named else "no name yet"
        at = f"({room.pose.x_m:.2f}, {room.pose.y_m:.2f})"
        print(f"{room.id:<9} {room.area_m2:7.1f} m2  middle {at:<16} {name}")
    if not proposals:
        print("no rooms are proposed")


def has_named_room(folder: Path, home: Path) -> bool:
    """Return whether any room of the site has a name, by its files or by a person's teaching."""
    return any(place.kind == "room" for place in _places(folder, home).places)


def _places(folder: Path, home: Path) -> KnownPlaces:
    from planner.site import Site, TaughtPlaces
    from planner.site.known_places import KnownPlaces

    store = TaughtPlaces.in_home(home) if (home / FILE).is_file() else None  # reading makes none
    return KnownPlaces(Site.load(folder), store)
