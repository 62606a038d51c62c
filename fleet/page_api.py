"""Serve the fleet's page, and what it asks for each second: robots, changed missions, the stop.

A page polls ``GET /v1/page``; a stream of changes would carry the same some kB, since positions
change each time, and need a second way to send the token. What robots say is cut to what is drawn.
"""

from __future__ import annotations

import asyncio
import math
from typing import TYPE_CHECKING, Annotated, Any

import sqlalchemy as sa
from fastapi import Header, Query, Request
from starlette.responses import HTMLResponse, Response

from fleet.errors import WORDS, FleetError, tell
from fleet.page_maps import MapShelf
from fleet.tables import stops
from pons_assets import PAGE
from pons_assets.built_page import load_page

if TYPE_CHECKING:
    from collections.abc import Callable

    from fastapi import FastAPI

    from fleet.desk import Desk
    from fleet.records import MissionRow, RobotRow
    from fleet.watch import RobotWatch

ENTRY = "fleet.html"
MOST_MISSIONS = 100
MOST_CHARACTERS = 120
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

Cursor = Annotated[int | None, Query(ge=0, le=2**53)]
Accepts = Annotated[str, Header(alias="accept-encoding")]
Known = Annotated[str, Header(alias="if-none-match")]


def add_page(
    app: FastAPI, desk: Desk, view_mission: Callable[[MissionRow], dict[str, Any]]
) -> None:
    """Add the page and what it asks for."""
    _files(app)
    shelf = MapShelf()

    @app.get("/v1/page", operation_id="watch_page")
    async def page(request: Request, after: Cursor = None) -> dict[str, Any]:
        """Show all at once: robots, missions that changed after a cursor, the newest stop."""
        held = await asyncio.to_thread(desk.store.missions_at_robots)
        stop, unstopped = await asyncio.to_thread(newest_stop, desk.store.engine)
        if after is None:
            missions = await desk.newest(MOST_MISSIONS)
            cursor = max((each.change for each in missions), default=0)
        else:
            missions, cursor = await desk.changed_since(after, MOST_MISSIONS)
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
            "stop": None if stop is None else await desk.stops.state(stop),
        }  # fmt: skip

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


def newest_stop(engine: sa.Engine) -> tuple[str | None, frozenset[str]]:
    """Return the newest stop's id, and the robots that have not confirmed some stop."""
    newest = sa.select(stops.c.id).order_by(stops.c.asked_unix_s.desc()).limit(1)
    waiting = sa.select(stops.c.robot).where(stops.c.confirmed_unix_s.is_(None)).distinct()
    with engine.begin() as connection:
        found = connection.execute(newest).scalar()
        return found, frozenset(connection.execute(waiting).scalars())


def view_robot(
    row: RobotRow,
    watch: RobotWatch,
    mission_id: str | None,
    shelf: MapShelf,
    *,
    is_unstopped: bool,
) -> dict[str, Any]:
    """Return a robot as the page draws it, whatever it told of itself."""
    card, status = row.capabilities, _fields(watch.told.get("status"))
    shown = shelf.look(watch, card)
    trouble = watch.trouble if watch.trouble in WORDS else None
    return {
        "name": row.name, "url": row.url,
        "state": watch.state,
        "is_silent": watch.is_silent, "heard_unix_s": watch.heard_unix_s,
        "message": tell(trouble, {"name": row.name, "found": "?"}) if trouble else None,
        "mission": mission_id, "unstopped": is_unstopped,
        "mode": _text(status.get("mode")), "room": _text(watch.told.get("room")),
        "battery": _share(_fields(status.get("drive")).get("battery")),
        "base_in_map": _pose(status.get("base_in_map")),
        "radius_m": _number(card.get("radius_m"), 0.05, 2.0) or 0.3,
        "site": _text(card.get("site")), "release": _text(card.get("release")),
        "map": shown.digest if shown else None, "map_trouble": shown.trouble if shown else None,
    }  # fmt: skip


def _fields(told: object) -> dict[str, Any]:
    return told if isinstance(told, dict) else {}


def _text(told: object) -> str | None:
    return told[:MOST_CHARACTERS] if isinstance(told, str) else None


def _number(told: object, low: float, high: float) -> float | None:
    is_number = isinstance(told, int | float) and not isinstance(told, bool)
    return float(told) if is_number and low <= told <= high else None  # type: ignore[arg-type,operator]


def _share(told: object) -> float | None:
    return _number(told, 0.0, 1.0)


def _pose(told: object) -> dict[str, float] | None:
    at = _fields(told)
    x_m, y_m = (_number(at.get(name), -1e4, 1e4) for name in ("x_m", "y_m"))
    yaw_rad = _number(at.get("yaw_rad"), -1e3, 1e3)
    if x_m is None or y_m is None or yaw_rad is None:
        return None
    return {"x_m": x_m, "y_m": y_m, "yaw_rad": math.remainder(yaw_rad, math.tau)}
