"""Serve the pictures that patrols kept: a list, one by its number, and an order to forget it."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Path, Query
from starlette.responses import Response

from planner.api.problems import HttpProblem
from planner.language.catalogue import say
from planner.language.object_names import name_object
from planner.memory import FactRefusal

if TYPE_CHECKING:
    from planner.api.interfaces import Services
    from planner.memory import KeptPicture

PictureId = Annotated[int, Path(ge=1, le=2**62)]
GoalId = Annotated[str | None, Query(max_length=80)]


def routes(services: Services) -> APIRouter:
    """Return the routes of pictures; who may see the camera may see them."""
    router = APIRouter(prefix="/v1/pictures", tags=["memory"])

    @router.get("", operation_id="list_pictures")
    async def pictures(goal: GoalId = None) -> dict[str, Any]:
        """List the pictures that patrols kept, of one goal or of all, the newest patrol first."""
        try:
            kept = await services.recollection.list_pictures(goal)
        except FactRefusal as refused:
            raise _unavailable(refused) from None
        return {"pictures": [picture_view(each) for each in kept]}

    @router.get(
        "/{picture_id}",
        operation_id="get_picture",
        response_class=Response,
        responses={200: {"content": {"image/jpeg": {}, "image/png": {}}}},
    )
    async def picture(picture_id: PictureId) -> Response:
        """Give one picture as the camera gave it."""
        try:
            found = await services.recollection.picture(picture_id)
        except FactRefusal as refused:
            raise _unavailable(refused) from None
        if found is None:
            raise _unknown(picture_id)
        kept, data = found
        headers = {"cache-control": "no-store", "x-content-type-options": "nosniff"}
        return Response(data, media_type=kept.media_type, headers=headers)

    @router.delete("/{picture_id}", operation_id="forget_picture")
    async def forget(picture_id: PictureId) -> dict[str, Any]:
        """Forget one picture."""
        try:
            gone = await services.recollection.forget_picture(picture_id)
        except FactRefusal as refused:
            raise _unavailable(refused) from None
        if not gone:
            raise _unknown(picture_id)
        return {"forgotten": 1}

    return router


def picture_view(kept: KeptPicture) -> dict[str, Any]:
    """Return what is known of a picture as people and pages read it."""
    return {
        "id": kept.id,
        "goal": kept.goal,
        "step": kept.step,
        "stop": kept.stop,
        "place": kept.place,
        "taken_unix_s": round(kept.taken_unix_s, 1),
        "age_s": round(max(0.0, time.time() - kept.taken_unix_s), 1),
        "media_type": kept.media_type,
        "bytes": kept.size,
        "names": [name_object(label).model_dump() for label in dict.fromkeys(kept.labels)],
    }


def _unknown(picture_id: int) -> HttpProblem:
    detail = f"got {picture_id}; GET /v1/pictures lists what there is"
    said = say("memory.unknown_picture").model_dump()
    return HttpProblem(404, "unknown_picture", detail, message=said)


def _unavailable(refused: FactRefusal) -> HttpProblem:
    return HttpProblem(503, refused.code, refused.detail, message=refused.said.model_dump())
