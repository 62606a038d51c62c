"""Serve the fleet's page, and what it asks for each second: robots, changed missions, the stop.

A page polls ``GET /v1/page``; a stream of changes would carry the same some kB, since positions
change each time, and need a second way to send the token.

Maps are fetched while somebody looks, judged, and named by their content, which robots may share: a
map's id alone proves nothing. One that is too large, broken or nonsense is refused alone.
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

from fastapi import Header, Query, Request
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator
from starlette.responses import HTMLResponse, Response

from fleet.errors import WORDS, FleetError, tell
from fleet.link import RobotAway, RobotBusy, RobotRefusal
from fleet.stops import tell_stop
from fleet.watch import show_robot
from pons_assets import PAGE
from pons_assets.built_page import load_page

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from fastapi import FastAPI

    from fleet.desk import Desk
    from fleet.records import MissionRow, RobotRow
    from fleet.watch import RobotWatch

log = logging.getLogger(__name__)

ENTRY = "fleet.html"
MOST_MISSIONS = 100
FOREVER = "private, max-age=31536000, immutable"
NOT_BUILT = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Pons: the page is not built</title></head><body>
<h1>Pons fleet</h1>
<p>The fleet runs, but its page is not built. Run <code>make page</code> and start again.</p>
<p lang="zh">车队已运行，但网页尚未构建。请运行 <code>make page</code> 后重新启动。</p>
<pre>pons fleet list
pons fleet say "everybody go home"
pons fleet stop</pre>
</body></html>
"""

MAX_CELLS = 2_900_000
"""A map of 85 m by 85 m in cells of 5 cm; more does not fit an answer that the link accepts."""
MAX_PLACES = 300
MAX_HELD_BYTES = 24_000_000
"""Of all maps together, squeezed."""
REFRESH_S = 60.0
"""So often a robot is asked again while somebody looks: places are taught, a home is mapped."""
AGAIN_S = 10.0
AT_ONCE = 2

Cursor = Annotated[int | None, Query(ge=0, le=2**53)]
Accepts = Annotated[str, Header(alias="accept-encoding")]
Known = Annotated[str, Header(alias="if-none-match")]
Metres = Annotated[float, Field(ge=-10_000.0, le=10_000.0)]
Outline = Annotated[list[tuple[Metres, Metres]], Field(max_length=2_000)]
Outlines = Annotated[list[Outline], Field(max_length=500)]


def add_page(
    app: FastAPI, desk: Desk, view_mission: Callable[[MissionRow], dict[str, Any]]
) -> None:
    """Add the page and what it asks for."""
    _files(app)
    shelf = MapShelf()

    @app.get("/v1/page", operation_id="watch_page")
    async def page(request: Request, after: Cursor = None) -> dict[str, Any]:
        """Show all at once: robots, missions that changed after a cursor, the newest stop."""
        missions, cursor, held, unstopped, stop = await asyncio.to_thread(read, after)
        rows = desk.rows()
        shelf.forget_but(row.name for row in rows)
        return {
            "you": getattr(request.state, "role", "viewer"),
            "robots": [
                view_robot(row, desk.watches[row.name], held.get(row.name), shelf,
                           is_unstopped=row.name in unstopped)
                for row in rows
            ],
            "missions": [view_mission(each) for each in missions], "next": cursor,
            "stop": None if stop is None else tell_stop(*stop),
        }  # fmt: skip

    def read(after: int | None) -> tuple[Any, ...]:
        """Read all rows of one answer in one turn of a thread."""
        store = desk.store
        if after is None:
            missions = store.newest(MOST_MISSIONS)
            cursor = max((each.change for each in missions), default=0)
        else:
            missions, cursor = store.changed_since(after, MOST_MISSIONS)
        unstopped = store.unconfirmed_stops()
        return missions, cursor, store.missions_at_robots(), unstopped, store.newest_stop()

    @app.get("/v1/maps/{digest}", operation_id="get_map", response_model=None)
    async def one_map(digest: str) -> Response:
        """Show a map, with its places, by the name that a robot of ``/v1/page`` gives it."""
        squeezed = shelf.find(digest)
        if squeezed is None:
            raise FleetError("unknown_map")
        headers = {"content-encoding": "gzip", "cache-control": FOREVER}
        return Response(squeezed, 200, headers, "application/json")


def _files(app: FastAPI) -> None:
    assets = load_page(PAGE)

    @app.get("/", include_in_schema=False, response_model=None)
    async def entry(accepts: Accepts = "", known: Known = "") -> Response:
        if ENTRY not in assets:
            return HTMLResponse(NOT_BUILT, headers={"cache-control": "no-cache"})
        status, headers, body = assets[ENTRY].answer(accepts, known)
        return Response(body, status, headers)

    @app.get("/assets/{name}", include_in_schema=False, response_model=None)
    async def asset(name: str, accepts: Accepts = "", known: Known = "") -> Response:
        found = assets.get(f"assets/{name}")
        if found is None:
            raise FleetError("unknown_route")
        status, headers, body = found.answer(accepts, known)
        return Response(body, status, headers)


def view_robot(
    row: RobotRow, watch: RobotWatch, mission_id: str | None, shelf: MapShelf, *, is_unstopped: bool
) -> dict[str, Any]:
    """Return a robot as the page draws it."""
    card, map_shown = row.capabilities, shelf.look(watch, row.capabilities)
    trouble = watch.trouble if watch.trouble in WORDS else None
    return {
        **show_robot(row, watch, mission_id),
        "is_silent": watch.is_silent, "unstopped": is_unstopped,
        "message": tell(trouble, {"name": row.name, "found": "?"}) if trouble else None,
        "radius_m": card.get("radius_m") or 0.3,
        "map": map_shown.digest if map_shown else None,
        "map_trouble": map_shown.trouble if map_shown else None,
    }  # fmt: skip


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
