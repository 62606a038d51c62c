"""Serve the places: the site's own and the taught ones; teach and forget. An operator's act."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, Response
from pydantic import ConfigDict, Field, model_validator

from maps.room_proposals import RoomProposal
from planner.api.interfaces import Services
from planner.api.problems import HttpProblem
from planner.api.schemas import Body, Source, law_broken
from planner.language.catalogue import say
from planner.site import MAX_HERE, PlaceRefusal, TaughtPlace
from planner.site.known_places import KeptPlace, KnownPlaces, Lesson
from wire import Pose2
from wire.geometry import Metres, Yaw

_STATUS = {
    "unknown_room": 404,
    "unknown_taught_place": 404,
    "place_of_site": 409,
    "place_name_taken": 409,
    "places_full": 409,
    "pose_unknown": 409,
    "robot_moving": 409,
    "map_mismatch": 409,
    "route_unavailable": 503,
    "places_unwritable": 503,
    "disk_full": 507,
}

Said = Annotated[str, Field(min_length=1, max_length=200)]
PlaceId = Annotated[str, Path(pattern=r"^[a-z][a-z0-9_]{0,63}$")]
Named = Annotated[str, Path(min_length=1, max_length=200)]


class PlaceNames(Body):
    """Name a place in one language or both."""

    en: Said | None = None
    zh: Said | None = None


class Point(Body):
    """Give a point of ``map``; without a heading it is the robot's of now."""

    model_config = ConfigDict(strict=True)  # true is no 1, and text no number

    x_m: Metres
    y_m: Metres
    yaw_rad: Yaw | None = None


class NewPlace(Body):
    """Teach a place: where the robot stands, at a free point of the map, or a proposed room."""

    name: PlaceNames
    point: Point | None = None
    room: Annotated[str, Field(min_length=1, max_length=40)] | None = None
    source: Source = "api"

    @model_validator(mode="after")
    def _one_spot(self) -> NewPlace:
        if self.point is not None and self.room is not None:
            raise law_broken("point_or_room")
        return self


def routes(services: Services) -> APIRouter:
    """Return the routes of places."""
    router = APIRouter(prefix="/v1/places", tags=["places"])

    @router.get("", operation_id="list_places")
    async def places() -> dict[str, Any]:
        """List rooms and places with their names in both languages, and all that was taught."""
        return places_view(services)

    @router.post("", status_code=201, operation_id="teach_place")
    async def teach(new: NewPlace, response: Response) -> dict[str, Any]:
        """Keep a place by its name; a name that was taught before is moved here (200)."""
        return await _teach(services, new, None, response)

    @router.put("/{place_id}", status_code=201, operation_id="put_place")
    async def put(place_id: PlaceId, new: NewPlace, response: Response) -> dict[str, Any]:
        """Keep a place under an id of one's own; 200 where that one was taught before."""
        return await _teach(services, new, place_id, response)

    @router.delete("/{place_id}", operation_id="forget_place")
    async def forget(place_id: Named) -> dict[str, Any]:
        """Forget a taught place, by id or name, of this map or another."""
        try:
            gone = await services.memory.forget(place_id, other_maps=True)
        except PlaceRefusal as refused:
            raise _problem(refused) from None
        return _record(gone)

    return router


def places_view(services: Services) -> dict[str, Any]:
    """Return the known places; ``version`` changes with them."""
    memory = services.memory
    return {
        "version": memory.version,
        "home": memory.site.home.id,
        "places": memory.places,
        "taught": [_view(kept) for kept in memory.taught_places],
        "proposed_rooms": [_view_proposal(memory, room) for room in memory.proposed_rooms],
        "most": MAX_HERE,
    }


def _view_proposal(memory: KnownPlaces, room: RoomProposal) -> dict[str, Any]:
    """Return a proposed room with the place that has its middle, if one has."""
    known = memory.room_at(room.pose.x_m, room.pose.y_m)
    return {**room.model_dump(mode="json"), "known_as": known.id if known is not None else None}


async def _teach(
    services: Services, new: NewPlace, place_id: str | None, response: Response
) -> dict[str, Any]:
    lesson = Lesson(
        en=new.name.en,
        zh=new.name.zh,
        pose=_pose(services, new.point),
        by=new.source,
        place_id=place_id,
        room=new.room,
    )
    try:
        place, first = await services.memory.teach(lesson)
    except PlaceRefusal as refused:
        raise _problem(refused) from None
    if not first:
        response.status_code = 200
    return _record(place)


def _pose(services: Services, point: Point | None) -> Pose2 | None:
    if point is None:
        return None
    status = services.robot.status
    here = status.base_in_map if status is not None else None
    yaw_rad = point.yaw_rad
    if yaw_rad is None:
        yaw_rad = here.yaw_rad if here is not None else 0.0
    return Pose2(point.x_m, point.y_m, yaw_rad)


def _record(place: TaughtPlace) -> dict[str, Any]:
    return place.model_dump(mode="json")


def _view(kept: KeptPlace) -> dict[str, Any]:
    """Return a taught place with the reason why it can't be driven to, where there is one."""
    message = None
    if kept.why_not is not None:
        message = say(f"taught_place.{kept.why_not}").model_dump()
    return {**_record(kept.place), "why_not": kept.why_not, "message": message}


def _problem(refused: PlaceRefusal) -> HttpProblem:
    status = _STATUS.get(refused.code, 422)
    said = refused.why.model_dump()
    return HttpProblem(status, refused.code, refused.detail, message=said)
