"""Read the rooms and places of a site and people's names for them. Knows no map and no fence."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from maps.errors import BilingualError, SiteError
from maps.yaml_records import SiteRecord, parse_yaml, read_bytes
from planner.language.folding import fold_words, unmask
from planner.site.fence import Outline
from planner.site.polygon import area_m2, contains
from wire.fence import crosses_itself
from wire.geometry import Pose2

Name = Annotated[str, Field(min_length=1, max_length=80)]
PlaceId = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,63}$")]


class Names(SiteRecord):
    """Name a place in English and in Chinese."""

    en: Name
    zh: Name


class Aliases(SiteRecord):
    """Give the other names people use, by language."""

    en: tuple[Name, ...] = ()
    zh: tuple[Name, ...] = ()


class Place(SiteRecord):
    """Describe a room or a place: its names, its outline where it has one, where to stand."""

    id: PlaceId
    kind: Literal["room", "place"]
    name: Names
    aliases: Aliases = Aliases()
    polygon: Outline | None = None  # in ``map`` [m]
    pose: Pose2  # in ``map``; where the robot stands when it is there

    @model_validator(mode="after")
    def _room_has_an_outline(self) -> Place:
        if self.kind == "room" and self.polygon is None:
            text, zh = f"the room {self.id!r} needs a polygon", f"房间 {self.id!r} 缺少 polygon"
            raise BilingualError(text, zh)
        if self.polygon is not None and not area_m2(self.polygon) > 0.0:
            flaw, flaw_zh = _flaw(self.polygon)
            raise BilingualError(
                f"the outline of {self.id!r} {flaw}", f"{self.id!r} 的轮廓{flaw_zh}"
            )
        return self

    @property
    def spoken_names(self) -> tuple[str, ...]:
        """Return every name by which a person may mean this place; the id is one."""
        plain = self.id.replace("_", " ")
        names = (self.name.en, self.name.zh, *self.aliases.en, *self.aliases.zh)
        return (self.id, plain, *names)

    @property
    def said_in_english(self) -> tuple[str, ...]:
        """Return the English names, as a recogniser of speech may expect them."""
        return (self.name.en, *self.aliases.en)

    def contains(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point of ``map`` lies in the outline; never where there is none."""
        return self.polygon is not None and contains(self.polygon, x_m, y_m)


def _flaw(outline: Outline) -> tuple[str, str]:
    """Return why an outline encloses nothing: its parts cancel out where its sides cross."""
    crossing, corners = crosses_itself(outline), tuple(dict.fromkeys(outline))
    (ax, ay), (bx, by) = corners[0], corners[-1]
    is_line = all((bx - ax) * (y - ay) == (by - ay) * (x - ax) for x, y in corners)
    if crossing is None or is_line:
        return "has no area", "没有面积"
    first, second = crossing
    return (
        f"has sides that cross: those from {first} and from {second}",
        f"自相交：始于 {first} 和 {second} 的两条边",
    )


class PlacesRecord(SiteRecord):
    """Mirror places.yaml."""

    version: Annotated[int, Field(ge=1, le=1)] = 1
    home: PlaceId
    places: Annotated[tuple[Place, ...], Field(min_length=1, max_length=10_000)]


def normalise(name: str) -> str:
    """Return a name as it is compared: one width, one case, one script, single spaces."""
    return fold_words(name)


def squash(name: str) -> str:
    """Return a name without what people write differently, as the grammar reads it."""
    # Late: the route process knows a site, reads no sentence and loads no grammar.
    from planner.language.grammar import sentence_text

    return sentence_text.squash(name)


def load_places(path: Path) -> PlacesRecord:
    """Load places.yaml and check that no two places answer to one name.

    Raises:
        SiteError: ``place_duplicate_id``, ``place_alias_clash``, ``home_unknown`` and the codes of
            :mod:`maps.yaml_records`.
    """
    record = parse_yaml(read_bytes(path), PlacesRecord, path)
    _check_names(record, path)
    ids = sorted(place.id for place in record.places)
    if record.home not in ids:
        text = f"{path}: home {record.home!r} is no place; known places: {', '.join(ids)}"
        zh = f"{path}：起始地点 {record.home!r} 不在地点之中；已有地点：{', '.join(ids)}"
        raise SiteError("home_unknown", text, zh)
    return record


def _check_names(record: PlacesRecord, path: Path) -> None:
    ids: set[str] = set()
    owner: dict[str, str] = {}
    for place in record.places:
        if place.id in ids:
            text, zh = f"{path}: the id {place.id!r} is given twice", f"{path}：编号 {place.id!r}"
            raise SiteError("place_duplicate_id", text, f"{zh} 出现了两次")
        ids.add(place.id)
        for name in place.spoken_names:
            first = owner.setdefault(normalise(name), place.id)
            if first != place.id:
                text = f"{path}: {name!r} names both {first!r} and {place.id!r}"
                zh = f"{path}：{name!r} 同时是 {first!r} 和 {place.id!r} 的名称"
                raise SiteError("place_alias_clash", text, zh)


def owner_of(name: str, places: tuple[Place, ...]) -> Place | None:
    """Return the place that answers to a name, as a sentence is read, or None."""
    wanted = squash(name)
    return next((place for place in places if wanted in map(squash, place.spoken_names)), None)


def drawn_alike(name: str, places: tuple[Place, ...]) -> Place | None:
    """Return the place whose name a person could not tell from this one, or None."""
    seen = unmask(squash(name))
    return next(
        (p for p in places if seen in {unmask(squash(said)) for said in p.spoken_names}), None
    )
