"""Serve the fleet over HTTP: robots, missions, answers, stops. Translates; decides nothing."""

from __future__ import annotations

from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Annotated, Any, Literal

from fastapi import FastAPI, Header, Query
from fastapi.exceptions import RequestValidationError
from pydantic import Field, StrictBool, model_validator
from sqlalchemy.exc import SQLAlchemyError
from starlette.exceptions import HTTPException

from fleet.access import AccessDoor, problem
from fleet.addressee import Addressee, to_names
from fleet.errors import FleetError, tell
from fleet.house_api import FleetBody, house_routes
from fleet.page_api import add_page
from fleet.records import MissionRow, show_mission

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable

    from fastapi import Request
    from starlette.responses import Response
    from starlette.types import ASGIApp

    from fleet.access import FleetAccess
    from fleet.carrier import CarrierLock
    from fleet.desk import Desk

MAX_TEXT_CHARACTERS = 4_000
Key = Annotated[str | None, Header(alias="Idempotency-Key", min_length=1, max_length=180,
                                   pattern=r"\S")]  # fmt: skip
Cursor = Annotated[int | None, Query(ge=0, le=2**53)]
Limit = Annotated[int, Query(ge=1, le=200)]
Names = Annotated[tuple[str, ...], Field(min_length=1, max_length=1_000)]


class NewMission(FleetBody):
    """Give an order in words, or as steps for the robots; the words may say to whom."""

    text: Annotated[str, Field(max_length=MAX_TEXT_CHARACTERS)] | None = None
    steps: Annotated[list[dict[str, Any]], Field(min_length=1, max_length=64)] | None = None
    to: Literal["any", "nearest", "each"] | Names | None = None
    """Who goes, or these robots; without it the words are asked, and then the nearest goes."""
    all_but: Names | None = None
    confirm: StrictBool = False
    """Each robot shows its plan and waits for a yes."""

    @model_validator(mode="after")
    def _given_once(self) -> NewMission:
        if (self.text is None) == (self.steps is None):
            raise ValueError("give text or steps, one of the two")
        if self.to is not None and self.all_but is not None:
            raise ValueError("give to or all_but, one of the two")
        return self

    def addressee(self, known: tuple[str, ...]) -> Addressee | None:
        """Return who may go as the fields say; None: the words may say it."""
        if self.all_but is not None:
            left_out = to_names(self.all_but, known)
            return Addressee("each", tuple(name for name in known if name not in left_out))
        if self.to is None:
            return None
        if isinstance(self.to, str):
            return Addressee(self.to, known if self.to == "each" else ())
        names = to_names(self.to, known)
        return Addressee("named" if len(names) == 1 else "each", names)


class MissionAnswer(FleetBody):
    """Answer what a mission asks."""

    text: Annotated[str, Field(min_length=1, max_length=MAX_TEXT_CHARACTERS)]


class MissionCancel(FleetBody):
    """End a mission; ``give_up`` ends one whose robot is silent, without knowing what it did."""

    give_up: StrictBool = False


class FleetStop(FleetBody):
    """Stop these robots; without names, all."""

    robots: Names | None = None


def build_app(desk: Desk, access: FleetAccess, url: str, lock: CarrierLock) -> ASGIApp:
    """Return the application; it starts the desk and ends it."""

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        await desk.start(url, lock)
        try:
            yield
        finally:
            await desk.close()

    app = FastAPI(title="Pons fleet", lifespan=lifespan, docs_url=None, redoc_url=None)
    for kind in (FleetError, SQLAlchemyError, RequestValidationError, HTTPException):
        app.add_exception_handler(kind, _refuse)
    _robots(app, desk)
    view = mission_view(desk)
    _missions(app, desk, view)
    app.include_router(house_routes(desk, view))
    add_page(app, desk, view)
    return AccessDoor(app, access)


def _robots(app: FastAPI, desk: Desk) -> None:
    @app.get("/healthz", operation_id="get_health")
    async def health() -> dict[str, Any]:
        """Say whether the service carries missions, how many, and how many the sweeper began."""
        return {"carries": desk.is_carrier, "running": len(desk.running), "swept": desk.swept,
                "robots": len(desk.watches)}  # fmt: skip

    @app.get("/v1/robots", operation_id="list_robots")
    async def robots() -> dict[str, Any]:
        """List the robots: where each is, what it does, and since when it is silent."""
        return {"robots": await desk.show_robots()}

    @app.post("/v1/stop", operation_id="stop_robots")
    async def stop(order: FleetStop | None = None) -> dict[str, Any]:
        """Stop robots, and tell who has confirmed; the others are told until they do."""
        return await desk.stops.stop(order.robots if order is not None else None)

    @app.get("/v1/stop/{stop_id}", operation_id="get_stop")
    async def stop_state(stop_id: str) -> dict[str, Any]:
        """Tell who has confirmed a stop by now."""
        return await desk.stops.state(stop_id)


def _missions(app: FastAPI, desk: Desk, view: Callable[[MissionRow], dict[str, Any]]) -> None:

    @app.post("/v1/missions", status_code=202, operation_id="give_mission")
    async def give(new: NewMission, idempotency_key: Key = None) -> dict[str, Any]:
        """Give an order: one mission, or one to each robot that it is said to.

        A bare stop stops at once and makes none. The same key and order make the same missions.
        """
        addressee = new.addressee(tuple(sorted(desk.watches)))
        if new.text is not None and addressee is None:
            stopped = desk.stops.robots_of(new.text)
            if stopped is not None:
                return {"missions": [], "stop": await desk.stops.stop(stopped)}
        missions = await desk.order(
            new.text, new.steps, addressee, idempotency_key, confirm=new.confirm
        )
        return {"missions": [view(each) for each in missions], "stop": None}

    @app.get("/v1/missions", operation_id="list_missions")
    async def several(after: Cursor = None, limit: Limit = 50) -> dict[str, Any]:
        """List missions: open ones first, then the newest; with ``after`` what changed since."""
        if after is None:
            return {"missions": [view(each) for each in await desk.newest(limit)]}
        changed, cursor = await desk.changed_since(after, limit)
        return {"missions": [view(each) for each in changed], "next": cursor}

    @app.get("/v1/missions/{mission_id}", operation_id="get_mission")
    async def one(mission_id: str) -> dict[str, Any]:
        """Show one mission."""
        return view(await desk.find(mission_id))

    @app.post("/v1/missions/{mission_id}/answer", operation_id="answer_mission")
    async def answer(mission_id: str, reply: MissionAnswer) -> dict[str, Any]:
        """Pass an answer on to the robot that asked."""
        return view(await desk.answer(mission_id, reply.text))

    @app.post("/v1/missions/{mission_id}/cancel", operation_id="cancel_mission")
    async def cancel(mission_id: str, how: MissionCancel | None = None) -> dict[str, Any]:
        """End a mission; its robot is told until it confirms."""
        asked = how or MissionCancel()
        return view(await desk.cancel(mission_id, give_up=asked.give_up))


def mission_view(desk: Desk) -> Callable[[MissionRow], dict[str, Any]]:
    """Return how a mission is shown: with what it waits for, and who could take it instead."""

    def view(mission: MissionRow) -> dict[str, Any]:
        shown = show_mission(mission)
        if not desk.is_carrier:  # who stands by knows of no robot whether it is free
            return {**shown, "instead": []}
        if (waits_for := desk.dispatcher.waits_for(mission)) is not None:
            shown["reason"], shown["message"] = waits_for, tell(waits_for)
        return {**shown, "instead": desk.dispatcher.instead_of(mission)}

    return view


async def _refuse(_: Request, error: Exception) -> Response:
    match error:
        case FleetError():
            return problem(error)
        case SQLAlchemyError():
            return problem(FleetError("store_unavailable", type(error).__name__))
        case RequestValidationError():
            first = error.errors()[0]
            at = ".".join(str(part) for part in first["loc"])
            return problem(FleetError("invalid_request", why=f"{at}: {first['msg']}"[:300]))
        case _:
            return problem(FleetError("unknown_route"))
