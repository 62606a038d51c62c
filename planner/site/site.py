"""Load a whole site and check that its files agree. Knows files and geometry, no motion."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from maps.errors import SiteError
from maps.grid import GridMap
from maps.map_file import load_map
from maps.spots import check_on_floor
from planner.site.fence import Fence, load_fence
from planner.site.places import Place, load_places, normalise
from planner.site.polygon import area_m2
from wire.plain_file import read_plain_file

MOST_BYTES = 16_000
"""Of an owner's templates: some two hundred lines."""


@dataclass(frozen=True, slots=True)
class Site:
    """Hold one place on earth: its map, its rooms and places, its fence."""

    folder: Path
    grid: GridMap
    map_id: str
    fence: Fence
    places: tuple[Place, ...]
    home: Place
    sentences: str = ""
    """Templates of sentences by its owner, as ``sentences.toml`` holds them; none: empty."""

    @classmethod
    def load(cls, folder: Path) -> Site:
        """Load map.yaml with its image, places.yaml and fence.json from one folder.

        A ``sentences.toml`` beside them is loaded, too.

        Raises:
            SiteError: a file is missing or malformed, or two files contradict each other.
        """
        loaded = load_map(folder / "map.yaml")
        fence = load_fence(folder / "fence.json")
        if fence.record.map_id != loaded.map_id:
            text = f"{folder}: fence.json is for map {fence.record.map_id}, not {loaded.map_id}"
            zh = f"{folder}：fence.json 属于地图 {fence.record.map_id}，不属于 {loaded.map_id}"
            raise SiteError("fence_map_mismatch", text, zh)
        record = load_places(folder / "places.yaml")
        for place in record.places:
            _check_standing(place, loaded.grid, fence)
        home = next(place for place in record.places if place.id == record.home)
        sentences = load_sentences(folder / "sentences.toml")
        return cls(folder, loaded.grid, loaded.map_id, fence, record.places, home, sentences)

    @property
    def rooms(self) -> tuple[Place, ...]:
        """Return the rooms, in the order of the file."""
        return tuple(place for place in self.places if place.kind == "room")

    def place(self, place_id: str) -> Place | None:
        """Return the place of an id, or None."""
        return next((place for place in self.places if place.id == place_id), None)

    def find_place(self, name: str) -> Place | None:
        """Return the place that answers to a name in either language, or None. No guessing."""
        wanted = normalise(name)
        return next(
            (place for place in self.places if wanted in map(normalise, place.spoken_names)), None
        )

    def room_at(self, x_m: float, y_m: float) -> Place | None:
        """Return the room around a point of ``map``; the smallest where outlines overlap."""
        around = [room for room in self.rooms if room.contains(x_m, y_m)]
        return min(around, key=lambda room: area_m2(room.polygon or ()), default=None)


def _check_standing(place: Place, grid: GridMap, fence: Fence) -> None:
    check_on_floor(grid, f"the place {place.id!r}", f"地点 {place.id!r}", place.pose)
    if not fence.allows(place.pose.x_m, place.pose.y_m):
        at = f"({place.pose.x_m:.2f}, {place.pose.y_m:.2f})"
        text = f"the place {place.id!r} at {at} is outside the fence, or in a keep-out area of it"
        zh = f"地点 {place.id!r} {at} 在围栏之外，或在禁入区内"
        raise SiteError("place_outside_fence", text, zh)


def load_sentences(path: Path) -> str:
    """Return the text of an owner's templates; nothing where there is no such file.

    Raises:
        SiteError: it can't be read, or a template in it can't.
    """
    from planner.language.templates.expressions import TemplateError  # words know sites' names
    from planner.language.templates.owners import read_owners_templates

    try:
        text = read_plain_file(path, MOST_BYTES).decode("utf-8")
        read_owners_templates(text)
    except FileNotFoundError:
        return ""
    except TemplateError as wrong:
        raise SiteError("bad_template", f"{path}: {wrong}", f"{path}：{wrong.told_zh}") from None
    except (OSError, UnicodeDecodeError) as wrong:
        why = getattr(wrong, "strerror", None) or "it is not UTF-8"
        zh = f"{path}：无法读取（{why}）；请存成不大于 {MOST_BYTES} 字节的 UTF-8 文本"
        text = f"{path}: {why}; save it as UTF-8 text of at most {MOST_BYTES} bytes"
        raise SiteError("bad_template", text, zh) from None
    return text
