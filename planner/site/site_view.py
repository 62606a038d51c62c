"""Show a site as missions and brains need it: its places as targets, and the names for them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from maps.growing_map import GROWING_MAP
from planner.language.catalogue import place_name
from planner.plan import Bilingual, Entry, Skill, Vocabulary
from planner.site.places import Place
from planner.site.polygon import area_m2, contains
from planner.site.site import Site
from planner.site.standing_spots import StandingFloor
from wire.geometry import Pose2

RADIUS_M = 0.3
"""Of the disc that holds a robot, where its description is not at hand."""


@dataclass(frozen=True, slots=True)
class Target:
    """Describe a room or place that can be driven to."""

    id: str
    room: bool
    name: Bilingual
    pose: Pose2
    polygon: tuple[tuple[float, float], ...] | None = None
    aliases: tuple[str, ...] = ()
    """What else people call it, in both languages."""


@dataclass(frozen=True)
class SiteView:
    """Hold what missions know of a site. They read no map: routes are the navigation's."""

    targets: dict[str, Target]
    home: str
    map_id: str = ""
    grows: bool = False
    """The map is being made by driving: there may be floor that nobody saw yet."""
    floor: StandingFloor | None = field(default=None, repr=False, compare=False)
    """Says where a robot may stand at a side of something; None: nobody knows."""
    sentences: str = ""
    """Templates of sentences by the site's owner."""
    skills: tuple[Skill, ...] = ()
    skill_templates: str = ""
    """The sentences that call them."""

    @property
    def radius_m(self) -> float:
        """Return the radius of the disc that holds the robot."""
        return self.floor.radius_m if self.floor is not None else RADIUS_M

    @cached_property
    def names(self) -> Vocabulary:
        """Return the names that people and plans use: one value a site, for all readers."""
        entries = tuple(map(self._entry, self.targets.values()))
        return Vocabulary(
            entries=entries, sentences=self.sentences,
            skills=self.skills, skill_templates=self.skill_templates,
        )  # fmt: skip

    def _entry(self, target: Target) -> Entry:
        at = target.pose
        return Entry(
            id=target.id,
            kind="room" if target.room else "place",
            name=target.name,
            aliases=target.aliases,
            room=None if target.room else self.room_at(at.x_m, at.y_m),
            is_home=target.id == self.home,
        )

    def room_at(self, x_m: float, y_m: float) -> str | None:
        """Return the room in which a point lies, the smallest of several."""
        rooms = [
            (area_m2(t.polygon), t.id)
            for t in self.targets.values()
            if t.room and t.polygon is not None and contains(t.polygon, x_m, y_m)
        ]
        return min(rooms)[1] if rooms else None


def facts_of(site: Site, taught: tuple[Place, ...] = (), radius_m: float = RADIUS_M) -> SiteView:
    """Return the rooms and places of a site, and the taught ones, as targets; and its home."""
    places = (*site.places, *taught)
    targets = {place.id: _target(place) for place in places}
    grows = (site.folder / GROWING_MAP).is_file()
    floor = StandingFloor(site, radius_m)
    return SiteView(targets, site.home.id, site.map_id, grows, floor, site.sentences)


def _target(place: Place) -> Target:
    return Target(
        id=place.id,
        room=place.kind == "room",
        name=place_name(place.name.en, place.name.zh),
        pose=place.pose,
        polygon=place.polygon,
        aliases=(*place.aliases.en, *place.aliases.zh),
    )


def calling(names: Vocabulary, other: Vocabulary) -> Vocabulary:
    """Return names with the skills of others."""
    called = {"skills": other.skills, "skill_templates": other.skill_templates}
    return names.model_copy(update=called)


def vocabulary_of(site: Site, taught: tuple[Place, ...] = ()) -> Vocabulary:
    """Return the names that a plan for this site may use, the taught ones last."""
    return facts_of(site, taught).names
