"""Keep the robots' maps for the page: fetched while somebody looks, judged, named by content.

A map is what a robot says: one that is too large, broken or nonsense is refused and the others are
shown. Robots share a map where its content is the same; a map's id alone proves nothing.
"""

from __future__ import annotations

import asyncio
import base64
import binascii
import gzip
import hashlib
import logging
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from fleet.link import RobotAway, RobotBusy, RobotRefusal

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fleet.watch import RobotWatch

log = logging.getLogger(__name__)

MAX_CELLS = 2_900_000
"""A map of 85 m by 85 m in cells of 5 cm; more does not fit an answer that the link accepts."""
MAX_PLACES = 300
MAX_HELD_BYTES = 24_000_000
"""Of all maps together, squeezed."""
REFRESH_S = 60.0
"""So often a robot is asked again while somebody looks: places are taught, a home is mapped."""
AGAIN_S = 10.0
AT_ONCE = 2

Metres = Annotated[float, Field(ge=-10_000.0, le=10_000.0)]
Outline = Annotated[list[tuple[Metres, Metres]], Field(max_length=2_000)]
Outlines = Annotated[list[Outline], Field(max_length=500)]


class DrawnShape(BaseModel):
    """Take the fields that are drawn and no others."""

    model_config = ConfigDict(extra="ignore", frozen=True, allow_inf_nan=False)


class OriginShape(DrawnShape):
    """Hold the map's lower left corner [m]."""

    x_m: Metres
    y_m: Metres


class DrawnPose(OriginShape):
    """Hold where something is in the map."""

    yaw_rad: Annotated[float, Field(ge=-1_000.0, le=1_000.0)] = 0.0


class SpeedZoneShape(DrawnShape):
    """Hold where a robot drives slower."""

    polygon: Outline
    max_speed_mps: Annotated[float, Field(ge=0.0, le=100.0)]


class FenceShape(DrawnShape):
    """Hold where a robot may be."""

    allowed: Outlines = []
    keep_outs: Outlines = []
    speed_zones: Annotated[list[SpeedZoneShape], Field(max_length=500)] = []


class MapPicture(DrawnShape):
    """Hold a map as a robot's ``GET /v1/map`` tells it; cells are a byte each, in base64."""

    map_id: Annotated[str, Field(max_length=64)]
    width: Annotated[int, Field(ge=1, le=MAX_CELLS)]
    height: Annotated[int, Field(ge=1, le=MAX_CELLS)]
    resolution_m: Annotated[float, Field(ge=0.005, le=1.0)]
    origin: OriginShape
    cells: str
    growing: None = None
    fence: FenceShape = FenceShape()

    @model_validator(mode="after")
    def _whole(self) -> MapPicture:
        if not self.width * self.height <= MAX_CELLS:
            raise ValueError("too many cells")
        try:
            count = len(base64.b64decode(self.cells, validate=True))
        except binascii.Error:
            raise ValueError("cells are no base64") from None
        if count != self.width * self.height:
            raise ValueError("not as many cells as it says")
        return self


class NameShape(DrawnShape):
    """Hold a place's name in both languages."""

    en: Annotated[str, Field(max_length=120)] = ""
    zh: Annotated[str, Field(max_length=120)] = ""


class PlaceShape(DrawnShape):
    """Hold a room or a place of a robot's card."""

    id: Annotated[str, Field(max_length=120)]
    kind: Literal["room", "place"] = "place"
    name: NameShape
    polygon: Outline | None = None
    pose: DrawnPose


@dataclass(frozen=True, slots=True)
class MapShown:
    """Hold which map a robot shows, or why none."""

    map_id: str
    digest: str | None
    trouble: str | None
    again_s: float


class MapShelf:
    """Hold the maps of all robots, each content once."""

    def __init__(self) -> None:
        self._squeezed: dict[str, bytes] = {}
        self._shown: dict[str, MapShown] = {}
        self._asking: dict[str, asyncio.Task[None]] = {}
        self._turn = asyncio.Semaphore(AT_ONCE)

    def find(self, digest: str) -> bytes | None:
        """Return a map by the name of its content, as squeezed JSON."""
        return self._squeezed.get(digest)

    def look(self, watch: RobotWatch, card: Mapping[str, Any]) -> MapShown | None:
        """Return what is known of a robot's map now; begin to ask where that is old."""
        known, map_id = self._shown.get(watch.name), str(card.get("map_id"))[:64]
        is_due = known is None or known.map_id != map_id or time.monotonic() > known.again_s
        if watch.is_ready and is_due and watch.name not in self._asking:
            task = asyncio.create_task(self._ask(watch, map_id, card.get("places")))
            self._asking[watch.name] = task
            task.add_done_callback(lambda _: self._asking.pop(watch.name, None))
        return known

    def forget_but(self, names: Iterable[str]) -> None:
        """Let go of robots that are no more, and of maps that none shows."""
        kept = set(names)
        self._shown = {name: shown for name, shown in self._shown.items() if name in kept}
        used = {shown.digest for shown in self._shown.values()}
        self._squeezed = {name: raw for name, raw in self._squeezed.items() if name in used}

    async def _ask(self, watch: RobotWatch, map_id: str, places: object) -> None:
        before = self._shown.get(watch.name)
        kept = before.digest if before is not None and before.map_id == map_id else None
        async with self._turn:
            try:
                told = await watch.link.get("/v1/map")
                digest, squeezed = await asyncio.to_thread(read_map, told, places)
                held = sum(map(len, self._squeezed.values()))
                if digest not in self._squeezed and not held + len(squeezed) <= MAX_HELD_BYTES:
                    raise ValueError("the maps together are too large")
            except RobotRefusal as refused:
                shown = MapShown(map_id, None, refused.code, time.monotonic() + AGAIN_S)
            except (RobotAway, RobotBusy) as away:
                log.info("map of %s: %s", watch.name, away)
                shown = MapShown(map_id, kept, "map_refused", time.monotonic() + AGAIN_S)
            except (ValueError, RecursionError) as wrong:
                log.warning("map_refused: %s: %s", watch.name, str(wrong)[:300])
                shown = MapShown(map_id, None, "map_refused", time.monotonic() + REFRESH_S)
            else:
                self._squeezed[digest] = squeezed
                shown = MapShown(map_id, digest, None, time.monotonic() + REFRESH_S)
        self._shown[watch.name] = shown


def read_map(told: object, places: object) -> tuple[str, bytes]:
    """Return the name of a map's content, and it as squeezed JSON with the places that are whole.

    Raises:
        ValueError: it is no map.
    """
    picture = MapPicture.model_validate(told)
    listed = places if isinstance(places, list) else []
    found = [place for each in listed[:MAX_PLACES] if (place := _place(each)) is not None]
    raw = picture.model_dump_json()[:-1] + ',"places":['
    raw += ",".join(place.model_dump_json() for place in found) + "]}"
    squeezed = gzip.compress(raw.encode(), 6, mtime=0)
    return hashlib.sha256(raw.encode()).hexdigest()[:32], squeezed


def _place(told: object) -> PlaceShape | None:
    try:
        place = PlaceShape.model_validate(told)
    except ValidationError:
        return None
    name = place.name
    both = NameShape(en=name.en or name.zh or place.id, zh=name.zh or name.en or place.id)
    return place.model_copy(update={"name": both})
